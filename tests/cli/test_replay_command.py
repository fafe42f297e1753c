"""``softshadow replay``: frames listed, drawn and explained."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import softshadow as ss
from cli.invocation import error_of, invoke, invoke_ok, json_of
from paths import TRACE
from recordings.traced_program import TracedProgram


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def test_a_frame_is_drawn_and_its_steps_are_printed() -> None:
    result = invoke_ok("replay", TRACE, "--frame", 3)
    assert "call 193: GL_TRIANGLES" in result.stdout
    assert result.stdout.splitlines()[-1] == "arrays_and_lists.png"
    np.testing.assert_array_equal(np.asarray(Image.open("arrays_and_lists.png")), ss.replay(TRACE, 3).image)


def test_frames_are_listed() -> None:
    assert len(invoke_ok("replay", TRACE, "--list").stdout.splitlines()) == 5
    frames = json_of("replay", TRACE, "--list")["frames"]
    assert [frame["draws"] for frame in frames] == [4, 4, 4, 4]


def test_a_pixel_is_explained_without_writing_a_file(tmp_path: Path) -> None:
    result = invoke_ok("replay", TRACE, "--frame", 3, "--pixel", 20, 30)
    assert "call 193, triangle 0), depth test LESS" in result.stdout
    assert list(tmp_path.iterdir()) == []


def test_json_has_all_that_was_left_out(tmp_path: Path) -> None:
    traced = TracedProgram()
    traced.glUseProgram(1)
    traced.triangle()
    answer = json_of("replay", traced.save(tmp_path), "--pixel", 1, 1)
    assert [(entry["kind"], entry["count"], entry["in_frame"]) for entry in answer["left_out"]] == [
        ("shading language", 1, 1), ("draw of a GLSL program", 1, 1),
    ]  # fmt: skip
    assert answer["explanation"].endswith("is background: no triangle covers it.")
    told = invoke_ok("replay", tmp_path / "program.trace").stderr
    assert "left out: glBegin (call 3), draw of a GLSL program" in told


def test_a_truncated_file_is_listed_as_far_as_it_goes(tmp_path: Path) -> None:
    traced = TracedProgram()
    traced.triangle()
    traced.swap()
    traced.content += b"\0"
    result = invoke_ok("replay", traced.save(tmp_path), "--list")
    assert "the file ends within a call" in result.stderr


def test_wrong_usage_and_bad_input_are_told() -> None:
    assert invoke("replay", TRACE, "--frame", 1, "--until", 3).exit_code == 2
    assert error_of("replay", "no.trace").startswith("no.trace: there is no such file")
    assert "has 4 frames, 0 to 3" in invoke("replay", TRACE, "--frame", 9).stderr
