"""What glBitmap keeps for characters: small bitmaps only, so that pictures of bits take no memory."""

import numpy as np
import pytest

from softshadow import gl
from softshadow.gl import bitmaps, window_quads

KEPT = (bitmaps._kept_rows, bitmaps._kept_runs, window_quads._attributes, window_quads._normals, window_quads._indices)


@pytest.mark.parametrize(("side", "keeps"), [(8, True), (96, False)])
def test_only_characters_are_kept(side: int, keeps: bool) -> None:
    for kept in KEPT:
        kept.cache_clear()
    bits = np.random.default_rng(1).integers(0, 256, (side, side // 8), np.uint8)
    with gl.create_context(side, side) as context:
        gl.glPixelStorei(gl.GL_UNPACK_ALIGNMENT, 1)
        gl.glRasterPos2f(-1, -1)
        gl.glBitmap(side, side, 0, 0, 0, 0, bits)
        drawn = context.storage.window.color.view[::-1, :, 0] > 0
    assert np.array_equal(drawn, np.unpackbits(bits, axis=1).astype(bool))
    assert [kept.cache_info().currsize > 0 for kept in KEPT] == [keeps] * len(KEPT)
