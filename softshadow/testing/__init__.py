"""Comparison of GL programs on softshadow and on Mesa, and of runs with ray casting.

`softshadow.testing.strategies` generates scenes with Hypothesis; it is not imported here because it needs that package.
"""

from softshadow.testing.agreement import Agreement, Truth, agreement, agreement_of, cast_truth
from softshadow.testing.comparison import (
    BufferDifference,
    ProgramComparison,
    compare,
    difference,
    differences,
    history_of_first,
    run_here,
    run_recorded,
)
from softshadow.testing.mesa import (
    EXPECTED_VERSION,
    MesaError,
    mesa_available,
    mesa_gl,
    mesa_reason,
    mesa_version,
    run_on_mesa,
    stop_workers,
)
from softshadow.testing.result import ProgramResult
from softshadow.testing.tracing import Divergence, diff_programs

__all__ = [
    "EXPECTED_VERSION",
    "Agreement",
    "BufferDifference",
    "Divergence",
    "MesaError",
    "ProgramComparison",
    "ProgramResult",
    "Truth",
    "agreement",
    "agreement_of",
    "cast_truth",
    "compare",
    "diff_programs",
    "difference",
    "differences",
    "history_of_first",
    "mesa_available",
    "mesa_gl",
    "mesa_reason",
    "mesa_version",
    "run_here",
    "run_on_mesa",
    "run_recorded",
    "stop_workers",
]
