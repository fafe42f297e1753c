"""The table of passes, for one light and one receiver and for several, as counted in the ledgers of runs."""

from dataclasses import replace
from typing import Any

import pytest

import softshadow as ss
from softshadow.scene import Light, Scene, SceneObject, Sphere, placement, shapes

pytestmark = pytest.mark.filterwarnings("ignore::softshadow.Warning")

FLOOR = SceneObject(shapes.floor(12), casts=False, receives=True, name="floor")
WALL = SceneObject(shapes.floor(6), placement((0, 2, -3), (90, 1, 0, 0)), casts=False, receives=True, name="wall")
# near-cut's casters: one of them is between the light and the near rectangle, which z-pass-plus draws again
SCENE = Scene.named("near-cut")
CASTERS = {caster.name for caster in SCENE.casters}


def counted(technique: str, scene: Scene, **options: Any) -> tuple[dict[str, int], list[frozenset[str]]]:
    """How often each receiver and each caster is drawn, and the passes as sets of names."""
    passes = ss.run(technique, scene, size=(48, 36), **options).ledger.total.passes
    names = [thing.name for thing in scene.objects]
    return {name: sum(name in each for each in passes) for name in names}, [frozenset(each) for each in passes]


@pytest.mark.parametrize(
    ("technique", "options", "receiver", "caster", "passes"),
    [
        ("planar", {"method": "depth-off"}, 1, 2, 3),
        ("planar", {"method": "offset"}, 1, 2, 3),
        ("planar", {"method": "stencil"}, 2, 2, 4),
        # as scene geometry twice, and the volume twice, or once with two-sided stencil
        ("volume-zpass", {}, 2, 2 + 2, 4),
        ("volume-zfail", {}, 2, 2 + 2, 4),
        ("volume-zpass", {"two_sided": True}, 2, 2 + 1, 3),
        ("volume-zfail", {"two_sided": True}, 2, 2 + 1, 3),
        ("volume-parity", {}, 2, 2 + 1, 3),
        # and the points and the visibility; the light is a point, so there are no wedges
        ("volume-wedges", {}, 4, 4 + 2, 6),
        # the light's depth pass; the camera's pass is two here, as it is for volumes: ambient, and what the light adds
        ("map", {}, 2, 2 + 1, 3),
        # and one that writes the visibility; a cube of six maps is drawn face by face
        ("map-distance", {}, 3, 3 + 1, 4),
        ("map-pcf", {}, 3, 3 + 1, 4),
        ("map-silhouette", {}, 3, 3 + 1, 4),
        ("map-pcss", {}, 3, 3 + 1, 4),
        # maps that are filtered contain the receivers, too, and are blurred in two passes
        ("map-variance", {}, 3 + 1, 3 + 1, 4 + 2),
        ("map-exponential", {}, 3 + 1, 3 + 1, 4 + 2),
        ("map-cube", {}, 3, 3 + 6, 9),
    ],
)
def test_one_light_takes_the_passes_of_the_table(
    technique: str, options: dict[str, Any], receiver: int, caster: int, passes: int
) -> None:
    drawn, in_order = counted(technique, SCENE, **options)
    receivers = {thing.name for thing in SCENE.receivers}
    assert {drawn[name] for name in receivers} == {receiver}
    assert {drawn[name] for name in CASTERS} == {caster}
    assert len(in_order) == passes


def test_the_near_plane_count_takes_one_pass_more_of_what_is_before_it() -> None:
    _, passes = counted("volume-zpass-plus", SCENE)
    assert len(passes) == 4 + 1
    assert passes[1] < CASTERS  # only what stands between the light and the near rectangle


def test_wedges_are_one_pass_and_caps_are_drawn_apart_from_sides() -> None:
    lights = [replace(light, shape=Sphere(0.1)) for light in SCENE.lights]
    drawn, passes = counted("volume-wedges", replace(SCENE, lights=lights))
    assert len(passes) == 1 + 8
    assert passes.count(frozenset({"wedges"})) == 1
    assert {drawn[name] for name in CASTERS} == {4 + 2 + 2}


@pytest.mark.parametrize(
    ("technique", "options", "each_light"),
    [
        ("volume-wedges", {}, 1 + 2 + 2),
        ("volume-zpass", {}, 2 + 1),
        ("volume-zfail", {}, 2 + 1),
        ("volume-zfail", {"two_sided": True}, 1 + 1),
        ("map", {}, 1 + 1),
        ("map-distance", {}, 1 + 2),
        ("map-pcf", {}, 1 + 2),
        ("map-pcss", {}, 1 + 2),
        ("map-variance", {}, 1 + 2 + 2),
    ],
)
@pytest.mark.parametrize("number", [2, 3])
def test_every_light_takes_its_own_passes_after_the_ambient_one(
    technique: str, options: dict[str, Any], each_light: int, number: int
) -> None:
    lights = [Light((2 - k, 6, 1 + k), (0.3, 0.3, 0.3), f"light {k}") for k in range(number)]
    assert len(counted(technique, replace(SCENE, lights=lights), **options)[1]) == 1 + number * each_light


def test_every_receiver_takes_its_own_flattened_casters() -> None:
    box, ball = (
        SceneObject(mesh, placement((x, 1, 0)), name=mesh.name)
        for mesh, x in ((shapes.box(0.8), -1), (shapes.sphere(0.4, 8, 4), 1))
    )
    scene = replace(Scene.named("boxes"), objects=[FLOOR, WALL, box, ball], lights=[Light((1, 5, 4))])
    drawn, _ = counted("planar", scene, method="offset")
    assert drawn == {"floor": 1, "wall": 1, "box": 2 + 1, "sphere": 2 + 1}
    drawn, _ = counted("planar", scene, method="stencil")
    assert drawn == {"floor": 2, "wall": 2, "box": 2 + 1, "sphere": 2 + 1}
