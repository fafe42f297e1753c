"""Sweeps: many points measured, on one process or on many machines, with nothing lost; one tidy table."""

from softshadow.sweeps.execution import Progress, execute
from softshadow.sweeps.measured import Result, measure
from softshadow.sweeps.point import Point

__all__ = ["Point", "Progress", "Result", "execute", "measure"]
