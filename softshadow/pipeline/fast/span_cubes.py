"""Cube maps for a block of fragments; equals `shade.shading.shade`, see fast/test_span_shading.py.

From directions to faces and places on them, with the operations of `softshadow.programs.cube_maps`, but without
branches. The faces are the slices of a 3-D image, between which nothing is mixed.
"""

import numpy as np

from softshadow.jit import kernel
from softshadow.pipeline.constants import HALF, ONE, ZERO
from softshadow.pipeline.fast.fragment_block import FIRST, R_AXIS, R, S, T
from softshadow.programs.cube_maps import X, Y, Z

FACE = R_AXIS + FIRST
AXIS_X, AXIS_Y, AXIS_Z = np.int32(X), np.int32(Y), np.int32(Z)
TWO_FACES, SIGN_BIT = np.int32(2), np.int32(31)


@kernel
def project_onto_faces_of_block(by_reciprocal, count, room, whole):
    """Write FACE, and to S and T the position on it, for the directions in S, T and R; as `cube_maps.on_faces`."""
    for n in range(np.uint64(count)):
        s, t, r = room[S + n], room[T + n], room[R + n]
        is_x = abs(s) > abs(t)
        is_z = abs(r) >= (abs(s) if is_x else abs(t))
        major = r if is_z else s if is_x else t
        sign = np.int32(np.float32(major).view(np.int32) >> SIGN_BIT)  # -1 or 0
        axis = AXIS_Z if is_z else AXIS_X if is_x else AXIS_Y
        if by_reciprocal:
            scale = abs(HALF * (ONE / major))
        else:
            scale = HALF / abs(major)
            scale = scale if abs(major) > ZERO else ZERO
        is_y = axis == AXIS_Y
        across = s if is_y or is_z else -r  # on a positive face
        across = -across if sign and not is_y else across
        down = r if is_y else -t
        down = -down if sign and is_y else down
        whole[FACE + n] = np.int32(axis * TWO_FACES) - sign
        room[S + n], room[T + n] = across * scale + HALF, down * scale + HALF
