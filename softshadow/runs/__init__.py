"""Runs: drawing a scene with a technique, recorded step by step, and the files that a run is saved to."""

from softshadow.runs.perform import run
from softshadow.runs.result import Run, RunLight, load_run

__all__ = ["Run", "RunLight", "load_run", "run"]
