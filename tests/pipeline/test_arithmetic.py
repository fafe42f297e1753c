"""float32 stays float32: checked on the types that Numba infers inside the kernels."""

import os
import subprocess
import sys
from pathlib import Path

import numba
import pytest

# Numba knows the types of code that it compiles, not of code from its cache: this runs in a process with an empty one.
# The truth and the geometry of scenes compute in double precision on purpose and are not checked.
TYPES = """
import importlib, pkgutil, sys
sys.path.insert(0, {tests!r})
import numba
import numpy as np
import softshadow.pipeline, softshadow.programs
from draws import draw, random_state, random_triangles
from softshadow.context import Context

rng = np.random.default_rng(0)
for depth_format in ("d24", "d32f"):
    context = Context(32, 32, depth_format)
    for _ in range(4):
        draw(context, random_state(rng, context.state), random_triangles(rng, 4))
kernels = set()
for block in (softshadow.pipeline, softshadow.programs):
    for module in pkgutil.walk_packages(block.__path__, block.__name__ + "."):
        for function in vars(importlib.import_module(module.name)).values():
            if not isinstance(function, numba.core.dispatcher.Dispatcher):
                continue
            for signature, compiled in function.overloads.items():
                name = f"{{function.py_func.__module__}}.{{function.py_func.__name__}}"
                if "float64" in str(signature):  # the "exact" precision is float64 from its arguments on
                    continue
                if function.py_func.__name__ == "narrow_rows":  # divides integers, exact in float64
                    continue
                kernels.add(name)
                for line in str(compiled.type_annotation).splitlines():
                    if "float64" in line:
                        print(name, line.strip(), file=sys.stderr)
print(len(kernels))
"""


@pytest.mark.slow  # reads the types of all kernels
@pytest.mark.skipif(vars(numba.config)["DISABLE_JIT"], reason="interpreted kernels have no inferred types")
def test_no_kernel_contains_float64_outside_exact(tmp_path):
    code = TYPES.format(tests=str(Path(__file__).parents[1]))
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path)}
    process = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True)
    assert not process.stderr
    assert int(process.stdout) > 10
