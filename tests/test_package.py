"""What `import softshadow` brings, and what it does not."""

import importlib.util
import subprocess
import sys

import pytest

import softshadow as ss

HEAVY = ("numpy", "numba", "PIL", "trimesh", "pydantic", "click", "rich", "OpenGL")


def python(code: str) -> str:
    """Return what a fresh interpreter prints."""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return done.stdout.strip()


def test_importing_the_package_imports_nothing_heavy():
    code = f"import sys, softshadow; print([name for name in {HEAVY} if name in sys.modules])"
    assert python(code) == "[]"


def test_every_public_name_is_there():
    for name in ss.__all__:
        assert getattr(ss, name) is not None
        assert name in dir(ss)


@pytest.mark.parametrize("name", ss.__all__)
def test_no_module_has_the_name_of_a_function_or_class(name):
    """Importing such a module would replace the attribute of the package."""
    is_module = importlib.util.find_spec(f"softshadow.{name}") is not None
    assert is_module == (name in ("gl", "notebook", "testing"))


def test_dir_lists_the_public_names_alone():
    assert dir(ss) == sorted([*ss.__all__, "__version__"])
    assert {"Technique", "shapes", "placement", "notebook"} <= set(dir(ss))


def test_names_can_be_imported_first():
    code = "from softshadow import failures, load_run, run; print(callable(run), 'acne' in failures)"
    assert python(code) == "True True"


def test_a_name_that_is_not_there_is_an_attribute_error():
    with pytest.raises(AttributeError, match="has no attribute 'rum'"):
        ss.rum  # noqa: B018


def test_technique_and_scene_names_are_lists_to_choose_from():
    assert "volume-zfail" in ss.technique_names()
    assert "torus" in ss.scene_names()
    assert "Option" in ss.describe("map")
