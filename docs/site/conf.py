"""The documentation as a site: `make docs` (Sphinx, MyST and the theme Furo, all from Debian)."""
import re

from pygments.lexers.special import TextLexer

project = "Nephroid"
extensions = ["myst_parser", "sphinx.ext.graphviz"]
graphviz_output_format = "svg"
exclude_patterns = ["site"]
root_doc = "index"
html_theme = "furo"
html_title = "Nephroid"
html_show_sphinx = False
html_show_copyright = False
myst_heading_anchors = 4
# Links from pages to files of the source tree, which the site does not hold.
suppress_warnings = ["myst.xref_missing", "ref.myst"]


def add_navigation(app, name, source):
    """The lists of links of an index page are the navigation of the site, too."""
    if name.split("/")[-1] != "index":
        return
    for section in re.split(r"^## ", source[0], flags=re.M):
        pages = re.findall(r"^- \[[^\]]*\]\(([^)]+)\.md\)", section, flags=re.M)
        caption = f":caption: {section.splitlines()[0]}\n" if not section.startswith("#") else ""
        if pages:
            source[0] += "\n```{toctree}\n:hidden:\n" + caption + "\n" + "\n".join(pages) + "\n```\n"


def graph_of(mermaid):
    """A flow chart of Mermaid, which the site cannot draw without a network, as one of Graphviz."""
    lines = mermaid.strip().splitlines()
    direction = lines[0].split()[1]
    graph = [f'rankdir={direction}; ranksep=0.25; bgcolor="transparent"; node [shape=box, style="rounded,filled", fillcolor="#f4f4f8",'
             ' fontname="sans-serif", fontsize=11]; edge [fontname="sans-serif", fontsize=10, color="#888888"];']
    for name, label in re.findall(r"(\w+)\[([^\]]+)\]", mermaid):
        label = label.replace("<br>", "\\n")
        graph.append(f'{name} [label="{label}"];')
    for line in lines[1:]:
        parts = re.split(r"\s*(-->|-\..*?\.->)\s*", re.sub(r"\[[^\]]+\]", "", line.strip()))
        for source, arrow, target in zip(parts[::2], parts[1::2], parts[2::2]):
            text = arrow[2:-3].strip() if arrow != "-->" else ""
            look = f' [style=dashed, label="{text}"]' if text else ""
            graph.append(f"{source} -> {target}{look};")
    return "digraph {\n" + "\n".join(graph) + "\n}"


def draw_charts(app, name, source):
    source[0] = re.sub(r"^```mermaid\n(.*?)^```", lambda m: "```{graphviz}\n" + graph_of(m[1]) + "\n```", source[0],
                       flags=re.M | re.S)


def setup(app):
    app.connect("source-read", add_navigation)
    app.connect("source-read", draw_charts)
    # Fences whose text a test reads have a language of their own, which is plain text to a reader.
    for language in ("routes", "words", "error", "warning", "pbrt"):
        app.add_lexer(language, TextLexer)
