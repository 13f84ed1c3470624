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
LAYERS = ["core", "input", "scene", "route", "film", "transport", "photon", "integrator", "session",
          "bench", "report_page", "apps"]
# Within scene/, the folders that others build on come first; the files of scene/ itself come last. A few
# headers of scene/ are vocabulary for the folders below it.
SCENE = ["shape", "bsdf", "texture", "medium", "material", "light", "camera", ""]
SCENE_VOCABULARY = {"scene/interaction.h"}
# Folders below scene/ that may use another one although it does not stand to their left.
LIBRARIES = {
    r"embree\d?/": {"scene/embree_scene.cpp"},
    r"(tbb|oneapi)/": {"core/parallel.cpp"},
    r"OpenEXR/": {"film"},
    r"OpenImageIO/": {"scene/texture", "scene/material", "film", "tests"},
    r"nanovdb/": {"scene/medium/nanovdb_grid.cpp"},
    r"xxhash": {"core/content_hash.cpp"},
    r"CLI/": {"session", "apps", "report_page/main.cpp"},
    r"nlohmann/": {"bench", "session/film_metadata.cpp"},
}
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def layer_of(path):
    """(layer, position within scene) of a path relative to src/, or None."""
    parts = path.split("/")
    if parts[0] not in LAYERS:
        return None
    sub = SCENE.index(parts[1]) if parts[0] == "scene" and len(parts) > 2 else len(SCENE) - 1
    return LAYERS.index(parts[0]), sub if parts[0] == "scene" else 0


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
            if other is None or name in SCENE_VOCABULARY:
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
