"""Run wild sequences in a process of its own and print what went wrong: ``python run_wild_programs.py FIRST END``.

The parent chooses the process's environment: kernels as plain Python (NUMBA_DISABLE_JIT=1), where NumPy checks every
index, or compiled with NUMBA_BOUNDSCHECK=1. Prints one line of JSON for each call that ended in a Python error, and
at last {"sequences": n}.
"""

import json
import os
import re
import sys
import traceback
import warnings
from collections.abc import Iterable
from functools import reduce
from operator import or_
from pathlib import Path
from typing import Any

import numpy as np

sys.path[:0] = [str(Path(__file__).parents[1])]
from bounds.checked_arrays import check_kernels  # noqa: E402

INTERPRETED = os.environ.get("NUMBA_DISABLE_JIT") == "1"
if INTERPRETED:
    check_kernels()  # before any kernel is made

from bounds.wild_programs import wild_program  # noqa: E402
from mesa.gl_calls import GENERATORS, OBJECT, Call  # noqa: E402
from softshadow import gl  # noqa: E402
from softshadow.errors import SoftShadowError  # noqa: E402
from softshadow.pipeline import choose, use_short_cuts  # noqa: E402

# compiled, only the states of few sequences are compiled for themselves: others find theirs compiled, or do without
POLICIES = (
    ("always", "always", "always", False) if INTERPRETED else ("always", *[False, True, True, True, True, True] * 6)
)
FORMATS = (("d24", "mesa"), ("d32f", "mesa"), ("d24", "mesa"), ("d24", "exact"))


def run(calls: list[Call], size: tuple[int, int], seed: int) -> list[dict[str, Any]]:
    """Make the calls in a new context and return the Python errors that they ended in."""
    objects: dict[str, int] = {}

    def value(argument: Any) -> Any:
        if isinstance(argument, list) and argument and isinstance(argument[0], str):
            return list(map(value, argument))
        if not isinstance(argument, str):
            return argument.copy() if isinstance(argument, np.ndarray) else argument
        if argument.startswith("program:"):
            return gl.program(argument.removeprefix("program:"))
        if OBJECT.fullmatch(argument) is None:
            return reduce(or_, (getattr(gl, token) for token in argument.split(" | ")))
        if argument not in objects:
            objects[argument] = int(getattr(gl, GENERATORS[argument.split()[0]])(1))
        return objects[argument]

    found = []
    depth_format, precision = FORMATS[seed // 7 % 4]
    bits = (8, 8, 1, 5)[seed // 3 % 4]
    with (
        use_short_cuts(POLICIES[seed % len(POLICIES)]),
        gl.create_context(*size, depth_format, bits, precision, raise_errors=False),
    ):
        for number, (name, arguments) in enumerate([*calls, ("glFinish", ())]):  # draws may wait until then
            try:
                getattr(gl, name)(*map(value, arguments))
            except SoftShadowError:
                pass  # GL's own errors are recorded; the others say what is not part of this subset
            except (TypeError, ValueError) as error:
                if not str(error).startswith((f"{name}: ", f"{name}(")):  # a refusal that names the call
                    found.append(finding(error, seed, number, name))
            except Exception as error:
                found.append(finding(error, seed, number, name))
    return found


def finding(error: Exception, seed: int, number: int, name: str) -> dict[str, Any]:
    """Return what is printed about an error."""
    frames = [frame for frame in traceback.extract_tb(error.__traceback__) if "softshadow" in frame.filename]
    where = f"{re.sub('.*softshadow/', '', frames[-1].filename)}:{frames[-1].lineno}" if frames else ""
    return {
        "seed": seed,
        "call": f"{number} {name}",
        "error": f"{type(error).__name__}: {error}"[:200],
        "where": where,
        "pipeline": any("softshadow/pipeline" in frame.filename for frame in frames),
        "text": "".join(traceback.format_exception(error))[-3000:],
    }


def main(seeds: Iterable[int]) -> None:
    """Run the sequences of the seeds; small windows are divided into bands, too."""
    warnings.simplefilter("ignore")
    pay = {name: getattr(choose, name) for name in ("WORTH_BANDS", "WORTH_BANDS_IN_TILES", "LAYERS")}
    count = 0
    for seed in seeds:
        for name, usual in pay.items():
            setattr(choose, name, 0 if seed // 5 % 2 else usual)
        calls, size = wild_program(seed)
        for finding in run(calls, size, seed):
            print(json.dumps(finding), flush=True)
        count += 1
    print(json.dumps({"sequences": count}), flush=True)


if __name__ == "__main__":
    main(range(int(sys.argv[1]), int(sys.argv[2])))
