"""GLUT without a screen."""

from softshadow.windows.glut.glut import Glut

__all__ = ["Glut"]
