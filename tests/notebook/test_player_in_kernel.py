"""The player in a real kernel: it follows the widget's values, and leaves a picture in the notebook."""

import jupytext
import nbclient


def shown(cell: dict) -> list[dict]:
    """Return what a cell shows: a dictionary by media type for each output that has one."""
    return [output["data"] for output in cell.get("outputs", []) if "data" in output]


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
