"""Programs of distance maps: what they store, what they compare, and their GLSL on Mesa, bit for bit."""

from typing import Any

import numpy as np
import pytest

from mesa_points import POINTS, same_bits
from programs.test_filtered_visibility import float_texture, shaded
from programs.test_map_visibility import SIDE, on_mesa
from softshadow.programs.reads import noted_reads

LARGEST = 8.0


def positions(seed: int) -> np.ndarray:
    """Positions in the light's view (POINTS, 4), some beside and behind the light."""
    placed = np.random.default_rng(seed).uniform(-4, 4, (POINTS, 4)).astype(np.float32)
    placed[:, 2] -= 2
    placed[:, 3] = 1
    return placed


def stored_distances() -> np.ndarray:
    return np.random.default_rng(3).uniform(0.5, LARGEST, (SIDE, SIDE, 1)).astype(np.float32)


def test_distance_is_the_length_of_the_vector_from_the_light() -> None:
    placed = positions(1)
    length = np.linalg.norm(placed[:, :3].astype(np.float64), axis=1)
    # three products, two sums and a root are each rounded to 2^-24
    assert shaded("light-distance", placed)[:, 0] == pytest.approx(length, rel=4 * 2.0**-24)


def test_distance_of_a_light_at_infinity_is_along_its_rays() -> None:
    placed = positions(2)
    assert (shaded("light-distance", placed, parallel=1.0)[:, 0] == -placed[:, 2]).all()


@pytest.mark.parametrize(("bias", "lit"), [(0.0, 0.0), (0.75, 0.0), (1.25, 1.0)])
def test_point_is_lit_if_it_is_not_farther_than_stored_by_more_than_the_bias(bias: float, lit: float) -> None:
    placed = np.array([[0.0, 3.0, -4.0, 1.0]])  # at distance 5, one behind what is stored
    found = shaded(
        "distance-visibility", placed, shadowMap=float_texture(np.full((1, 1, 1), 4.0)), bias=bias, farthest=9.0
    )
    assert found[0].tolist() == [4.0, 5.0 - bias, 0.0, lit]


def test_points_beyond_the_far_end_are_compared_as_if_they_were_on_it() -> None:
    placed = np.array([[0.0, 0.0, -50.0, 1.0]])
    for stored, lit in ((9.0, 1.0), (8.0, 0.0)):
        nothing_there = float_texture(np.full((1, 1, 1), stored))
        assert shaded("distance-visibility", placed, shadowMap=nothing_there, farthest=9.0)[0, 3] == lit


def test_cone_and_back_of_the_light_are_as_for_other_maps() -> None:
    placed = np.array([[0, 0, -1, 1], [0.8, 0, -1, 1], [0, 0, 1, 1], [0.3, 0.2, 0, 1]])
    far = float_texture(np.full((1, 1, 1), 9.0))
    found = shaded("distance-visibility", placed, shadowMap=far, farthest=9.0, cone=0.1, behind=0.25, scale=0.5)
    assert found[:, 3].tolist() == [1, 0, 0.25, 0.25]


def test_comparison_is_noted_as_one_of_distances() -> None:
    placed = np.array([[0.0, 3.0, -4.0, 1.0]])
    with noted_reads() as reads:
        shaded("distance-visibility", placed, shadowMap=float_texture(np.full((1, 1, 1), 4.0)), bias=0.5, farthest=9.0)
    (read,) = reads
    assert read.compared is not None
    assert (read.compared.depths.tolist(), read.compared.bias) == ([4.5], 0.5)
    assert (read.compared.measure, read.compared.farthest) == ("distance", 9.0)


def bind_distances(on: Any) -> None:
    """Bind a float texture of distances, with a border."""
    on.glBindTexture(on.GL_TEXTURE_2D, on.glGenTextures(1))
    for parameter, value in (
        (on.GL_TEXTURE_MIN_FILTER, on.GL_NEAREST),
        (on.GL_TEXTURE_MAG_FILTER, on.GL_NEAREST),
        (on.GL_TEXTURE_WRAP_S, on.GL_CLAMP_TO_EDGE),
    ):
        on.glTexParameteri(on.GL_TEXTURE_2D, parameter, value)
    on.glTexImage2D(on.GL_TEXTURE_2D, 0, on.GL_R32F, SIDE, SIDE, 0, on.GL_RED, on.GL_FLOAT, stored_distances())


@pytest.mark.mesa
@pytest.mark.parametrize("parallel", [0.0, 1.0])
@pytest.mark.parametrize(
    ("name", "own"),
    [
        ("light-distance", {}),
        (
            "distance-visibility",
            {"scale": 0.37, "farthest": LARGEST, "bias": 0.3, "behind": 0.25, "cone": 0.3},
        ),
    ],
)
def test_program_is_its_glsl_twin(name: str, own: dict[str, Any], parallel: float) -> None:
    placed, uniforms = positions(5), own | {"parallel": parallel}
    maps = {"shadowMap": float_texture(stored_distances())} if own else {}
    ours = shaded(name, placed, **uniforms, **maps)
    assert len(np.unique(ours[:, 0])) > SIDE
    assert same_bits(ours, on_mesa(name, placed, uniforms, bind_distances))
