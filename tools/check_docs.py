#!/usr/bin/env python3
"""Checks the links of all Markdown pages: files, pictures and headings exist, and every page under docs/ can be reached
from docs/index.md. Needs no build.

Prints one line per fault, `file:line: what`, and then exits with status 1.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
START = ROOT / "docs/index.md"
LINK = re.compile(r"!?\[(?:[^\[\]]|\[[^\]]*\])*\]\(([^()\s]+(?:\([^()]*\))?)\)")
HEADING = re.compile(r"^#{1,6}\s+(.*?)\s*#*$")


def pages():
    """All pages but those of build folders and of hidden ones."""
    return sorted(page for page in ROOT.rglob("*.md")
                  if not re.match(r"build|out$|\.", page.relative_to(ROOT).parts[0]))


def lines_outside_code(page):
    """(number, line) of all lines outside fenced blocks."""
    fence = None
    for number, line in enumerate(page.read_text(encoding="utf-8").split("\n"), 1):
        mark = re.match(r"\s*(```+|~~~+)", line)
        if mark and fence is None:
            fence = mark[1]
        elif mark and fence and mark[1].startswith(fence):
            fence = None
        elif fence is None:
            yield number, line


def anchors(page):
    """The anchors of a page's headings, as GitHub and MyST make them."""
    found = set()
    for _, line in lines_outside_code(page):
        heading = HEADING.match(line)
        if not heading:
            continue
        text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading[1]).replace("`", "").replace("*", "")
        slug = re.sub(r"[^\w\- ]", "", text.strip().lower()).replace(" ", "-")
        name, n = slug, 0
        while name in found:
            n += 1
            name = f"{slug}-{n}"
        found.add(name)
    return found


def main():
    faults, targets = [], {}
    for page in pages():
        targets[page] = set()
        for number, line in lines_outside_code(page):
            for link in LINK.findall(re.sub(r"`[^`]*`", "", line)):
                if re.match(r"[a-z]+:", link):
                    continue
                path, _, anchor = link.partition("#")
                where = f"{page.relative_to(ROOT)}:{number}"
                target = (page.parent / path).resolve() if path else page
                if not target.exists():
                    faults.append(f"{where}: there is no {link}")
                elif target.suffix == ".md":
                    targets[page].add(target)
                    if anchor and anchor not in anchors(target):
                        faults.append(f"{where}: {path or page.name} has no heading #{anchor}")
    reached, waiting = set(), [START]
    while waiting:
        page = waiting.pop()
        if page not in reached:
            reached.add(page)
            waiting += targets.get(page, ())
    for page in targets:
        if START.parent in page.parents and page not in reached:
            faults.append(f"{page.relative_to(ROOT)}:1: no link leads here from docs/index.md")
    print("\n".join(faults) if faults else f"docs: the links of {len(targets)} pages lead somewhere")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
