"""float32 stays float32: the types that Numba infers inside the kernels."""

import importlib
import pkgutil

import numba
import numpy as np
import pytest

import softshadow.pipeline
import softshadow.programs
from draws import draw, random_state, random_triangles
from softshadow.context import Context

# what counts coordinates of the scene in double precision on purpose: truth and geometry, not the pipeline
BLOCKS = (softshadow.pipeline, softshadow.programs)


def kernels() -> dict[str, numba.core.dispatcher.Dispatcher]:
    """Every compiled function of the pipeline and the programs, by its full name."""
    found = {}
    for block in BLOCKS:
        for module in pkgutil.walk_packages(block.__path__, block.__name__ + "."):
            for function in vars(importlib.import_module(module.name)).values():
                if isinstance(function, numba.core.dispatcher.Dispatcher):
                    found[f"{function.py_func.__module__}.{function.py_func.__name__}"] = function
    return found


@pytest.mark.skipif(numba.config.DISABLE_JIT, reason="interpreted kernels have no inferred types")
def test_no_kernel_contains_float64_outside_exact():
    rng = np.random.default_rng(0)
    for depth_format in ("d24", "d32f"):
        context = Context(32, 32, depth_format)
        for _ in range(4):
            draw(context, random_state(rng, context.state), random_triangles(rng, 4))
    seen = 0
    for name, function in kernels().items():
        for signature, compiled in function.overloads.items():
            if "float64" in str(signature):
                continue  # the "exact" precision: everything is float64 from its arguments on
            seen += 1
            wide = [line for line in str(compiled.type_annotation).splitlines() if "float64" in line]
            assert not wide, f"{name}{signature}:\n" + "\n".join(wide[:5])
    assert seen > 10
