"""What `import softshadow` brings, and what it does not."""

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


def test_the_function_run_is_not_hidden_by_its_module():
    assert python("import softshadow.run, softshadow as ss; print(type(ss.run).__name__)") == "function"
    assert python("import softshadow as ss; ss.run; import softshadow.run; print(callable(ss.run))") == "True"


def test_the_gallery_is_not_hidden_by_its_package():
    assert python("import softshadow.failures, softshadow as ss; print('acne' in ss.failures)") == "True"
    assert (
        python("import softshadow as ss; ss.failures; import softshadow.failures; print(len(ss.failures) > 1)")
        == "True"
    )


def test_a_name_that_is_not_there_is_an_attribute_error():
    with pytest.raises(AttributeError, match="has no attribute 'rum'"):
        ss.rum  # noqa: B018


def test_technique_and_scene_names_are_lists_to_choose_from():
    assert "volume-zfail" in ss.technique_names()
    assert "torus" in ss.scene_names()
    assert "Option" in ss.describe("map")
