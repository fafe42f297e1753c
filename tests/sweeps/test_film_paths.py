"""Paths of lights and cameras: one for films and sweeps."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from softshadow.errors import SceneError
from softshadow.sweeps.paths import route_of
from softshadow.sweeps.specification import specified

START, CENTER = np.array([2.0, 5.0, 1.0]), np.array([1.0, 0.0, 1.0])


def points(path: Any, n_frames: int) -> np.ndarray:
    return route_of(path, "light path").points(n_frames, START, CENTER)


def test_orbit_turns_around_the_vertical_axis_anticlockwise_seen_from_above() -> None:
    assert points("orbit", 4).tolist() == [[2, 5, 1], [1, 5, 0], [0, 5, 1], [1, 5, 2]]
    assert points("orbit:-360", 4).tolist() == [[2, 5, 1], [1, 5, 2], [0, 5, 1], [1, 5, 0]]


def test_turn_that_is_not_whole_reaches_its_end_and_a_whole_one_does_not_repeat_its_first_point() -> None:
    assert points("orbit:180", 3).tolist() == [[2, 5, 1], [1, 5, 0], [0, 5, 1]]
    assert len(np.unique(points("orbit:720", 10), axis=0)) == 5


def test_circle_of_a_film_is_that_of_a_sweep() -> None:
    circle = {"center": [0, 4, 0], "radius": 2, "count": 7}
    sweep = specified({"technique": "map", "light": {"circle": circle}}, "sweep.toml").points()
    assert [each.light for each in sweep] == [tuple(each) for each in points("circle:0,4,0,2", 7).tolist()]
    assert points("circle:0,4,0,2", 4).tolist() == [[2, 4, 0], [0, 4, -2], [-2, 4, 0], [0, 4, 2]]


def test_line_of_a_film_is_that_of_a_sweep_and_includes_both_ends() -> None:
    line = {"from": [0, 1, 5], "to": [4, 1, 5], "count": 6}
    sweep = specified({"technique": "map", "eye": {"line": line}}, "sweep.toml").points()
    assert [each.eye for each in sweep] == [tuple(each) for each in points("line:0,1,5:4,1,5", 6).tolist()]
    assert [each.eye[0] for each in sweep] == [0, 0.8, 1.6, 2.4, 3.2, 4]


def test_points_are_passed_at_constant_speed_and_a_closed_path_leads_back() -> None:
    assert points("points:0,0,0:1,0,0:1,0,3", 5).tolist() == [[0, 0, 0], [1, 0, 0], [1, 0, 1], [1, 0, 2], [1, 0, 3]]
    square = points("points:0,0,0:1,0,0:1,0,1:0,0,1:closed", 8)
    assert square[4:].tolist() == [[1, 0, 1], [0.5, 0, 1], [0, 0, 1], [0, 0, 0.5]]
    assert np.array_equal(points([[0, 0, 0], [1, 0, 0]], 3), [[0, 0, 0], [0.5, 0, 0], [1, 0, 0]])


@pytest.mark.parametrize(
    ("table", "text"),
    [
        ('kind = "orbit"\ndegrees = 90', "orbit:90"),
        ('kind = "circle"\ncenter = [0, 4, 0]\nradius = 2', "circle:0,4,0,2"),
        ('kind = "line"\nfrom = [0, 1, 5]\nto = [4, 1, 5]', "line:0,1,5:4,1,5"),
        ('kind = "points"\npoints = [[0, 0, 0], [1, 0, 0]]\nclosed = true', "points:0,0,0:1,0,0:closed"),
    ],
)  # fmt: skip
def test_path_of_a_file_is_that_of_a_text(table: str, text: str, tmp_path: Path) -> None:
    (tmp_path / "path.toml").write_text(table)
    assert np.array_equal(points(tmp_path / "path.toml", 5), points(text, 5))


def test_circle_of_a_file_may_begin_and_end_anywhere(tmp_path: Path) -> None:
    (tmp_path / "path.toml").write_text(
        'kind = "circle"\ncenter = [0, 4, 0]\nradius = 2\nstart_degrees = 90\nturn_degrees = -90'
    )
    assert points(tmp_path / "path.toml", 2).tolist() == [[0, 4, -2], [2, 4, 0]]


@pytest.mark.parametrize(
    ("path", "said"),
    [
        ("orbt", "light path 'orbt': did you mean 'orbit'?"),
        ("orbit:0", "degrees: expected a turn, such as 360 or -90, got 0"),
        ("circle:0,4,0", "'0,4,0': expected 4 numbers with commas between them"),
        ("circle:0,4,0,-1", "radius: expected a number above 0, got -1"),
        ("line:0,0,0", "expected line:X,Y,Z:X,Y,Z"),
        ("points:0,0,0:0,0,0", "all points are [0.0, 0.0, 0.0]; expected different ones"),
        ("none.toml", "light path none.toml: cannot be read"),
        ([[0, 0, 0]], "light path: expected at least two points"),
    ],
)
def test_mistake_in_a_path_is_named(path: Any, said: str) -> None:
    with pytest.raises(SceneError) as caught:
        points(path, 4)
    assert said in str(caught.value)


@pytest.mark.parametrize(
    ("table", "said"),
    [
        ('kind = "circel"', "kind: did you mean 'circle'?"),
        ('kind = "circle"\nradius = 2', "needs center"),
        ('kind = "circle"\ncentre = [0, 0, 0]\nradius = 2', "did you mean 'center'?"),
        ('kind = "points"\npoints = [[0, 0, 0], [1, 0, 0]]\nclosed = 1', "closed: expected true or false, got 1"),
        ("kind =", "is not TOML"),
    ],
)
def test_mistake_in_a_file_of_a_path_is_named(table: str, said: str, tmp_path: Path) -> None:
    (tmp_path / "path.toml").write_text(table)
    with pytest.raises(SceneError) as caught:
        points(tmp_path / "path.toml", 4)
    assert "path.toml" in str(caught.value)
    assert said in str(caught.value)


def test_orbit_around_the_place_where_the_light_stands_is_an_error() -> None:
    with pytest.raises(SceneError, match="stands on the axis that it would turn around"):
        route_of("orbit", "light path").points(4, np.array([1.0, 5.0, 1.0]), CENTER)
