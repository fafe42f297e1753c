"""docs/courses.toml: each subject of the courses has a lesson about these slides; all names exist."""

import re
import tomllib

import pytest

from paths import ROOT
from softshadow import listings, techniques

ROWS = tomllib.loads((ROOT / "docs" / "courses.toml").read_text(encoding="utf-8"))["row"]
LESSONS = {int(path.stem[:2]): path for path in (ROOT / "docs" / "lessons").glob("[0-9]*.py")}
TEXTS = ("RO1", "RO2", "SK", "CA")
WITHOUT_LESSON = {39, 102}  # a shadow in a texture; literature: the rows say what there is instead
REFERENCE = re.compile(r"\b(RO1|RO2|SK|CA):(\d+)(?:-(\d+))?")


def lines_of(text: str) -> set[tuple[str, int]]:
    """Return the lines (text, number) that references such as RO1:25-28 name."""
    return {
        (name, line)
        for name, first, last in REFERENCE.findall(text)
        for line in range(int(first), int(last or first) + 1)
    }


def test_rows_are_the_103_of_the_checklist() -> None:
    assert [row["number"] for row in ROWS] == list(range(1, 104))


@pytest.mark.parametrize("row", ROWS, ids=lambda row: str(row["number"]))
def test_a_row_has_lessons_whose_slides_are_its_own(row: dict) -> None:
    assert lines_of(row["slides"])
    assert (row["number"] in WITHOUT_LESSON) == (row["lessons"] == []) == ("instead" in row)
    assert set(row["lessons"]) <= set(LESSONS)
    taught = set()
    for number in row["lessons"]:
        taught |= lines_of(LESSONS[number].read_text(encoding="utf-8").rpartition("# ## Sources")[2])
    assert not row["lessons"] or taught & lines_of(row["slides"]), "none of its lessons names these slides"


def test_listings_and_techniques_exist_and_all_listings_are_placed() -> None:
    assert {name for row in ROWS for name in row.get("techniques", [])} <= set(techniques.names())
    assert {name for row in ROWS for name in row.get("listings", [])} == set(listings.names())


def test_every_lesson_but_that_of_no_course_is_in_a_row() -> None:
    assert set(LESSONS) - {number for row in ROWS for number in row["lessons"]} == {23}
