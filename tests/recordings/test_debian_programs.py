"""A sample of piglit's tests of fixed function and of XScreenSaver's hacks: frames equal those of Mesa."""

from pathlib import Path

import pytest

from recordings import debian_programs

pytestmark = [pytest.mark.mesa, pytest.mark.slow]
EVERY = 8
SECONDS = 500.0


def test_the_list_of_programs_that_differ_has_not_changed(tmp_path: Path) -> None:
    reason = debian_programs.missing_tools()
    if reason:
        pytest.skip(reason)
    names = debian_programs.programs()[::EVERY]
    compared = debian_programs.compare_all(names, tmp_path, SECONDS)
    assert any(each.outcome == "equal" for each in compared)
    told = debian_programs.changes(compared)
    assert not told, "\n".join(told)
