"""Bad input: one message that names the file, key or argument, exit code 3, and no new files."""

import errno
import json
from pathlib import Path

import pytest

from cli.invocation import error_of, invoke, usage_error_of
from paths import SCENES, shared_files

CRATE = (SCENES / "crate.obj").read_text()
TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
GLTF = {
    "asset": {"version": "2.0"},
    "buffers": [{"uri": "points.bin", "byteLength": 36}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "nodes": [{"mesh": 0}],
    "scenes": [{"nodes": [0]}],
}


def gltf(buffer: str) -> str:
    return json.dumps({**GLTF, "buffers": [{"uri": buffer, "byteLength": 36}]})


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Work in a subfolder, with a secret file in the folder above."""
    (tmp_path / "secret.bin").write_bytes(bytes(36))
    folder = tmp_path / "here"
    folder.mkdir()
    monkeypatch.chdir(folder)
    return folder


def content(folder: Path) -> dict[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@pytest.mark.parametrize(
    ("name", "text", "said"),
    [
        ("no.obj", None, "there is no such file; expected an existing file"),
        ("no/such/folder.obj", None, "there is no such file; expected an existing file"),
        ("model.fbx", CRATE, "cannot read files of type '.fbx'; expected one of glb, gltf, obj, off, ply, stl"),
        ("empty.obj", "", "the file is empty; expected a mesh with at least one triangle"),
        ("comment.obj", "# nothing\n", "the file has no mesh; expected a mesh with at least one triangle"),
        ("points.obj", TRIANGLE, "3 points and no triangle; expected"),
        ("index.obj", TRIANGLE + "f 1 2 4\n", "expected"),
        ("zero.obj", TRIANGLE + "f 0 1 2\n", "line 4: face '0' uses index 0; expected indices from 1 on"),
        ("nan.obj", TRIANGLE.replace("1 0 0", "nan 0 0") + "f 1 2 3\n", "expected"),
        ("inf.obj", TRIANGLE.replace("1 0 0", "1e999 0 0") + "f 1 2 3\n", "expected"),
        ("words.obj", "v one two three\n", "expected"),
        ("cut.stl", "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0", "expected"),
        ("garbage.glb", "glTF and then nothing of the kind", ""),
        ("buffer.gltf", gltf("points.bin"), "buffers[0].uri 'points.bin': the file is missing"),
        ("outside.gltf", gltf("../secret.bin"), "'../secret.bin'"),
        ("encoded.gltf", gltf("%2e%2e/secret.bin"), "secret.bin'"),
        ("address.gltf", gltf("http://localhost/points.bin"), "'http://localhost/points.bin'"),
    ],
)
def test_model_is_refused_in_one_line_that_names_it(name: str, text: str | None, said: str, here: Path) -> None:
    if text is not None:
        Path(name).write_text(text)
    before = content(here)
    message = error_of("render", "volume-zfail", "--mesh", name, "--size", "16x12", "-o", "out.png")
    assert message.startswith(f"{name}: ")
    assert said in message
    assert "\n" not in message
    assert content(here) == before


def test_folder_and_unreadable_file_are_named(monkeypatch: pytest.MonkeyPatch) -> None:
    Path("folder.obj").mkdir()
    assert error_of("render", "map", "--mesh", "folder.obj") == "folder.obj: is a folder; expected a model file"
    Path("crate.obj").write_text(CRATE)
    Path("lesson.toml").write_text("")

    def refuse(self: Path) -> bytes:
        raise PermissionError(errno.EACCES, "Permission denied")

    monkeypatch.setattr(Path, "read_bytes", refuse)  # root, who may run the tests, can read every file
    assert "crate.obj: cannot be read (Permission denied)" in error_of("render", "map", "--mesh", "crate.obj")
    assert "lesson.toml: cannot be read (Permission denied)" in error_of("render", "map", "--scene", "lesson.toml")


@pytest.mark.parametrize("file", shared_files("bad"), ids=lambda file: file.name)
def test_real_bad_model_is_refused_in_one_line_or_drawn_with_a_named_warning(file: Path, here: Path) -> None:
    answer = invoke("render", "volume-zfail", "--mesh", file, "--size", "24x18", "-o", "out.png")
    if answer.exit_code == 0:
        assert "written: out.png" in answer.stderr
        assert "warning: " in answer.stderr
        assert file.name in answer.stderr
    else:
        message = error_of("render", "volume-zfail", "--mesh", file, "--size", "24x18", "-o", "out.png")
        assert message.startswith(f"{file}: ")
        assert "\n" not in message
        assert content(here) == {}


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["render", "volume-zfial"], "did you mean 'volume-zfail'?"),
        (["render", "nope"], "unknown technique 'nope': expected one of shadow-polygons, planar, planar-accumulated"),
        (["techniques", "mapp"], "did you mean 'map'?"),
        (["render", "map", "--scene", "boxs"], "did you mean 'boxes'?"),
        (["render", "map", "--scene", "Boxes"], "did you mean 'boxes'?"),
        (["render", "map", "--scene", "qqq"], "unknown scene 'qqq': expected one of boxes, torus"),
        (["compare", "map", "mapp"], "did you mean 'map'?"),
        (["compare", "boxes", "map"], "'boxes' is a scene; expected a technique here, and --scene boxes"),
        (["compare", "map", "volume-zfail", "-O", "kernel=3"], "'kernel=3': no technique here has it"),
        (["compare", "map:kernel=3", "map"], "technique 'map' has no option 'kernel'"),
        (["compare", "map", "map", "-o", "a.gif"], "a.gif: expected an ending of .png or .html, or a folder"),
        (["render", "--all", "-o", "a.png"], "a.png: expected a folder, such as a/"),
        (["render", "map", "--eye", "1,2,3", "--target", "1,2,3"], "camera: eye and target are both"),
        (["render", "map", "--fov", "180"], "fov_y: expected degrees between 0 and 180"),
        (["render", "volume-zfail", "-O", "cpa=finite"], "did you mean 'cap'?"),
        (["render", "volume-zfail", "-O", "cap=infinit"], "did you mean 'infinite'?"),
        (["render", "planar", "-O", "method=x"], "expected one of depth-off, offset, stencil, stencil-blend, texture"),
        (["render", "volume-zfail", "-O", "two_sided=maybe"], "two_sided='maybe': expected true or false"),
        (["render", "map", "-O", "map_size=big"], "map_size='big': expected a whole number"),
        (["render", "map", "-O", "map_size=0"], "map_size=0: expected a whole number"),
        (["render", "map", "-O", "bias=nan"], "bias=nan: expected a finite number"),
        (["render", "map", "--light", "nan,1,2"], "light: position: expected 4 finite numbers"),
        (["render", "map", "--size", "0x0"], "size=(0, 0): expected a width from 1 to 16384 pixels"),
        (["render", "map", "--size", "4x0"], "size=(4, 0): expected a height from 1 to 16384 pixels"),
        (["render", "map", "--size", "-4x3"], "size=(-4, 3): expected a width from 1 to 16384 pixels"),
        (["steps", "map", "--size", "4x99999"], "size=(4, 99999): expected a height from 1 to 16384 pixels"),
        (["tour", "--size", "0x9"], "size=(0, 9): expected a width from 1 to 16384 pixels"),
        (["pixel", "map", "16", "0", "--size", "16x12"], "x=16: expected a whole number from 0 to 15"),
        (["pixel", "map", "0", "12", "--size", "16x12"], "y=12: expected a whole number from 0 to 11"),
        (["render", "map", "-o", "a.gif"], "a.gif: expected an ending of .png, .npz, .html, .glb, .ply, or a folder"),
    ],
)
def test_value_is_refused_with_what_was_expected(words: list[str], said: str, here: Path) -> None:
    assert said in usage_error_of(*words)
    assert content(here) == {}


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["render", "map", "--scene", "no.toml"], "no.toml: cannot be read"),
        (["render", "map", "-o", "no/a.png"], "no/a.png: the folder no does not exist"),
        (["compare", "map", "map", "-o", "no/a.png"], "no/a.png: the folder no does not exist"),
        (["tour", "-o", "no/tour"], "no/tour: the folder no does not exist"),
    ],
)
def test_file_is_refused_with_what_was_expected(words: list[str], said: str, here: Path) -> None:
    message = error_of(*words)
    assert said in message
    assert "\n" not in message
    assert content(here) == {}


def test_size_that_does_not_fit_in_memory_is_refused_before_anything_is_drawn(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("softshadow.runs.perform.memory", lambda: 1e6)
    monkeypatch.setattr("softshadow.runs.perform._draw", None)
    for command in ("render", "steps"):
        assert "expected a smaller picture" in error_of(command, "map", "--size", "640x480")
    assert "expected a smaller picture" in error_of("tour", "--size", "640x480")


SCENE = """
[camera]
eye = [0, 2, 6]
target = [0, 0, 0]
[[light]]
position = [2, 5, 3]
[[object]]
shape = "torus"
move = [0, 1, 0]
"""


def test_camera_at_its_target_is_named() -> None:
    Path("lesson.toml").write_text(SCENE.replace("eye = [0, 2, 6]", "eye = [0, 0, 0]"))
    message = error_of("render", "map", "--scene", "lesson.toml")
    assert message.startswith("lesson.toml")
    assert "camera" in message
    assert "target" in message


def test_all_mistakes_of_a_scene_file_are_named(here: Path) -> None:
    wrong = SCENE.replace("eye = [0, 2, 6]", 'eye = "here"').replace("torus", "tours").replace("position", "postion")
    Path("lesson.toml").write_text(wrong + 'mesh = "../secret.obj"\n')
    before = content(here)
    message = error_of("tour", "--scene", "lesson.toml")
    for named in ("lesson.toml", "camera.eye", "light[0].postion", "did you mean 'position'?", "object[0]"):
        assert named in message
    assert content(here) == before


@pytest.mark.parametrize("output", ["a.png", "a.html", "a.npz"])
def test_foreign_file_is_overwritten_by_force_only(output: str) -> None:
    asked = ("render", "planar", "--size", "16x12", "-o", output)
    Path(output).write_text("my homework")
    message = error_of(*asked)
    assert message == f"{output}: exists and was not written by softshadow; --force overwrites it"
    assert Path(output).read_text() == "my homework"
    assert invoke(*asked, "--force").exit_code == 0
    assert invoke(*asked).exit_code == 0  # now it is ours


def test_foreign_file_in_a_folder_keeps_the_folder_as_it_was(here: Path) -> None:
    Path("all").mkdir()
    Path("all/steps.png").write_text("my homework")
    before = content(here)
    assert "--force" in error_of("render", "planar", "--size", "16x12", "-o", "all/")
    assert "--force" in error_of("steps", "planar", "--size", "16x12", "-o", "all")
    assert content(here) == before


def test_full_disk_leaves_what_was_there(here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    asked = ("render", "planar", "--size", "16x12", "-o", "a.png")
    assert invoke(*asked).exit_code == 0
    before = content(here)

    def fill(picture: object, path: Path) -> None:
        path.write_bytes(b"half of it")
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr("softshadow.runs.saving.save_png", fill)
    assert error_of(*asked) == "a.png: cannot be written (No space left on device)"
    assert content(here) == before


def test_interrupted_command_is_exit_code_130(monkeypatch: pytest.MonkeyPatch, here: Path) -> None:
    def interrupt(*arguments: object, **named: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("softshadow.runs.run", interrupt)
    answer = invoke("render", "planar", "--size", "16x12")
    assert answer.exit_code == 130
    assert "interrupted" in answer.stderr
    assert content(here) == {}


def test_traceback_is_shown_to_who_asks_for_it() -> None:
    with pytest.raises(ValueError, match="bias=nan"):
        invoke("--traceback", "render", "map", "-O", "bias=nan")
