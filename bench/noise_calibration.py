#!/usr/bin/env python3
"""Measures the accuracy of a picture's stderr layer: how often the truth is within its 95 % interval.

  bench/noise_calibration.py SCENE [SCENE ...] [--integrator mixed ...] [--passes 64] [--renders 100] [--resolution 96x64]

Renders each scene with --renders seeds, and a reference with many more passes and another seed. Compares each render with
the reference (`nephroid compare`, which allows for the reference's own error). Prints a table in Markdown: the share of
pixels and channels whose difference is within 1.96 standard errors, as the mean over all renders and the least and most of
one; and the rms of z, which is 1 where the stated error is the true one. docs/measurements/validation.md keeps the results.
"""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = ROOT / "build/release/bin/nephroid"
REFERENCE = 32  # passes of the reference, relative to a render


def run(arguments):
    result = subprocess.run([str(a) for a in arguments], capture_output=True, text=True)
    if result.returncode != 0:
        sys.exit(f"{' '.join(map(str, arguments))}\n{result.stderr}")
    return result.stdout


def render(args, scene, integrator, passes, seed, out):
    run([PROGRAM, "render", scene, "-o", out, "--integrator", integrator, "--resolution", args.resolution,
         "--passes", passes, "--seed", seed, "--quiet"])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", type=pathlib.Path, nargs="+")
    parser.add_argument("--integrator", nargs="+", default=["mixed"])
    parser.add_argument("--passes", type=int, default=64)
    parser.add_argument("--renders", type=int, default=100)
    parser.add_argument("--resolution", default="96x64")
    args = parser.parse_args()
    print("| scene | integrator | within the 95 % interval | least of one render | most of one render | rms of z |\n| --- | --- | --- | --- | --- | --- |")
    with tempfile.TemporaryDirectory() as directory:
        reference, picture = pathlib.Path(directory, "reference.exr"), pathlib.Path(directory, "picture.exr")
        for scene in args.scenes:
            for integrator in args.integrator:
                render(args, scene, integrator, REFERENCE * args.passes, 0, reference)
                shares, squares = [], []
                for seed in range(1, args.renders + 1):
                    render(args, scene, integrator, args.passes, seed, picture)
                    figures = dict(re.findall(r"(z_\w+)=([-+\d.einf]+)", run([PROGRAM, "compare", reference, picture])))
                    shares.append(float(figures["z_in_95"]))
                    squares.append(float(figures["z_rms"]) ** 2)
                name = scene.parent.name if scene.stem == "scene" else scene.stem
                print(f"| {name} | {integrator} | {100 * sum(shares) / len(shares):.1f} % | {100 * min(shares):.1f} % "
                      f"| {100 * max(shares):.1f} % | {(sum(squares) / len(squares)) ** 0.5:.2f} |", flush=True)


if __name__ == "__main__":
    main()
