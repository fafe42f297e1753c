"""Sweeps and films: many points or frames, on one process or on many machines, with nothing lost."""

from softshadow.sweeps.contact_sheet import save_contact_sheet
from softshadow.sweeps.execution import Progress, execute
from softshadow.sweeps.films.animate import animate
from softshadow.sweeps.films.film import Film
from softshadow.sweeps.measured import measure
from softshadow.sweeps.perform import sweep
from softshadow.sweeps.plot import PlotRequest, save_plot
from softshadow.sweeps.point import Point
from softshadow.sweeps.specification import Specification, read_specification
from softshadow.sweeps.table import SweepTable, load_sweep
from softshadow.sweeps.task import Result

__all__ = [
    "Film",
    "PlotRequest",
    "Point",
    "Progress",
    "Result",
    "Specification",
    "SweepTable",
    "animate",
    "execute",
    "load_sweep",
    "measure",
    "read_specification",
    "save_contact_sheet",
    "save_plot",
    "sweep",
]
