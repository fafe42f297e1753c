"""Workloads: each draws something, the same in every frame and on Mesa; selection by name and pattern."""

import numpy as np
import pytest

from bench.small_workloads import SIZE, small
from softshadow import techniques
from softshadow.bench.frame_statistics import frame_statistics
from softshadow.bench.peers import Peer, peers_for
from softshadow.bench.technique_frame import KINDS, with_lights
from softshadow.bench.workloads import WORKLOADS, get, names, select_workloads
from softshadow.scene import Scene
from softshadow.testing.sessions import MesaSession, OwnSession

WITHOUT_PICTURE = "silhouette"
DRAWN = [
    *(name for name in WORKLOADS if name != WITHOUT_PICTURE),
    *(f"{technique}/boxes" for technique in techniques.names()),
]


# each takes a process of Mesa's own; the techniques are compared in tests/techniques/test_techniques_on_mesa.py
QUICK = ("w1-zpass-d24",)


@pytest.mark.mesa
@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=() if name in QUICK else pytest.mark.slow) for name in DRAWN]
)
def test_workload_leaves_the_same_buffers_on_mesa(name: str) -> None:
    workload = small(name)
    here, there = OwnSession(workload.program, SIZE), MesaSession(workload.program, SIZE)
    try:
        here.time(), there.time(2)  # the second frame finds what the first one left
        ours, theirs = here.buffers(), there.buffers()
    finally:
        there.close()
    assert any(np.ptp(buffer) > 0 for buffer in ours.values())
    for buffer in ours:
        np.testing.assert_array_equal(ours[buffer], theirs[buffer], buffer)


@pytest.mark.thin(2)
@pytest.mark.parametrize("name", DRAWN)
def test_every_frame_of_a_workload_is_the_same(name: str) -> None:
    workload = small(name)
    session = OwnSession(workload.program, SIZE)
    session.time()
    first = session.buffers()
    session.time()
    for buffer, expected in first.items():
        np.testing.assert_array_equal(session.buffers()[buffer], expected, buffer)


def test_results_do_not_depend_on_the_number_of_threads() -> None:
    workload = small("w1-zfail-d24").resized((256, 256)).with_amounts(quads=80)
    one, three = (OwnSession(workload.program, workload.size, threads) for threads in (1, 3))
    one.time(), three.time()
    np.testing.assert_array_equal(one.buffers()["stencil"], three.buffers()["stencil"])


def test_stencil_quads_cover_a_fifth_to_a_quarter_of_the_screen() -> None:
    counted = frame_statistics(small("w1-zpass-d24").with_amounts(quads=60))
    assert 0.2 < counted.all_fragments / 60 / (SIZE[0] * SIZE[1]) < 0.25


def test_amounts_decide_how_much_there_is() -> None:
    few, many = (frame_statistics(small("w2-grid").with_amounts(triangles=n)).triangles for n in (200, 800))
    assert (few, many) == (200, 800)


def test_an_unknown_workload_names_the_nearest() -> None:
    with pytest.raises(ValueError, match="did you mean 'w2-sphere'"):
        get("w2-spheer")
    with pytest.raises(ValueError, match="did you mean 'volume-zfail'"):
        get("volume-zfial/torus")
    with pytest.raises(ValueError, match="did you mean 'torus'"):
        get("volume-zfail/toruss")


def test_beginnings_of_names_ask_for_several_workloads_each_once() -> None:
    assert [each.name for each in select_workloads(["w3", "w3-pcf", "w5"])] == ["w3-nearest", "w3-pcf", "w5"]
    assert [each.name for each in select_workloads(["all"])] == list(WORKLOADS)
    assert [each.name for each in select_workloads(["map/all"])] == [
        name for name in names() if name.startswith("map/")
    ]


def test_peers_have_the_same_numbers_of_threads_and_softpipe_has_one() -> None:
    peers = peers_for(["mesa", "softpipe"], [1, 2])
    assert list(map(str, peers)) == ["softshadow@1", "softshadow@2", "llvmpipe@1", "llvmpipe@2", "softpipe@1"]
    assert peers_for(["mesa", "llvmpipe"], [1]) == [Peer("softshadow", 1), Peer("llvmpipe", 1)]
    with pytest.raises(ValueError, match="did you mean 'mesa'"):
        peers_for(["masa"], [1])


@pytest.mark.parametrize("kind", KINDS[1:])
def test_lights_of_a_kind_stand_where_the_kind_says(kind: str) -> None:
    scene = with_lights(Scene.named("boxes"), 3, kind)
    assert len(scene.lights) == 3
    vertices = np.concatenate([thing.world_positions for thing in scene.casters])
    for light in scene.lights:
        assert light.is_directional == (kind == "at infinity")
        if not light.is_directional:
            between = (vertices.min(axis=0) < light.position[:3]) & (light.position[:3] < vertices.max(axis=0))
            assert between.all() == (kind == "inside")


def test_an_unknown_kind_of_light_names_the_nearest() -> None:
    with pytest.raises(ValueError, match="did you mean 'inside'"):
        with_lights(Scene.named("boxes"), 1, "insight")
