"""The start page: one sentence, a report that can be clicked without a network, and links that lead somewhere."""

import importlib.util
import re
from types import ModuleType, SimpleNamespace
from typing import Any

import pytest

from paths import ROOT

DOCS = ROOT / "docs"
PAGE = (DOCS / "index.md").read_text(encoding="utf-8")
HEAVIEST = 1_000_000  # bytes of the report in the page
DOORS = ("lessons/index.md", "why.md", "replay.md", "techniques.md", "testing.md")


def test_report_in_the_page_is_small_has_a_title_and_loads_nothing() -> None:
    names: dict[str, Any] = {}
    for cell in re.findall(r"```\{code-cell\}[^\n]*\n(.*?)```", PAGE, re.DOTALL):
        *before, last = re.sub(r"^:tags: .*", "", cell, flags=re.MULTILINE).strip().splitlines()
        exec("\n".join([*before, f"shown = {last}"]), names)
    html = names["shown"]._repr_html_()
    assert len(html.encode()) < HEAVIEST
    assert re.search(r'<iframe srcdoc=".*?" title="[^"]+"', html, re.DOTALL)
    assert "width:100%" in html  # it is as wide as a phone
    assert not re.search(r"(src|href)=(&quot;|&#34;|\")https?:", html)


def test_first_sentence_says_what_it_is() -> None:
    first = PAGE.split("# softshadow\n\n")[1].split("\n\n")[0]
    assert first.count(".") == 1
    for word in ("shadow", "step by step", "pixel", "no GPU"):
        assert word in " ".join(first.split())


def test_every_door_and_every_page_of_the_contents_is_there() -> None:
    links = re.findall(r"\]\(([\w/]+\.md)\)", PAGE)
    assert set(DOORS) <= set(links)
    entries = [entry for block in re.findall(r"```\{toctree\}\n(.*?)```", PAGE, re.DOTALL)
               for entry in re.findall(r"^[\w/]+$", block, re.MULTILINE)]  # fmt: skip
    assert [name for name in links if not (DOCS / name).is_file()] == []
    assert [name for name in entries if not (DOCS / f"{name}.md").is_file()] == []
    assert sorted(entries) == sorted({*entries})
    pages = {path.stem for path in DOCS.glob("*.md")} - {"index"}
    assert pages == {entry for entry in entries if "/" not in entry}


@pytest.fixture
def settings() -> ModuleType:
    specification = importlib.util.spec_from_file_location("sphinx_settings", DOCS / "conf.py")
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    return module


def test_contributor_guide_is_a_page_whose_links_are_pages(settings: ModuleType) -> None:
    source = ["nothing"]
    settings.fill_contributing(SimpleNamespace(srcdir=str(DOCS)), "contributing", source)
    assert source[0].startswith("# Taking part")
    targets = [target for target in re.findall(r"\]\(([^)#]+)", source[0]) if "://" not in target]
    assert {"layout.md", "techniques.md"} <= set(targets)
    assert [target for target in targets if not (DOCS / target).is_file()] == []
    untouched = ["as it is"]
    settings.fill_contributing(SimpleNamespace(srcdir=str(DOCS)), "index", untouched)
    assert untouched == ["as it is"]
