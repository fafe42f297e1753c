"""Hostile model and scene files: loaded or refused with a short message that names the file, soon."""

import codecs
import os
import warnings
from pathlib import Path

import numpy as np
import pytest

from scene.mutated_files import SCENE, good_files, mutated
from softshadow.errors import SceneError
from softshadow.scene.files import load_scene
from softshadow.scene.loading import load_mesh
from softshadow.scene.obj_text import MOST_CORNERS

QUICK, LONG = 25, 1500  # files of each type
LONGEST_MESSAGE = 14_000  # 20 mistakes of a scene file, each at most 600 characters and its place

FILES = good_files()


def load(path: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        load_scene(path) if path.suffix == ".toml" else load_mesh(path)


def check(path: Path, what: object) -> bool:
    """Load a file; return whether it was refused, with a message that names it."""
    try:
        load(path)
    except SceneError as error:
        message = str(error)
        assert str(path) in message, (what, message[:300])
        assert len(message) < LONGEST_MESSAGE, (what, len(message))
        return True
    return False


def check_mutations(ending: str, seeds: range, folder: Path) -> None:
    path = folder / f"file.{ending}"
    refused = 0
    for seed in seeds:
        path.write_bytes(mutated(FILES[ending], np.random.default_rng([8, seed])))
        refused += check(path, (ending, seed))
    assert refused > 0


@pytest.mark.parametrize("ending", FILES)
def test_the_files_are_good_before_they_are_mutated(ending, tmp_path):
    path = tmp_path / f"file.{ending}"
    path.write_bytes(FILES[ending])
    assert not check(path, ending)


@pytest.mark.parametrize("ending", FILES)
def test_mutated_files_are_loaded_or_refused(ending, tmp_path):
    check_mutations(ending, range(QUICK), tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize("ending", FILES)
def test_thousands_of_mutated_files_are_loaded_or_refused(ending, tmp_path):
    check_mutations(ending, range(QUICK, LONG), tmp_path)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (SCENE + b"x = " + b"[" * 5000, "brackets in brackets, too deep"),
        (SCENE.replace(b"[1, 4, 1]", b"[" + b"9" * 5000 + b", 4, 1]"), "not TOML: "),
        (SCENE.replace(b"[1, 4, 1]", b"[" + b"9" * 400 + b", 4, 1]"), "light[0].position[0]: expected "),
        (SCENE.replace(b"sides = 5", b"major_radius = " + b"9" * 400), "parameters.major_radius: "),
        (
            SCENE.replace(b"sides = 5, segments = 6", b"sides = 1000, segments = 1000"),
            "2000000 triangles; expected",
        ),
        (SCENE + b'[[object]]\nshape = "box"\n' * 600, "object: expected at most 500 tables [[object]]"),
        (SCENE + b'[[object]]\nshape = "bx"\n' * 400, "and 380 more"),
        (b"#" * (1 << 24) + b"\n" + SCENE, "expected at most 16777216"),
    ],
    ids=range(8),
)
def test_a_hostile_scene_is_refused_with_the_reason(text, said, tmp_path):
    path = tmp_path / "scene.toml"
    path.write_bytes(text)
    with pytest.raises(SceneError) as raised:
        load(path)
    assert said in str(raised.value)
    assert check(path, said)


@pytest.mark.parametrize("ending", ["obj", "toml", "off"])
def test_a_byte_order_mark_is_no_part_of_the_text(ending, tmp_path):
    path = tmp_path / f"file.{ending}"
    path.write_bytes(codecs.BOM_UTF8 + FILES[ending])
    assert not check(path, ending)


@pytest.mark.parametrize(
    "line",
    [
        "vt x y", "vn a b c", "v 0 0 0 x", "v 1_0 0 0", "v 0 0", "vn 1 2", "f 1_0 2 3", "f \uff11 2 3", "v \u0661 0 0",
        "vt", "f 1 2 3 \0",
    ],
)  # fmt: skip
def test_a_wrong_token_of_an_obj_is_refused_with_its_line(line, tmp_path):
    path = tmp_path / "wrong.obj"
    path.write_text(f"v 0 0 0\nv 1 0 0\nv 0 1 0\n{line}\nf 1 2 3\n", encoding="utf-8")
    with pytest.raises(SceneError, match=r"wrong.obj: line 4: expected "):
        load(path)


@pytest.mark.parametrize("corners", [MOST_CORNERS, MOST_CORNERS + 1, 20 * MOST_CORNERS])
def test_polygons_of_thousands_of_corners_are_refused(corners, tmp_path):
    angle = np.linspace(0, 2 * np.pi, corners, endpoint=False)
    radius = 1 + 0.5 * (np.arange(corners) % 2)  # a star
    rows = "".join(f"v {x} {y} 0\n" for x, y in zip(radius * np.cos(angle), radius * np.sin(angle), strict=True))
    path = tmp_path / "star.obj"
    path.write_text(f"{rows}f {' '.join(map(str, range(1, corners + 1)))}\n")
    if corners <= MOST_CORNERS:
        assert len(load_mesh(path)[0].triangles) == corners - 2
    else:
        with pytest.raises(SceneError, match=rf"a face with {corners} corners; expected at most {MOST_CORNERS}"):
            load(path)


@pytest.mark.parametrize("ending", ["obj", "toml", "ply"])
@pytest.mark.parametrize("kind", ["fifo", "device", "folder", "too long", "zero byte"])
def test_what_is_no_file_is_refused(kind, ending, tmp_path):
    path = tmp_path / {"too long": "x" * 300 + ".", "zero byte": "a\0b."}.get(kind, "file.")
    path = path.with_name(path.name + ending)
    if kind == "fifo":
        os.mkfifo(path)
    elif kind == "device":
        path.symlink_to("/dev/zero")
    elif kind == "folder":
        path.mkdir()
    assert check(path, kind)
