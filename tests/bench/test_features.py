"""Features of GL on a mesh: each draws a picture, and the same one as Mesa; several can be put together."""

from functools import partial
from typing import Any

import numpy as np
import pytest

from softshadow.bench.corpus.features import FEATURES, NAMES
from softshadow.bench.corpus.programs import get
from softshadow.testing import compare, run_here

SIZE = (64, 48)
FRAMES = 2  # the second one finds what the first one has left


def draw(gl: Any, name: str) -> None:
    """Draw the first frames of a program."""
    get(name).resized(SIZE).frames(gl, FRAMES)


@pytest.mark.thin(5)
@pytest.mark.mesa
@pytest.mark.parametrize("name", NAMES)
def test_feature_draws_the_same_picture_as_mesa(name: str) -> None:
    comparison = compare(partial(draw, name=name), SIZE)
    assert comparison, comparison


def test_features_change_the_picture() -> None:
    plain = run_here(partial(draw, name="features/plain"), SIZE)
    for name in ("fog-exp", "scissor", "no-light", "units-3", "mode-line"):
        assert (run_here(partial(draw, name=f"features/{name}"), SIZE).color != plain.color).any(), name


def test_features_can_be_put_together() -> None:
    both = get("features/fog-exp+scissor")
    assert both.name == "features/fog-exp+scissor"
    assert both.title == f"{FEATURES['fog-exp'].title}, {FEATURES['scissor'].title}"
    fog, boxed = (
        run_here(partial(draw, name=f"features/{name}"), SIZE).color for name in ("fog-exp", "fog-exp+scissor")
    )
    assert (fog != boxed).any()
    assert np.isin(boxed.reshape(-1, 4), fog.reshape(-1, 4)).any()


def test_features_have_titles_and_names_of_their_own() -> None:
    assert len(FEATURES) > 100
    assert all(feature.title and feature.name == name for name, feature in FEATURES.items())


def test_an_unknown_feature_names_the_nearest() -> None:
    with pytest.raises(ValueError, match="did you mean 'fog-exp'"):
        get("features/fog-expp")
