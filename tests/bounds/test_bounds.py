"""No kernel leaves its arrays: random sequences of calls with wild values, in processes that check every index.

The quick lane runs kernels as plain Python, where an index beyond an array, a negative one, or a number without a place
in its type is an error. The long lane also runs them compiled with NUMBA_BOUNDSCHECK=1; their code has a cache folder
of its own, as such kernels are slow. Sequences are reproduced by their seed:
``NUMBA_DISABLE_JIT=1 python tests/bounds/run_wild_programs.py SEED END``.
"""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from bounds.checked_arrays import Checked
from softshadow.kernel_cache import cache_folder

RUNNER = Path(__file__).parent / "run_wild_programs.py"
QUICK, LONG = 90, 1500  # sequences


def findings(first: int, end: int, **environment: str) -> list[str]:
    """Run the sequences of these seeds in a process of its own; return a line for each call that failed."""
    done = subprocess.run(
        [sys.executable, str(RUNNER), str(first), str(end)],
        env={**os.environ, "SOFTSHADOW_THREADS": "1", **environment},
        capture_output=True,
        text=True,
    )
    lines = [json.loads(line) for line in done.stdout.splitlines()]
    if done.returncode or not lines or lines[-1] != {"sequences": end - first}:
        return [f"the process ended with {done.returncode}: {done.stderr[-2000:]}"]
    return [f"seed {line['seed']}, call {line['call']}: {line['error']}\n{line['text']}" for line in lines[:-1]]


def test_interpreted_kernels_stay_within_their_arrays(tmp_path):
    assert findings(0, QUICK, NUMBA_DISABLE_JIT="1", NUMBA_CACHE_DIR=str(tmp_path)) == []


@pytest.mark.slow
@pytest.mark.parametrize("part", range(3))
def test_interpreted_kernels_stay_within_their_arrays_in_thousands_of_sequences(part, tmp_path):
    seeds = QUICK + part * LONG, QUICK + (part + 1) * LONG
    assert findings(*seeds, NUMBA_DISABLE_JIT="1", NUMBA_CACHE_DIR=str(tmp_path)) == []


@pytest.mark.slow
def test_compiled_kernels_stay_within_their_arrays(tmp_path):
    kernels = cache_folder()
    folder = tmp_path if kernels is None else kernels.parents[1] / "softshadow-bounds-checked"
    assert findings(0, LONG, NUMBA_DISABLE_JIT="0", NUMBA_BOUNDSCHECK="1", NUMBA_CACHE_DIR=str(folder)) == []


@pytest.mark.parametrize("key", [-1, (0, -2), (slice(-1, 2), 0), (slice(0, 2), np.int32(-1)), 3, (0, 4)])
def test_checked_arrays_refuse_indices_outside(key):
    array = np.zeros((3, 4)).view(Checked)
    with pytest.raises(IndexError):
        array[key]
    with pytest.raises(IndexError):
        array[key] = 1
    assert array[1, 2] == array[1:, 0][0] == 0
