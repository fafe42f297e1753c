"""Inspecting a recorded frame: the buffers after any step, the history of any pixel, fragment counts, differences.

All of it comes from replaying the recorded commands with the pipeline's own functions; the kernels hold no extra code.
"""

from softshadow.inspection.comparison import Comparison, compare
from softshadow.inspection.difference import Difference, difference
from softshadow.inspection.history import PixelHistory, pixel_history, texel_history
from softshadow.inspection.history_row import HistoryRow
from softshadow.inspection.ledger import Counts, Ledger, ledger_of
from softshadow.inspection.maps import Maps
from softshadow.inspection.replay import Buffers, Replay
from softshadow.inspection.soft_truth import SoftTruth, soft_truth
from softshadow.inspection.step import DrawSummary, Step, Steps
from softshadow.inspection.wedge_contributions import WedgeContribution, WedgeContributions, wedge_contributions

__all__ = [
    "Buffers",
    "Comparison",
    "Counts",
    "Difference",
    "DrawSummary",
    "HistoryRow",
    "Ledger",
    "Maps",
    "PixelHistory",
    "Replay",
    "SoftTruth",
    "Step",
    "Steps",
    "WedgeContribution",
    "WedgeContributions",
    "compare",
    "difference",
    "ledger_of",
    "pixel_history",
    "soft_truth",
    "texel_history",
    "wedge_contributions",
]
