#!/usr/bin/env python3
"""Holds the architecture: a file includes only from its own layer or from one to the left of it, each
external library is included where it belongs, and files keep to the soft limit of length.

Exit status 1 and one line per violation, `file:line: what`.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
SRC = ROOT / "src"
LAYERS = ["core", "input", "scene", "route", "film", "transport", "photon", "integrator", "image",
          "session", "options", "bench", "apps"]
# Layers with rooms, folders in their own: a room includes only from itself or from one to its left.
# "" is the layer's own files.
ROOMS = {
    "scene": ["shape", "bsdf", "texture", "medium", "material", "light", "camera", ""],
    "session": ["settings", "report", "checkpoint", ""],
}
# Headers that all rooms of their layer may include.
VOCABULARY = {"scene/interaction.h"}
# External libraries and where they may be included.
LIBRARIES = {
    r"embree\d?/": {"scene/embree_scene.cpp"},
    r"(tbb|oneapi)/": {"core/parallel.cpp"},
    r"OpenEXR/": {"film"},
    r"OpenImageIO/": {"scene/texture", "scene/material", "film", "tests"},
    r"nanovdb/": {"scene/medium/nanovdb_grid.cpp"},
    r"CLI/": {"options"},
    r"nlohmann/": {"bench", "session/checkpoint/film_metadata.cpp"},
}
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def layer_of(path):
    """(layer, room) of a path relative to src/, as positions; None if it has no such place."""
    layer, *folders = path.split("/")[:-1] or [""]
    room = "/".join(folders)
    rooms = ROOMS.get(layer, [""])
    if layer not in LAYERS or room not in rooms:
        return None
    return LAYERS.index(layer), rooms.index(room)


def library_allowed(path, places):
    return any(path == p or path.startswith(p + "/") for p in places)


def main():
    problems = []
    for file in sorted(SRC.rglob("*")):
        if file.suffix not in (".h", ".cpp"):
            continue
        path = file.relative_to(SRC).as_posix()
        own = layer_of(path)
        if own is None:
            problems.append(f"src/{path}:1: belongs to no layer")
            continue
        for number, line in enumerate(file.read_text().splitlines(), 1):
            match = INCLUDE.match(line)
            if not match:
                continue
            kind, name = match.groups()
            if kind == "<":
                for pattern, places in LIBRARIES.items():
                    if re.match(pattern, name) and not library_allowed(path, places):
                        problems.append(f"src/{path}:{number}: <{name}> belongs in "
                                        + " or ".join(sorted(places)))
                continue
            other = layer_of(name)
            if other is None or name in VOCABULARY:
                continue
            if other > own:
                problems.append(f"src/{path}:{number}: includes \"{name}\", which stands to its right")
    for problem in problems:
        print(problem)
    if not problems:
        print("layers: every include points to the left")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
