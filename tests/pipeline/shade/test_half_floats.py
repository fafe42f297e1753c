"""A number truncated to half precision in a kernel is that of NumPy's half floats, for every size of number."""

import numpy as np
import pytest

from softshadow.pipeline.shade.float_writes import halves_of
from softshadow.texel_codes import as_halves

COUNT = 20_000
BORDERS = [0.0, 2.0**-24, 2.0**-14, 65504.0, 65520.0, 3e38, np.inf, np.nan]  # of steps, normal numbers, the largest


@pytest.mark.interpreted
def test_halves_are_truncated_as_by_numpy() -> None:
    rng = np.random.default_rng(0)
    near = np.array(BORDERS, np.float32)
    borders = np.concatenate([near, np.nextafter(near, np.float32(0)), np.nextafter(near, np.float32(np.inf))])
    any_bits = rng.integers(0, 1 << 32, COUNT, np.uint32, endpoint=False).view(np.float32)
    sizes = (rng.standard_normal(COUNT) * 2.0 ** rng.integers(-28, 18, COUNT)).astype(np.float32)
    values = np.concatenate([borders, -borders, any_bits, sizes])
    with np.errstate(all="ignore"):
        (out,) = halves_of(values[np.newaxis])
    expected = as_halves(values, truncated=True)
    is_nan = np.isnan(values)
    assert np.isnan(out[is_nan]).all()
    assert np.array_equal(out[~is_nan].view(np.uint32), expected[~is_nan].view(np.uint32))
