"""The lanes of the tests, and the examples that Hypothesis draws.

Compilation makes the first call of a kernel slow, so no test has a deadline. ``SOFTSHADOW_LANE=all`` also runs the
tests marked ``slow`` and draws 25 times as many examples. With ``CI`` the same examples are drawn in every session.
"""

import os

import pytest
from hypothesis import settings

from softshadow.testing import mesa_available, mesa_reason

ALL_LANES = os.environ.get("SOFTSHADOW_LANE") == "all"

settings.register_profile("here", deadline=None, max_examples=40)
settings.register_profile("ci", deadline=None, max_examples=40, derandomize=True, print_blob=True)
settings.register_profile("all", deadline=None, max_examples=1000, print_blob=True)
settings.load_profile("all" if ALL_LANES else "ci" if os.environ.get("CI") else "here")


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Deselect tests of built pages where there are none, and slow ones unless the lane or -m asks for them."""
    left_out = [] if os.environ.get("SOFTSHADOW_SITE") else ["site"]
    if not ALL_LANES and "slow" not in config.getoption("markexpr"):
        left_out.append("slow")
    deselected = [item for item in items if any(item.get_closest_marker(name) for name in left_out)]
    config.hook.pytest_deselected(items=deselected)
    items[:] = [item for item in items if item not in set(deselected)]


def pytest_runtest_setup(item: pytest.Item) -> None:
    """Skip the tests that compare with Mesa where it is not installed."""
    if item.get_closest_marker("mesa") and not mesa_available():
        pytest.skip(mesa_reason())
