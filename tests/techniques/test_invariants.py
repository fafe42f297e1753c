"""What holds for every scene: whatever is moved, split, reordered or seen from elsewhere, the shadow stays.

Frames of different transforms are compared off the boundary band: there edges are snapped to other sub-pixels.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from softshadow.scene import Camera, Light, Mesh, Scene, SceneObject, placement, shapes, silhouette
from softshadow.testing import run_on_mesa
from softshadow.testing.strategies import cameras, closed_meshes, coordinates, floor_scenes, lights, meshes, scenes
from techniques.drawn_frames import SIZE, cast_rays, draw, program

FEW = settings(max_examples=max(2, settings().max_examples // 16))  # 2, and 62 in the longer lane
COUNTED = "count front faces"

FLOOR = SceneObject(shapes.floor(12), casts=False, receives=True, name="floor")


def counts(scene: Scene, **options: object) -> np.ndarray:
    """The stencil buffer after z-fail has counted the volumes of the only light."""
    drawn = draw("volume-zfail", scene, **options)
    return drawn.stencil["count front and back faces" if options.get("two_sided") else COUNTED]


def moved(scene: Scene, matrix: np.ndarray) -> Scene:
    """The whole scene carried by a similarity, with its camera and its lights."""
    scale = float(np.cbrt(np.linalg.det(matrix[:3, :3])))
    camera = scene.camera

    def point(place: np.ndarray) -> np.ndarray:
        return matrix[:3, :3] @ place + matrix[:3, 3]

    return replace(
        scene,
        camera=Camera(
            point(camera.eye), point(camera.target), matrix[:3, :3] @ camera.up, camera.fov_y,
            camera.near * scale, camera.far * scale,
        ),
        lights=[replace_light(light, matrix @ light.position) for light in scene.lights],
        objects=[replace(thing, object_to_world=matrix @ thing.object_to_world) for thing in scene.objects],
    )  # fmt: skip


def replace_light(light: Light, position: np.ndarray) -> Light:
    return Light(position, light.color, light.name)


@FEW
@given(scenes())
def test_count_is_that_of_rays_for_casters_of_every_kind_seen_from_anywhere(scene: Scene) -> None:
    truth = cast_rays(scene)
    # on a caster whose faces lie on one another it is open which of them is seen: they are equally deep
    compared = truth.sure() & (truth.objects == 0)
    assert (counts(scene) == truth.counts[0])[compared].all()


@FEW
@given(floor_scenes(), cameras())
def test_a_surface_point_has_the_same_count_from_everywhere(scene: Scene, camera: Camera) -> None:
    other = replace(scene, camera=camera)
    here, there = cast_rays(scene), cast_rays(other)
    one, two = counts(scene), counts(other)
    right, up, back = camera.frame
    away = here.points - camera.eye
    depth = -(away @ back)
    tall = np.tan(np.radians(camera.fov_y / 2))
    with np.errstate(divide="ignore", invalid="ignore"):
        x = np.floor((away @ right / (depth * tall * SIZE[0] / SIZE[1]) + 1) / 2 * SIZE[0])
        y = np.floor((away @ up / (depth * tall) + 1) / 2 * SIZE[1])
    met = here.sure() & (depth > camera.near) & (x >= 0) & (x < SIZE[0]) & (y >= 0) & (y < SIZE[1])
    x, y = x[met].astype(int), y[met].astype(int)
    # the same object on a sure pixel is the same surface, near enough not to have changed its count
    same = there.sure()[y, x] & (there.objects[y, x] == here.objects[met])
    close = np.linalg.norm(there.points[y, x] - here.points[met], axis=1) < 0.05  # less than a pixel of either picture
    assert (one[met] == two[y, x])[same & close].all()


TURNS = st.tuples(st.integers(0, 359), st.sampled_from([(0, 1, 0), (1, 0, 0), (1, 2, 3)]))


@FEW
@given(floor_scenes(), TURNS, st.tuples(*[coordinates(-3, 3)] * 3), st.sampled_from([0.125, 1.0, 3.0]))
def test_a_scene_moved_turned_and_scaled_as_a_whole_has_the_same_shadow(
    scene: Scene, turn: tuple, move: tuple[float, ...], scale: float
) -> None:
    matrix = placement(move, (turn[0], *turn[1]), scale)
    sure = cast_rays(scene).sure()
    assert (counts(scene) == counts(moved(scene, matrix)))[sure].all()


def split(mesh: Mesh, face: int, corner: np.ndarray) -> Mesh:
    """The mesh with one face cut in three at a point of its plane."""
    a, b, c = mesh.triangles[face]
    middle = corner @ mesh.positions[[a, b, c]].astype(np.float64)
    new = len(mesh.positions)
    cut = [[a, b, new], [b, c, new], [c, a, new]]
    return Mesh([*mesh.positions, middle], [*np.delete(mesh.triangles, face, axis=0), *cut])


@given(closed_meshes(), lights(), st.integers(0, 1000))
def test_splitting_a_face_adds_no_silhouette(mesh: Mesh, light: np.ndarray, number: int) -> None:
    face = number % len(mesh.triangles)
    finer = split(mesh, face, np.array([0.5, 0.25, 0.25]))
    distance = (light[:3] - light[3] * mesh.first_corners) * mesh.face_normals
    assume((np.abs(distance.sum(axis=1)) > 1e-3).all())  # rounding of the point turns no part over

    def outline(thing: Mesh) -> set[tuple]:
        found = silhouette(thing, light)
        return {
            (*map(tuple, (thing.positions[edge] + 0.0).tolist()), int(times))
            for edge, times in zip(found.edges, found.multiplicity, strict=True)
        }

    assert outline(finer) == outline(mesh)


@FEW
@given(floor_scenes(), st.integers(0, 1000))
def test_splitting_a_face_changes_neither_shadow_nor_count(scene: Scene, number: int) -> None:
    caster = scene.casters[0]
    face = number % len(caster.mesh.triangles)
    finer = replace(caster, mesh=split(caster.mesh, face, np.array([0.5, 0.25, 0.25])))
    objects = [finer if thing is caster else thing for thing in scene.objects]
    sure = cast_rays(scene).sure()
    assert (counts(scene) == counts(replace(scene, objects=objects)))[sure].all()


@FEW
@given(scenes(), st.booleans())
def test_counters_that_wrap_do_not_know_the_order_of_casters(scene: Scene, two_sided: bool) -> None:
    turned = replace(scene, objects=scene.objects[::-1])
    assert (counts(scene, two_sided=two_sided) == counts(turned, two_sided=two_sided)).all()


def test_counters_that_stop_know_the_order_of_casters() -> None:
    # of two boxes one above the other, drawn in one pass, the lower one's front is behind the floor of what the upper
    # one has counted, or not yet
    boxes = [SceneObject(shapes.box(0.8), placement((0, y, 0.3 * y)), name=f"box {y}") for y in (1, 2)]
    scene = Scene("pile", Camera((3, 4, 6), (0, 0.5, 0), near=1, far=30), [Light((-2.5, 5, 0))], [FLOOR, *boxes])
    turned = replace(scene, objects=[FLOOR, *boxes[::-1]])
    options = {"two_sided": True, "ops": "saturate"}
    assert (counts(scene, **options) != counts(turned, **options)).any()


@FEW
@given(floor_scenes())
def test_a_light_far_away_is_a_directional_light(scene: Scene) -> None:
    towards = scene.lights[0].position[:3]
    # 1e5 times as far, its rays are parallel to a thousandth of a pixel over this scene
    near, far = (replace(scene, lights=[Light(position)]) for position in ((*towards, 0.0), (*(1e5 * towards), 1.0)))
    sure = cast_rays(near).sure()
    assert (counts(near) == counts(far))[sure].all()


@pytest.mark.parametrize("technique", ["volume-zfail", "volume-zpass-plus", "planar"])
def test_one_more_caster_never_lightens(technique: str) -> None:
    @FEW
    @given(scenes(), meshes())
    def never_lightens(scene: Scene, mesh: Mesh) -> None:
        more = SceneObject(mesh, placement((0.3, 2.5, 0.2), scale=1 / float(np.ptp(mesh.bounds))), name="more")
        fuller = replace(scene, objects=[*scene.objects, more])
        before, after = draw(technique, scene), draw(technique, fuller)
        # where the same surface is seen
        same = cast_rays(scene).sure() & cast_rays(fuller).sure()
        same &= before.depth[before.titles[-1]] == after.depth[after.titles[-1]]
        assert not (before.shadow & ~after.shadow & same).any()

    never_lightens()


@FEW
@given(st.integers(-60, 60), st.integers(-60, 60), coordinates(-2, 2), coordinates(-1, 1), st.sampled_from([0.0, 1.0]))
def test_a_slope_factor_of_one_leaves_no_acne_on_any_plane(pitch: int, roll: int, x: float, z: float, w: float) -> None:
    matrix = placement((0, 1, 0), (pitch, 1, 0, 0)) @ placement(turn=(roll, 0, 0, 1))
    roof = SceneObject(shapes.floor(2, 1), matrix, receives=True, name="roof")
    towards = np.array([x, 5.0, z]) - w * np.array([0, 1, 0])
    assume(matrix[:3, 1] @ towards > 0.2)  # the light is before the roof, and not in its plane
    scene = Scene("roof", Camera((0, 6, 3), (0, 1, 0), near=1, far=20), [Light((x, 5, z, w))], [roof])
    # one unit for the rounding of the stored depth, the factor for the slope
    assert draw("map", scene, map_size=32, factor=1.0, units=1.0).shadow.sum() == 0


TECHNIQUES: list[tuple[str, dict[str, object]]] = [("volume-zfail", {}), ("planar", {}), ("map", {"map_size": 48})]


@pytest.mark.mesa
@pytest.mark.parametrize(("technique", "options"), TECHNIQUES)
def test_random_scenes_leave_the_same_buffers_on_mesa(technique: str, options: dict[str, object]) -> None:
    @settings(max_examples=max(1, settings().max_examples // 32))
    @given(scenes())
    def same(scene: Scene) -> None:
        def drawing(gl: object) -> object:
            return program(gl, technique, scene, SIZE, options)

        run: Callable = run_on_mesa
        here, there = draw(technique, scene, SIZE, **options), run(drawing, SIZE).returned
        for title in here.titles:
            assert (here.stencil[title] == there.stencil[title]).all(), title
            assert (here.depth[title] == there.depth[title]).all(), title
            assert (here.color[title] == there.color[title]).all(), title

    same()
