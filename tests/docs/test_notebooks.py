"""The notebooks run from their first cell to their last, in the order of the course."""

from pathlib import Path

import jupytext
import nbclient
import pytest

NOTEBOOKS = sorted((Path(__file__).parents[2] / "docs" / "notebooks").glob("*.py"))


def shown(cell: dict) -> list[dict]:
    """Return what a cell shows: a dictionary by media type for each output that has one."""
    return [output["data"] for output in cell.get("outputs", []) if "data" in output]


# building the documentation runs all of them
QUICK = NOTEBOOKS[:1]


@pytest.mark.parametrize(
    "path",
    [pytest.param(path, marks=() if path in QUICK else pytest.mark.slow) for path in NOTEBOOKS],
    ids=[path.stem for path in NOTEBOOKS],
)
def test_a_notebook_runs_and_shows_a_report_figures_a_pixel_and_two_failures(path: Path) -> None:
    notebook = jupytext.read(path)
    nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3").execute()
    cells = [cell for cell in notebook.cells if cell.cell_type == "code"]
    pictures = [data for cell in cells for data in shown(cell) if "image/png" in data]
    (report,) = (data for data in pictures if data["text/plain"].startswith("Run("))
    assert "<iframe srcdoc=" in report["text/html"]
    assert len([data for data in pictures if data["text/plain"].startswith("<Figure")]) >= 1
    assert len([data for data in pictures if "with the cure" in data["text/plain"]]) == 2
    assert any("text/html" in data and "PixelHistory" in data["text/plain"] for cell in cells for data in shown(cell))
    assert any(line.startswith("assert ") for cell in cells for line in cell.source.splitlines())


def test_there_are_three_in_the_order_of_the_course() -> None:
    assert [path.stem for path in NOTEBOOKS] == ["1_planar_shadows", "2_shadow_volumes", "3_shadow_maps"]


def test_the_player_runs_in_a_kernel_and_leaves_a_picture() -> None:
    cells = """# %%
import softshadow as ss

player = ss.notebook.play("map", "torus", (64, 48), map_size=32)
player

# %%
player.values = player.values | {"light.x": -1.0}
player.pixel = [30, 35]
print(player.explanation)
"""
    notebook = jupytext.reads(cells, fmt="py:percent")
    nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3").execute()
    first, second = (cell for cell in notebook.cells if cell.cell_type == "code")
    assert [set(data) for data in shown(first)] == [
        {"text/plain", "image/png", "application/vnd.jupyter.widget-view+json"}
    ]
    assert second["outputs"][0]["text"].startswith("pixel x=30 y=35")
