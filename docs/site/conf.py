"""The documentation as a site: `make docs` (Sphinx, MyST and the theme Furo, all from Debian)."""
import re

from pygments.lexers.special import TextLexer

project = "Nephroid"
extensions = ["myst_parser"]
exclude_patterns = ["site"]
root_doc = "index"
html_theme = "furo"
html_title = "Nephroid"
html_show_sphinx = False
html_show_copyright = False
myst_heading_anchors = 4
# Links from pages to files of the source tree, which the site does not hold.
suppress_warnings = ["myst.xref_missing"]


def add_navigation(app, name, source):
    """The lists of links of an index page are the navigation of the site, too."""
    if name.split("/")[-1] != "index":
        return
    for section in re.split(r"^## ", source[0], flags=re.M):
        pages = re.findall(r"^- \[[^\]]*\]\(([^)]+)\.md\)", section, flags=re.M)
        caption = f":caption: {section.splitlines()[0]}\n" if not section.startswith("#") else ""
        if pages:
            source[0] += "\n```{toctree}\n:hidden:\n" + caption + "\n" + "\n".join(pages) + "\n```\n"


def setup(app):
    app.connect("source-read", add_navigation)
    # Fences whose text a test reads have a language of their own, which is plain text to a reader.
    for language in ("routes", "words", "error", "warning", "pbrt", "mermaid"):
        app.add_lexer(language, TextLexer)
