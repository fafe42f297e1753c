"""Series over one amount, and their fitted exponents."""

import sys
from pathlib import Path

import pytest

from bench.sample_reports import report, result
from softshadow.bench.growth import exponent, growth, series
from softshadow.bench.plot import figure_class, save_plot, workload_names
from softshadow.bench.tables import growth_rows
from softshadow.bench.workloads import get
from softshadow.errors import SoftShadowError


@pytest.mark.parametrize("power", [0.0, 0.5, 1.0, 2.0])
def test_exponent_of_a_power_is_found(power: float) -> None:
    assert exponent([1, 4, 16], [0.3 * amount**power for amount in (1, 4, 16)]) == pytest.approx(power)


def test_resolution_is_the_number_of_pixels() -> None:
    amounts = [amount for amount, _ in series(get("w5"), "resolution")]
    assert amounts == [640 * 480 / 16, 640 * 480 / 4, 640 * 480]


def test_amounts_of_a_series_are_those_of_its_workloads() -> None:
    assert [(n, each.amounts["triangles"]) for n, each in series(get("w4"), "triangles")] == [
        (4375, 4375),
        (17500, 17500),
        (70000, 70000),
    ]
    assert [each.amounts["lights"] for _, each in series(get("map/boxes"), "lights")] == [1, 2, 4, 8]
    assert [n for n, _ in series(get("map/boxes"), "kind")] == ["at infinity", "outside", "inside"]


def test_an_amount_that_a_workload_does_not_have_is_refused() -> None:
    with pytest.raises(ValueError, match="workload w4 has resolution, triangles"):
        series(get("w4"), "lights")
    with pytest.raises(ValueError, match="did you mean 'triangles'"):
        series(get("w4"), "triangle")


def test_growth_has_an_exponent_for_each_peer() -> None:
    grown = growth("w4", "triangles", [1, 2, 4], [result(seconds=s) for s in (0.1, 0.2, 0.4)])
    assert grown.exponents == pytest.approx({"softshadow@1": 1, "softshadow@2": 1, "llvmpipe@1": 1})
    columns, rows = growth_rows(grown)
    assert columns == ["renderer", "threads", "1", "2", "4", "exponent"]
    assert rows[0][-1] == "1.00"


def test_kinds_of_light_have_no_exponent() -> None:
    grown = growth("map/boxes", "kind", ["outside", "inside"], [result(), result()])
    assert grown.exponents == {}
    assert growth_rows(grown)[1][0][-1] == "-"


def test_without_matplotlib_the_message_says_how_to_get_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    with pytest.raises(SoftShadowError, match=r"pip install 'softshadow\[notebook\]'"):
        figure_class()


def test_names_in_the_picture_are_distinct() -> None:
    sizes = [result(size=(8, 6)), result(size=(16, 12)), result("w5"), result("map"), result("map")]
    names = workload_names(report(*sizes))
    assert names[:3] == ["w4 8x6", "w4 16x12", "w5"]
    assert names[3] == "map 8x6 triangles 12 12 triangles"  # nothing tells the last two apart


def test_picture_is_written(tmp_path: Path) -> None:
    grown = growth("w4", "triangles", [1, 2], [result(), result()])
    save_plot(str(tmp_path / "bench.png"), report(result()), [grown])
    assert (tmp_path / "bench.png").read_bytes().startswith(b"\x89PNG")
