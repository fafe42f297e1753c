"""The histories that the page computes: the same rows as `Run.pixel`, at pixels of techniques and of random frames."""

import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import softshadow as ss
from conftest import ALL_LANES
from inspection.recorded_frames import random_frame
from report.browser import chromium, opened
from softshadow.inspection import Replay, Step, Steps, pixel_history
from softshadow.inspection.history_row import origin_name
from softshadow.report import RunPage, write_run_page

FIELDS = ("step", "title", "draw", "object", "triangle", "front_facing", "z", "stored_z", "verdict", "stencil_before",
          "stencil_after", "depth_after", "reason")  # fmt: skip
QUICK = ("volume-zfail", "map", "planar-accumulated")


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    with chromium() as running:
        yield running


def name_of(row: dict[str, Any]) -> str:
    """What the triangle of a row was made from, as `HistoryRow.name` says it."""
    feature = f"edge {row['edge']}" if row["edge"] is not None else "" if row["face"] is None else f"face {row['face']}"
    return origin_name(row["part"], row["caster"], row["front_facing"], feature)


def compare_rows(page: Any, frame: Any, pixels: list[tuple[int, int]]) -> set[str]:
    """Compare the page's rows with the replay's; return the verdicts that occurred."""
    verdicts = set()
    found = page.evaluate(
        "async pixels => { const all = []; for (const [x, y] of pixels) all.push(await softshadow.rows(x, y));"
        " return all.map(rows => rows.map(row => ({...row, color: row.color_after, written: !!row.color_written}))); }",
        pixels,
    )
    for (x, y), rows in zip(pixels, found, strict=True):
        # the page has the triangles after clipping only
        expected = [row for row in pixel_history(frame, x, y).to_dicts() if row["verdict"] != "clipped"]
        for row, want in zip(rows, expected, strict=True):
            assert {name: row[name] for name in FIELDS} == {name: want[name] for name in FIELDS}, (x, y)
            assert tuple(row["color"]) == want["color_after"], (x, y, row)
            assert row["written"] == want["color_written"]
            made_from = row.get("extra", {}).get("made from")
            assert made_from == (name_of(want) if want["part"] else None)
            verdicts.add(row["verdict"])
    return verdicts


@pytest.mark.parametrize(
    "technique",
    [name if name in QUICK else pytest.param(name, marks=pytest.mark.slow) for name in ss.technique_names()],
)
def test_page_has_the_history_of_any_pixel(technique: str, browser: Any, tmp_path: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ss.Warning)
        run = ss.run(technique, "soft-overlap" if technique == "volume-wedges" else "torus", (64, 48))
    rng = np.random.default_rng(len(technique))
    pixels = [(int(rng.integers(64)), int(rng.integers(48))) for _ in range(12)]
    with opened(browser, run.save(tmp_path / "run.html")) as page:
        assert "passed" in compare_rows(page, run.frame, pixels)


@pytest.mark.parametrize("options", [{}, {"depth_format": "d32f"}, {"precision": "exact"}])
def test_random_states_have_the_same_rows(options: dict[str, Any], browser: Any, tmp_path: Path) -> None:
    verdicts = set()
    for seed in range(3 if ALL_LANES else 1):
        frame = random_frame(seed, draws=6, **options).frame
        steps = Steps([Step(i, title, {}, frame, Replay(frame)) for i, (title, _) in enumerate(frame.steps)])
        write_run_page(
            RunPage("random", ss.Scene.named("torus"), frame.size, {}, (), steps, None), tmp_path / f"{seed}.html"
        )
        width, height = frame.size
        pixels = [(x, y) for x in range(0, width, 2) for y in range(0, height, 2)]
        with opened(browser, tmp_path / f"{seed}.html") as page:
            verdicts |= compare_rows(page, frame, pixels)
    assert verdicts >= {"passed", "scissor", "stencil failed", "depth failed"}
