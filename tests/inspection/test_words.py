"""What is displayed says in words what is seen: figures that a sighted reader takes from the picture."""

import numpy as np
import pytest

import softshadow as ss
from softshadow.inspection import Maps
from softshadow.inspection.words import colors_in_words, counts_in_words, depths_in_words, map_in_words

SIZE = (64, 48)


@pytest.fixture(scope="module")
def zfail() -> ss.Run:
    return ss.run("volume-zfail", "torus", SIZE)


def test_a_step_says_how_many_pixels_have_each_count(zfail: ss.Run) -> None:
    step = zfail["count back faces"]
    said = step.describe()
    assert said.startswith("volume-zfail on torus, step 1 of 0 to 3, count back faces. Colour: ")
    values, pixels = np.unique(step.stencil, return_counts=True)
    first, *others = [f"{value} in {number:,}" for value, number in zip(values, pixels, strict=True)]
    assert f"stencil: {', '.join([f'{first} pixels', *others])}." in said
    assert "The window has 64 x 48 pixels." in said


def test_a_run_says_how_much_is_in_shadow_and_what_changes(zfail: ss.Run) -> None:
    lines = zfail.describe().splitlines()
    assert lines[0] == "volume-zfail on torus, 64 x 48 pixels, steps 0 to 3."
    assert len(lines) == 1 + len(zfail.steps)
    assert lines[2].endswith("; colour and depth as before.")
    dark = np.mean(zfail.visibility[zfail.valid] == 0)
    assert lines[-1].endswith(f"; {100 * dark:.0f} % of the surface in shadow.")
    changed = int((zfail[3].image != zfail[2].image).any(axis=-1).sum())
    assert f" {changed:,} of {64 * 48:,} pixels changed" in lines[-1]


def test_a_run_of_many_steps_describes_the_first_and_the_last() -> None:
    run = ss.run("volume-sampled", "soft-slab", (32, 24), samples=9)
    lines = run.describe().splitlines()
    assert "of which 0 to 6 and the last are described" in lines[0]
    assert [line.split(",")[0] for line in lines[1:]] == [f"Step {n}" for n in (*range(7), len(run.steps) - 1)]


def test_a_saved_run_says_the_same(zfail: ss.Run, tmp_path) -> None:
    assert ss.load_run(zfail.save(tmp_path / "run.npz")).describe() == zfail.describe()


def test_displays_give_notebooks_the_words(zfail: ss.Run) -> None:
    for shown in (zfail, zfail[1], zfail.maps, ss.failures["mask-1"]):
        data, metadata = shown._repr_mimebundle_()
        assert metadata == {"image/png": {"alt": " ".join(shown.describe().split())}}
        assert data["image/png"]


def test_a_failure_says_how_many_pixels_are_wrong_on_each_side() -> None:
    failure = ss.failures["mask-1"]
    said = failure.describe()
    assert f"{failure.number_wrong:,} pixels are wrong; on the right, with the cure, {failure.number_cured:,}" in said
    differ = int((failure.wrong.image != failure.cured.image).any(axis=-1).sum())
    assert f"{differ:,} of {240 * 180:,} pixels differ" in said


def test_words_tell_clear_depths_and_many_counts_and_one_colour_apart() -> None:
    assert depths_in_words(np.ones((2, 2))) == "nothing drawn"
    assert depths_in_words(np.array([[1.0, 0.5]]), None) == "0.5 to 1"
    assert counts_in_words(np.arange(9, dtype=np.uint8)[None]).endswith("5 in 1, other values in 3")
    assert colors_in_words(np.full((1, 2, 3), 255, np.uint8)) == "all of one colour, #ffffff"
    assert map_in_words("ZS", np.array([[1.0, 0.5]])) == "drawn in 50 % of the pixels, 0.5 to 0.5"
    assert map_in_words("mean depth", np.array([[1.0, 0.5]])) == "0.5 to 1"
    assert Maps().describe() == "no maps"


def test_a_section_says_counts_and_how_much_is_in_shadow() -> None:
    section = ss.cross_section("soft-slab")
    words = section.describe()
    shares = np.array([share for _, share in section.strips("floor")])
    assert ((shares > 0) & (shares < 1)).any()
    assert "floor: " in words
    assert " in shadow, " in words
    svg, metadata = section._repr_svg_()
    assert svg.startswith("<svg")
    assert metadata == {"alt": words}
    counted = ss.cross_section("overlapping", (132, 101), (232, 174)).describe()
    assert counted.endswith("the line of sight crosses 4 sides: +1 = 1, +1 = 2, -1 = 1, -1 = 0.")
