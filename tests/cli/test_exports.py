"""``export`` and ``view3d``: the files that they write, and what they print."""

import numpy as np
import pytest
import trimesh

import softshadow as ss
from cli.invocation import error_of, invoke, invoke_ok, json_of, usage_error_of

SMALL = ["--scene", "boxes", "--size", "48x36"]


@pytest.fixture(autouse=True)
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_export_writes_the_buffer_of_a_step(here):
    assert "written: stencil.npz" in invoke_ok("export", "volume-zfail", "stencil", *SMALL, "--step", "1").stderr
    with np.load(here / "stencil.npz") as stored:
        assert np.array_equal(stored["stencil"], ss.run("volume-zfail", "boxes", (48, 36))[1].stencil)
    told = json_of("export", "map", "ZS", *SMALL, "-o", "map.exr", "-O", "map_size=32")
    assert (told["written"], told["buffer"], told["technique"]) == ("map.exr", "ZS", "map")
    invoke_ok("export", "volume-zfail", "depth", *SMALL, "--step", "count back faces", "-o", "depth.png")


def test_export_tells_what_was_wrong():
    wrong = ["export", "volume-zfail"]
    assert "did you mean 'stencil'" in usage_error_of(*wrong, "stencl", *SMALL)
    assert "expected a name that ends in .npz" in usage_error_of(*wrong, "depth", "-o", "a.tif")
    assert "--step '9': step 9: there are 4" in usage_error_of(*wrong, "depth", *SMALL, "--step", "9")
    assert "did you mean" in usage_error_of(*wrong, "depth", *SMALL, "--step", "count back face")


def test_view3d_writes_a_page_and_prints_the_count(here):
    said = invoke_ok("view3d", "volume-zpass", 32, 17, *SMALL)
    lines = said.stdout.splitlines()
    assert lines[0] == "pixel 32, 17, light light: the count starts from 0"
    assert "written: volume-zpass-3d.html" in said.stderr
    told = json_of("view3d", "volume-zpass", 32, 17, *SMALL, "--of-light", "light")
    assert len(told["crossings"]) == len(lines) - 1
    assert "written: map.glb" in invoke_ok("view3d", "map", *SMALL, "-o", "map.glb").stderr
    assert "frustum/light" in trimesh.load_scene(here / "map.glb").geometry
    assert invoke("view3d", "map", 3, *SMALL).exit_code == 2


def test_render_writes_geometry(here):
    assert "written: volume.glb" in invoke_ok("render", "volume-zfail", *SMALL, "-o", "volume.glb").stderr
    assert "volume/light/tower/sides" in trimesh.load_scene(here / "volume.glb").geometry
    invoke_ok("render", "volume-zfail", *SMALL, "-o", "volume.ply")


def test_cards_are_written_and_their_answers_told(here):
    arguments = ["cards", "volume-zfail", "--scene", "boxes", "--size", "96x72", "-n", "2"]
    assert "written: cards.pdf" in invoke_ok(*arguments).stderr
    told = json_of(*arguments, "--seed", "3", "-o", "cards.png")
    assert told["written"] == "cards.png"
    assert len(told["cards"]) == 2
    assert all(card["stencil"] == [0, *card["counts"]][-1] for card in told["cards"])
    assert "counts no faces" in error_of("cards", "map", "--size", "48x36")
