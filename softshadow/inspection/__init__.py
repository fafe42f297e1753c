"""Looking at a recorded frame: buffers after any step, the history of any pixel, counts and differences.

Everything here plays the recorded commands again with the functions of the pipeline itself; no kernel knows of it.
"""

from softshadow.inspection.comparison import Comparison, compare
from softshadow.inspection.difference import Difference, difference
from softshadow.inspection.history import HistoryRow, PixelHistory, pixel_history
from softshadow.inspection.ledger import Counts, Ledger, ledger_of
from softshadow.inspection.replay import Buffers, Replay
from softshadow.inspection.step import DrawSummary, Step, Steps

__all__ = [
    "Buffers",
    "Comparison",
    "Counts",
    "Difference",
    "DrawSummary",
    "HistoryRow",
    "Ledger",
    "PixelHistory",
    "Replay",
    "Step",
    "Steps",
    "compare",
    "difference",
    "ledger_of",
    "pixel_history",
]
