#!/usr/bin/env python3
"""Checks the architecture. A file includes only from its own layer and room or from those to its left. Headers
do not include each other in a circle. External libraries are included only where they belong. Files have at most
400 lines of 100 columns.

Prints one line per violation, `file:line: what`, and then exits with status 1.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
SRC = ROOT / "src"
LAYERS = ["core", "input", "scene", "route", "film", "transport", "photon", "integrator", "image",
          "session", "options", "bench", "report_page", "view",
          "apps"]
# Rooms: the folders of a layer. In this order, each one includes only from those to its left. "" stands for the
# layer's own files.
ROOMS = {
    "input": ["", "sky", "obj", "gltf", "mitsuba", "staging", "convert"],
    "scene": ["shape", "bsdf", "texture", "medium", "material", "light", "camera", ""],
    "integrator": ["estimator", "path", "photons", "learning", "photon_mapping", "virtual_lights",
                   "bidirectional", "metropolis", "mixed", "presets"],
    "session": ["settings", "report", "checkpoint", ""],
}
# Headers that all rooms of their layer may include.
VOCABULARY = {"scene/interaction.h"}
# Files of a layer's own that may include from all of its rooms.
DISPATCHERS = {"input/scene_reader.cpp"}
# External libraries and where they may be included.
LIBRARIES = {
    r"embree\d?/": {"scene/embree_scene.cpp"},
    r"(tbb|oneapi)/": {"core/parallel.cpp"},
    r"OpenEXR/": {"film"},
    r"OpenImageIO/": {"scene/texture", "scene/material", "film", "tests"},
    r"nanovdb/": {"scene/medium/nanovdb_grid.cpp"},
    r"xxhash": {"core/content_hash.cpp"},
    r"CLI/": {"options", "report_page/main.cpp"},
    r"nlohmann/": {"bench", "session/checkpoint/film_metadata.cpp", "input/gltf/json_value.h",
                   "input/gltf/json_value.cpp", "apps/frame_stream.cpp", "view"},
    r"draco/": {"input/gltf/draco.cpp"},
    r"meshoptimizer": {"input/gltf/meshopt.cpp"},
    r"httplib": {"view/server.cpp"},
    r"pugixml": {"input/mitsuba/xml_text.h"},
}
MAX_LINES, MAX_COLUMNS = 400, 100
# Files that are tables of text or data, not code.
TABLES = {"report_page/page_style.cpp", "options/scene_support.cpp", "input/sky/hosek_wilkie_data.cpp",
          "options/mitsuba_support.cpp", "options/obj_support.cpp", "options/gltf_support.cpp"}
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def layer_of(path):
    """Positions (layer, room) of a path relative to src/, or None if it belongs to none."""
    layer, *folders = path.split("/")[:-1] or [""]
    room = "/".join(folders)
    rooms = ROOMS.get(layer, [""])
    if layer not in LAYERS or room not in rooms:
        return None
    return LAYERS.index(layer), rooms.index(room)


def library_allowed(path, places):
    return any(path == p or path.startswith(p + "/") for p in places)


def too_long(path, lines):
    """Violations of the length limits; tables are exempt."""
    if path in TABLES:
        return
    if len(lines) > MAX_LINES:
        yield f"src/{path}:{MAX_LINES + 1}: has {len(lines)} lines, expected {MAX_LINES} at most"
    for number, line in enumerate(lines, 1):
        if len(line) > MAX_COLUMNS:
            yield f"src/{path}:{number}: has {len(line)} columns, expected {MAX_COLUMNS} at most"


def circles(includes):
    """One line per circle of headers."""
    done, stack = set(), []

    def visit(header):
        if header in stack:
            yield " -> ".join(stack[stack.index(header):] + [header])
            return
        if header in done:
            return
        stack.append(header)
        for other in sorted(includes.get(header, ())):
            yield from visit(other)
        stack.pop()
        done.add(header)

    for header in sorted(includes):
        yield from visit(header)


def main():
    problems = []
    includes = {}
    for file in sorted(SRC.rglob("*")):
        if file.suffix not in (".h", ".cpp"):
            continue
        path = file.relative_to(SRC).as_posix()
        own = layer_of(path)
        if own is None:
            problems.append(f"src/{path}:1: belongs to no layer")
            continue
        lines = file.read_text().splitlines()
        problems += too_long(path, lines)
        for number, line in enumerate(lines, 1):
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
            if file.suffix == ".h":
                includes.setdefault(path, set()).add(name)
            other = layer_of(name)
            if other is None or name in VOCABULARY:
                continue
            if other > own and path not in DISPATCHERS:
                problems.append(f"src/{path}:{number}: includes \"{name}\", which stands to its right")
    problems += [f"headers include each other in a circle: {circle}" for circle in circles(includes)]
    for problem in problems:
        print(problem)
    if not problems:
        print("layers: every include points to the left, no circles, no file or line too long")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
