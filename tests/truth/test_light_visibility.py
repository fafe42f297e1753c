"""Soft visibility: the exact area against strips, formulas and rays; rays against Embree; what must hold for both."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from oracle.hidden_area import hidden_share
from paths import shared_file
from softshadow.scene import Disc, Light, LightShape, Mesh, Rectangle, Scene, SceneObject, Segment, Sphere, placement
from softshadow.scene import shapes as meshes
from softshadow.testing.strategies import SOLIDS
from softshadow.testing.strategies import meshes as any_mesh
from softshadow.truth import casting_faces_between, light_classes, light_visibility
from softshadow.truth.light_visibility import METHODS
from strategies import closed_meshes, coordinates, open_meshes

SHAPES = (Rectangle((1, 0, 0), (0, 0, 1)), Disc(0.5, (0, 1, 0)), Sphere(0.5), Segment((1, 0, 0.5)))
# float64: cuts of some hundred faces, each rounded to 1e-15
ROUNDING = 1e-9
# standard errors that the mean of stratified samples stays within, over thousands of points
FAR_OFF = 5

light_shapes = st.sampled_from(SHAPES)
places = st.tuples(coordinates(-3, 3), st.just(0.0), coordinates(-3, 3)).map(np.array)


def lamp(shape: LightShape | None = SHAPES[0], height: float = 4) -> Light:
    return Light((0, height, 0), shape=shape)


def over_the_floor(mesh: Mesh, height: float = 2) -> SceneObject:
    """Return a caster with an extent of 1.5 around a height."""
    scale = 1.5 / float(np.ptp(mesh.bounds, axis=0).max())
    return SceneObject(mesh, placement((0, height, 0), scale=scale) @ placement(tuple(-mesh.bounds.mean(axis=0))))


def on_the_floor(n: int, seed: int = 1, extent: float = 2) -> np.ndarray:
    points = np.random.default_rng(seed).uniform(-extent, extent, (n, 3))
    points[:, 1] = 0
    return points


# -- the exact area ----------------------------------------------------------------------------------------------------


@pytest.mark.interpreted
def test_penumbra_of_a_parallel_slab_is_as_wide_as_the_formula_says() -> None:
    """S0.4: w = s (d_r - d_b) / d_b and u = (o d_r - s (d_r - d_b)) / d_b, and visibility is linear in between."""
    size, slab, to_slab, to_floor = 1.0, 1.5, 2.0, 4.0
    penumbra = size * (to_floor - to_slab) / to_slab
    umbra = (slab * to_floor - size * (to_floor - to_slab)) / to_slab
    x = np.linspace(-2.5, 2.5, 41)
    points = np.stack([x, 0 * x, 0 * x + 0.01], axis=1)
    caster = SceneObject(meshes.floor(slab), placement((0, to_floor - to_slab, 0)))
    seen = light_visibility(points, lamp(Rectangle((size, 0, 0), (0, 0, size))), [caster])
    assert seen.method == "exact"
    assert seen.visible == pytest.approx(np.clip((np.abs(x) - umbra / 2) / penumbra, 0, 1), abs=ROUNDING)


@pytest.mark.parametrize(("size", "slab"), [(1.0, 1.6), (0.5, 0.8), (2.0, 1.0)])
def test_umbra_vanishes_behind_a_large_light_and_grows_as_the_light_shrinks(size: float, slab: float) -> None:
    caster = SceneObject(meshes.floor(slab), placement((0, 2, 0)))
    (seen,) = light_visibility(np.zeros((1, 3)), lamp(Rectangle((size, 0, 0), (0, 0, size))), [caster]).visible
    covered = min(2 * slab / size, 1)  # the image of the slab on the light, in each direction
    assert seen == pytest.approx(1 - covered**2)


@pytest.mark.slow
@settings(max_examples=60)
@given(
    open_meshes(), places, st.sampled_from([Rectangle((1, 0, 0), (0, 0, 1)), Rectangle((1.5, 0, 2), (-0.8, 0, 0.6))])
)
def test_exact_area_is_that_of_strips(mesh: Mesh, place: np.ndarray, shape: Rectangle) -> None:
    caster = over_the_floor(mesh)
    light = lamp(shape)
    (seen,) = light_visibility(place[None], light, [caster], method="exact").visible
    triangles = caster.world_positions[mesh.triangles]
    # faces of closed parts cast only towards the light
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    casts = ~mesh.topology.closed_faces | ((normals * (triangles[:, 0] - place)).sum(axis=1) > 0)
    assert seen == pytest.approx(1 - hidden_share(place, light.corners, triangles[casts]), abs=ROUNDING)


@given(places, coordinates(-0.6, 0.6))
def test_half_plane_before_a_disc_leaves_a_circular_segment(place: np.ndarray, edge: float) -> None:
    radius = 0.5
    large = SceneObject(meshes.quad((edge, 2, 50), (100, 0, 0), (0, 0, -100)))
    (seen,) = light_visibility(place[None], lamp(Disc(radius, (0, 1, 0))), [large], method="exact").visible
    offset = np.clip((2 * edge - place[0]) / radius, -1, 1)  # of the edge's image on the light, from its centre
    assert seen == pytest.approx(1 - (np.arccos(offset) - offset * np.sqrt(1 - offset**2)) / np.pi, abs=ROUNDING)


@pytest.mark.slow
@settings(max_examples=60)
@given(st.lists(st.integers(0, 71), min_size=3, max_size=8, unique=True), places, st.sampled_from([0.2, 0.8]))
@example([0, 20, 40], np.array([0.5, 0, 0.25]), 0.8)
def test_convex_caster_hides_the_hard_shadow_and_the_sectors_of_its_edges(
    turns: list[int], place: np.ndarray, radius: float
) -> None:
    """S20.2: O = H + sum of sigma A over the edges, with A = sector beyond the edge less the triangle, on a disc."""
    angles = np.radians(5.0 * np.array(sorted(turns)))
    rim = np.stack([np.cos(angles), 0 * angles, np.sin(angles)], axis=1)
    fan = [(0, i + 1, i) for i in range(1, len(rim) - 1)]
    caster = SceneObject(Mesh(rim, fan), placement((0, 2, 0)))
    (seen,) = light_visibility(place[None], lamp(Disc(radius, (0, 1, 0))), [caster], method="exact").visible
    image = (2 * caster.world_positions - place)[:, [0, 2]] / radius  # on the light, whose centre is 0 and radius 1
    hidden, is_inside = 0.0, True
    for a, b in zip(image, np.roll(image, -1, axis=0), strict=True):
        along = b - a
        half = (a @ along) ** 2 - (along @ along) * (a @ a - 1)
        side = a[0] * b[1] - a[1] * b[0]
        assume(abs(side) > 1e-9)
        is_inside &= side > 0
        if half <= 0:
            continue
        low, high = np.clip((-(a @ along) + np.array([-1, 1]) * np.sqrt(half)) / (along @ along), 0, 1)
        p, q = a + low * along, a + high * along
        angle = abs(np.arctan2(p[0] * q[1] - p[1] * q[0], p @ q))
        sector = (angle - abs(p[0] * q[1] - p[1] * q[0])) / (2 * np.pi)
        hidden += -sector if side > 0 else sector
    assert seen == pytest.approx(1 - (is_inside + hidden), abs=ROUNDING)


def test_a_segment_sees_shares_of_its_length() -> None:
    caster = SceneObject(meshes.floor(0.25), placement((0, 2, 0)))
    (seen,) = light_visibility(np.array([[0.0, 0, 0.01]]), lamp(Segment((1, 0, 0))), [caster]).visible
    assert seen == pytest.approx(0.5)


def test_too_many_pieces_for_the_exact_area_are_named() -> None:
    rng = np.random.default_rng(4)
    corners = rng.uniform([-0.5, 1, -0.5], [0.5, 3, 0.5], (9000, 1, 3)) + rng.normal(0, 0.004, (9000, 3, 3))
    cloud = SceneObject(Mesh(corners.reshape(-1, 3), np.arange(27000).reshape(-1, 3)))
    with pytest.raises(ValueError, match='method="exact": light falls into more than 4096 visible pieces'):
        light_visibility(np.zeros((1, 3)), lamp(), [cloud], method="exact")
    seen = light_visibility(np.zeros((1, 3)), lamp(), [cloud])
    assert (seen.method, bool(seen.exact[0])) == ("rays", False)
    assert seen.standard_error[0] > 0


# -- rays --------------------------------------------------------------------------------------------------------------


@pytest.mark.slow
@settings(max_examples=40)
@given(any_mesh(), light_shapes, st.integers(0, 5))
def test_rays_are_within_their_standard_error_of_the_area(mesh: Mesh, shape: LightShape, seed: int) -> None:
    points = on_the_floor(40, seed)
    exact, rays = (
        light_visibility(points, lamp(shape), [over_the_floor(mesh)], method=method, samples=400, seed=seed)
        for method in ("exact", "rays")
    )
    allowed = FAR_OFF * np.sqrt(exact.visible * (1 - exact.visible) / 400) + 2 / 400
    assert (np.abs(exact.visible - rays.visible) <= allowed).all()
    assert (exact.standard_error == 0).all()
    assert rays.standard_error == pytest.approx(np.sqrt(rays.visible * (1 - rays.visible) / 400))


@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: type(shape).__name__)
def test_error_of_the_rays_falls_with_their_number(shape: LightShape) -> None:
    points, caster = on_the_floor(2000), [over_the_floor(meshes.torus(0.5, 0.2, 12, 8))]
    area = light_visibility(points, lamp(shape), caster, method="exact").visible
    errors = [
        float(
            np.sqrt(
                np.mean((light_visibility(points, lamp(shape), caster, method="rays", samples=n).visible - area) ** 2)
            )
        )
        for n in (16, 64, 256)
    ]
    # independent samples would halve it each time; stratified ones fall faster
    assert errors[2] < errors[1] / 2 < errors[0] / 4
    bound = np.sqrt(np.mean(area * (1 - area)) / 256)
    assert errors[2] < bound


@pytest.mark.interpreted
@pytest.mark.parametrize("samples", [1, 3, 20])
def test_rays_together_find_what_single_rays_find(samples: int) -> None:
    """A light so small that all its samples see the same: what its centre sees."""
    points = on_the_floor(20)
    caster = [over_the_floor(meshes.tetrahedron())]
    seen = light_visibility(points, lamp(SHAPES[0].scaled(1e-9)), caster, method="rays", samples=samples)
    assert (seen.visible == (casting_faces_between(points, lamp().position, caster) == 0)).all()


@given(any_mesh(), light_shapes)
def test_small_light_sees_as_its_centre(mesh: Mesh, shape: LightShape) -> None:
    points, caster = on_the_floor(60), [over_the_floor(mesh)]
    seen = light_visibility(points, lamp(shape.scaled(1e-7)), caster)
    hard = light_visibility(points, lamp(None), caster)
    assert hard.method == "exact"
    assert set(hard.visible) <= {0, 1}
    # an edge may pass through the light, however small it is
    sure = (seen.visible == 0) | (seen.visible == 1)
    assert (seen.visible[sure] == hard.visible[sure]).all()
    assert sure.sum() >= 50


@pytest.mark.slow
@given(st.lists(any_mesh(), min_size=2, max_size=3), light_shapes, st.sampled_from(["auto", "rays"]))
def test_a_further_caster_takes_light_away(bodies: list[Mesh], shape: LightShape, method: str) -> None:
    points = on_the_floor(60)
    casters = [over_the_floor(mesh, 1 + 0.75 * i) for i, mesh in enumerate(bodies)]
    before = np.ones(len(points))
    for n in range(1, len(casters) + 1):
        seen = light_visibility(points, lamp(shape), casters[:n], method=method, samples=36)
        assert (seen.visible >= 0).all()
        assert (
            seen.visible <= before + (ROUNDING if method == "rays" else 2 * seen.standard_error.max() + ROUNDING)
        ).all()
        before = seen.visible


def ball_with_a_spike() -> Mesh:
    """Return a mesh on whole numbers: rays from a middle of a face to the light run in the plane of another face."""
    positions = np.rint(4 * SOLIDS["ball"].positions)
    positions[16, 0] += 5
    return Mesh(positions, SOLIDS["ball"].triangles)


@pytest.mark.slow
@given(closed_meshes(), light_shapes)
@example(ball_with_a_spike(), SHAPES[0])
def test_point_on_a_caster_is_not_hidden_by_its_own_face(mesh: Mesh, shape: LightShape) -> None:
    caster = over_the_floor(mesh)
    corners = caster.world_positions[mesh.triangles]
    points = corners.mean(axis=1)
    exclude = np.zeros(len(points), int), np.arange(len(points))
    seen = light_visibility(points, lamp(shape), [caster], exclude=exclude, method="exact")
    centre = lamp(shape).position
    blocked = casting_faces_between(points, centre, [caster], exclude=exclude) > 0
    sure = (seen.visible == 0) | (seen.visible == 1)
    if not isinstance(shape, Sphere):  # whose disc has another centre
        assert ((seen.visible == 0)[sure] == blocked[sure]).all()


@pytest.mark.parametrize("method", METHODS)
def test_back_of_an_open_sheet_is_dark_for_a_viewer_below(method: str) -> None:
    if method == "embree":
        pytest.importorskip("embreex")
    sheet = SceneObject(meshes.floor(2), placement((0, 1, 0)))
    point, own = np.array([[0.2, 1, 0.1]]), (np.zeros(1, int), np.zeros(1, int))
    for height, visible in ((3.0, 1.0), (-3.0, 0.0)):
        seen = light_visibility(
            point, lamp(), [sheet], exclude=own, viewer=np.array([0, height, 0.0]), method=method, samples=16
        )
        assert seen.visible.tolist() == [visible]


def test_light_that_stands_on_its_edge_behind_a_sheet_is_half_seen() -> None:
    """The own plane of the point cuts a light that stands upright in it."""
    upright = Light((3, 1, 0), shape=Rectangle((0, 1, 0), (0, 0, 1)))
    sheet = SceneObject(meshes.floor(2), placement((0, 1, 0)))
    own = np.zeros(1, int), np.zeros(1, int)
    seen = light_visibility(np.array([[0, 1.0, 0.2]]), upright, [sheet], exclude=own, viewer=np.array([0, 3.0, 0]))
    assert seen.visible == pytest.approx([0.5])


def test_point_inside_a_sphere_sees_all_of_it() -> None:
    points = np.array([[0.1, 4, 0], [0, 3.4, 0]])
    wall = SceneObject(meshes.floor(9), placement((0, 3.45, 0)))
    assert light_visibility(points, lamp(Sphere(0.5)), [wall]).visible.tolist() == [1, 0]


def test_spot_light_is_dark_outside_its_cone() -> None:
    spot = Light((0, 4, 0), axis=(0, -1, 0), cutoff=20)
    assert light_visibility(np.array([[0.0, 0, 0], [3, 0, 0]]), spot, []).visible.tolist() == [1, 0]


def test_visibility_does_not_depend_on_how_the_work_is_shared() -> None:
    scene = Scene.named("soft-torus")
    points = on_the_floor(9000)

    def backwards(work, n_pieces):  # type: ignore[no-untyped-def]
        for piece in reversed(range(n_pieces)):
            work(piece)

    one, other = (
        light_visibility(points, scene.lights[0], scene.casters, samples=36, **more)
        for more in ({}, {"share": backwards})
    )
    assert (one.visible == other.visible).all()
    assert one.method == "exact and rays"


# -- other code --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: type(shape).__name__)
@pytest.mark.parametrize("name", ["boxes", "soft-torus"])
def test_rays_agree_with_embree(name: str, shape: LightShape) -> None:
    pytest.importorskip("embreex")
    scene = Scene.named(name)
    light = replace(scene.lights[0], shape=shape)
    points = on_the_floor(3000)
    own, embree = (
        light_visibility(points, light, scene.casters, method=method, samples=64) for method in ("rays", "embree")
    )
    assert embree.method == "embree"
    assert (own.visible < 1).sum() > 300
    # the same samples: a float32 ray in some thousand passes an edge on the other side
    assert np.abs(own.visible - embree.visible).mean() < 2e-4
    assert np.abs(own.visible - embree.visible).max() < 5 / 64


def test_rays_agree_with_embree_on_a_fine_mesh() -> None:
    pytest.importorskip("embreex")
    scene = Scene.from_mesh(shared_file("meshes/stanford-bunny.obj"))
    light = replace(scene.lights[0], shape=Rectangle((0.6, 0, 0), (0, 0, 0.6)))
    points = on_the_floor(500)
    own, embree = (
        light_visibility(points, light, scene.casters, method=method, samples=256) for method in ("auto", "embree")
    )
    assert np.abs(own.visible - embree.visible).mean() < 2e-3  # of 256 samples


# -- classes and misuse ------------------------------------------------------------------------------------------------


def test_classes_are_umbra_penumbra_and_lit() -> None:
    classes = light_classes(np.array([[0, 0.5], [1, 1e-6]]))
    assert classes.dtype == np.uint8
    assert classes.tolist() == [[0, 1], [2, 1]]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ({"points": np.zeros(3)}, r"points: expected shape \(N, 3\)"),
        ({"method": "exakt"}, r"method='exakt': did you mean 'exact'\?"),
        ({"samples": 0}, "samples=0: expected a whole number of at least 1"),
    ],
)
def test_misuse_names_the_argument(arguments: dict, said: str) -> None:
    complete = {"points": np.zeros((2, 3)), "light": lamp(), "casters": [SceneObject(meshes.box())], **arguments}
    with pytest.raises(ValueError, match=said):
        light_visibility(**complete)


def test_an_edge_in_one_plane_with_a_segment_hides_it() -> None:
    sheet = SceneObject(meshes.floor(2), placement((0, 1, 0)))  # its diagonal goes from corner to corner
    for direction in (1.0, -1.0):
        light = lamp(Segment(edge=np.array([0.25, 0.0, 0.25 * direction])))
        point = np.array([[light.position[0], 0.0, light.position[2]]])
        assert light_visibility(point, light, [sheet], method="exact").visible.tolist() == [0.0]
