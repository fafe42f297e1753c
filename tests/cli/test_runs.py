"""``softshadow render``, ``steps`` and ``pixel``: images, reports, tables and the history of a pixel."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

import softshadow as ss
from cli.invocation import invoke_ok, json_of
from paths import SCENES, shared_file
from softshadow.cli.arguments import SceneArguments

SIZE = (48, 36)
SMALL = ("--size", "48x36")


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture(scope="module")
def zfail() -> ss.Run:
    return ss.run("volume-zfail", "torus", SIZE)


def test_picture_is_named_by_the_technique_and_its_path_is_printed(zfail: ss.Run) -> None:
    answer = invoke_ok("render", "volume-zfail", *SMALL)
    assert (answer.stdout, answer.stderr) == ("", "written: volume-zfail.png\n")
    with Image.open("volume-zfail.png") as picture:
        np.testing.assert_array_equal(np.asarray(picture), zfail.image)


def test_ending_chooses_the_form(zfail: ss.Run, here: Path) -> None:
    for output in ("a.html", "a.npz", "a.png", "all/"):
        invoke_ok("render", "volume-zfail", *SMALL, "-o", output)
    assert (here / "a.html").read_text(encoding="utf-8").lstrip().startswith("<!doctype html>")
    np.testing.assert_array_equal(ss.load_run("a.npz").stencil, zfail.stencil)
    assert {"image.png", "steps.png", "visibility.png", "state.txt", "run.npz"} <= {
        p.name for p in Path("all").iterdir()
    }


def test_indices_of_the_stencil_pictures_are_the_counts(zfail: ss.Run) -> None:
    invoke_ok("render", "volume-zfail", *SMALL, "-o", "all/")
    pictures = sorted(Path("all").glob("*-stencil.png"))
    assert len(pictures) == len(zfail.steps)
    for path, step in zip(pictures, zfail.steps, strict=True):
        with Image.open(path) as picture:
            assert picture.mode == "P"
            np.testing.assert_array_equal(np.asarray(picture), step.stencil)
    assert zfail[1].stencil.max() > 0


def test_explain_path_tells_the_way_of_every_draw() -> None:
    draws = len(ss.run("volume-zfail", "torus", SIZE).frame.commands)
    paths = json_of("render", "volume-zfail", *SMALL, "--explain-path")["paths"]
    assert 0 < len(paths) <= draws
    assert {path["way"] for path in paths} >= {"opaque", "depth and stencil only, in chunks"}
    assert all(path["reasons"] for path in paths)
    printed = invoke_ok("render", "volume-zfail", *SMALL, "--explain-path", "--force").stdout
    assert printed.count("no colour is written or tested") == sum("chunks" in path["way"] for path in paths)


def test_json_of_render_tells_what_was_drawn_and_written(zfail: ss.Run) -> None:
    answer = json_of("render", "volume-zfail", *SMALL, "-O", "two-sided=yes", "-o", "b.png")
    assert answer["written"] == "b.png"
    assert answer["size"] == list(SIZE)
    assert answer["scene"] == "torus"
    assert answer["options"]["two_sided"] is True
    assert answer["shadowed_share"] == pytest.approx(zfail.shadow_mask.mean())


def test_options_arrive_as_their_kinds() -> None:
    arguments = ("-O", "map_size=64", "-O", "factor=2", "-O", "cull=front")
    options = json_of("render", "map", *SMALL, *arguments, "-o", "map.npz")["options"]
    assert options == {**ss.load_run("map.npz").options}
    assert (options["map_size"], options["factor"], options["cull"]) == (64, 2.0, "front")


def test_scene_may_be_named_a_file_or_a_model() -> None:
    assert json_of("render", "map", *SMALL, "--scene", "boxes")["scene"] == "boxes"
    assert json_of("render", "map", *SMALL, "--scene", SCENES / "lesson.toml")["scene"] == "lesson"
    assert json_of("render", "map", *SMALL, "--mesh", SCENES / "crate.obj")["scene"] == "crate"


def test_light_replaces_the_lights_of_a_scene() -> None:
    invoke_ok("render", "volume-zfail", *SMALL, "--light=-2,5,1,0", "-o", "a.npz")
    assert ss.load_run("a.npz").scene.lights[0].position.tolist() == [-2, 5, 1, 0]
    invoke_ok("render", "volume-zfail", *SMALL, "--mesh", SCENES / "crate.obj", "--light", "0,9,0.5", "-o", "a.npz")
    assert ss.load_run("a.npz").scene.lights[0].position.tolist() == [0, 9, 0.5, 1]


def test_repeated_light_is_several_lights() -> None:
    invoke_ok("render", "volume-zfail", *SMALL, "--light=2,5,3", "--light=-2,5,1,0", "-o", "a.npz")
    lights = ss.load_run("a.npz").scene.lights
    assert [light.position.tolist() for light in lights] == [[2, 5, 3, 1], [-2, 5, 1, 0]]
    assert [light.name for light in lights] == ["light 1", "light 2"]


def test_camera_is_that_of_the_scene_but_for_what_is_given() -> None:
    invoke_ok("render", "map", *SMALL, "--scene", "boxes", "--eye=3,4,5", "--fov", "60", "-o", "a.npz")
    camera, own = ss.load_run("a.npz").scene.camera, ss.Scene.named("boxes").camera
    assert (camera.eye.tolist(), camera.fov_y) == ([3, 4, 5], 60)
    assert camera.target.tolist() == own.target.tolist()
    invoke_ok("render", "map", *SMALL, "--mesh", SCENES / "crate.obj", "--target=0,1,0", "-o", "a.npz")
    assert ss.load_run("a.npz").scene.camera.target.tolist() == [0, 1, 0]


def test_arguments_are_spelled_as_the_shell_takes_them() -> None:
    assert SceneArguments().text((4, 3)) == "--scene torus --size 4x3"
    lit = SceneArguments("boxes", lights=((-1.0, 2.5, 3.0), (0.0, 1.0, 0.0, 0.0)))
    assert lit.text((4, 3)) == "--scene boxes --light=-1,2.5,3 --light=0,1,0,0 --size 4x3"
    seen = SceneArguments(mesh="my duck.glb", eye=(1.0, 2.0, -3.5), target=(0.0, 0.0, 0.0), fov=50.0)
    assert seen.text((4, 3)) == "--mesh 'my duck.glb' --eye=1,2,-3.5 --target=0,0,0 --fov=50 --size 4x3"


def test_all_techniques_are_drawn_into_a_folder(here: Path) -> None:
    answer = json_of_all("--scene", "boxes", "--size", "24x18", "-O", "map_size=32")
    drawn = [each["technique"] for each in answer["techniques"]]
    assert drawn + [each["technique"] for each in answer["left_out"]] == ss.technique_names()
    assert {path.name for path in (here / "all-techniques").iterdir()} == {
        "sheet.png", *(f"{name}.png" for name in drawn)
    }  # fmt: skip
    with Image.open("all-techniques/map.png") as picture:
        expected = ss.run("map", "boxes", (24, 18), map_size=32).image
        np.testing.assert_array_equal(np.asarray(picture), expected)


def test_technique_that_refuses_the_scene_is_left_out(here: Path) -> None:
    answer = invoke_ok("render", "--all", "--scene", "sunlight", "--size", "24x18", "-o", "sun/")
    assert "left out: map-cube: " in answer.stderr
    assert answer.stderr.endswith("written: sun/\nwritten: sun/sheet.png\n")
    assert not Path("sun/map-cube.png").exists()


def json_of_all(*words: str) -> dict[str, Any]:
    answer = json.loads(invoke_ok("render", "--all", *words, "--json").stdout)
    assert answer["schema"] == "softshadow/render-all/1"
    return answer


def test_written_file_is_opened(monkeypatch: pytest.MonkeyPatch, here: Path) -> None:
    opened: list[str] = []
    monkeypatch.setattr("webbrowser.open", lambda address: opened.append(address) or True)
    invoke_ok("render", "planar", *SMALL, "-o", "a.html", "--open")
    invoke_ok("section", "--scene", "boxes", "--open")
    assert opened == [(here / "a.html").as_uri(), (here / "section.svg").as_uri()]


def test_steps_are_counted_as_in_the_ledger(zfail: ss.Run) -> None:
    rows = json_of("steps", "volume-zfail", *SMALL)["steps"]
    assert [row["title"] for row in rows] == zfail.steps.titles
    for row, counts, step in zip(rows, zfail.ledger.steps, zfail.steps, strict=True):
        assert (row["draws"], row["triangles"]) == (counts.draws, counts.triangles)
        assert row["fragments"] == counts.fragments
        assert sum(row["stencil_counts"].values()) == step.stencil.size
        assert row["stencil_counts"].get("1", 0) == np.count_nonzero(step.stencil == 1)
    lines = invoke_ok("steps", "volume-zfail", *SMALL).stdout.splitlines()
    for step in zfail.steps:
        assert any(step.title in line for line in lines)


def test_steps_are_written_when_a_folder_is_named(here: Path) -> None:
    answer = invoke_ok("steps", "volume-zpass", *SMALL, "-o", "pass")
    assert "written: pass" in answer.stderr
    np.testing.assert_array_equal(ss.load_run("pass/run.npz").stencil, ss.run("volume-zpass", "torus", SIZE).stencil)


def test_pixel_is_told_as_by_the_run(zfail: ss.Run) -> None:
    y, x = np.argwhere(zfail.shadow_mask)[0]
    text = invoke_ok("pixel", "volume-zfail", x, y, *SMALL).stdout
    assert text == f"{zfail.pixel(x, y)}\n{zfail.explain(x, y)}\n"
    answer = json_of("pixel", "volume-zfail", x, y, *SMALL)
    assert (answer["x"], answer["y"], answer["gl_y"]) == (x, y, SIZE[1] - 1 - y)
    assert answer["explanation"] == zfail.explain(x, y)
    assert answer["fragments"][-1]["stencil_after"] == zfail.stencil[y, x]


@pytest.mark.parametrize("model", ["stanford-bunny.obj", "Duck.glb"])
@pytest.mark.parametrize("technique", ["volume-zfail", "map"])
def test_real_model_is_drawn_with_a_shadow(model: str, technique: str) -> None:
    answer = json_of("render", technique, "--mesh", shared_file(f"meshes/{model}"), "--size", "96x72", "-o", "a.png")
    # a model of size 2 under a light from (2, 5, 3): its shadow and its dark side are a part of the picture, no more
    assert 0.01 < answer["shadowed_share"] < 0.5
    assert [warning["name"] for warning in answer["warnings"]] == (["OpenMesh"] if "bunny" in model else [])
