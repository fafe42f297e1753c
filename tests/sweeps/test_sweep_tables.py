"""Tables of sweeps: written, read, plotted; each row with the command that draws it again."""

import shlex
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from imageio.v3 import imread
from PIL import Image

import softshadow as ss
from cli.invocation import invoke_ok
from paths import SCENES
from softshadow.sweeps import PlotRequest, save_plot
from softshadow.sweeps.plot import grouped
from softshadow.testing import agreement, cast_truth

SWEEP = {
    "technique": ["map", "volume-zfail"],
    "scene": ["boxes", "torus"],
    "size": "48x36",
    "options": {"map_size": [32, 64], "factor": 0.1},
    "light": [[2, 4.123456789, 0], [0.1, 1, 0.2, 0]],
    "eye": [[3, 3, 4.25]],
    "fov": 41.23456789,
    "measure": ["hard", "counts", "time", "memory"],
    "repetitions": 1,
    "picture": True,
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("sweep")


@pytest.fixture(scope="module")
def table(folder: Path) -> ss.SweepTable:
    return ss.sweep(SWEEP, folder / "table.csv")


@pytest.mark.parametrize("suffix", [".csv", ".json", ".parquet"])
def test_table_is_read_as_it_was_written(table: ss.SweepTable, suffix: str, tmp_path: Path) -> None:
    if suffix == ".parquet":
        pytest.importorskip("pyarrow")
    loaded = ss.load_sweep(table.save(tmp_path / f"table{suffix}"))
    assert loaded.columns == table.columns
    assert loaded.rows == [{k: v for k, v in row.items() if v is not None} for row in table.rows]


def test_journal_has_the_rows_of_the_table(table: ss.SweepTable, folder: Path) -> None:
    assert ss.load_sweep(folder / "table.journal").rows == table.rows


def test_recipe_of_a_row_draws_its_picture_again(table: ss.SweepTable, folder: Path, tmp_path: Path) -> None:
    for row in table.rows[::3]:
        program, *words = shlex.split(row["recipe"])
        assert program == "softshadow"
        invoke_ok(*words, "-o", tmp_path / "again.png", "--force")
        pictures = folder / "table.pictures" / f"{row['key']}.png", tmp_path / "again.png"
        first, second = (imread(path) for path in pictures)
        assert np.array_equal(first, second)


def test_numbers_are_those_of_a_run(table: ss.SweepTable) -> None:
    row = next(row for row in table.rows if row["technique"] == "map")
    scene = ss.Scene.named("boxes")
    camera = ss.Camera(
        (3, 3, 4.25), scene.camera.target, scene.camera.up, 41.23456789, scene.camera.near, scene.camera.far
    )
    scene = replace(scene, camera=camera, lights=(ss.Light((2, 4.123456789, 0)),))
    run = ss.run("map", scene, (48, 36), map_size=32, factor=0.1)
    assert row["shadow_px"] == run.shadow_mask.sum()
    assert row["stencil_max"] == run.stencil.max()
    assert row["fragments"] == run.ledger.total.all_fragments
    assert row["hard_wrong_px"] == sum(int(each.wrong.sum()) for each in agreement(run))
    truth = cast_truth(scene, (48, 36))
    (light,), (compared,) = run.lights, agreement(run)
    squares = (light.visibility.astype(float) - truth.lit(0))[compared.compared] ** 2
    assert (
        row["hard_rms"]
        == np.sqrt(squares.mean())
        == pytest.approx(
            np.sqrt(row["hard_wrong_px"] / row["hard_compared_px"]),
            rel=1e-12,  # a square root of a mean of 0 and 1
        )
    )
    assert 0 < row["frame_min_ms"] <= row["frame_ms"]
    assert row["peak_memory_MB"] is None or row["peak_memory_MB"] > 30
    assert row["core_alone"] in (True, False)


def test_short_names_of_columns_are_found_or_explained(table: ss.SweepTable) -> None:
    assert table.column("map_size") == "option_map_size"
    assert table.column("wrong_px") == "hard_wrong_px"
    assert table.column("rms") == "hard_rms"
    assert np.array_equal(table["map_size"], [32, 32, 64, 64] * 2 + [np.nan] * 4, equal_nan=True)
    with pytest.raises(ss.SoftShadowError, match="did you mean 'width_px'"):
        table.column("widht_px")
    with pytest.raises(ss.SoftShadowError, match="expected one of frame_ms, frame_min_ms"):
        table.column("frame")


def test_plot_has_a_line_for_each_colour_with_the_mean_of_repeated_points(table: ss.SweepTable, tmp_path: Path) -> None:
    lines = grouped(table, "option_map_size", "hard_wrong_px", "scene")
    assert list(lines) == ["boxes", "torus"]
    assert [len(values) for places in lines.values() for values in places.values()] == [2] * 4  # both lights
    pytest.importorskip("matplotlib")
    path = save_plot(table, tmp_path / "plot.png", PlotRequest.parse("x=map_size,y=wrong_px,color=scene"))
    with Image.open(path) as image:
        assert image.size[0] > 300
    with pytest.raises(ss.SoftShadowError, match="no row has numbers in both columns"):
        save_plot(table, tmp_path / "plot.png", PlotRequest("scene", "frame_ms"))


@pytest.mark.parametrize("text", ["x=a", "x=a,y=b,z=c", "x=a,y=b,c", ""])
def test_request_for_a_plot_that_is_none_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match="expected x=COLUMN,y=COLUMN"):
        PlotRequest.parse(text)


def test_point_that_fails_becomes_a_row_with_its_error_and_the_rest_goes_on(tmp_path: Path) -> None:
    (tmp_path / "bad.obj").write_text("v 0 0 nan\nf 1 1 1\n")
    scenes = [str(tmp_path / "missing.obj"), str(tmp_path / "bad.obj"), "boxes", str(SCENES / "crate.obj")]
    table = ss.sweep({"technique": "blob", "scene": scenes, "size": "24x18", "measure": ["counts"]}, tmp_path / "t.csv")
    assert [row["status"] for row in table.rows] == ["error", "error", "ok", "ok"]
    assert "there is no such file" in table.rows[0]["error"]
    assert table.rows[1]["error"].startswith("MeshError: ")
    assert len(table.failed) == 2


@pytest.mark.parametrize("contents", ["", "a,b\n1,2\n", "{}", "[1]"])
def test_file_that_is_no_table_is_an_error_that_names_it(contents: str, tmp_path: Path) -> None:
    for name in ("table.csv", "table.json"):
        (tmp_path / name).write_text(contents)
        with pytest.raises(ss.SoftShadowError, match=f"{name}: expected the table of a sweep"):
            ss.load_sweep(tmp_path / name)
    with pytest.raises(ss.SoftShadowError, match=r"missing.csv: cannot be read"):
        ss.load_sweep(tmp_path / "missing.csv")
