"""Every file of `fast/` names the readable function that it equals, and a test that compares the two."""

import ast
import importlib
import re
from pathlib import Path

import pytest

from softshadow.pipeline import fast

FILES = sorted(file for file in Path(fast.__file__).parent.rglob("*.py") if file.name != "__init__.py")
TESTS = Path(__file__).parents[1]
HEAD = re.compile(r"equals? (?:to )?`(?P<twin>[\w.]+)`, see (?P<test>fast/test_\w+\.py)\.$")


def test_there_are_files():
    assert len(FILES) >= 5


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_first_line_names_a_twin_and_an_agreement_test(file):
    head = (ast.get_docstring(ast.parse(file.read_text(encoding="utf-8"))) or "").splitlines()[0]
    match = HEAD.search(head)
    assert match, f"{file.name}: {head!r} does not end in 'equals `room.file.function`, see fast/test_NAME.py.'"
    module, function = f"softshadow.pipeline.{match['twin']}".rsplit(".", 1)
    assert not module.startswith("softshadow.pipeline.fast")
    assert callable(getattr(importlib.import_module(module), function))
    text = (TESTS / match["test"]).read_text(encoding="utf-8")
    assert "use_short_cuts(False)" in text, "the test does not draw without short cuts"
