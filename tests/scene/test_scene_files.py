"""Scene files: the examples load, and one message lists every mistake."""

import shutil
from pathlib import Path

import numpy as np
import pytest

from paths import SCENES
from softshadow.errors import OpenMesh, PartlyReadFile, SceneError
from softshadow.scene import Scene
from softshadow.scene.scene_schema import SHAPES

MINIMAL = """
[camera]
eye = [3, 3, 5]
target = [0, 0, 0]
[[light]]
position = [2, 5, 3]
[[object]]
shape = "box"
"""


def write(folder: Path, text: str, name: str = "lesson.toml") -> Path:
    file = folder / name
    file.write_text(text)
    return file


def mistakes_of(folder: Path, text: str) -> list[str]:
    """Return the mistakes listed in the error about a scene file."""
    file = write(folder, text)
    with pytest.raises(SceneError) as caught:
        Scene.load(file)
    first, *lines = str(caught.value).split("\n")
    assert first.startswith(f"{file}: {len(lines)} mistake")
    return [line.strip() for line in lines]


@pytest.mark.parametrize("file", sorted(SCENES.glob("*.toml")), ids=lambda file: file.stem)
def test_example_scene_loads(file: Path) -> None:
    scene = Scene.load(file)
    assert scene.name == file.stem
    assert scene.receivers
    assert scene.casters
    assert scene.warnings() == []


def test_example_scene_is_what_its_file_says() -> None:
    scene = Scene.load(SCENES / "lesson.toml")
    assert [light.name for light in scene.lights] == ["lamp", "sun"]
    assert [light.is_directional for light in scene.lights] == [False, True]
    assert [item.name for item in scene.objects] == ["floor", "back wall", "torus", "crate"]
    torus, crate = scene.casters
    assert torus.material.shininess == 40
    assert torus.material.color.tolist() == [0.85, 0.65, 0.2]
    assert np.cbrt(np.linalg.det(crate.object_to_world[:3, :3])) == pytest.approx(0.8)
    assert crate.mesh.topology.closed
    assert scene.ambient.tolist() == [0.15, 0.15, 0.18]


def test_smallest_scene_file_has_defaults(tmp_path: Path) -> None:
    scene = Scene.load(write(tmp_path, MINIMAL))
    assert scene.title == "lesson"
    assert scene.camera.fov_y == 45
    assert scene.casters[0].name == "box"


@pytest.mark.parametrize("shape", sorted(SHAPES))
def test_every_shape_can_be_used(tmp_path: Path, shape: str) -> None:
    sides = "parameters = { corner = [0, 0, 0], across = [1, 0, 0], up = [0, 1, 0] }\n" if shape == "quad" else ""
    scene = Scene.load(write(tmp_path, MINIMAL.replace('"box"', f'"{shape}"') + sides))
    assert scene.objects[0].mesh.name == shape


def test_unnamed_objects_get_unique_names(tmp_path: Path) -> None:
    text = MINIMAL + '[[object]]\nshape = "box"\n[[object]]\nshape = "box"\n[[light]]\ndirection = [0, 1, 0]\n'
    scene = Scene.load(write(tmp_path, text))
    assert [item.name for item in scene.objects] == ["box", "box 2", "box 3"]
    assert [light.name for light in scene.lights] == ["light", "light 2"]


def test_spot_light_has_an_axis_and_a_cutoff(tmp_path: Path) -> None:
    place = "position = [2, 5, 3]"
    scene = Scene.load(write(tmp_path, MINIMAL.replace(place, f"{place}\naxis = [0, -2, 0]\ncutoff = 25")))
    (light,) = scene.lights
    assert (light.is_spot, light.cutoff) == (True, 25)
    mistakes = mistakes_of(tmp_path, MINIMAL.replace(place, "direction = [0, 1, 0]\naxis = [0, -2, 0]\ncutoff = 25"))
    assert len(mistakes) == 1
    assert "a light at infinity has no cone" in mistakes[0]


def test_all_mistakes_are_listed_in_one_message(tmp_path: Path) -> None:
    mistakes = mistakes_of(
        tmp_path,
        """
titel = "x"
ambient = [0.1, 2, 0.1]
[camera]
eye = [0, 0, 0]
target = [0, 0, 0]
[[light]]
postion = [1, 2, 3]
[[light]]
position = [1, 2]
[[object]]
shape = "tours"
[[object]]
shape = "torus"
parameters = { major_radios = 2, segments = 2.5 }
material = "gould"
[[object]]
shape = "box"
name = "a"
scale = -1
[[object]]
mesh = "nothere.obj"
name = "a"
turn = [0, 0, 0, 0]
material = { colour = [1, 2, 3] }
[[object]]
shape = "sphere"
mesh = "crate.obj"
[[receiver]]
corner = [0, 0, 0]
across = [1, 0, 0]
[materials.gold]
color = "red"
shininess = inf
""",
    )
    nothere = tmp_path / "nothere.obj"
    assert sorted(mistakes) == sorted(
        [
            "titel: unknown key; did you mean 'title'? (there are: title, camera, light, object, receiver, materials, "
            "ambient, background)",
            "ambient[1]: expected [red, green, blue], each 0 to 1, got 2",
            "camera: eye and target are both [0.0, 0.0, 0.0]; expected two different points",
            "light[0].postion: unknown key; did you mean 'position'? "
            "(there are: name, position, direction, axis, cutoff, shape, parameters, attenuation, color)",
            "light[1].position: expected [x, y, z], got [1, 2]",
            "object[0].shape: no shape is called 'tours'; did you mean 'torus'? (there are: " + ", ".join(SHAPES) + ")",
            "object[1].parameters.major_radios: torus has no such parameter; did you mean 'major_radius'? "
            "(there are: major_radius, minor_radius, segments, sides)",
            "object[1].parameters.segments: expected a whole number from 1 to 1000, got 2.5",
            "object[1].material: no material is called 'gould'; did you mean 'gold'? (there are: gold)",
            "object[2].scale: expected positive factors, got -1",
            f"object[3].mesh: {nothere}: there is no such file; expected an existing file",
            "object[3].name: 'a' is used twice; expected a unique name",
            "object[3].turn: expected an axis of a length other than 0, got [0.0, 0.0, 0.0, 0.0]",
            "object[3].material.colour: unknown key; did you mean 'color'? "
            "(there are: color, specular, shininess, emission)",
            "object[4]: expected either shape (a built-in shape) or mesh (a model file)",
            "receiver[0].up: expected [x, y, z], but it is missing",
            "materials.gold.color: expected [red, green, blue], each 0 to 1, got 'red'",
            "materials.gold.shininess: expected a number from 0 to 128, got inf",
        ]
    )


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (
            ("[camera]\neye = [3, 3, 5]\ntarget = [0, 0, 0]\n", ""),
            "camera: expected a table [camera] with eye and target",
        ),
        (("[[light]]", "[light]"), "light: expected one or more tables [[light]], got {'position': [2, 5, 3]}"),
        (("[[light]]\nposition = [2, 5, 3]\n", ""), "light: expected one or more tables [[light]], but it is missing"),
        (('[[object]]\nshape = "box"\n', ""), "expected at least one [[object]] or [[receiver]]"),
        (("position = [2, 5, 3]", ""), "light[0]: expected either position (a point) or direction"),
        (("position = [2, 5, 3]", "direction = [0, 0, 0]"), "light[0].position: expected a point"),
        (("target = [0, 0, 0]", "target = [0, 0, 0]\nnear = 9\nfar = 2"), "camera: expected 0 < near < far"),
        (
            ("target = [0, 0, 0]", "target = [0, 0, 0]\nfov_y = '45'"),
            "camera.fov_y: expected degrees between 0 and 180",
        ),
        (("position = [2, 5, 3]", "position = [2, 5, nan]"), "light[0].position[2]: expected [x, y, z], got nan"),
        (('shape = "box"', 'shape = "box"\ncasts = 1'), "object[0].casts: expected true or false, got 1"),
        (
            ('shape = "box"', 'shape = "box"\nmaterial = 3'),
            "object[0].material: expected the name of a [materials.NAME]",
        ),
        (
            ('"box"', '"box"\nparameters = { width = 0 }'),
            "object[0].parameters.width: expected a positive number, got 0",
        ),
        (('"box"', '"torus"\nparameters = { sides = 2 }'), "object[0].parameters.sides: expected at least 3, got 2"),
        (('"box"', '"sphere"\nparameters = { rings = 100000 }'), "rings: expected a whole number from 1 to 1000"),
        (('"box"', '"cylinder"\nparameters = { capped = 1 }'), "parameters.capped: expected true or false, got 1"),
        (('"box"', '"quad"'), "object[0].parameters.corner: expected [x, y, z], but it is missing"),
        (('"box"', '"box"\nparameters = 3'), "object[0].parameters: expected a table of numbers, got 3"),
    ],
)
def test_mistake_is_named_with_its_place(tmp_path: Path, change: tuple[str, str], said: str) -> None:
    text = MINIMAL.replace(*change)
    assert text != MINIMAL
    assert any(said in line for line in mistakes_of(tmp_path, text))


@pytest.mark.parametrize("mesh", ["../crate.obj", "/crate.obj", "link.obj", "sub/../../crate.obj"])
def test_model_outside_the_folder_of_the_file_is_refused(tmp_path: Path, mesh: str) -> None:
    folder = tmp_path / "lesson"
    folder.mkdir()
    shutil.copy(SCENES / "crate.obj", tmp_path)
    (folder / "link.obj").symlink_to(tmp_path / "crate.obj")
    (line,) = mistakes_of(folder, MINIMAL.replace('shape = "box"', f'mesh = "{mesh}"'))
    assert line == f"object[0].mesh: {mesh!r} is outside the folder of the scene file; expected a file inside it"


def test_model_below_the_folder_is_read_with_its_warnings(tmp_path: Path) -> None:
    (tmp_path / "models").mkdir()
    write(tmp_path / "models", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2\n", "flat.obj")
    scene = Scene.load(write(tmp_path, MINIMAL.replace('shape = "box"', 'mesh = "models/flat.obj"')))
    assert [type(warning) for warning in scene.warnings()] == [PartlyReadFile, OpenMesh]


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"[camera\n", r"not TOML: .*line 1"),
        (b"title = '\xff'", "byte 9 is not UTF-8; expected a scene file"),
    ],
)
def test_file_that_is_not_toml_is_named(tmp_path: Path, content: bytes, said: str) -> None:
    file = tmp_path / "lesson.toml"
    file.write_bytes(content)
    with pytest.raises(SceneError, match=said):
        Scene.load(file)


def test_missing_scene_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(SceneError, match=r"gone.toml: cannot be read \(No such file or directory\)"):
        Scene.load(tmp_path / "gone.toml")
    with pytest.raises(SceneError, match="is a folder; expected a scene file"):
        Scene.load(tmp_path)
