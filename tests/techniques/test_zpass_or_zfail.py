"""Z-pass or z-fail for each caster, or for each pixel by a plane: the same count, and fewer stencil values changed."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import softshadow as ss
from softshadow.errors import NearClipZPass
from softshadow.scene import Camera, Light, Scene, SceneObject, placement, scene_names, shapes
from softshadow.techniques import drawing
from softshadow.techniques.near_rectangle import shadows_near_rectangle
from softshadow.techniques.shadow_volumes import volumes_of
from softshadow.techniques.zpass_or_zfail import Counting, split_plane
from strategies import coordinates, scenes_from_within
from techniques.drawn_frames import SIZE, begin_count, draw, in_context

TWO = ["volume-zpass", "volume-zfail"]


def counts(name: str, scene: Scene, **options: Any) -> np.ndarray:
    """The stencil buffer at the end, where the light has been added and the count still stands."""
    drawn = draw(name, scene, **options)
    return drawn.stencil[drawn.titles[-1]]


@settings(max_examples=20)
@given(
    scenes_from_within(),
    st.sampled_from(TWO),
    st.sampled_from(["zfail", "per-caster", "split-plane"]),
    st.booleans(),
    st.sampled_from(["infinite", "clamp"]),
)
def test_every_choice_counts_what_zfail_counts(scene: Scene, name: str, choose: str, two_sided: bool, far: str) -> None:
    chosen = counts(name, scene, choose=choose, two_sided=two_sided, far=far)
    assert (chosen == counts("volume-zfail", scene, far=far)).all()


@settings(max_examples=15)
@given(scenes_from_within(), st.lists(st.booleans(), min_size=3, max_size=3), st.booleans())
def test_casters_that_do_not_reach_the_near_rectangle_are_counted_either_way(
    scene: Scene, choice: list[bool], saturate: bool
) -> None:
    light = scene.lights[0]

    def program(gl: Any) -> np.ndarray:
        drawing.begin_frame(gl, scene)
        drawing.set_camera(gl, scene.camera, SIZE, far="infinite")
        drawing.draw_shapes(gl, scene.objects)
        begin_count(gl)
        ops = (gl.GL_INCR, gl.GL_DECR) if saturate else (gl.GL_INCR_WRAP, gl.GL_DECR_WRAP)
        counting = Counting(*ops, two_sided=False, caps=True, finite=False)
        for item, passing in zip(volumes_of(scene, light), choice, strict=False):
            reached = shadows_near_rectangle(item.caster, light, scene.camera, SIZE, "infinite")
            (counting.where_passing if passing and not reached else counting.where_failing)(gl, [item])
        return drawing.read_stencil(gl, SIZE)

    assert (in_context(program) == counts("volume-zfail", scene)).all()


@pytest.mark.parametrize("name", TWO)
def test_zpass_by_choice_is_zpass(name: str) -> None:
    for scene in ("boxes", "eye-in-shadow"):
        chosen, zpass = draw(name, Scene.named(scene), choose="zpass"), draw("volume-zpass", Scene.named(scene))
        assert (chosen.stencil[chosen.titles[-1]] == zpass.stencil[zpass.titles[-1]]).all()
        assert chosen.warnings == zpass.warnings


@pytest.mark.parametrize("choose", ["per-caster", "split-plane"])
def test_a_choice_is_right_where_the_eye_is_in_shadow_and_does_not_warn(choose: str) -> None:
    for scene in ("eye-in-shadow", "near-cut"):
        drawn = draw("volume-zpass", Scene.named(scene), choose=choose)
        assert NearClipZPass not in drawn.warnings
        assert (drawn.maps["visibility"] == draw("volume-zfail", Scene.named(scene)).maps["visibility"]).all()


def test_only_the_caster_before_the_near_rectangle_is_counted_by_zfail() -> None:
    drawn = draw("volume-zpass", Scene.named("eye-in-shadow"), choose="per-caster")
    assert drawn.objects["count where the depth test passes"] == ["cube", "ball"] * 2
    assert drawn.objects["count where the depth test fails"] == ["roof"] * 2


def test_every_light_has_its_own_choice_and_an_empty_stencil_buffer() -> None:
    scene = Scene.named("two-lights")
    for choose in ("per-caster", "split-plane"):
        both = draw("volume-zfail", scene, choose=choose)
        for light in scene.lights:
            one = draw("volume-zfail", replace(scene, lights=(light,)), choose=choose)
            assert (both.maps[f"visibility of {light.name}"] == one.maps["visibility"]).all()


# -- split plane -------------------------------------------------------------------------------------------------------


def updates(scene: Scene, **options: Any) -> int:
    """How many stencil values change in the steps that count; marking by split planes is a step of its own."""
    ledger = ss.run("volume-zfail", scene, (160, 120), **options).ledger
    return sum(step.stencil_updates for step in ledger.steps if step.title.startswith("count"))


def test_a_split_plane_through_the_shadow_of_a_ball_changes_fewer_values_than_zpass_and_zfail() -> None:
    # the shadow crosses the view in the air: floor is seen before it and behind it
    floor = SceneObject(shapes.floor(40), casts=False, receives=True, name="floor")
    ball = SceneObject(shapes.sphere(0.5, 24, 12), placement((-1, 1.5, 0)), name="ball")
    camera = Camera((0, 3, 6), (0, 0.5, 0), near=1)
    for light in (Light((-4, 2.2, 0)), Light((-3, 0.6, 0, 0))):
        scene = Scene("side light", camera, (light,), (floor, ball))
        split, zpass, zfail = (updates(scene, choose=choose) for choose in ("split-plane", "zpass", "zfail"))
        assert 0 < split < min(zpass, zfail)


@pytest.mark.filterwarnings("ignore::softshadow.errors.Warning")  # z-pass is there for its number of updates
@pytest.mark.parametrize("name", scene_names())
def test_split_planes_change_no_more_values_than_zpass_or_zfail(name: str) -> None:
    # no theorem: where a volume does not fill the cone round it, a surface between the two is on the wrong side
    split, zpass, zfail = (updates(Scene.named(name), choose=choose) for choose in ("split-plane", "zpass", "zfail"))
    assert split < min(zpass, zfail)


def test_marks_and_map_say_which_pixels_are_counted_by_zfail() -> None:
    drawn = draw("volume-zpass", Scene.named("eye-in-shadow"), choose="split-plane")
    by_zfail = drawn.maps["volumes counted by z-fail"]
    # the roof is, everywhere; cube and ball are behind their planes
    marks = [drawn.stencil[f"mark what lies behind the split plane of {name}"] & 0x80 != 0 for name in ("cube", "ball")]
    assert (by_zfail == 1 + marks[0] + marks[1]).all()
    assert marks[0].any()
    assert not marks[0].all()
    assert "mark what lies behind the split plane of roof" not in drawn.titles
    assert drawn.stencil[drawn.titles[-1]].max() < 0x80


# a cone through a point is met by lines twice only if they are not nearly tangent: rounding decides those
CLEAR = 1e-6


@given(
    st.tuples(*[coordinates(-6, 6)] * 3),
    st.tuples(*[coordinates(-6, 6)] * 3, st.sampled_from([0.0, 1.0])).filter(lambda light: any(light[:3])),
    st.tuples(*[coordinates(-1, 1)] * 2),
)
def test_a_sight_that_enters_the_shadow_cone_and_leaves_it_crosses_the_split_plane_between(
    eye: tuple[float, ...], light: tuple[float, ...], beside: tuple[float, float]
) -> None:
    ball = SceneObject(shapes.sphere(0.5, 24, 12), name="ball")
    source, start = Light(light), np.array(eye)
    plane = split_plane(ball, source, start)
    assume(plane is not None)
    assert plane is not None
    away = -source.position[:3]  # the ball is at the origin
    across = np.cross(away, np.eye(3)[np.abs(away).argmin()])
    through = away * (0.5 + abs(beside[0])) + beside[1] * across / np.linalg.norm(across)
    sight = through - start
    # q(start + t sight) = a t² + b t + c, the quadric of the docstring with radius 1/2
    a, b, c = quadric(source, start, sight, square=0.25)
    assume(a < -CLEAR and b * b - 4 * a * c > CLEAR)
    first, last = sorted(np.roots([a, b, c]).real)
    assume(first > CLEAR)  # ahead of the eye, both on the side of the ball
    if not source.is_directional:
        assume(all((start + t * sight - source.position[:3]) @ away > CLEAR for t in (first, last)))
    crossing = -(plane[:3] @ start + plane[3]) / (plane[:3] @ sight)
    assert first < crossing < last


def quadric(light: Light, start: np.ndarray, sight: np.ndarray, square: float) -> tuple[float, float, float]:
    """The coefficients of t², t and 1 of q along a line, for a ball about the origin."""
    position = light.position[:3]
    if light.is_directional:
        along = position / np.linalg.norm(position)
        e, d = (v - (v @ along) * along for v in (start, sight))
        return -d @ d, -2 * e @ d, square - e @ e
    e, factor = start - position, position @ position - square
    return (
        (position @ sight) ** 2 - factor * (sight @ sight),
        2 * ((position @ e) * (position @ sight) - factor * (e @ sight)),
        (position @ e) ** 2 - factor * (e @ e),
    )


def test_there_is_no_plane_for_an_eye_in_the_cone_or_a_light_in_the_sphere() -> None:
    ball = SceneObject(shapes.sphere(0.5, 24, 12), name="ball")
    assert split_plane(ball, Light((0, 5, 0)), np.array([0.1, -4, 0])) is None
    assert split_plane(ball, Light((0, 1, 0, 0)), np.array([0.1, 9, 0])) is None
    assert split_plane(ball, Light((0, 0.4, 0)), np.array([3.0, 1, 0])) is None


# -- options that do not go together -----------------------------------------------------------------------------------


def test_counters_that_stop_do_not_go_with_split_planes() -> None:
    with pytest.raises(ValueError, match=r"choose='split-plane' with ops='saturate'.*expected ops='wrap'"):
        draw("volume-zfail", Scene.named("boxes"), choose="split-plane", ops="saturate")


def test_split_planes_need_a_stencil_bit_to_count_in() -> None:
    with pytest.raises(ValueError, match="choose='split-plane' with 1 stencil bit: expected"):
        ss.run("volume-zfail", "boxes", (16, 12), choose="split-plane", stencil_bits=1)
    three, eight = (ss.run("volume-zfail", "boxes", SIZE, choose="split-plane", stencil_bits=bits) for bits in (3, 8))
    assert (three.stencil == eight.stencil).all()


def test_a_start_value_does_not_go_with_a_choice() -> None:
    with pytest.raises(ValueError, match=r"start='eye' with choose='per-caster'.*expected start='none'"):
        draw("volume-zpass", Scene.named("boxes"), choose="per-caster", start="eye")
