"""Shading programs: a vertex stage, a fragment stage, and the same program in GLSL, which a GL driver compiles.

A program is a record of functions and GLSL sources. `shade` gets thousands of fragments of a draw per call, possibly in
several threads at once, so it may be plain NumPy; the programs of this package call a few cached kernels. `inputs` and
`out` are stored column by column: ``inputs[:, 3]``, ``inputs.T`` and ``out.T`` are contiguous, so kernels that loop
over fragments are vectorised.
"""

from softshadow.programs.program import Program, Varyings, VertexInputs, needs_blocks
from softshadow.programs.registry import get, register

__all__ = ["Program", "Varyings", "VertexInputs", "get", "needs_blocks", "register"]
