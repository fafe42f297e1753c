"""Mesa runs as intended: its coverage and depth follow the documented rules, without fused multiply-add.

The rules (docs: exactness) are spelled here in NumPy float32, one operation after the other, for triangles inside the
frustum in the default framebuffer, whose rows are computed from the top.
"""

import numpy as np
import pytest

from softshadow.testing import EXPECTED_VERSION, mesa_version, run_on_mesa

pytestmark = pytest.mark.mesa
WIDTH, HEIGHT = 90, 70
HALF = np.float32(0.5)


def window_positions(clip):
    """Return float32 x, y from the top, z of float32 clip positions (3, 4)."""
    reciprocal = np.float32(1) / clip[:, 3]
    scale = np.array([WIDTH / 2, -HEIGHT / 2, 0.5], np.float32)
    centre = np.array([WIDTH / 2, HEIGHT / 2, 0.5], np.float32)
    return (clip[:, :3] * reciprocal[:, None]) * scale + centre


def rule_depths(clip):
    """Return the covered pixels (h, w) bool and the 24-bit depths, row 0 at the bottom."""
    window = window_positions(clip)
    snapped = np.rint((window[:, :2] - HALF) * np.float32(256)).astype(np.int64)
    (x0, y0), (x1, y1), (x2, y2) = snapped.tolist()
    if (x0 - x1) * (y2 - y0) - (x2 - x0) * (y0 - y1) < 0:
        window, snapped = window[[1, 0, 2]], snapped[[1, 0, 2]]
    column, row = np.meshgrid(np.arange(WIDTH, dtype=np.int64), np.arange(HEIGHT, dtype=np.int64))
    covered = np.ones((HEIGHT, WIDTH), bool)
    for (xa, ya), (xb, yb) in zip(snapped.tolist(), np.roll(snapped, -1, axis=0).tolist(), strict=True):
        edge = (xa - xb) * (256 * row - ya) - (ya - yb) * (256 * column - xa)
        inclusive = ya < yb or (ya == yb and xa < xb)  # left edges, and the bottom edge
        covered &= (edge >= 0) if inclusive else (edge > 0)
    (xa, ya, za), (xb, yb, zb), (xc, yc, zc) = window
    dx01, dy01, dx20, dy20, dz01, dz20 = xa - xb, ya - yb, xc - xa, yc - ya, za - zb, zc - za
    reciprocal = np.float32(1) / (dx01 * dy20 - dy01 * dx20)
    dzdx = dz01 * (dy20 * reciprocal) - dz20 * (dy01 * reciprocal)
    dzdy = dz20 * (dx01 * reciprocal) - dz01 * (dx20 * reciprocal)
    origin = za - (dzdx * (xa - HALF) + dzdy * (ya - HALF))
    z = dzdy * row.astype(np.float32) + (dzdx * column.astype(np.float32) + origin)
    depth = np.rint(np.clip(z, np.float32(0), np.float32(1)) * np.float32(2**24 - 1)).astype(np.uint32)
    return covered[::-1], depth[::-1]


@pytest.mark.parametrize("seed", range(12))
def test_coverage_and_depth_of_a_triangle_are_the_rules(seed):
    if mesa_version() != EXPECTED_VERSION:
        pytest.skip(f"the rules are those of Mesa {EXPECTED_VERSION}, this is {mesa_version()}")
    rng = np.random.default_rng(seed)
    clip = np.ones((3, 4), np.float32)
    on_grid = seed % 3 == 0  # vertices on pixel centres and corners: samples exactly on edges
    clip[:, 3] = 1 if on_grid else rng.uniform(0.5, 2, 3)
    clip[:, :3] = rng.uniform(-0.95, 0.95, (3, 3)) * clip[:, 3:]
    if on_grid:
        clip[:, 0] = rng.integers(0, 2 * WIDTH, 3) / WIDTH - 1
        clip[:, 1] = rng.integers(0, 2 * HEIGHT, 3) / HEIGHT - 1

    def program(gl):
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glEnable(gl.GL_STENCIL_TEST)
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_INCR)
        gl.glBegin(gl.GL_TRIANGLES)
        for vertex in clip:
            gl.glVertex4fv(vertex)
        gl.glEnd()

    result = run_on_mesa(program, (WIDTH, HEIGHT))
    covered, depth = rule_depths(clip)
    assert covered.any()
    np.testing.assert_array_equal(result.stencil == 1, covered)
    np.testing.assert_array_equal(result.depth[covered], depth[covered])
