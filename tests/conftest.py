"""The lanes of the tests, and the examples that Hypothesis draws.

Compilation makes the first call of a kernel slow, so no test has a deadline. ``SOFTSHADOW_LANE=all`` also runs the
tests marked ``slow`` and all cases of those marked ``thin``, and draws 40 times as many examples. With ``CI`` the same
examples are drawn in every session.
"""

import os
from collections import Counter

import pytest
from hypothesis import settings

from softshadow.testing import mesa_available, mesa_reason

pytest_plugins = ["pipeline.small_draws"]  # its fixtures
ALL_LANES = os.environ.get("SOFTSHADOW_LANE") == "all"

settings.register_profile("here", deadline=None, max_examples=25)
settings.register_profile("ci", deadline=None, max_examples=25, derandomize=True, print_blob=True)
settings.register_profile("all", deadline=None, max_examples=1000, print_blob=True)
settings.load_profile("all" if ALL_LANES else "ci" if os.environ.get("CI") else "here")


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Deselect tests of built pages where there are none, and slow ones unless the lane or -m asks for them."""
    left_out = [] if os.environ.get("SOFTSHADOW_SITE") else ["site"]
    if not ALL_LANES and "slow" not in config.getoption("markexpr"):
        left_out.append("slow")
    is_left_out = {item: any(item.get_closest_marker(name) for name in left_out) for item in items}
    if "slow" in left_out:
        is_left_out |= _thinned([item for item in items if not is_left_out[item]])
    config.hook.pytest_deselected(items=[item for item in items if is_left_out[item]])
    items[:] = [item for item in items if not is_left_out[item]]


def _thinned(items: list[pytest.Item]) -> dict[pytest.Item, bool]:
    """Return whether the quick lane leaves a case out: of tests marked ``thin(n)``, it runs every n-th one."""
    number: Counter[str] = Counter()
    is_left_out = {}
    for item in items:
        marker, test = item.get_closest_marker("thin"), item.nodeid.partition("[")[0]
        is_left_out[item] = marker is not None and number[test] % marker.args[0] > 0
        number[test] += 1
    return is_left_out


def pytest_runtest_setup(item: pytest.Item) -> None:
    """Skip the tests that compare with Mesa where it is not installed."""
    if item.get_closest_marker("mesa") and not mesa_available():
        pytest.skip(mesa_reason())
