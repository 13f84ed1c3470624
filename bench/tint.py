#!/usr/bin/python3
"""Measures the tint of one pass: how far its mean colour is from that of a long render.

  bench/tint.py SCENE [SCENE ...] [--resolution WxH] [--seeds 16] [--passes 1] [--seconds 60] [--integrator mixed]

Prints a row of a Markdown table for each scene: the root mean square, over seeds, of the relative error of the mean of red,
green and blue, in per cent, for the picture and for the layer `albedo`. The noise of the passes is part of it. The long render
takes --seconds. Needs the Python modules of OpenImageIO and NumPy (python3-openimageio, python3-numpy).
"""
import argparse
import pathlib
import tempfile

import numpy

from picture_file import read_channels
from validate import PROGRAM, run

CHANNELS = ["R", "G", "B", "albedo.R", "albedo.G", "albedo.B"]


def mean_colors(scene, folder, options):
    """Means of a render's CHANNELS."""
    out = folder / "picture.exr"
    run([PROGRAM, "render", scene, "-o", out, "--quiet", "--no-state", "--float", *options])
    means = read_channels(out, CHANNELS).mean(axis=(0, 1))
    for file in folder.iterdir():
        file.unlink()
    return means


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="+", type=pathlib.Path, metavar="SCENE")
    parser.add_argument("--resolution", metavar="WxH")
    parser.add_argument("--seeds", type=int, default=16)
    parser.add_argument("--passes", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--integrator", default="mixed")
    args = parser.parse_args()
    print("| scene | picture: red, green, blue | layer `albedo`: red, green, blue |\n| --- | --- | --- |", flush=True)
    options = ["--integrator", args.integrator]
    if args.resolution:
        options += ["--resolution", args.resolution]
    for scene in args.scenes:
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            long = mean_colors(scene, folder, [*options, "--seed", str(args.seeds), "--time", f"{args.seconds}s"])
            short = [mean_colors(scene, folder, [*options, "--seed", str(seed), "--passes", str(args.passes)])
                     for seed in range(args.seeds)]
        rms = 100 * numpy.sqrt(((numpy.array(short) / long - 1) ** 2).mean(axis=0))
        name = scene.parent.name if scene.stem == "scene" else scene.stem
        print(f"| {name} | {', '.join(f'{v:.2f}' for v in rms[:3])} | {', '.join(f'{v:.2f}' for v in rms[3:])} |", flush=True)


if __name__ == "__main__":
    main()
