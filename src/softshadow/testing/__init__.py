"""Run one GL program on softshadow and on Mesa, and say where they differ."""

from softshadow.testing.mesa import (
    EXPECTED_VERSION,
    MesaError,
    MesaResult,
    mesa_available,
    mesa_gl,
    mesa_reason,
    mesa_version,
    run_on_mesa,
    stop_workers,
)

__all__ = [
    "EXPECTED_VERSION",
    "MesaError",
    "MesaResult",
    "mesa_available",
    "mesa_gl",
    "mesa_reason",
    "mesa_version",
    "run_on_mesa",
    "stop_workers",
]
