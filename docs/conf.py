"""Sphinx settings: MyST pages whose code cells run when the pages are built."""

import os
import re
import sys
from pathlib import Path
from typing import Any

from softshadow import __version__, failures
from softshadow.lessons.copies import copy_lessons
from softshadow.scene import scene_names

sys.path.insert(0, str(Path(__file__).parent))
from gallery_page import gallery

project = "softshadow"
author = copyright = "The softshadow developers"
release = version = __version__

extensions = [
    "myst_nb",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx_click",
]
exclude_patterns = ["_build", "conf.py", "gallery_page.py", "sweeps"]  # scripts, of which only the lessons are pages
html_theme = "furo"
html_title = f"softshadow {version}"
html_static_path = ["_static"]
html_css_files = ["softshadow.css"]
html_js_files = ["softshadow.js"]

myst_enable_extensions = ["colon_fence", "deflist"]
myst_heading_anchors = 3

nb_custom_formats = {".py": ["jupytext.reads", {"fmt": "py:percent"}]}  # the lessons
nb_execution_mode = "force"  # numbers and pictures on the pages are those of this version
nb_execution_raise_on_error = True
# of the lessons the quick lane executes four, and it makes a part of the gallery; `.ci/run --all` makes all
QUICK_LESSONS = ("05_stencil_buffer", "08_planar_with_stencil", "11_zpass", "16_shadow_maps")
QUICK = os.environ.get("SOFTSHADOW_LANE") != "all"
if QUICK:
    nb_execution_excludepatterns = [
        f"lessons/{path.name}"
        for path in sorted(Path(__file__).parent.glob("lessons/*.py"))
        if path.stem not in QUICK_LESSONS
    ]
nb_execution_show_tb = True
nb_execution_timeout = 300
nb_merge_streams = True
nb_render_markdown_format = "myst"  # tables made by cells
nb_mime_priority_overrides = [("*", "image/png", 25)]  # of a run its picture, not a report of 0.3 MB each
FEWEST_WORDS = 4  # in the description of a picture

smartquotes_action = "qe"  # two hyphens are an option, not a dash
default_role = "py:obj"
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_preserve_defaults = True
napoleon_google_docstring = False
napoleon_use_rtype = False
napoleon_preprocess_types = False


def spread_columns(app: Any, what: str, name: str, obj: Any, options: Any, lines: list[str]) -> None:
    """Give each entry of a docstring's section the two lines that numpydoc has: we write them in columns on one."""
    spread: list[str] = []
    in_section = False
    for line in lines:
        if re.fullmatch(r"-{3,}", line):
            in_section = True
        elif in_section and (entry := re.fullmatch(r"(\S.*?)\s{2,}(\S.*)", line)):
            spread += [entry[1], f"    {entry[2]}"]
            continue
        elif in_section and line.startswith(" "):
            line = f"    {line.strip()}"
        spread.append(line)
    lines[:] = spread


def offer_notebook(app: Any, name: str, source: list[str]) -> None:
    """Add a link to the lesson's notebook at its end."""
    if re.fullmatch(r"lessons/\d\d_\w+", name):
        link = f'<a href="{Path(name).name}.ipynb" download>Download this lesson as a notebook</a>'
        source[0] += f"\n# %% [markdown]\n# {link}\n"


def fill_contributing(app: Any, name: str, source: list[str]) -> None:
    """Let the contributor guide be a page: links to pages become links from page to page, those to files plain text."""
    pages = Path(app.srcdir)

    def link(match: re.Match[str]) -> str:
        words, target = match[1], match[2].removeprefix("docs/")
        is_page = target.endswith(".md") and (pages / target).is_file()
        return f"[{words}]({target})" if is_page or "://" in target else words

    if name == "contributing":
        text = (pages.parent / "CONTRIBUTING.md").read_text(encoding="utf-8")
        source[0] = re.sub(r"\[([^]]*)\]\(([^)]*)\)", link, text)


def fill_gallery(app: Any, name: str, source: list[str]) -> None:
    """Draw the pictures of the gallery."""
    if name == "gallery":
        scenes = ["boxes", "torus"] if QUICK else scene_names()
        shown = list(failures.values())[: 4 if QUICK else None]
        source[0] = gallery(source[0], Path(app.outdir) / "gallery", scenes, shown)


def use_descriptions() -> None:
    """Give the pictures that cells show the text that belongs to them: what the object that is shown says of itself."""
    from myst_nb.core.render import NbElementRenderer  # the tests import this file without Sphinx

    render = NbElementRenderer.render_image

    def render_image(self: Any, data: Any) -> list[Any]:
        shown = render(self, data)
        for image in shown:
            if words := data.output_metadata.get(data.mime_type, {}).get("alt"):
                image["alt"] = words
        return shown

    NbElementRenderer.render_image = render_image


def check_descriptions(app: Any, doctree: Any) -> None:
    """Warn of pictures without a text that says what is seen; a warning ends the build."""
    from docutils import nodes
    from sphinx.util import logging

    for image in doctree.findall(nodes.image):
        if len(image.get("alt", "").split()) < FEWEST_WORDS:
            logging.getLogger(__name__).warning("a picture without a description: %s", image["uri"], location=image)


def write_notebooks(app: Any, error: Exception | None) -> None:
    """Write the notebooks that the pages of the lessons link to."""
    folder = Path(app.outdir) / "lessons"
    if error is None and folder.is_dir():
        for earlier in folder.glob("*.ipynb"):
            earlier.unlink()
        copy_lessons(folder)


def setup(app: Any) -> None:
    """Connect the hooks; that of docstrings before napoleon's (priority 500) sees them."""
    app.connect("autodoc-process-docstring", spread_columns, priority=400)
    app.connect("source-read", offer_notebook, priority=400)
    app.connect("source-read", fill_contributing)
    app.connect("source-read", fill_gallery)
    app.connect("doctree-read", check_descriptions)
    use_descriptions()
    app.connect("build-finished", write_notebooks)
