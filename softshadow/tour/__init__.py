"""The tour: every technique on one scene, as a folder of pictures and buffers with a page to read."""

from softshadow.tour.stops import STOPS, Stop
from softshadow.tour.writing import write_tour

__all__ = ["STOPS", "Stop", "write_tour"]
