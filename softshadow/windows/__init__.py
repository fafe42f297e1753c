"""Windows for programs written for PyOpenGL with GLUT, pygame or GLFW: they run unchanged, without a screen."""

from softshadow.windows.script import run_script

__all__ = ["run_script"]
