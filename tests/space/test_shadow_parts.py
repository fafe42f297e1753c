"""The geometry of shadows: what files hold is what techniques draw, and closed where the volume is closed."""

import json
import struct
import warnings

import numpy as np
import pytest
import trimesh

import softshadow as ss
from softshadow.scene import Light, Scene
from softshadow.scene.silhouette import silhouette
from softshadow.space import Edges, Surface, shadow_geometry
from softshadow.space.shadow_parts import cut_at
from softshadow.techniques.shadow_volumes import scene_reach, volumes_of

SCENES = ["torus", "boxes", "sunlight", "overlapping", "open-tube"]


def loaded(path):
    return trimesh.load_scene(path)


def whole(pieces):
    """Return meshes as one, with equal positions merged."""
    corners = np.concatenate([np.asarray(piece.vertices)[piece.faces] for piece in pieces])
    positions, numbers = np.unique(corners.reshape(-1, 3).astype(np.float32), axis=0, return_inverse=True)
    return trimesh.Trimesh(positions, numbers.reshape(-1, 3), process=False)


@pytest.mark.parametrize("name", SCENES)
def test_a_loaded_glb_has_the_edges_and_faces_that_the_techniques_draw(name, tmp_path):
    scene = Scene.named(name)
    file = loaded(shadow_geometry(scene).save(tmp_path / "volume.glb"))
    for light in scene.lights:
        for item in volumes_of(scene, light):
            start = f"volume/{light.name}/{item.caster.name}"
            outline = silhouette(item.caster.mesh, light.in_object_space(item.caster.object_to_world))
            if not len(outline.edges):  # it shades only itself: an object in the plane of the light
                continue
            lines = file.geometry[f"silhouette/{light.name}/{item.caster.name}"]
            assert len(lines.vertices) == 2 * len(outline.edges)
            # edge i joins the vertices of the caster's mesh that the file tells
            vertices = np.array(lines.metadata["vertices"])
            assert (vertices == outline.edges).all()
            ends = np.asarray(lines.vertices, np.float32).reshape(-1, 2, 3)
            assert np.array_equal(ends, item.caster.world_positions[vertices].astype(np.float32))
            assert len(file.geometry[f"{start}/sides"].faces) == 2 * len(item.volume.sides)
            cap = len(item.volume.light_cap) + len(item.volume.light_cap_reversed)
            assert len(file.geometry[f"{start}/light cap"].faces) == cap
            end = "cut" if light.is_directional else "dark cap"
            assert len(file.geometry[f"{start}/{end}"].faces) == cap
            assert light.is_directional or cap == len(item.volume.dark_cap)


@pytest.mark.parametrize("name", ["torus", "boxes", "sunlight", "overlapping"])
@pytest.mark.parametrize("more", [{}, {"cap": "finite"}, {"distance": 50.0}])
def test_the_volume_of_a_closed_caster_is_watertight_in_the_file(name, more, tmp_path):
    geometry = shadow_geometry(name, **more)
    file = loaded(geometry.save(tmp_path / "volume.glb"))
    volumes = {name.rsplit("/", 1)[0] for name in file.geometry if name.startswith("volume/")}
    assert volumes
    for volume in volumes:
        mesh = whole([piece for part, piece in file.geometry.items() if part.startswith(f"{volume}/")])
        edges = np.concatenate([mesh.faces[:, [i, (i + 1) % 3]] for i in range(3)])
        ways, numbers = np.unique(edges, axis=0, return_counts=True)
        backwards = dict(zip(map(tuple, ways[:, ::-1].tolist()), numbers.tolist(), strict=True))
        assert all(backwards[tuple(way)] == n for way, n in zip(ways.tolist(), numbers.tolist(), strict=True))
        assert mesh.volume > 0


def test_a_box_is_watertight_for_trimesh_too(tmp_path):
    file = loaded(shadow_geometry("boxes").save(tmp_path / "volume.glb"))
    for caster in ("cube", "block", "tower"):
        mesh = whole([piece for name, piece in file.geometry.items() if name.startswith(f"volume/light/{caster}/")])
        assert mesh.is_watertight


def test_vertices_at_infinity_are_cut_at_the_stated_distance():
    scene = Scene.named("boxes")
    geometry = shadow_geometry(scene, distance=20.0)
    (light,) = scene.lights
    assert geometry.distances == {"light": 20.0}
    far = geometry["volume/light/tower/dark cap"].positions
    assert np.linalg.norm(far - light.position[:3], axis=1) == pytest.approx(20, rel=1e-6)


@pytest.mark.parametrize("name", SCENES)
def test_everything_in_the_scene_lies_before_the_cut(name):
    scene = Scene.named(name)
    for light in scene.lights:
        geometry = shadow_geometry(scene, light.name)
        reach = scene_reach(scene, light)
        assert geometry.distances[light.name] >= reach
        if light.is_directional:
            continue
        for cap in geometry.surfaces("volume"):
            if cap.name.endswith("dark cap"):
                assert (np.linalg.norm(cap.faces.mean(axis=1) - light.position[:3], axis=1) >= 0.99 * reach).all()


def test_a_cut_leaves_points_behind_the_distance_where_they_are():
    light = Light((0, 0, 0))
    assert cut_at(np.array([[1.0, 0, 0], [0, 9.0, 0]]), light, 4.0).tolist() == [[4, 0, 0], [0, 9, 0]]


def test_frusta_wedges_and_lights_of_areas_are_closed_and_where_they_should_be(tmp_path):
    scene = Scene.named("soft-slab")
    geometry = shadow_geometry(scene, parts=("frustum", "wedges"))
    file = loaded(geometry.save(tmp_path / "soft.glb"))
    box, wedges = file.geometry["frustum/light"], file.geometry["wedges/light/slab"]
    assert (len(box.faces), len(wedges.faces)) == (12, 4 * 8)
    assert box.is_watertight
    assert wedges.is_watertight
    assert box.volume > 0
    assert wedges.volume > 0
    assert (file.geometry["light/light"].vertices[:, 1] == scene.lights[0].position[1]).all()


def test_a_run_has_the_geometry_of_its_technique(tmp_path):
    small = {"size": (32, 24)}
    kinds = {
        name: {each.split("/")[0] for each in ss.run(name, "boxes", **small).geometry().names}
        for name in ("volume-zfail", "map", "map-cube", "planar")
    }
    same = {"receiver", "caster", "light"}
    assert kinds == {
        "volume-zfail": same | {"silhouette", "volume"},
        "map": same | {"frustum"},
        "map-cube": same | {"frustum"},
        "planar": same | {"silhouette"},
    }
    run = ss.run("volume-zpass", "boxes", **small, generator="per-polygon", cap="finite", reach=9.0)
    sides = run.geometry()["volume/light/cube/sides"]
    item = volumes_of(run.scene, run.scene.lights[0], "per-polygon", "finite", 9.0)[0]
    assert item.caster.name == "cube"
    assert sides.notes["sides"] == len(item.volume.sides) == 18


def test_run_save_writes_glb_and_ply(tmp_path):
    run = ss.run("volume-zfail", "boxes", (32, 24))
    file = loaded(run.save(tmp_path / "volume.glb"))
    assert set(file.geometry) == set(run.geometry().names)
    ply = run.save(tmp_path / "volume.ply")
    mesh = trimesh.load_mesh(ply)
    surfaces = [piece for piece in run.geometry() if isinstance(piece, Surface)]
    assert len(mesh.faces) == sum(len(piece.triangles) for piece in surfaces)
    assert b"comment piece 0: receiver/floor" in ply.read_bytes()[:4096]
    run.save(tmp_path / "volume.glb")  # its own files are overwritten
    run.save(tmp_path / "volume.ply")
    (tmp_path / "foreign.glb").write_bytes(b"glTF")
    with pytest.raises(ss.SoftShadowError, match="was not written by softshadow"):
        run.save(tmp_path / "foreign.glb")


def test_names_in_a_glb_are_node_names_too(tmp_path):
    data = shadow_geometry("torus").save(tmp_path / "a.glb").read_bytes()
    (length,) = struct.unpack("<I", data[12:16])
    tree = json.loads(data[20 : 20 + length])
    assert "volume/light/torus/sides" in [node["name"] for node in tree["nodes"]]


def test_pieces_are_found_by_name_and_mistakes_are_told(tmp_path):
    geometry = shadow_geometry("boxes")
    assert isinstance(geometry["silhouette/light/cube"], Edges)
    with pytest.raises(KeyError, match="did you mean 'volume/light/cube/sides'"):
        geometry["volume/light/cube/side"]
    with pytest.raises(ValueError, match="did you mean 'frustum'"):
        shadow_geometry("boxes", parts=("frustrum",))
    with pytest.raises(ValueError, match="did you mean 'light'"):
        shadow_geometry("boxes", "ligth")
    with pytest.raises(ValueError, match="expected a positive number"):
        shadow_geometry("boxes", distance=-1)
    with pytest.raises(ValueError, match=r"expected a name that ends in .glb or .ply"):
        geometry.save(tmp_path / "a.stl")
    assert repr(geometry).startswith("ShadowGeometry('boxes', ")


def test_names_with_odd_characters_survive(tmp_path):
    plain = Scene.named("boxes")
    light = Light((-2, 4, 2), name='lamp "<1>"\nsecond line')
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        scene = Scene("odd", plain.camera, [light], plain.objects)
        geometry = shadow_geometry(scene)
    assert f"silhouette/{light.name}/cube" in loaded(geometry.save(tmp_path / "a.glb")).geometry
    assert len(trimesh.load_mesh(geometry.save(tmp_path / "a.ply")).faces)
