"""Sweep files: the points that they make, and what is said about mistakes."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from softshadow import SoftShadowError
from softshadow.sweeps.specification import read_specification, specified


def points(**table: Any) -> list[Any]:
    return specified({"technique": "map", **table}, "sweep.toml").points()


def test_every_combination_is_a_point_and_a_technique_gets_only_options_that_it_has() -> None:
    made = points(technique=["map", "volume-zfail"], options={"map_size": [64, 128]}, size=["32x24", "64x48"])
    assert [(each.technique, dict(each.options), each.size[0]) for each in made] == [
        ("map", {"map_size": 64}, 32), ("map", {"map_size": 64}, 64),
        ("map", {"map_size": 128}, 32), ("map", {"map_size": 128}, 64),
        ("volume-zfail", {}, 32), ("volume-zfail", {}, 64),
    ]  # fmt: skip


def test_logarithmic_range_has_a_constant_ratio_and_whole_numbers_stay_whole() -> None:
    sizes = [
        each.options["map_size"]
        for each in points(options={"map_size": {"from": 32, "to": 512, "count": 5, "scale": "log"}})
    ]
    assert sizes == [32, 64, 128, 256, 512]
    assert all(type(size) is int for size in sizes)
    factors = [each.options["factor"] for each in points(options={"factor": {"from": 0, "to": 2, "count": 5}})]
    assert factors == [0, 0.5, 1, 1.5, 2]


def test_random_numbers_depend_on_the_seed_alone() -> None:
    def drawn(seed: int) -> list[float]:
        made = points(options={"factor": {"random": [1, 2]}}, samples=20, seed=seed)
        return [each.options["factor"] for each in made]

    assert drawn(1) == drawn(1) != drawn(2)
    assert len(set(drawn(1))) == 20
    assert all(1 <= number <= 2 for number in drawn(1))


def test_logarithmic_random_numbers_have_uniform_logarithms() -> None:
    axis = {"random": [0.01, 100], "scale": "log"}
    made = points(options={"factor": axis}, samples=400)
    # the mean logarithm is 0; its standard error is 4.6 * 2 / sqrt(12 * 400) = 0.13, and 5 of these never happen
    assert abs(np.mean(np.log([each.options["factor"] for each in made]))) < 0.65


def test_light_on_a_circle_keeps_its_distance_and_does_not_repeat_the_first_place() -> None:
    made = points(light={"circle": {"center": [1, 4, 2], "radius": 3, "count": 12}})
    places = np.array([each.light for each in made])
    assert np.allclose(np.hypot(places[:, 0] - 1, places[:, 2] - 2), 3, atol=1e-8)  # written with 9 decimals
    assert len({tuple(place) for place in places.tolist()}) == 12
    line = points(eye={"line": {"from": [0, 1, 5], "to": [4, 1, 5], "count": 5}})
    assert [each.eye for each in line] == [(x, 1, 5) for x in (0, 1, 2, 3, 4)]


def test_equal_points_are_measured_once_but_repetitions_are_kept() -> None:
    assert len(points(size=["32x24", "32x24"])) == 1
    assert [each.repetition for each in points(repetitions=3)] == [0, 1, 2]


@pytest.mark.parametrize(
    ("table", "said"),
    [
        ({"technique": "mop"}, "sweep.toml: technique: unknown technique 'mop': did you mean 'map'?"),
        ({"scene": "boxs"}, "sweep.toml: scene: unknown scene 'boxs': did you mean 'boxes'?"),
        ({"size": "3"}, 'sweep.toml: size: size \'3\': expected WIDTHxHEIGHT in pixels, as in "320x240"'),
        ({"opshuns": {}}, "sweep.toml: opshuns: unknown key: did you mean 'options'?"),
        ({"options": {"map_size": {"from": 1, "to": 3}}}, "sweep.toml: options.map_size.count: Field required"),
        ({"options": {"map_size": {"count": 3}}}, "sweep.toml: options.map_size: expected a value, a list, {from, to"),
        ({"options": {"map_size": {"random": [3, 1]}}}, "random: expected [low, high] with low <= high"),
        (
            {"options": {"factor": {"from": 0, "to": 3, "count": 2, "scale": "log"}}},
            "sweep.toml: options.factor: a logarithmic range: expected from and to above 0",
        ),
        ({"frames": 0}, "sweep.toml: frames: expected greater than or equal to 1"),
        ({"light": [[1, 2]]}, "sweep.toml: light: expected a list of points [x, y, z], {circle = ...} or {line"),
        ({"light": {"circle": {"radius": 2, "count": 2}}}, "sweep.toml: light.circle.center: Field required"),
        ({"measure": ["hrad"]}, "sweep.toml: measure: unknown measure 'hrad': did you mean 'hard'?"),
    ],
)  # fmt: skip
def test_mistake_is_named_with_file_key_and_what_was_expected(table: dict[str, Any], said: str) -> None:
    with pytest.raises(SoftShadowError) as caught:
        specified({"technique": "map", **table}, "sweep.toml")
    assert said in str(caught.value)


def test_technique_is_required() -> None:
    with pytest.raises(SoftShadowError, match=r"sweep.toml: technique: Field required"):
        specified({}, "sweep.toml")


def test_option_that_no_technique_has_is_an_error() -> None:
    with pytest.raises(ValueError, match=r"options.map_sise: no technique here has it; did you mean 'map_size'"):
        points(options={"map_sise": 3})
    with pytest.raises(TypeError, match="option map_size='large': expected a whole number"):
        points(options={"map_size": "large"})


@pytest.mark.parametrize("contents", [b"technique = [", b"\xff\xfe\x00", b"a=1\na=2"])
def test_file_that_is_no_toml_is_an_error_that_names_it(contents: bytes, tmp_path: Path) -> None:
    file = tmp_path / "sweep.toml"
    file.write_bytes(contents)
    with pytest.raises(SoftShadowError, match=r"sweep.toml: expected a sweep file in TOML"):
        read_specification(file)


def test_models_are_relative_to_the_sweep_file(tmp_path: Path) -> None:
    (tmp_path / "sweep.toml").write_text('technique = "map"\nscene = ["boxes", "bunny.obj"]')
    assert [each.scene for each in read_specification(tmp_path / "sweep.toml").points()] == [
        "boxes", str(tmp_path / "bunny.obj"),
    ]  # fmt: skip
