"""``softshadow errata``: the list, one error with what shows it, and what a place in the slides is."""

from cli.invocation import invoke_ok, json_of, usage_error_of
from softshadow import course


def test_errors_are_listed_without_running_anything() -> None:
    text = invoke_ok("errata").stdout
    rows = json_of("errata")["errata"]
    assert [row["number"] for row in rows] == list(course.ERRATA)
    for row in rows:
        assert any(line.startswith(f"{row['number']} ") and row["title"] in line for line in text.splitlines())


def test_one_error_is_explained_and_measured() -> None:
    text = invoke_ok("errata", "E64").stdout
    assert text.startswith("E64: stencil writing is not disabled by default\n\nRO1:181 is line 181 of the slides of ")
    assert "default of the stencil write mask, 8 bits: 0 → 255" in text
    (row,) = json_of("errata", "E64")["errata"]
    assert row["measured"][0]["numbers"] == [0, 255]


def test_a_place_is_explained_and_bad_input_refused() -> None:
    assert invoke_ok("errata", "--source", "SK:369").stdout.startswith("SK:369 is line 369 of the slides of Marek")
    assert json_of("errata", "--source", "SK:369")["source"].startswith("SK:369 is")
    assert "expected a tag" in usage_error_of("errata", "--source", "XY")
    assert "unknown error 'E99'" in usage_error_of("errata", "E99")
    assert "expected no NUMBER" in usage_error_of("errata", "E1", "--source", "SK:1")
