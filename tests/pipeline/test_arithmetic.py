"""float32 stays float32: checked on the types that Numba infers inside the kernels."""

import json
import os
import subprocess
import sys

import numba
import pytest

# Numba knows the types of code that it compiles, not of code from its cache: this runs in a process with an empty one.
# The truth and the geometry of scenes compute in double precision on purpose and are not checked.
TYPES = """
import importlib, json, pkgutil, sys
import numba
import softshadow.pipeline, softshadow.programs
from softshadow.cli.machine import warmup

warmup.callback(as_json=True)
kernels = {}
for block in (softshadow.pipeline, softshadow.programs):
    for module in pkgutil.walk_packages(block.__path__, block.__name__ + "."):
        for function in vars(importlib.import_module(module.name)).values():
            if not isinstance(function, numba.core.dispatcher.Dispatcher):
                continue
            for signature, compiled in function.overloads.items():
                if "float64" not in str(signature):  # the "exact" precision is float64 from its arguments on
                    lines = kernels.setdefault(f"{function.py_func.__module__}.{function.py_func.__name__}", [])
                    types = str(compiled.type_annotation).splitlines()
                    lines += [line.strip() for line in types if line.lstrip().startswith("#") and "float64" in line]
print()
print(json.dumps(kernels))
"""
DIVIDE_INTEGERS = {  # exactly, in float64
    "softshadow.pipeline.raster.coverage.narrow_rows",
    "softshadow.programs.filtering.fetch",  # a depth of 32 bits
}


@pytest.mark.slow  # compiles all kernels
@pytest.mark.skipif(vars(numba.config)["DISABLE_JIT"], reason="interpreted kernels have no inferred types")
def test_no_kernel_contains_float64_outside_exact(tmp_path):
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path)}
    process = subprocess.run([sys.executable, "-c", TYPES], env=environment, capture_output=True, text=True, check=True)
    kernels = json.loads(process.stdout.splitlines()[-1])
    assert len(kernels) > 200
    with_doubles = {name: lines for name, lines in kernels.items() if lines}
    assert with_doubles.keys() == DIVIDE_INTEGERS, with_doubles
