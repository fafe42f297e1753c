"""Where the provoking vertex stands in a triangle: with GL_FIRST_VERTEX_CONVENTION, Mesa orders corners in another way.

The order decides the last bits of interpolated values, with smooth shading, too. Of quads the last vertex provokes in
either convention, as GL_QUADS_FOLLOW_PROVOKING_VERTEX_CONVENTION says.
"""

from __future__ import annotations

import numpy as np

from softshadow import tokens as gl
from softshadow.state import State


def first_provokes(state: State) -> bool:
    """Return whether flat colours are those of the first vertex."""
    return state.lighting.provoking_vertex == gl.GL_FIRST_VERTEX_CONVENTION


def order_pieces(triangles: np.ndarray, edges: np.ndarray, cut: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return pieces of clipped triangles (T, 3) and their edges with the last corner first, where they were `cut` (T,).

    Mesa's clipping makes a fan around the first corner, and lets it be the provoking one of each piece.
    """
    triangles = np.where(cut[:, None], np.roll(triangles, 1, axis=1), triangles)
    if len(edges):
        edges = np.ascontiguousarray(np.where(cut[:, None], np.roll(edges, 1, axis=1), edges))
    return np.ascontiguousarray(triangles), edges


def order_for_setup(triangles: np.ndarray, areas: np.ndarray) -> np.ndarray:
    """Return triangles (T, 3) so that the setup of those with a negative area keeps the first corner.

    The setup exchanges the first two corners of these; llvmpipe exchanges the last two (lp_setup_tri.c, triangle_cw).
    """
    return np.ascontiguousarray(np.where((areas < 0)[:, None], np.roll(triangles, 1, axis=1), triangles))
