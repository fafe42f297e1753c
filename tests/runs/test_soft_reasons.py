"""What a run says about a pixel in penumbra: the numbers are those of its maps."""

import re

import numpy as np
import pytest

import softshadow as ss

SIZE = (64, 48)


def pixel_in_penumbra(run: ss.Run) -> tuple[int, int]:
    ys, xs = np.nonzero(run.valid & (run.visibility > 0.2) & (run.visibility < 0.8))
    return int(xs[len(xs) // 2]), int(ys[len(ys) // 2])


@pytest.mark.parametrize("technique", ["volume-sampled", "map-sampled"])
def test_the_points_that_are_seen_make_the_share(technique):
    run = ss.run(technique, "soft-slab", SIZE, samples=9)
    x, y = pixel_in_penumbra(run)
    seen, points = map(int, re.search(r"(\d+) of (\d+) points of light are seen", run.explain(x, y)).groups())
    assert points == 9
    assert np.float32(seen / points) == run.visibility[y, x]


def test_blockers_and_width_are_those_of_the_maps():
    run = ss.run("map-pcss", "soft-slab", SIZE)
    x, y = pixel_in_penumbra(run)
    text = run.explain(x, y)
    assert f"The blockers are {run.maps['blocker distance'][y, x]:.3g} from light" in text
    assert f"{run.maps['penumbra width'][y, x]:.3g} wide" in text


def test_lit_pixels_and_hard_techniques_have_no_such_sentence():
    run = ss.run("volume-sampled", "soft-slab", SIZE, samples=4)
    y, x = np.argwhere(run.valid & (run.visibility == 1))[0]
    assert "points of" not in run.explain(int(x), int(y))
