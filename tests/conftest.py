"""Which examples Hypothesis draws, and which lane runs.

The compiled kernels make the first call of a test slow, so no test has a deadline.  ``SOFTSHADOW_LANE=all`` runs what
is marked ``slow`` too and draws ten times as many examples; ``CI`` draws the same examples on every run.
"""

import os

import pytest
from hypothesis import settings

from softshadow.testing import mesa_available, mesa_reason

ALL_LANES = os.environ.get("SOFTSHADOW_LANE") == "all"

settings.register_profile("here", deadline=None)
settings.register_profile("ci", deadline=None, derandomize=True, print_blob=True)
settings.register_profile("all", deadline=None, max_examples=1000, print_blob=True)
settings.load_profile("all" if ALL_LANES else "ci" if os.environ.get("CI") else "here")


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leave the longer lane out, unless it was asked for by SOFTSHADOW_LANE or by an expression with -m."""
    if ALL_LANES or "slow" in config.getoption("markexpr"):
        return
    slow = [item for item in items if item.get_closest_marker("slow")]
    config.hook.pytest_deselected(items=slow)
    items[:] = [item for item in items if not item.get_closest_marker("slow")]


def pytest_runtest_setup(item: pytest.Item) -> None:
    """Skip what compares with Mesa where there is none."""
    if item.get_closest_marker("mesa") and not mesa_available():
        pytest.skip(mesa_reason())
