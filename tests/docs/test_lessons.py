"""The lessons have all their parts, run from their first cell to their last, and accept right answers."""

import re
from pathlib import Path

import jupytext
import nbclient
import pytest

from softshadow import listings

LESSONS = sorted((Path(__file__).parents[2] / "docs" / "lessons").glob("*.py"))
PARTS = ("Predict, then run", "Exercise", "Sources")
QUICK = ("05_stencil_buffer",)  # building the documentation runs more of them

each_lesson = pytest.mark.parametrize("path", LESSONS, ids=[path.stem for path in LESSONS])


def test_lessons_are_numbered_and_all_in_the_table_of_contents() -> None:
    contents = (LESSONS[0].parent / "index.md").read_text(encoding="utf-8")
    assert re.findall(r"^(\d\d_\w+)$", contents, re.MULTILINE) == [path.stem for path in LESSONS]
    for path in LESSONS:
        title = re.search(r"^# # (\d+)\. ", path.read_text(encoding="utf-8"), re.MULTILINE)
        assert title is not None
        assert int(title[1]) == int(path.stem[:2])


@each_lesson
def test_a_lesson_has_goal_slides_a_question_a_failure_an_exercise_and_sources(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    headings = re.findall(r"^# ## (.*)$", text, re.MULTILINE)
    assert [part for part in PARTS if part not in headings] == []
    assert any(heading.startswith("What goes wrong") for heading in headings) or "ss.failures[" in text
    for part in ("# **Goal.** ", "# **Slides.** ", "lessons.clickable(", "lessons.compare_prediction("):
        assert part in text, f"{path.name} has no {part!r}"
    assert re.search(r"lessons\.check_(program|function)\(", text)
    for name in re.findall(r"code_beside_slide\(\"([\w-]+)\"", text):
        assert name in listings.names()


@pytest.mark.parametrize(
    "path",
    [pytest.param(path, marks=() if path.stem in QUICK else pytest.mark.slow) for path in LESSONS],
    ids=[path.stem for path in LESSONS],
)
def test_a_lesson_runs_and_waits_for_answers(path: Path) -> None:
    notebook = jupytext.read(path)
    nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3").execute()
    cells = [cell for cell in notebook.cells if cell.cell_type == "code"]
    shown = [output["data"] for cell in cells for output in cell.get("outputs", []) if "data" in output]
    assert any("Not predicted yet" in data["text/plain"] for data in shown)
    assert any("<iframe srcdoc=" in data.get("text/html", "") for data in shown)
    last = cells[-1].outputs[0]["data"]["text/plain"]
    assert last.startswith(("Not written yet", "Not yet", "Right"))
    assert not last.startswith("Right")  # the exercise is left to the reader
