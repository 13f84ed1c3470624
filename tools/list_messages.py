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
    r"throw (?:std::)?(\w*[Ee]rror|BadFile)\(|\b(fail|fail_at|wrong|refuse)\(|"
    r"\b(warn\w*|warnings\.(?:push|emplace)_back)\(|notes\.(?:push|emplace)_back\(|diagnostics_?\.note\(")
TOKEN = re.compile(r'R"(\w*)\((.*?)\)\1"|"((?:\\.|[^"\\])*)"|\'(?:\\.|[^\'\\])*\'|//[^\n]*|[()]|[^()"\'/]+|/', re.S)
KINDS = {
    "UsageError": "The command line", "SceneError": "Scene files", "IoError": "Files", "Error": "Rendering",
    "runtime_error": "Scene files", "BadFile": "Scene files", "warn": "Warnings", "note": "Notes of the report",
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
    depth, parts, value, before, resume, either = 1, [], False, "", start, False
    arguments = [False]  # for each open bracket: True behind the format string of fmt::format
    formats = [False]
    tokens = list(TOKEN.finditer(text, start, start + 4000))
    for i, token in enumerate(tokens):
        if token.start() < resume:
            continue
        t, last = token[0], before
        before = t
        noun = re.search(r"(,?)[^,]*\b(counted|in_number)$", last) if t == "(" else None
        if noun:
            plural, resume = counted(text, token.end())
            # As an argument it stands where the format has an ellipsis.
            if not any(arguments):
                parts.append(plural if noun[2] == "in_number" else "… " + (plural or "…"))
                value = False
        elif t == "(":
            depth += 1
            arguments.append(False)
            formats.append(bool(re.search(r"\bformat\s*$", last)))
        elif t == ")":
            depth -= 1
            if depth == 0:
                break
            arguments.pop()
            formats.pop()
        elif t.startswith("//") or t.startswith("'"):
            continue
        elif token[2] is not None or token[3] is not None:
            following = tokens[i + 1][0] if i + 1 < len(tokens) else ""
            is_word = re.fullmatch(r'"[\w-]+"', t)
            # Arguments of a format stand where it has an ellipsis. Names that a nested call looks up, or that the call
            # itself puts before the message, are no part of the text.
            is_key = depth > 1 and is_word and (last == "(" or (following.startswith(")") and last.endswith("+ ")))
            if any(arguments) or is_key:
                continue
            if is_word and not parts and following.startswith(","):
                parts.append("… ")
                continue
            if parts and either:
                parts.append(" / ")
            piece = token[2] if token[2] is not None else re.sub(
                r"\\(.)", lambda m: {"n": " "}.get(m[1], m[1]), token[3])
            if value and not (parts and parts[-1] == " / "):
                parts.append("…")
            parts.append(piece)
            value, either = False, False
        else:
            if formats[-1] and "," in t:
                arguments[-1] = True
            if re.search(r"(?<!:):(?!:)", t):
                either = True
            if "+" in t and (re.search(r"\w", t) or not parts):
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
            if call[1] == "logic_error":
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
             "Messages of the program, collected by `tools/list_messages.py`; `…` stands for a name or a number, and ` / ` separates "
             "alternatives. A message says what is wrong, and then what was expected. Errors in scene files begin with "
             "`file:line:column`, in glTF files with `file#pointer`.", ""]
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
