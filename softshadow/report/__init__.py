"""Runs as pages to read: one self-contained file of one run, and the tour with its pictures beside it.

Pages load nothing from anywhere: styles, script and (in a single file) pictures are in them.
"""

from softshadow.report.page import write

__all__ = ["write"]
