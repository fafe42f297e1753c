"""Model files: each is loaded or refused with one sentence, and none can reach files outside its folder."""

import base64
import json
import struct
import warnings
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from paths import shared_file, shared_files
from softshadow.errors import MeshError, PartlyReadFile, SceneError
from softshadow.scene import Mesh, Scene, shapes
from softshadow.scene.loading import load_mesh
from softshadow.scene.obj_text import drawable_lines
from softshadow.scene.polygon import quads_are_fans, triangulate

CUBE_OBJ = (Path(__file__).parents[2] / "docs" / "scenes" / "crate.obj").read_text()

# for each file of data/bad: a part of its error message, or of a warning about the scene
BAD_FILES = {
    "TestScene.gltf": "error: buffers[0].uri 'TestScene.bin': the file is missing",
    "busted.STL": "facet normals of length 0 replaced by computed ones",
    "empty.obj": "error: the file has no mesh",
    "empty.stl": "error: the file has no mesh",
    "empty_nodes.glb": "error: the file has no mesh",
    "nancolor.obj": "vertex colours that are not finite numbers left out",
    "notenoughindices.obj": "1 face with fewer than 3 corners left out",
    "obj_points.obj": "error: 8 points and no triangle",
    "obj_wireframe.obj": "error: 8 points and no triangle",
    "obj_with_no_face_in_chunk.obj": "the mesh is open, 1 body: 3 boundary edges",
    "points_ascii.ply": "error: 5 points and no triangle",
}
TOPOLOGIES = {
    "stanford-bunny.obj": "open, 1 body: 223 boundary edges",
    "teapot.obj": "open, 3 bodies: 160 boundary edges",
    "rocker-arm.obj": "closed, 1 body",
    "Duck.glb": "closed, 1 body",
    "BoxTextured.glb": "closed, 1 body",
    "unit_sphere.STL": "closed, 1 body",
    "sphere.ply": "closed, 1 body",
    "wallhole.obj": "closed, 1 body",
    "suzanne.obj": "open, 1 body: 42 boundary edges, 1 non-manifold edge",
}


def write(folder: Path, name: str, content: str | bytes) -> Path:
    file = folder / name
    file.write_bytes(content if isinstance(content, bytes) else content.encode())
    return file


def triangle_gltf(**changes: object) -> dict:
    """Return a glTF tree of one triangle with an embedded buffer."""
    data = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], dtype="<f4").tobytes()
    tree = {
        "asset": {"version": "2.0"},
        "buffers": [{"uri": "data:;base64," + base64.b64encode(data).decode(), "byteLength": 36}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "nodes": [{"mesh": 0}],
        "scenes": [{"nodes": [0]}],
    }
    return {**tree, **changes}


@pytest.mark.parametrize("file", shared_files("meshes"), ids=lambda file: file.name)
def test_model_becomes_a_scene_without_output(file: Path, capfd: pytest.CaptureFixture) -> None:
    if file.suffix == ".bin":
        pytest.skip("the buffer of a glTF file")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        scene = Scene.from_mesh(file)
    assert [item.name for item in scene.casters] == [file.name]
    assert capfd.readouterr() == ("", "")
    if file.name in TOPOLOGIES:
        assert scene.casters[0].mesh.topology.describe() == TOPOLOGIES[file.name]


@pytest.mark.parametrize("file", shared_files("bad"), ids=lambda file: file.name)
def test_bad_model_is_refused_in_one_sentence_or_gives_warnings(file: Path, capfd: pytest.CaptureFixture) -> None:
    expected = BAD_FILES[file.name]
    if expected.startswith("error: "):
        with pytest.raises(MeshError) as caught:
            Scene.from_mesh(file)
        message = str(caught.value)
        assert message.startswith(str(file))
        assert expected.removeprefix("error: ") in message
        assert "expected" in message
        assert "\n" not in message
    else:
        assert any(expected in str(warning) for warning in Scene.from_mesh(file).warnings())
    assert capfd.readouterr() == ("", "")


def test_every_bad_file_is_listed() -> None:
    assert {file.name for file in shared_files("bad")} <= set(BAD_FILES)


def test_model_stands_on_the_floor_with_size_two_in_the_middle_of_the_picture() -> None:
    scene = Scene.from_mesh(shared_file("meshes/stanford-bunny.obj"))
    points = scene.casters[0].world_positions[np.unique(scene.casters[0].mesh.triangles)]
    low, high = points.min(axis=0), points.max(axis=0)
    assert (high - low).max() == pytest.approx(2)
    assert low[1] == pytest.approx(0, abs=1e-12)  # float64 rounding of a size of 2
    assert (low + high)[[0, 2]] == pytest.approx(0, abs=1e-12)
    assert scene.camera.target == pytest.approx((low + high) / 2)


def test_file_with_z_up_is_turned_upright(tmp_path: Path) -> None:
    tall = write(tmp_path, "tall.obj", CUBE_OBJ.replace("0.5\n", "2.5\n"))  # long along z
    upright = Scene.from_mesh(tall, up="z").casters[0].world_positions
    assert np.ptp(upright, axis=0) == pytest.approx([0.4, 2, 0.4])
    with pytest.raises(SceneError, match="up: unknown axis 'Z'"):
        Scene.from_mesh(tall, up="Z")


def test_light_may_be_a_point_or_a_direction(tmp_path: Path) -> None:
    cube = write(tmp_path, "cube.obj", CUBE_OBJ)
    assert Scene.from_mesh(cube, light=(1, 2, 3)).lights[0].position.tolist() == [1, 2, 3, 1]
    assert Scene.from_mesh(cube, light=(1, 2, 3, 0)).lights[0].is_directional


# -- paths that are not a readable model file --------------------------------------------------------------------------


def test_mesh_is_loaded_in_the_coordinates_of_its_file_with_warnings(tmp_path: Path) -> None:
    file = write(tmp_path, "cube.obj", CUBE_OBJ)
    loaded, expected = Mesh.load(file), load_mesh(file)[0]
    np.testing.assert_array_equal(loaded.positions, expected.positions)
    assert loaded.name == "cube.obj"
    with pytest.warns(PartlyReadFile):
        Mesh.load(write(tmp_path, "other.obj", "mtllib ../other.mtl\n" + CUBE_OBJ))


def test_missing_file_is_named_with_a_similar_one(tmp_path: Path) -> None:
    write(tmp_path, "bunny.obj", CUBE_OBJ)
    with pytest.raises(MeshError, match=r"buny.obj: there is no such file; did you mean 'bunny.obj'\?"):
        load_mesh(tmp_path / "buny.obj")
    with pytest.raises(MeshError, match="there is no such file; expected an existing file"):
        load_mesh(tmp_path / "nowhere" / "x.obj")


def test_folder_is_named(tmp_path: Path) -> None:
    (tmp_path / "folder.obj").mkdir()
    with pytest.raises(MeshError, match="is a folder; expected a model file"):
        load_mesh(tmp_path / "folder.obj")


def test_unreadable_file_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(self: Path) -> bytes:
        raise PermissionError(13, "Permission denied")

    file = write(tmp_path, "cube.obj", CUBE_OBJ)
    monkeypatch.setattr(Path, "read_bytes", refuse)  # root, who may run the tests, can read every file
    with pytest.raises(MeshError, match=r"cannot be read \(Permission denied\); expected a readable file"):
        load_mesh(file)


@pytest.mark.parametrize("name", ["model.blend", "model", "model.ob"])
def test_unknown_type_is_named_with_the_known_ones(tmp_path: Path, name: str) -> None:
    with pytest.raises(MeshError, match=r"cannot read files of type .*glb, gltf, obj, off, ply, stl"):
        load_mesh(write(tmp_path, name, CUBE_OBJ))


@pytest.mark.parametrize("suffix", ["obj", "ply", "stl", "off", "glb", "gltf"])
@pytest.mark.parametrize("content", [b"", b"\0" * 200, b"garbage " * 40, b"\xff\xfe\x00ply\nformat"])
def test_garbage_of_every_type_gives_one_sentence(tmp_path: Path, suffix: str, content: bytes) -> None:
    with pytest.raises(MeshError) as caught:
        load_mesh(write(tmp_path, f"garbage.{suffix}", content))
    assert str(caught.value).startswith(str(tmp_path))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("name", ["sphere.ply", "unit_sphere.STL", "Duck.glb", "Mesh_PrimitiveMode_04.gltf"])
def test_truncated_file_is_refused_in_one_sentence(tmp_path: Path, name: str) -> None:
    data = shared_file(f"meshes/{name}").read_bytes()
    with pytest.raises(MeshError) as caught:
        load_mesh(write(tmp_path, name, data[: len(data) * 2 // 3 + 1]))
    assert "\n" not in str(caught.value)


# -- Wavefront OBJ -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4", "line 4: v 4 does not exist; expected 1 to 3"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2", "line 4: face '0' uses index 0; expected indices from 1 on"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -4", "line 4: v -4 does not exist; there are 3 before this line"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/9 2/1 3/1\nvt 0 0", "line 4: vt 9 does not exist"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 x", "line 4: expected whole numbers in a face, got 'x'"),
        ("v 0 0\nv 1 0 0", "line 1: expected v with three numbers, got '0 0'"),
        ("v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3", "1 vertices have coordinates that are NaN"),
        ("v 0 0 inf\nv 1 0 0\nv 0 1 0\nf 1 2 3", "infinite"),
        ("v 0 0 0\nv 1e300 0 0\nv 0 1 0\nf 1 2 3", "infinite or beyond"),
        ("v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3", "none of the 1 triangles has an area"),
    ],
)
def test_wrong_line_of_an_obj_is_named(tmp_path: Path, text: str, said: str) -> None:
    with pytest.raises(MeshError) as caught:
        load_mesh(write(tmp_path, "wrong.obj", text))
    assert said in str(caught.value)
    assert str(tmp_path / "wrong.obj") in str(caught.value)


def test_quads_with_normals_keep_their_creases_and_are_closed(tmp_path: Path) -> None:
    mesh, notes = load_mesh(write(tmp_path, "cube.obj", CUBE_OBJ))
    assert len(mesh.triangles) == 12
    assert mesh.topology.describe() == "closed, 1 body"
    assert len(mesh.positions) == 24
    assert mesh.signed_volume == pytest.approx(1)
    assert ((mesh.face_normals * mesh.normals[mesh.triangles[:, 0]]).sum(axis=1) == 1).all()
    assert notes == []


def test_triangles_are_in_the_order_of_the_file(tmp_path: Path) -> None:
    text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nusemtl a\nf 1 2 3 4\no b\nusemtl b\nf 1 2 5\nusemtl a\nf 3 4 5"
    mesh, _ = load_mesh(write(tmp_path, "order.obj", text))
    assert mesh.triangles.tolist() == [[0, 1, 2], [0, 2, 3], [0, 1, 4], [2, 3, 4]]
    assert len(mesh.positions) == 5


def test_negative_indices_count_back_from_their_line(tmp_path: Path) -> None:
    text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 5 5\nv 6 5 5\nv 5 6 5\nf -3 -2 -1"
    mesh, _ = load_mesh(write(tmp_path, "relative.obj", text))
    assert mesh.triangles.tolist() == [[0, 1, 2], [3, 4, 5]]


def test_polygon_with_a_notch_is_triangulated_inside_its_outline(tmp_path: Path) -> None:
    text = "v 0 0 0\nv 2 -1 0\nv 0 2 0\nv 0.5 0 0\nf 1 2 3 4"
    mesh, _ = load_mesh(write(tmp_path, "notch.obj", text))
    assert (mesh.face_normals[:, 2] > 0).all()


def test_vertex_colors_of_an_obj_are_read(tmp_path: Path) -> None:
    text = "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 0.5\nf 1 2 3"
    mesh, _ = load_mesh(write(tmp_path, "colors.obj", text))
    assert mesh.colors.tolist() == [[1, 0, 0, 1], [0, 1, 0, 1], [0, 0, 0.5, 1]]


def test_texture_coordinates_of_an_obj_are_read(tmp_path: Path) -> None:
    text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3"
    mesh, _ = load_mesh(write(tmp_path, "uv.obj", text))
    assert mesh.texcoords.tolist() == [[0, 0], [1, 0], [0, 1]]


@pytest.mark.parametrize("path", ["../secret.mtl", "/etc/passwd", "C:\\secret.mtl", "a/../../secret.mtl"])
def test_material_library_outside_the_folder_is_not_read_and_named(tmp_path: Path, path: str) -> None:
    folder = tmp_path / "models"
    folder.mkdir()
    _, notes = load_mesh(write(folder, "cube.obj", f"mtllib {path}\n{CUBE_OBJ}"))
    (note,) = notes
    assert isinstance(note, PartlyReadFile)
    assert f"line 1: mtllib {path}: outside the folder, not read" in str(note)


# -- glTF --------------------------------------------------------------------------------------------------------------


def test_gltf_with_an_embedded_buffer_is_read(tmp_path: Path) -> None:
    mesh, notes = load_mesh(write(tmp_path, "inside.gltf", json.dumps(triangle_gltf())))
    assert mesh.positions.tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
    assert notes == []


@pytest.mark.parametrize(
    ("uri", "said"),
    [
        ("../outside.bin", "outside the folder, refused"),
        ("%2e%2e/outside.bin", "outside the folder, refused"),
        ("/etc/hostname", "outside the folder, refused"),
        ("file:///etc/hostname", "outside the folder, refused"),
        ("https://example.org/a.bin", "outside the folder, refused"),
        ("..\\outside.bin", "outside the folder, refused"),
        ("link.bin", "outside the folder, refused"),
        ("gone.bin", "the file is missing"),
        ("short.bin", "expected 36 bytes, got 5"),
    ],
)
def test_buffer_that_is_not_beside_the_model_is_refused(tmp_path: Path, uri: str, said: str) -> None:
    folder = tmp_path / "models"
    folder.mkdir()
    write(tmp_path, "outside.bin", np.zeros(9, "<f4").tobytes())
    write(folder, "short.bin", b"short")
    (folder / "link.bin").symlink_to(tmp_path / "outside.bin")
    tree = triangle_gltf(buffers=[{"uri": uri, "byteLength": 36}])
    with pytest.raises(MeshError) as caught:
        load_mesh(write(folder, "model.gltf", json.dumps(tree)))
    assert "buffers[0]" in str(caught.value)
    assert said in str(caught.value)


def test_image_outside_the_folder_is_not_read_and_named(tmp_path: Path) -> None:
    tree = triangle_gltf(images=[{"uri": "../secret.png"}], textures=[{"source": 0}])
    _, (note,) = load_mesh(write(tmp_path, "image.gltf", json.dumps(tree)))
    assert "images[0].uri '../secret.png': outside the folder, not read" in str(note)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"asset": {"version": "1.0"}}, "asset.version: expected glTF 2.x, got '1.0'"),
        ({"extensionsRequired": ["KHR_draco_mesh_compression"]}, "KHR_draco_mesh_compression is not supported"),
        ({"accessors": [{"componentType": 5126, "count": 3, "type": "VEC3"}]}, "accessors[0]: sparse"),
        ({"accessors": []}, "not a well-formed GLTF file (IndexError"),
        ({"meshes": [{"primitives": [{"attributes": {}}]}]}, "KeyError: 'POSITION'"),
        ({"meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 0}]}]}, "the file has no mesh"),
        ({"nodes": []}, "not a well-formed GLTF file"),
        ({"buffers": [{"byteLength": 36}]}, "buffers[0]: has no uri"),
        ({"buffers": "text"}, "not a well-formed GLTF file"),
    ],
)
def test_unreadable_gltf_is_refused_in_one_sentence(tmp_path: Path, changes: dict, said: str) -> None:
    with pytest.raises(MeshError) as caught:
        load_mesh(write(tmp_path, "model.gltf", json.dumps(triangle_gltf(**changes))))
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)


def test_scene_graph_moves_turns_and_repeats_a_mesh(tmp_path: Path) -> None:
    nodes = [
        {"children": [1, 2], "translation": [10, 0, 0]},
        {"mesh": 0, "scale": [2, 2, 2]},
        {"mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1], "camera": 0},
    ]
    tree = triangle_gltf(nodes=nodes, cameras=[{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}])
    mesh, _ = load_mesh(write(tmp_path, "graph.gltf", json.dumps(tree)))
    assert len(mesh.triangles) == 2
    assert sorted(map(tuple, mesh.positions.tolist())) == sorted(
        [(10, 0, 0), (12, 0, 0), (10, 2, 0), (10, 0, 5), (11, 0, 5), (10, 1, 5)]
    )


def test_mirrored_node_keeps_its_faces_outward(tmp_path: Path) -> None:
    tree = triangle_gltf(nodes=[{"mesh": 0, "scale": [-1, 1, 1]}])
    mesh, _ = load_mesh(write(tmp_path, "mirror.gltf", json.dumps(tree)))
    assert (mesh.face_normals[:, 2] > 0).all()


def test_nodes_that_contain_each_other_do_not_loop_forever(tmp_path: Path) -> None:
    tree = triangle_gltf(nodes=[{"mesh": 0, "children": [1]}, {"children": [0]}])
    mesh, _ = load_mesh(write(tmp_path, "cycle.gltf", json.dumps(tree)))
    assert len(mesh.triangles) >= 1


def test_index_beyond_the_vertices_is_named(tmp_path: Path) -> None:
    data = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], "<f4").tobytes() + struct.pack("<3H", 0, 1, 7)
    tree = triangle_gltf(
        buffers=[{"uri": "data:;base64," + base64.b64encode(data).decode(), "byteLength": 42}],
        bufferViews=[{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
        accessors=[
            {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"},
        ],
        meshes=[{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    )
    with pytest.raises(MeshError, match="a face uses vertex 7; expected 0 to 2"):
        load_mesh(write(tmp_path, "index.gltf", json.dumps(tree)))


def test_base_color_and_texture_coordinates_of_a_glb_are_read() -> None:
    mesh, _ = load_mesh(shared_file("meshes/BoxTextured.glb"))
    assert mesh.colors is not None
    assert mesh.texcoords.min() >= 0
    assert mesh.normals is not None


def test_glb_that_declares_more_bytes_than_it_has_is_named(tmp_path: Path) -> None:
    data = b"glTF" + struct.pack("<IIII", 2, 1000, 900, 0x4E4F534A) + b"{}"
    with pytest.raises(MeshError, match="a GLB chunk declares 900 bytes, but the file has only 2 more"):
        load_mesh(write(tmp_path, "short.glb", data))


# -- the other types ---------------------------------------------------------------------------------------------------


def test_binary_stl_is_closed_by_position(tmp_path: Path) -> None:
    box = shapes.box()
    facets = np.zeros(12, dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("spare", "<u2")])
    facets["corners"] = box.positions[box.triangles]
    facets["normal"] = box.face_normals
    mesh, notes = load_mesh(write(tmp_path, "box.stl", b"\0" * 80 + struct.pack("<I", 12) + facets.tobytes()))
    assert mesh.topology.describe() == "closed, 1 body"
    assert len(mesh.positions) == 36
    assert notes == []


def test_binary_stl_of_wrong_length_is_named(tmp_path: Path) -> None:
    with pytest.raises(MeshError, match="as a binary STL it declares 50084 bytes but has 134"):
        load_mesh(write(tmp_path, "cut.stl", b"\0" * 80 + struct.pack("<I", 1000) + b"\0" * 50))


def test_truncated_off_is_refused(tmp_path: Path) -> None:
    with pytest.raises(MeshError, match="not a well-formed OFF file"):
        load_mesh(write(tmp_path, "cut.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1"))


def test_off_with_quads_is_read(tmp_path: Path) -> None:
    mesh, _ = load_mesh(write(tmp_path, "quad.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"))
    assert len(mesh.triangles) == 2
    assert (mesh.face_normals[:, 2] > 0).all()


PLY = """ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
{vertex}element face 2
property list uchar int vertex_indices
{face}end_header
"""


def test_vertex_colors_of_a_ply_are_read(tmp_path: Path) -> None:
    names = "".join(f"property uchar {name}\n" for name in ("red", "green", "blue"))
    rows = "0 0 0 255 0 0\n1 0 0 0 255 0\n1 1 0 0 0 255\n0 1 0 0 0 0\n3 0 1 2\n3 0 2 3\n"
    mesh, _ = load_mesh(write(tmp_path, "colors.ply", PLY.format(vertex=names, face="") + rows))
    assert mesh.colors[:2].tolist() == [[1, 0, 0, 1], [0, 1, 0, 1]]


def test_face_colors_of_a_ply_are_read_and_faces_share_no_vertices(tmp_path: Path) -> None:
    names = "".join(f"property uchar {name}\n" for name in ("red", "green", "blue"))
    rows = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 255 0 0\n3 0 2 3 0 0 255\n"
    mesh, _ = load_mesh(write(tmp_path, "faces.ply", PLY.format(vertex="", face=names) + rows))
    assert mesh.colors[mesh.triangles[0]].tolist() == [[1, 0, 0, 1]] * 3
    assert mesh.colors[mesh.triangles[1]].tolist() == [[0, 0, 1, 1]] * 3
    assert mesh.topology.boundary_edges == 4


def test_ply_index_out_of_range_is_named(tmp_path: Path) -> None:
    rows = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 9\n"
    with pytest.raises(MeshError, match="a face uses vertex 9; expected 0 to 3"):
        load_mesh(write(tmp_path, "index.ply", PLY.format(vertex="", face="") + rows))


@given(st.integers(0, 2**32 - 1))
def test_quadrilaterals_are_fans_where_ears_say_so(seed):
    rng = np.random.default_rng(seed)
    quads = rng.choice([0.0, 1.0, 2.0, 0.5, -1.0, np.nan], (50, 4, 3), p=[0.2, 0.2, 0.2, 0.2, 0.19, 0.01])
    quads[::2] += rng.normal(0, 0.3, (25, 4, 3))
    fans = quads_are_fans(quads)
    for quad in quads[fans]:
        assert triangulate(quad) == [(0, 1, 2), (0, 2, 3)]
    convex = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]) + rng.uniform(-0.2, 0.2, (20, 4, 3))
    assert quads_are_fans(convex).all()


@given(st.integers(0, 2**32 - 1))
def test_faces_cut_many_at_a_time_are_those_cut_one_by_one(seed):
    """Indices with a sign are resolved one by one."""
    rng = np.random.default_rng(seed)
    positions = rng.integers(-2, 3, (9, 3))
    lines = [f"v {x} {y} {z}" for x, y, z in positions] + ["vt 0 0"] * 9 + ["vn 0 0 1"] * 9
    forms = ["{0}", "{0}/{0}", "{0}//{0}", "{0}/{0}/{0}"]
    faces = [
        [str(rng.choice(forms)), *rng.permutation(9)[: rng.choice([3, 4, 4, 5])]] for _ in range(rng.integers(1, 9))
    ]

    def cut(first: int) -> str:
        text = [*lines, *(f"f {' '.join(form.format(n + first) for n in corners)}" for form, *corners in faces)]
        return drawable_lines("\n".join(text), "model.obj")[0]

    assert cut(1) == cut(-9)
