#!/usr/bin/env python3
"""Renders every scene of a folder and compares it with its reference picture; prints tables in Markdown.

  bench/validate.py --scenes DIR --references DIR [--only NAME ...] [--integrator mixed ...]
                    [--passes 64 --passes 512 | --time 15s] [--out DIR]

A scene is DIR/NAME/scene.pbrt, its reference DIR/NAME.exr, which sets the resolution. The figures are
those of `nephroid compare`. relmse_trim omits the worst 0.1 % of pixels. The mean ratio, over pixels whose
reference is below 10, has its 95 % interval. The last column is the share of pixels whose difference is
within 3.3 standard errors in all channels. docs/measurements/validation.md keeps the results.
"""
import argparse
import pathlib
import re
import struct
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = ROOT / "build/release/bin/nephroid"


def exr_size(path):
    """Width and height from the dataWindow attribute of an EXR header."""
    data = path.read_bytes()[:65536]
    at = data.index(b"dataWindow\0box2i\0") + len(b"dataWindow\0box2i\0") + 4
    x0, y0, x1, y1 = struct.unpack("<4i", data[at:at + 16])
    return x1 - x0 + 1, y1 - y0 + 1


def run(arguments):
    result = subprocess.run([str(a) for a in arguments], capture_output=True, text=True)
    if result.returncode != 0:
        sys.exit(f"{' '.join(map(str, arguments))}\n{result.stderr}")
    return result.stdout


def compare(reference, picture):
    """The output of `nephroid compare`, and its figures by name, without the reference's own error."""
    text = run([PROGRAM, "compare", reference, picture, "--subtract-reference-error"])
    return text, {k: float(v) for k, v in re.findall(r"(\w+)=([-+\d.einfa]+)", text)}


def measure(scene, reference, integrator, stop, out):
    """(seconds, {name: figure}) of one render."""
    width, height = exr_size(reference)
    started = time.monotonic()
    run([PROGRAM, "render", scene, "-o", out, "--integrator", integrator,
         "--resolution", f"{width}x{height}", "--quiet", *stop])
    seconds = time.monotonic() - started
    text, figures = compare(reference, out)
    # Without a number if the reference is black there, or if there are no such pixels.
    dim = re.search(r"mean_rel below 10: (-?[\d.]\S*)(?: \+- (\S+))?", text)
    figures["dim"] = float(dim.group(1)) if dim else float("nan")
    figures["dim_half"] = float(dim.group(2)) if dim and dim.group(2) else float("nan")
    return seconds, figures


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", type=pathlib.Path, required=True)
    parser.add_argument("--references", type=pathlib.Path, required=True)
    parser.add_argument("--only", nargs="+", default=[])
    parser.add_argument("--integrator", nargs="+", default=["mixed"])
    parser.add_argument("--passes", type=int, action="append", default=[])
    parser.add_argument("--time")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "out/validation")
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    stops = [("--passes", str(n)) for n in args.passes] or [("--time", args.time or "15s")]
    print("| scene | integrator | stop | seconds | relmse | relmse_trim | trim x s "
          "| mean below 10, 95 % | z within 3.3 |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    for reference in sorted(args.references.glob("*.exr")):
        name = reference.stem
        scene = args.scenes / name / "scene.pbrt"
        if not scene.exists() or (args.only and name not in args.only):
            continue
        for integrator in args.integrator:
            for stop in stops:
                out = args.out / f"{name}-{integrator}-{stop[1]}.exr"
                seconds, f = measure(scene, reference, integrator, stop, out)
                print(f"| {name} | {integrator} | {stop[1]} | {seconds:.1f} | {f['relmse']:.3g} "
                      f"| {f['relmse_trim']:.3g} | {f['relmse_trim'] * seconds:.3g} "
                      f"| {1 + f['dim']:.4f} ± {f['dim_half']:.4f} "
                      f"| {100 * f.get('z_within', float('nan')):.2f} % |", flush=True)


if __name__ == "__main__":
    main()
