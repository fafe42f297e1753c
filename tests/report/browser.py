"""Debian's or any other installed Chromium, driven by Playwright, for tests of pages."""

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)

# what leaves its slide, in a page of slides that shows all of them
OVERFLOWING = """() => [...document.querySelectorAll(".slide")].flatMap((slide) => {
  const box = slide.getBoundingClientRect();
  return [...slide.querySelectorAll("h1, h2, p, li, td, figcaption, svg")].filter((each) => {
    const own = each.getBoundingClientRect();
    return own.bottom > box.bottom + 1 || own.right > box.right + 1 || own.bottom < own.top;
  }).map((each) => `${slide.id}: ${each.tagName} ${each.textContent.slice(0, 40)}`);
})"""


@contextmanager
def chromium() -> Iterator[Any]:
    """A running browser; the test is skipped where there is none."""
    playwright = pytest.importorskip("playwright.sync_api", reason="needs Playwright (pip install playwright)")
    if CHROMIUM is None:
        pytest.skip("needs Chromium (apt-get install chromium)")
    with playwright.sync_playwright() as driver:
        # without its sandbox it also starts as root, as in a container
        browser = driver.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        yield browser
        browser.close()


@contextmanager
def opened(browser: Any, file: Path, fragment: str = "", **options: Any) -> Iterator[Any]:
    """A page that has been opened as a file; it may neither load anything else nor report an error."""
    context = browser.new_context(**({"viewport": {"width": 1280, "height": 900}} | options))
    page = context.new_page()
    problems: list[str] = []
    page.on("pageerror", lambda error: problems.append(str(error)))
    page.on("console", lambda message: problems.append(message.text) if is_complaint(message) else None)
    page.on("request", lambda request: problems.append(request.url) if not own(request.url, file) else None)
    page.goto(f"file://{file}{fragment}")
    page.wait_for_selector("html[data-ready]", timeout=20_000)
    yield page
    context.close()
    assert not problems, problems


def is_complaint(message: Any) -> bool:
    """Whether a message of the console is an error or a warning; those of a WebGL driver do not count."""
    return message.type in ("error", "warning") and "GL Driver Message" not in message.text


def own(url: str, file: Path) -> bool:
    """Whether a request is for the file itself or for data in it."""
    return url.startswith((f"file://{file}", "data:", "blob:", "about:srcdoc"))
