"""Every error of the slides demonstrated: by a listing, a failure of the gallery, or a small program of its own.

`measure` runs what shows an error and returns the numbers; docs/corrections.md is made of them. `passes` counts the
passes of techniques for the table that completes the course.
"""

from softshadow.demonstrations.measuring import PROGRAMS, Measured, measure, measure_one

__all__ = ["PROGRAMS", "Measured", "measure", "measure_one"]
