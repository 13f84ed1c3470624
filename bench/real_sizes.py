#!/usr/bin/python3
"""Measures error times CPU seconds of integrators at typical picture sizes, and renders the references.

  bench/real_sizes.py references --scenes DIR --references OUT [--only NAME ...] [--seconds 300]
  bench/real_sizes.py measure --scenes DIR --references DIR [--only NAME ...] [--integrator mixed ...]
                              [--time 10 60] [--seeds 3] --results FILE.json
  bench/real_sizes.py table --results FILE.json

--scenes is the folder of third-party scenes (DIR/NAME/scene.pbrt). Scenes of this project are found without it; scenes
without files are skipped. A reference is the mean of two independent renders of --seconds each. Its layer `stderr` is their
difference, so that `nephroid compare --subtract-reference-error` can remove the reference's own error. `measure` renders
results missing in FILE.json and adds them, so it can be stopped and restarted. `table` prints the medians over seeds as a
page of Markdown (docs/measurements/real-sizes.md). Needs the Python modules of OpenImageIO and NumPy (python3-openimageio,
python3-numpy).
"""
import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys
import time

from validate import PROGRAM, ROOT, compare, run

INTEGRATORS = ["mixed", "path", "doidge2012", "sppm", "vcm", "bpm", "bdpt"]

# Scenes, their size here, and the options of their reference: `path` or `bdpt` where they find all light well, else an
# integrator that merges with a small first radius. The last four have no caustics: there `mixed` must keep up with `path`.
MERGING = ["--integrator", "mixed", "-D", "radius=1"]
PATHS = ["--integrator", "path"]
SUITE = {
    "water-caustic": ("512x512", ["--integrator", "sppm", "-D", "radius=1.5"]),
    "glass-of-water": ("912x512", MERGING),
    "veach-bidir": ("512x512", MERGING),
    "coffee": ("400x500", PATHS),
    "staircase2": ("512x512", MERGING),
    "pool": ("960x540", MERGING),
    "coffee-cup": ("800x600", MERGING),
    "cut-gems": ("720x512", MERGING),
    "hall": ("750x500", MERGING),
    "cornell-box": ("512x512", PATHS),
    "material-testball": ("640x360", PATHS),
    "daylight-room": ("600x400", MERGING),
    "door-ajar": ("600x400", MERGING),
}


def scene_file(scenes, name):
    for folder in (ROOT / "scenes", scenes):
        if folder and (folder / name / "scene.pbrt").exists():
            return folder / name / "scene.pbrt"
    return None


def chosen(args):
    for name, (size, reference) in SUITE.items():
        scene = scene_file(args.scenes, name)
        if scene and (not args.only or name in args.only):
            yield name, scene, size, reference


def render(scene, out, size, options):
    """CPU seconds of a render."""
    before = os.times()
    run([PROGRAM, "render", scene, "-o", out, "--resolution", size, "--quiet", "--no-state", *options])
    after = os.times()
    return after.children_user - before.children_user + after.children_system - before.children_system


def make_references(args):
    import numpy
    import OpenImageIO as oiio

    from picture_file import read_channels

    args.references.mkdir(parents=True, exist_ok=True)
    for name, scene, size, recipe in chosen(args):
        target = args.references / f"{name}.exr"
        if target.exists():
            continue
        halves = []
        for half in range(2):
            out = args.references / f"{name}-half{half}.exr"
            if not out.exists():
                render(scene, out, size, [*recipe, "--seed", str(1000 + half), "--time", f"{args.seconds}s"])
            halves.append(read_channels(out, "RGB"))
        mean = (halves[0] + halves[1]) / 2
        error = abs(halves[0] - halves[1]) / 2
        height, width = mean.shape[:2]
        spec = oiio.ImageSpec(width, height, 6, oiio.HALF)
        spec.channelnames = ("R", "G", "B", "stderr.R", "stderr.G", "stderr.B")
        spec.attribute("compression", "zip")
        layers = numpy.concatenate([mean, error], axis=2).clip(0, 65504).astype(numpy.float32)
        out = oiio.ImageOutput.create(str(target))
        if not (out and out.open(str(target), spec) and out.write_image(numpy.ascontiguousarray(layers))):
            sys.exit(f"{target}: {oiio.geterror()}")
        out.close()
        own = numpy.sort((error**2 / (mean**2 + 0.01)).mean(axis=2).ravel())
        kept = own[:len(own) - len(own) // 1000]
        print(f"{name}: own relMSE {own.mean():.2g}, trimmed {kept.mean():.2g}", flush=True)


def machine():
    for line in pathlib.Path("/proc/cpuinfo").read_text().split("\n"):
        if line.startswith("model name"):
            return f"{os.cpu_count()} cores of {line.partition(':')[2].strip()}"
    return f"{os.cpu_count()} cores"


def measure(args):
    results = json.loads(args.results.read_text()) if args.results.exists() else []
    done = {(r["scene"], r["integrator"], r["time"], r["seed"]) for r in results}
    revision = subprocess.run(["git", "-C", ROOT, "describe", "--always", "--dirty"],
                              capture_output=True, text=True).stdout.strip()
    out = args.results.with_suffix(".exr")
    for seed in range(args.seeds):
        for name, scene, size, _ in chosen(args):
            reference = args.references / f"{name}.exr"
            if not reference.exists():
                continue
            for integrator in args.integrator:
                for seconds in args.time:
                    if (name, integrator, seconds, seed) in done:
                        continue
                    cpu = render(scene, out, size, ["--integrator", integrator, "--seed", str(seed),
                                                    "--time", f"{seconds}s"])
                    _, figure = compare(reference, out)
                    results.append({"scene": name, "size": size, "integrator": integrator, "time": seconds,
                                    "seed": seed, "cpu": round(cpu, 2), "relmse": figure["relmse"],
                                    "relmse_trim": figure["relmse_trim"], "revision": revision,
                                    "machine": machine(), "day": time.strftime("%Y-%m-%d")})
                    args.results.write_text("[\n" + ",\n".join(map(json.dumps, results)) + "\n]\n")
                    print(f"{name} {integrator} {seconds} s, seed {seed}: "
                          f"{figure['relmse_trim'] * cpu:.3g} ({figure['relmse'] * cpu:.3g})", flush=True)
    out.unlink(missing_ok=True)


def ratio(figures):
    """Ratio of `mixed` to the best of the others."""
    others = [value for integrator, value in figures.items() if integrator != "mixed"]
    return f"{figures['mixed'] / min(others):.2f}" if "mixed" in figures and others else ""


def table(args):
    results = json.loads(args.results.read_text())
    runs = {}
    for r in results:
        runs.setdefault((r["time"], r["scene"], r["integrator"]), []).append(r)

    def all_of(key):
        return ", ".join(sorted({str(r[key]) for r in results}))

    print(f"""# Error times CPU seconds at the sizes people render

Written by `bench/real_sizes.py table`; the pictures are made by its commands `references` and `measure`.

Revision {all_of("revision")}, {all_of("day")}, on {all_of("machine")}.

A figure is relMSE times CPU seconds. It leaves out the worst 0.1 % of pixels and the reference's own error. The figure in brackets includes
all pixels. It is the median of the seeds. The last column is `mixed` over the best of the others.""")
    for seconds in sorted({r["time"] for r in results}):
        shown = [i for i in INTEGRATORS if any(key[0] == seconds and key[2] == i for key in runs)]
        seeds = {r["seed"] for r in results if r["time"] == seconds}
        print(f"\n## After {seconds} s, {len(seeds)} seed{'s' if len(seeds) > 1 else ''}\n")
        print("| scene | " + " | ".join(shown) + " | mixed / best other |")
        print("| --- " * (len(shown) + 2) + "|")
        for name in SUITE:
            row, trimmed, whole, size = [], {}, {}, ""
            for integrator in shown:
                of_cell = runs.get((seconds, name, integrator), [])
                if of_cell:
                    size = of_cell[0]["size"]
                    trimmed[integrator] = statistics.median(r["relmse_trim"] * r["cpu"] for r in of_cell)
                    whole[integrator] = statistics.median(r["relmse"] * r["cpu"] for r in of_cell)
                row.append(f"{trimmed[integrator]:.2g} ({whole[integrator]:.2g})" if of_cell else "")
            if size:
                print(f"| {name} {size} | " + " | ".join(row) + f" | {ratio(trimmed)} ({ratio(whole)}) |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    for name, function in (("references", make_references), ("measure", measure), ("table", table)):
        command = commands.add_parser(name)
        command.set_defaults(function=function)
        if name != "table":
            command.add_argument("--scenes", type=pathlib.Path)
            command.add_argument("--references", type=pathlib.Path, required=True)
            command.add_argument("--only", nargs="+", default=[])
        if name == "references":
            command.add_argument("--seconds", type=int, default=300)
        else:
            command.add_argument("--results", type=pathlib.Path, required=True)
        if name == "measure":
            command.add_argument("--integrator", nargs="+", default=INTEGRATORS)
            command.add_argument("--time", nargs="+", type=int, default=[10, 60])
            command.add_argument("--seeds", type=int, default=3)
    args = parser.parse_args()
    args.function(args)


if __name__ == "__main__":
    main()
