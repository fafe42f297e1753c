"""Origins of polygons in histories: the face or the edge of the caster that a polygon was made from."""

import numpy as np
import pytest

import softshadow as ss
from softshadow import gl
from softshadow.inspection import pixel_history
from softshadow.inspection.row_fields import origin_fields
from softshadow.pipeline.commands import Draw

SIZE = (64, 48)


def draws(run, part):
    return [c for c in run.frame.commands if isinstance(c, Draw) and c.origin is not None and c.origin.part == part]


def mesh_of(run, name):
    return next(thing.mesh for thing in run.scene.objects if thing.name == name)


@pytest.mark.filterwarnings("ignore::softshadow.errors.OpenMesh")
@pytest.mark.parametrize("generator", ["silhouette", "per-polygon"])
@pytest.mark.parametrize("scene", ["boxes", "sunlight", "open-tube"])
def test_sides_of_volumes_stand_on_their_edge_or_face(generator, scene):
    run = ss.run("volume-zfail", scene, size=SIZE, generator=generator)
    sides = draws(run, "volume side")
    assert sides
    for command in sides:
        origin, corners = command.origin, command.vertices.position
        mesh = mesh_of(run, origin.casters[0])
        per_side = len(corners) // len(origin.numbers)
        for number, side in zip(origin.numbers, corners.reshape(-1, per_side, 4), strict=True):
            if origin.feature == "edge":
                u, v = mesh.topology.representatives[mesh.topology.edges[number]]
                expected = {tuple(mesh.positions[u]), tuple(mesh.positions[v])}
            else:
                expected = {tuple(corner) for corner in mesh.positions[mesh.triangles[number]]}
            assert {tuple(side[0, :3]), tuple(side[1, :3])} <= expected


def test_caps_of_volumes_are_the_faces_that_they_name():
    run = ss.run("volume-zfail", "boxes", size=SIZE)
    for command in draws(run, "near cap"):
        mesh = mesh_of(run, command.origin.casters[0])
        drawn = command.vertices.position[command.indices.reshape(-1, 3)][..., :3]
        assert (drawn == mesh.positions[mesh.triangles[command.origin.numbers]]).all()


@pytest.mark.parametrize("method", ["stencil", "depth-off"])
def test_parts_of_flattened_casters_lie_in_their_face(method):
    run = ss.run("planar", "light-between", size=SIZE, method=method)
    clipped = [command for command in draws(run, "flattened face") if command.origin.numbers is not None]
    assert clipped
    for command in clipped:
        mesh = mesh_of(run, command.origin.casters[0])
        for number, triangle in zip(command.origin.numbers, command.vertices.position.reshape(-1, 3, 4), strict=True):
            a, b, c = mesh.positions[mesh.triangles[number]].astype(float)
            normal = np.cross(b - a, c - a)
            assert np.abs((triangle[:, :3] - a) @ normal).max() < 1e-5 * np.linalg.norm(normal)


def test_shadow_polygons_name_a_face_between_them_and_the_light():
    run = ss.run("shadow-polygons", "boxes", size=SIZE)
    light = run.scene.lights[0].position[:3]
    for command in draws(run, "shadow polygon"):
        origin = command.origin
        for number, owner, polygon in zip(
            origin.numbers, origin.owners, command.vertices.position.reshape(-1, 3, 4), strict=True
        ):
            thing = next(t for t in run.scene.objects if t.name == origin.casters[owner])
            a, b, c = thing.world_positions[thing.mesh.triangles[number]]
            middle, normal = polygon[:, :3].mean(axis=0), np.cross(b - a, c - a)
            assert ((middle - a) @ normal) * ((light - a) @ normal) <= 1e-6  # the face's plane parts them


def test_rows_say_what_polygons_were_made_from():
    run = ss.run("volume-zfail", "boxes", size=SIZE)
    y, x = np.argwhere(run.stencil > 0)[0]
    rows = [row for row in run.pixel(int(x), int(y)) if row.part]
    assert rows
    for row in rows:
        assert row.name.startswith(("front face of the volume of", "back face of the volume of", "near cap", "far cap"))
        assert (row.edge is None) == (row.part != "volume side")
        assert row.caster == row.object
    assert f"{rows[0].name}: " in " ".join(str(run.pixel(int(x), int(y))).split())


def test_wedges_name_their_caster_and_edge():
    run = ss.run("volume-wedges", "soft-slab", size=SIZE)
    (command,) = draws(run, "wedge")
    assert {command.origin.casters[owner] for owner in command.origin.owners} == {"slab"}
    assert set(command.origin.numbers) == set(range(command.origin.numbers.max() + 1))


def test_a_program_of_one_s_own_may_describe_its_primitives():
    with gl.create_context(8, 8) as context:
        gl.describe_primitives("lid", "face", [7], ["box"])
        gl.glRectf(-1, -1, 1, 1)
        gl.describe_primitives("")
        gl.glRectf(-1, -1, 1, 1)
        context.end_step("all")
    first, second = (pixel_history(context.frame, 4, 4)[n] for n in (0, 1))
    assert (first.part, first.caster, first.face, first.name) == ("lid", "box", 7, "lid of box, face 7")
    assert (second.part, second.caster, second.face) == ("", "", None)


def test_origins_of_quads_count_both_triangles():
    run = ss.run("volume-zfail", "boxes", size=SIZE)
    command = draws(run, "volume side")[0]
    numbers = [origin_fields(command, triangle)["edge"] for triangle in range(2 * len(command.origin.numbers))]
    assert numbers == np.repeat(command.origin.numbers, 2).tolist()
