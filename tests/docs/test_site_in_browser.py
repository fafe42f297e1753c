"""The built pages of the documentation in a browser, at desktop and phone width; `nox -s docs` runs this.

SOFTSHADOW_SITE is the folder with the pages. The quick lane opens a few of them, the long lane all.
"""

import ast
import os
import re
from collections.abc import Iterator
from functools import cache
from html import unescape
from pathlib import Path
from typing import Any
from urllib.parse import unquote, urlsplit

import pytest

from conftest import ALL_LANES
from report.browser import chromium, is_complaint

pytestmark = pytest.mark.site

SITE = Path(os.environ.get("SOFTSHADOW_SITE", "no folder")).resolve()
PAGES = sorted(str(page.relative_to(SITE)) for page in SITE.rglob("*.html") if page.parent.name != "gallery")
QUICK = ("index.html", "gallery.html", "install.html", "lessons/08_planar_with_stencil.html", "techniques.html")
OPENED = [page for page in PAGES if ALL_LANES or page in QUICK]
FEWEST_WORDS = 4
WIDTHS = {"desktop": (1280, 800), "phone": (390, 844)}
MADE_BY_SPHINX = ("genindex.html", "search.html", "py-modindex.html")  # no text of ours

MISSING = """async () => {
  const pictures = [...document.images];
  for (const picture of pictures) picture.loading = "eager";
  await Promise.all(pictures.map((picture) => picture.decode().catch(() => null)));
  return pictures.filter((picture) => !picture.naturalWidth).map((picture) => picture.src);
}"""
# programs and commands go on in the next line; tables of text keep their lines, and scroll
CUT = """() => [...document.querySelectorAll(
  ".highlight-python pre, .highlight-ipython3 pre, .highlight-sh pre"
)].filter((pre) => pre.scrollWidth > pre.clientWidth + 1).map((pre) => pre.textContent.slice(0, 60))"""


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    with chromium() as started:
        yield started


@pytest.mark.parametrize("width", WIDTHS)
@pytest.mark.parametrize("name", OPENED)
def test_a_page_is_whole_and_fits(name: str, width: str, browser: Any) -> None:
    size = WIDTHS[width]
    page = browser.new_page(viewport={"width": size[0], "height": size[1]})
    problems: list[str] = []
    page.on("pageerror", lambda error: problems.append(str(error)))
    page.on("console", lambda message: problems.append(message.text) if is_complaint(message) else None)
    page.on("request", lambda request: problems.append(request.url) if request.url.startswith("http") else None)
    page.goto(f"file://{SITE / name}")
    assert page.evaluate(MISSING) == []
    assert page.evaluate("document.documentElement.scrollWidth") <= size[0]
    assert problems == []
    assert serious_findings(page) == []
    page.set_viewport_size({"width": min(size[0], 900), "height": size[1]})
    assert page.evaluate(CUT) == []
    page.close()


@pytest.mark.parametrize("name", [page for page in PAGES if page not in MADE_BY_SPHINX])
def test_pictures_have_a_text_that_says_what_is_seen(name: str) -> None:
    text = (SITE / name).read_text(encoding="utf-8")
    titles = {
        words(title) for title in re.findall(r"<(?:h[1-6]|title)\b[^>]*>(.*?)</(?:h[1-6]|title)>", text, re.DOTALL)
    }
    for picture in re.findall(r"<img\b[^>]*>", text):
        alt = re.search(r'\balt="([^"]*)"', picture)
        assert alt, picture[:120]
        said = words(alt[1])
        assert len(said.split()) >= FEWEST_WORDS, said  # not only the name of a file
        assert said not in titles
        assert not is_code(said), said


def words(text: str) -> str:
    """HTML as one line of text."""
    return " ".join(unescape(re.sub("<[^>]+>", "", text)).replace("¶", "").split())


def is_code(text: str) -> bool:
    """Whether a text is a statement of Python."""
    try:
        ast.parse(text)
    except (SyntaxError, ValueError):
        return False
    return True


def serious_findings(page: Any) -> list[str]:
    """What axe finds that keeps somebody from reading a page."""
    axe = pytest.importorskip("axe_playwright_python.sync_playwright", reason="needs axe-playwright-python")
    found = axe.Axe().run(page).response["violations"]
    return [
        f"{each['id']}: {each['nodes'][0]['html'][:120]}" for each in found if each["impact"] in ("serious", "critical")
    ]


@cache
def anchors(page: Path) -> set[str]:
    """The places in a page that a link can name."""
    return set(re.findall(r'\b(?:id|name)="([^"]+)"', page.read_text(encoding="utf-8")))


@pytest.mark.parametrize("name", PAGES)
def test_links_between_pages_lead_somewhere(name: str) -> None:
    page = SITE / name
    broken = []
    for link in re.findall(r'<(?:a|img|iframe)\b[^>]*?\b(?:href|src)="([^"]+)"', page.read_text(encoding="utf-8")):
        parts = urlsplit(link)
        if parts.scheme or link.startswith("//"):
            continue
        target = (page.parent / unquote(parts.path)).resolve() if parts.path else page
        place = unquote(parts.fragment)
        if not target.is_file() or (place and target.suffix == ".html" and place not in anchors(target)):
            broken.append(link)
    assert broken == []
