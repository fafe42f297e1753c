"""docs/api.md has every public name, and docs/api_gl.md every function of GL."""

import importlib
import re
from types import ModuleType
from typing import Any

import pytest

import softshadow as ss
from paths import ROOT
from softshadow import gl, lessons, notebook, testing
from softshadow.testing import strategies

PAGE = (ROOT / "docs" / "api.md").read_text(encoding="utf-8")
MODULES = set(re.findall(r"automodule:: ([\w.]+)", PAGE))
PLACES = {"failures": "`failures`", "shapes": "`shapes`", "gl": "`softshadow.gl`"}  # described in words
NOT_DESCRIBED = {"SOLIDS"}  # of the strategies: the bodies that they choose from


def documented() -> list[Any]:
    """Return the objects that the page describes one by one."""
    found = []
    for path in re.findall(r"auto(?:function|class|exception|data):: ([\w.]+)", PAGE):
        module, _, name = path.rpartition(".")
        found.append(getattr(importlib.import_module(module), name))
    return found


DOCUMENTED = documented()


@pytest.mark.parametrize("module", [ss, testing, lessons, notebook, strategies], ids=lambda module: module.__name__)
def test_every_public_name_is_on_the_page(module: ModuleType) -> None:
    missing = []
    for name in set(module.__all__) - NOT_DESCRIBED:
        thing = getattr(module, name)
        if isinstance(thing, ModuleType) or name in PLACES:
            described = f"softshadow.{name}" in PAGE or PLACES.get(name, name) in PAGE
        else:
            described = any(thing is each for each in DOCUMENTED) or getattr(thing, "__module__", "") in MODULES
        missing += [] if described else [name]
    assert missing == []


def test_every_function_of_gl_is_on_its_page_with_what_it_does() -> None:
    code = re.search(r"```\{code-cell\}.*?\n\n(.*?)```", (ROOT / "docs" / "api_gl.md").read_text(), re.DOTALL)[1]
    names: dict[str, Any] = {}
    exec(code, names)
    rows = dict(re.findall(r"^\| `(\w+)` \| (.+) \|$", "\n".join(names["lines"]), re.MULTILINE))
    functions = {name for name in dir(gl) if name.startswith("gl") and callable(getattr(gl, name))}
    assert set(rows) == functions
    assert len(functions) > 500


def test_what_gl_adds_to_opengl_is_on_the_page() -> None:
    added = {name for name in dir(gl) if not name.lower().startswith(("gl", "_")) and callable(getattr(gl, name))}
    assert [
        name for name in added - {"Context"} if f"`gl.{name}`" not in PAGE and f"softshadow.gl.{name}" not in PAGE
    ] == []
