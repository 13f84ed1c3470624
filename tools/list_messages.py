#!/usr/bin/env python3
"""Writes docs/messages.md: every message of the program, from the sources. `--check` compares instead and fails if the
page differs.

Messages are the texts of errors, warnings and notes. Values appear as an ellipsis.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/messages.md"
CALL = re.compile(
    r"throw (\w*Error)\(|\b(fail|fail_at|wrong|refuse)\(|[.>](warn|warn_of_unknown_name)\(|notes\.(?:push|emplace)_back\(")
TOKEN = re.compile(r'R"(\w*)\((.*?)\)\1"|"((?:\\.|[^"\\])*)"|\'(?:\\.|[^\'\\])*\'|//[^\n]*|[()]|[^()"\'/]+|/', re.S)
KINDS = {
    "UsageError": "The command line", "SceneError": "Scene files", "IoError": "Files", "Error": "Rendering",
    "warn": "Warnings", "note": "Notes of the report",
}


def counted(text, start):
    """The plural of a call of counted() or in_number() whose opening bracket ends at `start`, and the end of the call."""
    depth, words = 1, []
    for token in TOKEN.finditer(text, start):
        depth += {"(": 1, ")": -1}.get(token[0], 0)
        if depth == 0:
            return words[1] if len(words) > 1 else words[0] + "s" if words else "", token.end()
        if token[3] is not None:
            words.append(token[3].replace('\\"', '"'))
    return "", start


def literals(text, start):
    """The string literals of the call whose opening bracket ends at `start`, joined to a message. Values become an ellipsis."""
    depth, parts, value, before, resume = 1, [], False, "", start
    for token in TOKEN.finditer(text, start):
        if token.start() < resume:
            continue
        t, last = token[0], before
        before = t
        noun = re.search(r"(,?)[^,]*\b(counted|in_number)$", last) if t == "(" else None
        if noun:
            plural, resume = counted(text, token.end())
            # As an argument it stands where the format has an ellipsis.
            if not noun[1]:
                parts.append(plural if noun[2] == "in_number" else "… " + (plural or "…"))
                value = False
        elif t == "(":
            depth += 1
        elif t == ")":
            depth -= 1
            if depth == 0:
                break
        elif t.startswith("//") or t.startswith("'"):
            continue
        elif token[2] is not None or token[3] is not None:
            # The name of a parameter that a nested call looks up is no part of the message.
            if depth > 1 and last == "(" and re.fullmatch(r'"[\w-]+"', t):
                continue
            if parts and re.fullmatch(r"\s*:\s*", last):
                parts.append(" / ")
            piece = token[2] if token[2] is not None else token[3].replace('\\"', '"').replace("\\n", " ").replace("\\\\", "\\")
            if value and parts:
                parts.append("…")
            parts.append(piece)
            value = False
        elif "+" in t and re.search(r"\w", t):
            value = True
    message = "".join(parts) + ("…" if value and parts else "")
    message = re.sub(r"\{\{|\}\}", "'", re.sub(r"\{[^{}]*\}", "…", message))
    return re.sub(r"\s+", " ", message).strip(" :/")


def messages():
    found = {}
    for path in sorted((ROOT / "src").rglob("*")):
        if path.suffix not in (".cpp", ".h"):
            continue
        text = path.read_text(encoding="utf-8")
        for call in CALL.finditer(text):
            message = literals(text, call.end())
            if len(re.findall(r"[a-z]{2,}", message)) < 2:
                continue
            kind = call[1] or ("warn" if call[3] else "SceneError" if call[2] else "note")
            layer = path.relative_to(ROOT / "src").parts[0]
            if call[2] and layer in ("options", "apps", "route"):
                kind = "UsageError"
            found.setdefault(KINDS.get(kind, KINDS["Error"]), {}).setdefault(message, path.relative_to(ROOT).as_posix())
    return found


def page():
    found = messages()
    lines = ["# Messages", "",
             "Every message of the program, written by `tools/list_messages.py`; `…` stands for a name or a number. A message says what "
             "is wrong, and then what was expected. Errors in scene files begin with `file:line:column`.", ""]
    for kind in dict.fromkeys(KINDS.values()):
        if kind not in found:
            continue
        lines += [f"## {kind}", "", "| message | source |", "| --- | --- |"]
        for message, source in sorted(found[kind].items(), key=lambda item: item[0].lower().lstrip("… '\"-:")):
            text = message.replace("|", "\\|").replace("<", "&lt;").replace("`", "'").replace("*", "\\*").replace("[", "\\[")
            lines.append(f"| {text} | [{source.split('/', 1)[1]}](../{source}) |")
        lines.append("")
    return "\n".join(lines)


if __name__ == "__main__":
    text = page()
    if "--check" in sys.argv[1:]:
        if not PAGE.exists() or PAGE.read_text(encoding="utf-8") != text:
            sys.exit("docs/messages.md: is not what the sources say; run tools/list_messages.py")
    else:
        PAGE.write_text(text, encoding="utf-8")
