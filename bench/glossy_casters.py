#!/usr/bin/python3
"""Measures the noise of caustics over the roughness of what casts them: a ball of glass and an open ring of gold on a floor.

  bench/glossy_casters.py [--alpha 0 0.05 0.1 0.2 0.5] [--lamp point ball window] [--seconds 8] [--integrator mixed]

Prints a Markdown table: variance times CPU seconds of the floor, where the caustics are, and of ball and ring. The variance is
that of two seeds: half their squared difference over the squared mean + 0.01, averaged over pixels and channels without the
worst 0.1 % of pixels. Needs the Python modules of OpenImageIO and NumPy (python3-openimageio, python3-numpy).
"""
import argparse
import pathlib
import tempfile

import numpy

from picture_file import read_channels
from real_sizes import render

LAMPS = {
    "point": 'LightSource "point" "rgb I" [18 17 16] "point3 from" [1 3 0.5]',
    "ball": """AttributeBegin AreaLightSource "diffuse" "rgb L" [2300 2170 2040]
               Translate 1 3 0.5 Shape "sphere" "float radius" 0.05 AttributeEnd""",
    "window": """AttributeBegin AreaLightSource "diffuse" "rgb L" [4.5 4.25 4] "bool twosided" true
                 Shape "bilinearmesh" "point3 P" [-1 1 2.5  1 1 2.5  -1 3 2.5  1 3 2.5] AttributeEnd""",
}
SCENE = """LookAt 0 2.2 -3.4  0 0.3 0  0 1 0
Camera "perspective" "float fov" 40
WorldBegin
{lamp}
Material "diffuse" "rgb reflectance" [0.5 0.5 0.5]
Shape "bilinearmesh" "point3 P" [-4 0 -4  4 0 -4  -4 0 4  4 0 4]
Material "dielectric" "bool remaproughness" false "float roughness" {alpha}
AttributeBegin Translate -0.6 0.501 0 Shape "sphere" "float radius" 0.5 AttributeEnd
Material "conductor" "spectrum eta" "metal-Au-eta" "spectrum k" "metal-Au-k"
  "bool remaproughness" false "float roughness" {alpha}
Translate 0.7 0.001 0 Rotate -90 1 0 0
Shape "cylinder" "float radius" 0.5 "float zmin" 0 "float zmax" 0.3
"""


def measured(scene, folder, options):
    """Pixels of R, G and B, the mask of the floor, and CPU seconds of a render."""
    out = folder / "picture.exr"
    cpu = render(scene, out, "480x360", options)
    pixels = read_channels(out, ["R", "G", "B", "N.Y"])
    out.unlink()
    return pixels[..., :3], numpy.abs(pixels[..., 3]) > 0.999, cpu


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--alpha", nargs="+", default=["0", "0.05", "0.1", "0.2", "0.5"])
    parser.add_argument("--lamp", nargs="+", default=list(LAMPS), choices=list(LAMPS))
    parser.add_argument("--seconds", type=float, default=8)
    parser.add_argument("--integrator", default="mixed")
    args = parser.parse_args()
    print("| lamp | alpha | floor | ball and ring |\n| --- | --- | --- | --- |", flush=True)
    for lamp in args.lamp:
        for alpha in args.alpha:
            with tempfile.TemporaryDirectory() as folder:
                folder = pathlib.Path(folder)
                scene = folder / "scene.pbrt"
                scene.write_text(SCENE.format(lamp=LAMPS[lamp], alpha=alpha))
                options = ["--integrator", args.integrator, "--time", f"{args.seconds}s"]
                (a, floor, cpu_a), (b, _, cpu_b) = [measured(scene, folder, [*options, "--seed", str(seed)])
                                                   for seed in (1, 2)]
            error = ((a - b) ** 2 / 2 / (((a + b) / 2) ** 2 + 0.01)).mean(axis=2)
            figures = []
            for part in (floor, ~floor):
                values = numpy.sort(error[part])
                figures.append(values[:len(values) - len(values) // 1000].mean() * (cpu_a + cpu_b) / 2)
            print(f"| {lamp} | {alpha} | {figures[0]:.2g} | {figures[1]:.2g} |", flush=True)


if __name__ == "__main__":
    main()
