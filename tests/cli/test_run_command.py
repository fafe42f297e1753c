"""``softshadow run``: a PyOpenGL program's last frame."""

from pathlib import Path

import pytest

from cli.invocation import error_of, invoke, invoke_ok, json_of
from windows.window_programs import GLUT


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("program.py").write_text(GLUT + "print('printed')\n")


def test_the_last_frame_is_drawn_and_its_steps_are_printed() -> None:
    result = invoke_ok("run", "program.py", "--size", "32x24")
    assert result.stdout.splitlines()[-1] == "program.png"
    assert "line 12: GL_QUADS" in result.stdout
    assert Path("program.png").is_file()


def test_a_pixel_after_keys_and_clicks_is_explained() -> None:
    result = invoke_ok("run", "program.py", "--keys", "g,Up", "--click", "16,0", "--pixel", 8, 6)
    assert "#ff0000" in result.stdout
    assert "shows what was drawn in step 'line 12: GL_QUADS'" in result.stdout


def test_json_is_not_mixed_with_what_the_program_prints() -> None:
    assert json_of("run", "program.py")["steps"] == ["clear colour", "line 12: GL_QUADS"]


def test_wrong_usage_and_bad_input_are_told() -> None:
    assert invoke("run", "program.py", "--click", "3").exit_code == 2
    assert error_of("run", "none.py").startswith("none.py: there is no such file")
    Path("broken.py").write_text("1 / 0\n")
    assert error_of("run", "broken.py").startswith("broken.py line 1: ZeroDivisionError: division by zero")
