"""The table of GL 2.1: each command is there, or a group of the table says why not."""

import tomllib
from fnmatch import fnmatchcase

import pytest

from paths import ROOT
from softshadow import gl

TABLE = tomllib.loads((ROOT / "docs/gl21.toml").read_text(encoding="utf-8"))
COMMANDS = [name for text in TABLE["commands"].values() for name in text.split()]


def reasons(name: str) -> list[str]:
    """The groups of the table that a command belongs to."""
    return [
        group["title"]
        for group in TABLE["missing"]
        if any(fnmatchcase(name, pattern) for pattern in group["commands"].split())
    ]


def test_every_command_is_there_or_has_a_reason() -> None:
    missing = [name for name in COMMANDS if not hasattr(gl, f"gl{name}")]
    assert [name for name in missing if not reasons(name)] == []


@pytest.mark.parametrize(("version", "count"), [("1.0", 306), ("1.1", 30), ("1.5", 19), ("2.1", 6)])
def test_the_list_has_the_commands_of_the_registry(version: str, count: int) -> None:
    assert len(TABLE["commands"][version].split()) == count


def test_no_command_is_listed_twice() -> None:
    assert len(COMMANDS) == len(set(COMMANDS)) == 551


def test_every_group_has_a_title_a_sentence_and_missing_commands() -> None:
    missing = [name for name in COMMANDS if not hasattr(gl, f"gl{name}")]
    for group in TABLE["missing"]:
        assert group["title"]
        assert any(group["title"] in reasons(name) for name in missing)
        assert group["reason"].endswith(".")
