"""The glossary: four languages, names that exist, and one spelling of each term in the documentation."""

import importlib
from pathlib import Path
from typing import Any

import pytest

from softshadow.course.glossary import TERMS, markdown_table

ROOT = Path(__file__).parents[2]


def resolve(name: str) -> Any:
    """Return what a full name stands for: a module, or an attribute of one; of a field without value its annotation."""
    parts = name.split(".")
    for length in range(len(parts), 0, -1):
        try:
            value: Any = importlib.import_module(".".join(parts[:length]))
        except ModuleNotFoundError:
            continue
        for attribute in parts[length:]:
            fields = getattr(value, "__dataclass_fields__", {})
            value = fields[attribute] if attribute in fields else getattr(value, attribute)
        return value
    raise ModuleNotFoundError(name)


@pytest.mark.parametrize("term", TERMS, ids=lambda term: term.english)
def test_every_name_of_a_term_exists(term: Any) -> None:
    assert term.symbols
    for name in term.symbols:
        resolve(name)


def test_every_term_has_four_languages_and_a_meaning() -> None:
    for term in TERMS:
        assert all(text.strip("* ") for text in term[:4])
        assert term.meaning.endswith(".")
    english = [term.english for term in TERMS]
    assert len(set(english)) == len(english) >= 40
    for term in TERMS:
        assert markdown_table().count(f"\n| {term.english} |") == 1


def test_every_term_is_used_in_the_documentation_in_one_spelling() -> None:
    pages = [*ROOT.glob("docs/*.md"), *ROOT.glob("docs/lessons/*.py"), ROOT / "README.md"]
    text = " ".join(" ".join(page.read_text(encoding="utf-8").lower().split()) for page in pages)
    for term in TERMS:
        short = term.english.partition(" (")[0]
        assert short in text, f"{term.english} is in no page"
        for spelling in term.avoid:
            assert spelling not in text, f"{spelling!r}: expected {term.english!r}"
