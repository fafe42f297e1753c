"""Pictures with matplotlib and a live player for notebooks; they need the extra `softshadow[notebook]`.

A run, a step and its maps display themselves without it. All positions are those of `Run.pixel`: x from the left, y
from the top.
"""

from softshadow.notebook.arrays import show_image, show_map
from softshadow.notebook.buffers import show_depth, show_stencil
from softshadow.notebook.descriptions import describe
from softshadow.notebook.play import play
from softshadow.notebook.section import show_section
from softshadow.notebook.steps import show_steps

__all__ = ["describe", "play", "show_depth", "show_image", "show_map", "show_section", "show_stencil", "show_steps"]
