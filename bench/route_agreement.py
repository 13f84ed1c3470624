#!/usr/bin/env python3
"""Tests that pictures do not depend on how paths are divided among routes. Renders every scene of a folder with
several presets of routes and independent seeds, and compares block means of the pictures by Student's t.

  bench/route_agreement.py --scenes DIR [--only NAME ...] [--preset NAME ...] [--seeds 8] [--passes 24]
                           [--size 96] [--camera-samples 4] [--light EXPR] [--out DIR]

A scene is DIR/NAME/scene.pbrt. All presets are compared with the first one. Merged light is extrapolated to a
radius of zero, as its bias falls with r^2: 2 L(r/sqrt 2) - L(r), both with the same seeds. With --light only paths
that match the expression are compared, e.g. "C.*[DGVH].*L" for all but lamps seen directly or in mirrors. Columns:
ratio of the picture's mean to that of the first preset, with its standard error; the largest |t| over blocks, and
the bound that it exceeds by chance in one of a thousand tables; the largest deviation of the sum of route layers
from the picture, relative to the brightest of both. Needs NumPy and OpenImageIO (Debian: /usr/bin/python3).
"""
import argparse
import math
import pathlib
import subprocess
import sys

import numpy as np
import OpenImageIO as oiio

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = ROOT / "build/release/bin/nephroid"
ACROSS = 4  # blocks in each direction
RADIUS = 1.0


def run(arguments):
    result = subprocess.run([str(a) for a in arguments], capture_output=True, text=True)
    if result.returncode != 0:
        sys.exit(f"{' '.join(map(str, arguments))}\n{result.stderr}")
    return result.stdout + result.stderr


def resolution_of(scene, size):
    text = run([PROGRAM, "info", scene])
    width, height = map(int, text.split("resolution: ")[1].split()[0].split("x"))
    scale = min(1, size / max(width, height))
    return f"{max(ACROSS, round(width * scale))}x{max(ACROSS, round(height * scale))}"


def read(path):
    """The picture's R G B, its route layers by name, and the compared light."""
    image = oiio.ImageBuf(str(path))
    names = image.spec().channelnames
    pixels = image.get_pixels(oiio.FLOAT)
    text = image.spec().getattribute("nephroid:routes")
    routes = [line.split(" = ")[0] for line in text.splitlines()]
    layer = lambda name: np.stack([pixels[..., names.index(f"{name}.{c}")] for c in "RGB"], -1)
    picture = pixels[..., :3].astype(np.float64)
    compared = layer("compared").astype(np.float64) if "compared.R" in names else picture
    return picture, {r: layer(r) for r in routes}, compared


def blocks(picture):
    rows = np.array_split(picture.mean(-1), ACROSS, axis=0)
    return np.array([b.mean() for r in rows for b in np.array_split(r, ACROSS, axis=1)] +
                    [picture.mean()])


def t_quantile(p, df):
    """Two-sided: P(|t| > result) = p, by bisection over a numerical integral."""
    x = np.tan(np.linspace(0, math.pi / 2, 200001)[:-1])
    density = (1 + x * x / df) ** (-(df + 1) / 2)
    mass = np.concatenate([[0], np.cumsum((density[1:] + density[:-1]) / 2 * np.diff(x))])
    mass *= 0.5 / mass[-1]
    return float(np.interp(0.5 - p / 2, mass, x))


def values(scene, preset, options, out):
    """Block means as [seed][block], extrapolated for merging presets, and the largest deviation of the layers."""
    merges = any(m in line for line in run([PROGRAM, "routes", "--routes", preset]).splitlines()
                 for m in (" photons ", " sppm ", " photons+light "))
    worst = 0.0
    result = []
    for seed in range(options.seeds):
        found = []
        for radius in ([RADIUS, RADIUS * math.sqrt(0.5)] if merges else [RADIUS]):
            run([PROGRAM, "render", scene, "-o", out, "--routes", preset, "--quiet", "--seed",
                 1 + seed + 1000 * options.preset.index(preset), "--passes", options.passes,
                 "--resolution", options.resolution, "-D", f"radius={radius}", "-D",
                 f"camera-samples={options.camera_samples}",
                 *(["--aov", f"compared={options.light}"] if options.light else [])])
            picture, layers, compared = read(out)
            total = sum(layers.values())
            scale = np.maximum(np.maximum(abs(picture), sum(abs(l) for l in layers.values())), 1e-6)
            worst = max(worst, float((abs(total - picture) / scale).max()))
            found.append(blocks(compared))
        result.append(2 * found[1] - found[0] if merges else found[0])
    return np.array(result), worst


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", type=pathlib.Path, required=True)
    parser.add_argument("--only", nargs="+", default=[])
    parser.add_argument("--preset", nargs="+",
                        default=["doidge2012", "classic", "split", "path-only"])
    parser.add_argument("--program", type=pathlib.Path, default=PROGRAM)
    parser.add_argument("--seeds", type=int, default=8)
    parser.add_argument("--passes", type=int, default=24)
    parser.add_argument("--size", type=int, default=96)
    parser.add_argument("--camera-samples", type=int, default=4)
    parser.add_argument("--light")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/route_agreement"))
    options = parser.parse_args()
    globals()["PROGRAM"] = options.program
    options.out.mkdir(parents=True, exist_ok=True)
    bound = t_quantile(1 - (1 - 1e-3) ** (1 / (ACROSS * ACROSS)), 2 * options.seeds - 2)
    print(f"largest |t| by chance: {bound:.1f}\n")
    print("| scene | routes | mean ratio | largest \\|t\\| of a block | layers off by |")
    print("| --- | --- | --- | --- | --- |", flush=True)
    for folder in sorted(options.scenes.iterdir()):
        if options.only and folder.name not in options.only:
            continue
        scene = folder / "scene.pbrt"
        options.resolution = resolution_of(scene, options.size)
        reference = None
        for preset in options.preset:
            found, worst = values(scene, preset, options, options.out / f"{folder.name}.exr")
            mean = found.mean(0)
            error = found.std(0, ddof=1) / math.sqrt(options.seeds)
            if reference is None:
                reference = mean, error
                print(f"| {folder.name} | {preset} | {mean[-1]:.5g} ± {error[-1] / mean[-1]:.2%} | | "
                      f"{worst:.1e} |", flush=True)
                continue
            t = (mean - reference[0]) / np.maximum(np.hypot(error, reference[1]), 1e-12)
            ratio_error = math.hypot(error[-1], reference[1][-1]) / reference[0][-1]
            print(f"| {folder.name} | {preset} | {mean[-1] / reference[0][-1]:.4f} ± {ratio_error:.4f} | "
                  f"{abs(t[:-1]).max():.1f} | {worst:.1e} |", flush=True)


if __name__ == "__main__":
    main()
