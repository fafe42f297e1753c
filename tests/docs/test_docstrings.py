"""Every example in a docstring gives what it says."""

import doctest
import importlib
import pkgutil

import pytest

import softshadow

# modules that can only be imported in a process where Mesa was chosen beforehand; their examples would need it too
MESA_SIDE = ("softshadow.testing.opengl", "softshadow.testing.mesa_worker")  # beginnings of names
MODULES = [
    "softshadow",
    *(
        module.name
        for module in pkgutil.walk_packages(softshadow.__path__, "softshadow.")
        if not module.name.startswith(MESA_SIDE) and not module.name.endswith("__main__")
    ),
]


@pytest.mark.parametrize("name", MODULES)
def test_examples_of_docstrings_hold(name: str) -> None:
    module = importlib.import_module(name)
    options = doctest.NORMALIZE_WHITESPACE | doctest.ELLIPSIS
    failed, _ = doctest.testmod(module, optionflags=options, verbose=False)
    assert failed == 0
