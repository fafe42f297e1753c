"""What a notebook shows of a run: the report in a frame, a picture, a text; also where the report is too large."""

import html
import re
from base64 import b64decode
from io import BytesIO
from pathlib import Path

import imageio.v3 as imageio
import jupytext
import nbclient
import nbconvert
import pytest

import softshadow as ss
from softshadow.runs import display
from widget_page import browser_page

SIZE = (64, 48)


@pytest.fixture(scope="module")
def run():
    return ss.run("map", "torus", SIZE, map_size=64)


def page_in(shown: str) -> str:
    """Return the page in the frame of what is shown."""
    (srcdoc,) = re.findall(r'<iframe srcdoc="([^"]*)"', shown)
    return html.unescape(srcdoc)


def test_a_notebook_gets_the_report_a_picture_and_a_text(run):
    shown = run._repr_mimebundle_()
    assert list(shown) == ["text/html", "text/plain", "image/png"]
    assert page_in(shown["text/html"]).startswith("<!doctype html>")
    assert shown["text/plain"].splitlines()[0] == repr(run)
    assert imageio.imread(BytesIO(b64decode(shown["image/png"]))).ndim == 3


def test_the_report_in_the_frame_is_the_one_that_is_saved(run, tmp_path):
    saved = run.save(tmp_path / "run.html").read_text(encoding="utf-8")
    assert page_in(run._repr_mimebundle_()["text/html"]) == saved


def test_a_report_that_is_too_large_gives_way_to_a_sentence(run, monkeypatch):
    monkeypatch.setattr(display, "LARGEST_REPORT", 1000)
    shown = run._repr_mimebundle_()
    assert "iframe" not in shown["text/html"]
    assert re.search(r"The report of this run has 0\.\d MB.*run\.save", shown["text/html"])
    assert f"data:image/png;base64,{shown['image/png']}" in shown["text/html"]


def test_a_report_that_would_be_much_too_large_is_not_begun(run, monkeypatch):
    monkeypatch.setattr(display, "MOST_PIXELS", 3 * 64 * 48 - 1)
    monkeypatch.setattr(display, "report_html", lambda run: pytest.fail("begun"))
    assert "would have many megabytes" in run._repr_mimebundle_()["text/html"]


def test_names_with_html_are_shown_as_text(run):
    scene = ss.Scene('"><script>alert(1)</script>', run.scene.camera, run.scene.lights, run.scene.objects)
    shown = ss.run("map", scene, SIZE, map_size=16)._repr_mimebundle_()["text/html"]
    assert "<script>" not in shown  # that of the report is escaped in its frame
    assert "<script>alert" not in page_in(shown)


@pytest.mark.slow
def test_an_exported_notebook_shows_the_report_without_kernel_and_network(tmp_path):
    cells = f"# %%\nimport softshadow as ss\nss.run('map', 'torus', {SIZE}, map_size=64)\n"
    notebook = jupytext.reads(cells, fmt="py:percent")
    nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3").execute()
    exporter = nbconvert.HTMLExporter(template_name="basic", require_js_url="", mathjax_url="", mermaid_js_url="")
    path = Path(tmp_path / "exported.html")
    path.write_text(exporter.from_notebook_node(notebook)[0], encoding="utf-8")
    with browser_page(viewport={"width": 1000, "height": 900}) as page:
        page.goto(path.as_uri())
        page.frame_locator("iframe").get_by_role("heading", name="map on torus").wait_for()
        assert page.errors == []
