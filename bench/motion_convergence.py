#!/usr/bin/python3
"""Measures how fast the caustic of a moving object converges: RMSE of the layer `caustic` over passes.

  bench/motion_convergence.py [--passes 1024] [--reference-passes 4096] [--plot FILE.svg]

Renders scenes/moving-glass with `mixed`. All photons of a pass share one time, stratified over the passes. The
reference is a longer render with another seed. Prints a table in Markdown and plots it. Needs the Python modules
of OpenImageIO and NumPy (python3-openimageio, python3-numpy).
"""
import argparse
import math
import pathlib
import subprocess

import numpy

from picture_file import read_channels

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = ROOT / "build/release/bin/nephroid"
SCENE = ROOT / "scenes/moving-glass/scene.pbrt"


def caustic(out, passes, seed):
    subprocess.run([PROGRAM, "render", SCENE, "-o", out, "--integrator", "mixed", "--quiet",
                    "-D", "photons=16384", "--passes", str(passes), "--seed", str(seed)], check=True, capture_output=True)
    return read_channels(out, [f"caustic.{c}" for c in "RGB"])


def svg(points, slope):
    """A log-log plot: measured points, and the line of the fitted slope."""
    width, height, margin = 480, 300, 48
    xs = [math.log2(n) for n, _ in points]
    ys = [math.log10(e) for _, e in points]
    x0, x1, y0, y1 = min(xs), max(xs), min(ys) - 0.1, max(ys) + 0.1
    px = lambda x: margin + (x - x0) / (x1 - x0) * (width - 2 * margin)
    py = lambda y: height - margin - (y - y0) / (y1 - y0) * (height - 2 * margin)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
           'font-family="sans-serif" font-size="12">', '<rect width="100%" height="100%" fill="white"/>']
    for x in xs:
        out.append(f'<text x="{px(x):.1f}" y="{height - margin + 18}" text-anchor="middle">{2 ** round(x)}</text>')
    for e in (1, 0.3, 0.1, 0.03, 0.01, 0.003, 0.001):
        if y0 <= math.log10(e) <= y1:
            y = py(math.log10(e))
            out.append(f'<line x1="{margin}" x2="{width - margin}" y1="{y:.1f}" y2="{y:.1f}" stroke="#ddd"/>')
            out.append(f'<text x="{margin - 6}" y="{y + 4:.1f}" text-anchor="end">{e}</text>')
    middle = (numpy.mean(xs), numpy.mean(ys))
    ends = [(x, middle[1] + slope * (x - middle[0]) * math.log10(2)) for x in (x0, x1)]
    out.append('<line stroke="#888" stroke-dasharray="4" ' + " ".join(
        f'x{i + 1}="{px(x):.1f}" y{i + 1}="{py(y):.1f}"' for i, (x, y) in enumerate(ends)) + "/>")
    out.append('<polyline fill="none" stroke="#c40" stroke-width="2" points="' +
               " ".join(f"{px(x):.1f},{py(y):.1f}" for x, y in zip(xs, ys)) + '"/>')
    out.append(f'<text x="{width / 2}" y="{height - 8}" text-anchor="middle">passes (dashed: slope {slope:.2f})</text>')
    out.append(f'<text x="{margin}" y="20">RMSE of the moving caustic</text></svg>')
    return "\n".join(out) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--passes", type=int, default=1024)
    parser.add_argument("--reference-passes", type=int, default=4096)
    parser.add_argument("--plot", type=pathlib.Path, default=ROOT / "out/motion-convergence.svg")
    args = parser.parse_args()
    folder = ROOT / "out/motion"
    folder.mkdir(parents=True, exist_ok=True)
    reference = caustic(folder / "reference.exr", args.reference_passes, 1000)
    points = []
    print("| passes | RMSE | over mean |\n| --- | --- | --- |")
    n = 4
    while n <= args.passes:
        error = math.sqrt(numpy.mean((caustic(folder / f"{n}.exr", n, 1) - reference) ** 2))
        points.append((n, error))
        print(f"| {n} | {error:.3g} | {error / reference.mean():.3g} |", flush=True)
        n *= 2
    slope = numpy.polyfit([math.log(n) for n, _ in points], [math.log(e) for _, e in points], 1)[0]
    print(f"\nslope {slope:.2f}")
    args.plot.write_text(svg(points, slope))


if __name__ == "__main__":
    main()
