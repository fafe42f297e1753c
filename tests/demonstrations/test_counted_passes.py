"""The completed table of the course: its formulas are what the ledgers of runs count."""

import pytest

from softshadow.course.passes import ROWS, Row
from softshadow.demonstrations.passes import count, markdown_table, scene_of, unseen_passes
from softshadow.scene import Scene

# measured on scenes of the course, M lights: one; one that does not see all of the scene; a spot; two
MAP = {"torus": 3, "boxes": 4, "spotlight": 5, "two-lights": 6}


def label(row: Row) -> str:
    return " ".join([row.technique, *map(str, row.options.values())])


@pytest.mark.slow
@pytest.mark.parametrize("casters", [1, 3])
@pytest.mark.parametrize("lights", [1, 2, 3])
@pytest.mark.parametrize("row", ROWS, ids=label)
def test_formula_is_the_number_of_passes_in_the_ledger(row: Row, lights: int, casters: int) -> None:
    assert count(row, scene_of(lights, casters)).passes == row.passes(lights)


def test_formula_of_volumes_holds_for_three_lights() -> None:
    row = next(row for row in ROWS if row.technique == "volume-zpass")
    assert count(row, scene_of(3, 2)).passes == row.passes(3) == 10


@pytest.mark.parametrize("name", [pytest.param(name, marks=pytest.mark.slow) for name in MAP])
def test_a_light_that_does_not_see_all_of_the_scene_takes_more_passes(name: str) -> None:
    (row,) = (row for row in ROWS if row.technique == "map")
    scene = Scene.named(name)
    counted = count(row, scene).passes
    assert counted == row.passes(len(scene.lights), unseen_passes(scene)) == MAP[name]
    assert row.passes(1) in (counted, counted - unseen_passes(scene), 3)


@pytest.mark.slow
def test_table_has_a_line_for_each_row_with_all_columns() -> None:
    lines = markdown_table().splitlines()
    assert len(lines) == 2 + len(ROWS)
    assert {line.count("|") for line in lines} == {9}
    for row, line in zip(ROWS, lines[2:], strict=True):
        assert f"| {', '.join(str(row.passes(lights)) for lights in (1, 2, 3))} |" in line
        assert row.formula in line
