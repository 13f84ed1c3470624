#!/usr/bin/env python3
"""Runs what pages of the documentation tell a reader to do: run_pages.py PROGRAM PAGE...

Each page has a scratch directory of its own. A block ```pbrt NAME is written to the file NAME; the lines of a block ```sh
run in order, with `nephroid` a small and quick version of PROGRAM: renders have 24 x 16 pixels and two passes, whatever
their options say. Other blocks are for the eye. Exit status 1 if a command fails, with what it printed.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
# Options with a value that decide how long a render takes.
LIMITS = ("--time", "--noise", "--passes", "--resolution", "--checkpoint")
QUICK = """#!/usr/bin/env python3
import os, sys
program, limits, arguments, kept = {program!r}, {limits!r}, sys.argv[1:], []
if arguments[:1] == ["render"]:
    words = iter(arguments)
    for word in words:
        if word in limits:
            # A range of passes is part of what the page shows.
            value = next(words, "")
            if word == "--passes" and ".." in value:
                kept += [word, value]
        elif word.partition("=")[0] not in limits:
            kept.append(word)
    arguments = kept + ["--resolution", "24x16"]
    if "--passes" not in arguments:
        arguments += ["--passes", "2"]
os.execv(program, [program, *arguments])
"""


def blocks(page):
    """(line, language, rest of the fence line, text) of each fenced block."""
    found, start = [], None
    for number, line in enumerate(page.read_text(encoding="utf-8").split("\n"), 1):
        if not line.startswith("```"):
            if start:
                start[3].append(line)
        elif start:
            found.append((start[0], start[1], start[2], "\n".join(start[3]) + "\n"))
            start = None
        else:
            language, _, rest = line[3:].partition(" ")
            start = (number, language, rest.strip(), [])
    return found


def run(page, program):
    """Commands that ran; exits at the first that fails."""
    ran = 0
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        (scratch / "bin").mkdir()
        quick = scratch / "bin/nephroid"
        quick.write_text(QUICK.format(program=str(program), limits=LIMITS))
        quick.chmod(0o755)
        work = scratch / "work"
        work.mkdir()
        (work / "scenes").symlink_to(ROOT / "scenes")
        environment = {**os.environ, "PATH": f"{scratch / 'bin'}:{os.environ['PATH']}"}
        for line, language, rest, text in blocks(page):
            if language == "pbrt" and rest:
                (work / rest).write_text(text)
            elif language == "python":
                compile(text, f"{page}:{line}", "exec")
            elif language == "sh":
                done = subprocess.run(["bash", "-euo", "pipefail", "-c", text], cwd=work, env=environment,
                                      stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=300)
                ran += 1
                if done.returncode:
                    sys.exit(f"{page}:{line}: exit status {done.returncode}\n{text}\n{done.stdout}")
    return ran


if __name__ == "__main__":
    for name in sys.argv[2:]:
        page = pathlib.Path(name).resolve()
        print(f"{page.relative_to(ROOT)}: {run(page, pathlib.Path(sys.argv[1]).resolve())} blocks of commands ran", flush=True)
