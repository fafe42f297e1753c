"""The pages of docs/ name what is there: every file of the package, every technique, every warning."""

import ast
import re
from pathlib import Path

import pytest

from softshadow import course, errors, techniques

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
PACKAGE = ROOT / "softshadow"


def page(name: str) -> str:
    return (DOCS / name).read_text(encoding="utf-8")


def test_every_file_says_what_it_does() -> None:
    """docs/layout.md is made of these first sentences."""
    silent = [
        str(file.relative_to(PACKAGE))
        for file in PACKAGE.rglob("*.py")
        if not ast.get_docstring(ast.parse(file.read_text(encoding="utf-8")))
    ]
    assert silent == []


def test_floors_of_the_layout_name_every_block() -> None:
    drawn = page("layout.md").split("```text")[1].split("```")[0]
    blocks = {file.stem if file.is_file() else f"{file.name}/" for file in PACKAGE.iterdir()}
    blocks -= {"__init__", "__main__", "__pycache__/", "py"}
    assert [block for block in sorted(blocks) if not re.search(rf"\b{re.escape(block)}(?!\w)", drawn)] == []


def test_every_technique_has_a_section() -> None:
    headings = " ".join(re.findall(r"^## .*", page("techniques.md"), re.MULTILINE))
    assert [name for name in techniques.names() if f"`{name}`" not in headings] == []


@pytest.mark.parametrize("base", [errors.Warning, errors.SoftShadowError])
def test_every_message_class_is_explained(base: type) -> None:
    text = page("messages.md")
    classes = [kind for kind in vars(errors).values() if isinstance(kind, type) and issubclass(kind, base)]
    assert [kind.__name__ for kind in classes if f"{kind.__name__}`" not in text] == []


def test_every_cited_paper_has_an_entry() -> None:
    entries = set(re.findall(r"@\w+\{([A-Za-z]+)(\d{4}),", page("papers.bib")))
    cited = re.findall(r"\*([A-Z]\w+)(?:[^*\"]*?) (\d{4}), \"", page("techniques.md"))
    assert cited, "techniques.md cites no paper"
    assert [f"{author} {year}" for author, year in cited if (author, year) not in entries] == []


def test_every_correction_that_a_technique_or_a_failure_points_at_is_told() -> None:
    told = set(course.ERRATA)
    cited = {
        number
        for block in ("techniques", "gallery", "listings", "lessons")
        for file in (PACKAGE / block).glob("*.py")
        for number in re.findall(r"\bE\d+\b", file.read_text(encoding="utf-8"))
    }
    assert sorted(cited - told) == []
