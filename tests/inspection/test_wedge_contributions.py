"""What each wedge contributes at a pixel: sums of areas in float64 that are the drawn map."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import softshadow as ss
from softshadow.errors import StateError
from softshadow.inspection import wedge_contributions
from softshadow.scene import Light, Rectangle, Scene, SceneObject, Sphere, placement, shapes

SIZE = (64, 48)
# positions are float32; a point that sees its own edge at a grazing angle magnifies what that is off
FLOAT_PRECISION, GRAZING = 1e-5, 1e-3


@pytest.mark.parametrize(("name", "tolerance"), [("soft-slab", FLOAT_PRECISION), ("soft-torus", GRAZING)])
def test_contributions_add_up_to_the_map(name: str, tolerance: float) -> None:
    run = ss.run("volume-wedges", name, size=SIZE)
    pixels = np.argwhere(run.valid & (run.maps["wedges"] > 0))
    for y, x in pixels[:: len(pixels) // 60]:
        contributions = run.contributions(int(x), int(y))
        assert contributions.coverage == pytest.approx(float(run.maps["coverage"][y, x]), abs=tolerance)
        assert contributions.visibility == pytest.approx(float(run.visibility[y, x]), abs=tolerance)
        assert contributions.count == run.maps["count"][y, x]
        assert len(contributions.contributions) == pytest.approx(run.maps["wedges"][y, x], abs=1)
        sizes = [abs(each.share) for each in contributions.contributions]
        assert sizes == sorted(sizes, reverse=True)
        for each in contributions.contributions:
            assert each.wedge.contains(contributions.point)
            assert {tuple(end) for end in each.ends} == {tuple(each.wedge.near_end), tuple(each.wedge.far_end)}


def test_a_sentence_names_the_wedges() -> None:
    light = Light((0, 4, 0), name="lamp", shape=Rectangle((1, 0, 0), (0, 0, 1)))
    sheet = SceneObject(shapes.floor(40), placement((-20.1, 2, 0)), name="sheet")
    scene = replace(Scene.named("soft-slab"), lights=(light,), objects=(sheet,))
    outside = wedge_contributions(scene, light, np.array([0.2, 0, 0]), 0)
    number = outside.contributions[0].number
    assert str(outside) == f"0.9 of lamp is visible: wedge {number} of sheet takes 0.1."
    inside = wedge_contributions(scene, light, np.array([-0.4, 0, 0]), 1)
    assert str(inside) == f"0.3 of lamp is visible: a volume covers it, wedge {number} of sheet gives back 0.3."
    assert str(wedge_contributions(scene, light, np.array([9.0, 0, 0]), 0)) == "1 of lamp is visible."
    assert str(wedge_contributions(scene, light, np.array([-9.0, 0, 0]), 2)) == (
        "0 of lamp is visible: 2 volumes cover it."
    )


def test_an_explanation_of_a_partly_lit_pixel_ends_with_its_wedges() -> None:
    run = ss.run("volume-wedges", "soft-slab", size=SIZE)
    y, x = np.argwhere(run.valid & (run.visibility > 0.4) & (run.visibility < 0.6))[0]
    assert run.explain(int(x), int(y)).endswith(str(run.contributions(int(x), int(y))))
    y, x = np.argwhere(run.valid & (run.visibility == 1))[0]
    assert "wedge" not in run.explain(int(x), int(y))


def test_saved_runs_answer_too_and_wrong_questions_are_refused(tmp_path: Path) -> None:
    lights = (Light((0, 4, 0), (0.5, 0.5, 0.5), "lamp", shape=Sphere(0.5)), Light((1, 4, 1), (0.5, 0.5, 0.5), "bulb"))
    run = ss.run("volume-wedges", replace(Scene.named("soft-slab"), lights=lights), size=SIZE)
    y, x = (int(n) for n in np.argwhere(run.valid & (run.maps["wedges: lamp"] > 0))[0])
    saved = ss.load_run(run.save(tmp_path / "run.npz"))
    assert str(saved.contributions(x, y)) == str(run.contributions(x, y))
    assert "lamp" in str(run.contributions(x, y))
    assert run.contributions(x, y, light=1).contributions == ()
    with pytest.raises(ValueError, match="light=2: expected 0 to 1"):
        run.contributions(x, y, light=2)
    with pytest.raises(ValueError, match="outside the picture of 64 x 48 pixels"):
        run.contributions(64, 0)
    y, x = (int(n) for n in np.argwhere(~run.valid)[0])
    with pytest.raises(StateError, match="expected a pixel that shows a surface"):
        run.contributions(x, y)
    with pytest.raises(StateError, match="'volume-zfail' has no map 'positions'"):
        ss.run("volume-zfail", "boxes", size=SIZE).contributions(1, 1)
