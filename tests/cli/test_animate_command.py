"""``softshadow animate``: films, posters, exit codes, and what goes on after an interruption."""

from pathlib import Path

import imageio.v3 as imageio
import numpy as np
import pytest

import softshadow as ss
from cli.invocation import error_of, invoke, invoke_ok, json_of, usage_error_of

WORDS = ("animate", "map", "--scene", "boxes", "--size", "24x18", "-O", "map_size=16", "--frames", "4")


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def test_film_is_that_of_the_python_function_and_its_journal_is_deleted() -> None:
    shown = invoke_ok(*WORDS, "--light-path", "orbit", "--rate", 8, "-o", "film.webp", "--poster", "poster.png")
    assert "4 of 4 frames done, 0 failed, 0 left" in shown.stderr
    assert "written: film.webp" in shown.output
    film = ss.animate("map", "boxes", (24, 18), light_path="orbit", frames=4, rate=8, map_size=16)
    assert film.save("python.webp").read_bytes() == Path("film.webp").read_bytes()
    assert np.array_equal(imageio.imread("poster.png"), film.poster)
    assert sorted(each.name for each in Path().iterdir()) == ["film.webp", "poster.png", "python.webp"]


def test_film_without_a_name_is_called_after_the_technique_and_its_json_has_the_captions() -> None:
    answer = json_of(*WORDS, "--vary", "units=0..3", "--no-captions")
    assert answer["written"] == ["map.webp"]
    assert answer["captions"] == ["units=0.00", "units=1.00", "units=2.00", "units=3.00"]
    assert (answer["size"], answer["frames"]) == ([24, 18], 4)


def test_interrupted_film_is_not_begun_anew_but_resumed(monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object, **__: object) -> None:
        raise ss.SoftShadowError("film.webp: cannot be written: disk full")

    words = (*WORDS, "--light-path", "orbit", "-o", "film.webp")
    with monkeypatch.context() as patched:
        patched.setattr(ss.Film, "save", full)
        ended = invoke(*words)
    assert (ended.exit_code, ended.stderr.splitlines()[-1]) == (3, "error: film.webp: cannot be written: disk full")
    assert "expected --resume" in error_of(*words)
    shown = invoke_ok(*words, "--resume")
    assert "4 of 4 frames done, 0 failed, 0 left, 0.0 frames/s" in shown.stderr  # all were there
    assert Path("film.webp").exists()
    assert not Path("film.film-journal").exists()


def test_file_of_somebody_else_is_kept_and_found_before_anything_is_drawn() -> None:
    Path("film.webp").write_text("mine")
    assert "was not written by softshadow" in error_of(*WORDS, "--light-path", "orbit", "-o", "film.webp")
    assert not Path("film.film-journal").exists()
    invoke_ok(*WORDS, "--light-path", "orbit", "-o", "film.webp", "--force")


def test_wrong_words_are_named() -> None:
    assert "nothing changes from frame to frame" in usage_error_of(*WORDS)
    assert "an ending of .webp, .png, .gif, .mp4" in usage_error_of(*WORDS, "--light-path", "orbit", "-o", "a.avi")
    assert "expected a poster with the ending .png" in usage_error_of(
        *WORDS, "--light-path", "orbit", "--poster", "a.jpg"
    )
    assert "did you mean 'color'" in usage_error_of(*WORDS, "--light-path", "orbit", "--show", "colour")
    assert "expected only one of them" in usage_error_of(
        *WORDS, "--light-path", "orbit", "--workers", 2, "--scheduler", "tcp://a:1"
    )
    assert "did you mean 'orbit'" in error_of(*WORDS, "--light-path", "orbt")
