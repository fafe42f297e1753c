"""Shadow volumes by z-pass and z-fail: counts, and when they go wrong."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings

from softshadow.errors import CounterSaturated, NearClipZPass
from softshadow.scene import Camera, Light, Mesh, Scene, SceneObject, placement, scene_names, shapes
from softshadow.techniques import drawing
from softshadow.techniques.shadow_volumes import draw_volumes, volumes_of
from strategies import coordinates, floor_scenes, open_meshes
from techniques.drawn_frames import SIZE, Drawn, begin_count, cast_rays, draw, in_context, off_the_edges

FLOOR = SceneObject(shapes.floor(12), casts=False, receives=True, name="floor")
BOX = SceneObject(shapes.box(0.8), placement((0, 1, 0)), name="box")
CAMERA = Camera((3, 4, 6), (0, 0.5, 0), near=1, far=30)
SCENE = Scene("test", CAMERA, (Light((-2.5, 5, 0)),), (FLOOR, BOX))
FAILING = Scene.named("eye-in-shadow")
COUNTED = {"volume-zpass": "count back faces", "volume-zfail": "count front faces"}


def counts(name: str, scene: Scene, **options: object) -> np.ndarray:
    """The stencil buffer after the volumes have been counted."""
    drawn = draw(name, scene, **options)
    title = "count front and back faces" if options.get("two_sided") else COUNTED[name]
    return drawn.stencil[title]


def count_differs_from_rays(drawn: Drawn, scene: Scene, size: tuple[int, int] = SIZE) -> np.ndarray:
    """Where the last light's count is not the number of casting faces that a ray to it crosses, off the edges."""
    truth = cast_rays(scene, size)
    assert truth.sure(-1).any()
    return (drawn.stencil[drawn.titles[-1]] != truth.counts[-1]) & truth.sure(-1)


@settings(max_examples=10)
@given(floor_scenes())
def test_count_is_the_number_of_casting_faces_between_light_and_point(scene: Scene) -> None:
    assert not count_differs_from_rays(draw("volume-zfail", scene), scene).any()


@settings(max_examples=15)
@given(open_meshes(), coordinates(-2, 2))
def test_count_of_an_open_or_non_manifold_caster_is_that_of_rays(soup: Mesh, aside: float) -> None:
    caster = SceneObject(soup, placement((0, 1.5, 0), (30, 1, 2, 3), 0.3), name="soup")
    scene = replace(SCENE, lights=(Light((aside, 6, 1)),), objects=(FLOOR, caster))
    truth = cast_rays(scene)
    for generator in ("silhouette", "per-polygon"):
        count = counts("volume-zfail", scene, generator=generator)
        on_floor = truth.sure() & (truth.objects == 0)
        assert (count == truth.counts[0])[on_floor].all()
        # seen from their dark side, faces that lie in one plane count one by one, and for rays they are one
        assert ((count > 0) == (truth.counts[0] > 0))[truth.sure()].all()
    assert NearClipZPass not in draw("volume-zpass", scene).warnings
    assert (counts("volume-zpass", scene) == counts("volume-zfail", scene)).all()


@pytest.mark.parametrize("name", scene_names())
def test_count_is_that_of_rays_in_every_named_scene(name: str) -> None:
    scene, size = Scene.named(name), (160, 120)
    assert not count_differs_from_rays(draw("volume-zfail", scene, size), scene, size).any()


@pytest.mark.parametrize("generator", ["silhouette", "per-polygon"])
@pytest.mark.parametrize("eye", [(3, 4, 6), (0.6, 1.6, 1.2), (0.2, 1.1, 1.1)])
def test_a_light_cap_nowhere_passes_over_its_own_surface(generator: str, eye: tuple[float, float, float]) -> None:
    # near eyes: the sides of the view and the near plane cut through the meshes
    ring = SceneObject(shapes.torus(0.7, 0.25), placement((-0.2, 1, -0.3), (50, 1, 2, 0), 1.1), name="ring")
    open_tube = Scene.named("open-tube").casters[0]  # some of its faces are turned towards the light
    camera = Camera(eye, (0, 1, 0), near=0.5, far=20)
    scene = replace(SCENE, camera=camera, objects=(FLOOR, BOX, ring, open_tube))

    def program(gl: Any) -> tuple[np.ndarray, np.ndarray]:
        drawing.begin_frame(gl, scene)
        drawing.set_camera(gl, camera, SIZE, far="infinite")
        drawing.draw_shapes(gl, scene.objects)
        volumes = volumes_of(scene, scene.lights[0], generator, "infinite", None)
        begin_count(gl)
        gl.glDisable(gl.GL_CULL_FACE)
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_INCR)
        draw_volumes(gl, volumes, sides=False, dark_caps=False)
        passed = drawing.read_stencil(gl, SIZE)
        gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
        gl.glDepthFunc(gl.GL_EQUAL)
        draw_volumes(gl, volumes, sides=False, dark_caps=False)
        return passed, drawing.read_stencil(gl, SIZE)

    passed, equal = in_context(program)
    assert not passed.any()
    assert equal.any()


@settings(max_examples=10)
@given(floor_scenes())
def test_zpass_and_zfail_count_the_same_where_the_eye_is_in_no_volume(scene: Scene) -> None:
    zpass = draw("volume-zpass", scene)
    assume(NearClipZPass not in zpass.warnings)
    assert (zpass.stencil["count back faces"] == counts("volume-zfail", scene)).all()


@settings(max_examples=10)
@given(floor_scenes())
def test_both_generators_count_the_same(scene: Scene) -> None:
    one = counts("volume-zfail", scene, generator="silhouette")
    other = counts("volume-zfail", scene, generator="per-polygon")
    # more edges are snapped to the sub-pixel grid, so single samples on them may fall to the other side
    differing = one != other
    assert not (differing & off_the_edges(one)).any()
    assert differing.sum() <= 2


@pytest.mark.parametrize("name", COUNTED)
@pytest.mark.parametrize("scene", ["boxes", "torus", "overlapping", "staircase", "sunlight", "open-tube"])
def test_options_that_only_change_the_way_give_the_same_count(name: str, scene: str) -> None:
    drawn = Scene.named(scene)
    reference = counts(name, drawn)
    assert (counts(name, drawn, two_sided=True) == reference).all()
    assert (counts(name, drawn, ops="saturate") == reference).all()
    for options in ({"cap": "finite"}, {"far": "clamp"}):
        # another far cap or projection moves edges by rounding: samples on them only
        assert (counts(name, drawn, **options) != reference).sum() <= 2


def test_the_near_rectangle_in_shadow_is_warned_of_and_seen() -> None:
    zpass = draw("volume-zpass", FAILING)
    assert zpass.warnings == [NearClipZPass]
    assert draw("volume-zfail", FAILING).warnings == []
    # with the whole near rectangle in one shadow every count is one too low
    one_less = counts("volume-zfail", FAILING) - np.uint8(1)
    assert (zpass.stencil["count back faces"] == one_less).all()


@pytest.mark.parametrize("far", ["infinite", "clamp"])
def test_a_volume_that_touches_a_corner_of_the_near_rectangle_is_warned_of(far: str) -> None:
    right, up, back = CAMERA.frame
    # a speck between the light and the lower left corner, then the same beyond the corner and beside it
    near = 1.0 if far == "infinite" else 0.0
    tall = np.tan(np.radians(22.5)) * near
    corner = CAMERA.eye - near * back - tall * up - tall * 4 / 3 * right
    light = np.array([-2, 9, 3.0])
    for part, warned in ((0.5, True), (1.05, False)):
        centre = light + part * (corner - light)
        speck = SceneObject(shapes.box(0.02), placement(tuple(centre)), name="speck")
        scene = replace(SCENE, lights=(Light(light),), objects=(FLOOR, speck))
        assert (NearClipZPass in draw("volume-zpass", scene, far=far).warnings) == warned
    beside = light + 0.5 * (corner - light) - 0.2 * right
    speck = SceneObject(shapes.box(0.02), placement(tuple(beside)), name="speck")
    scene = replace(SCENE, lights=(Light(light),), objects=(FLOOR, speck))
    assert draw("volume-zpass", scene, far=far).warnings == []


def test_zfail_needs_its_caps_and_a_far_plane_that_cuts_nothing() -> None:
    # the light is behind the eye: the shadow runs away from it and leaves the view through the far plane
    scene = replace(SCENE, camera=replace(CAMERA, far=20), lights=(Light((3, 3.5, 8)),))
    reference = draw("volume-zfail", scene).shadow
    assert (draw("volume-zfail", scene, closed=False).shadow != reference).sum() > 10
    assert (draw("volume-zfail", scene, far="finite").shadow != reference).sum() > 10
    # another projection moves edges by rounding: samples on them only
    assert (draw("volume-zfail", scene, far="clamp").shadow != reference).sum() <= 2


def test_a_finite_cap_ends_the_shadow() -> None:
    # a sheet 1 above the floor and 4 below the light: reaching 4.5, its volume ends half way to the floor
    sheet = SceneObject(shapes.floor(0.8), placement((0, 1, 0)), name="sheet")
    scene = replace(SCENE, objects=(FLOOR, sheet))
    for name in COUNTED:
        assert draw(name, scene, cap="finite").shadow.any()
        assert draw(name, scene, cap="finite", reach=5.1).shadow.any()
        assert not draw(name, scene, cap="finite", reach=4.5).shadow.any()


def test_two_sided_saturating_counters_lose_counts() -> None:
    reference = counts("volume-zfail", SCENE)
    assert (counts("volume-zfail", SCENE, two_sided=True, ops="saturate") != reference).any()


def test_a_saturated_counter_is_warned_of_and_a_wrapped_one_is_lit() -> None:
    # 256 sheets one above the other: 256 is 0 in 8 bits
    sheet = shapes.box(0.8, 0.001, 0.8)
    pile = tuple(SceneObject(sheet, placement((0, 1 + k / 256, 0)), name=f"sheet {k}") for k in range(256))
    scene = replace(SCENE, lights=(Light((0, 1, 0, 0)),), objects=(FLOOR, *pile))
    saturated, wrapped = (draw("volume-zfail", scene, ops=ops) for ops in ("saturate", "wrap"))
    assert saturated.warnings == [CounterSaturated]
    assert wrapped.warnings == []
    below = saturated.stencil["count front faces"] == 255
    assert below.any()
    assert (wrapped.stencil["count front faces"][below] <= 1).all()
    assert saturated.shadow.sum() > wrapped.shadow.sum()


@settings(max_examples=5)
@given(floor_scenes(lights=2))
def test_picture_is_ambient_light_and_what_each_light_adds(scene: Scene) -> None:
    both = draw("volume-zfail", scene)
    ambient = both.color["draw the scene without the light"].astype(int)
    total = ambient.copy()
    for light in scene.lights:
        one = draw("volume-zfail", replace(scene, lights=(light,)))
        assert (both.maps[f"visibility of {light.name}"] == one.maps["visibility"]).all()
        total += one.image.astype(int) - ambient
    surface = both.maps["valid"]
    assert (both.image[surface] == np.minimum(total, 255)[surface]).all()
    turned = draw("volume-zfail", replace(scene, lights=scene.lights[::-1]))
    assert (turned.image == both.image).all()
    mean = (both.maps["visibility of light 0"] + both.maps["visibility of light 1"]) / 2
    assert (both.maps["visibility"] == mean).all()


@pytest.mark.parametrize("name", COUNTED)
def test_light_is_added_just_where_the_count_is_0(name: str) -> None:
    drawn = draw(name, SCENE)
    first, *_, last = drawn.titles
    changed = (drawn.color[first] != drawn.color[last]).any(axis=2)
    assert changed.any()
    assert not (changed & (drawn.stencil[last] != 0)).any()
    assert (drawn.stencil[last] == drawn.stencil[COUNTED[name]]).all()


@pytest.mark.parametrize(
    ("name", "options", "passes"),
    [
        ("volume-zpass", {}, 4), ("volume-zfail", {}, 4), ("volume-zpass-plus", {}, 5), ("volume-parity", {}, 3),
        ("volume-zpass", {"two_sided": True}, 3), ("volume-zfail", {"two_sided": True}, 3),
        ("volume-zpass-plus", {"two_sided": True}, 4), ("volume-zpass", {"start": "preload"}, 6),
        ("volume-zfail", {"choose": "per-caster"}, 4),
    ],
)  # fmt: skip
def test_passes_are_those_of_the_table(name: str, options: dict[str, Any], passes: int) -> None:
    drawn = [thing for step in draw(name, SCENE, **options).objects.values() for thing in step]
    assert drawn == ["floor", "box", *["box"] * (passes - 2), "floor", "box"]
