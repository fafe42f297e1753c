"""Description of the machine that a report was measured on."""

from __future__ import annotations

import os
import platform
from importlib.metadata import version
from pathlib import Path
from typing import Any

import softshadow
from softshadow.testing import mesa_available, mesa_version


def machine(with_mesa: bool) -> dict[str, Any]:
    """Return processor, cores, load and versions, without the names of the machine and its user."""
    facts: dict[str, Any] = {
        "processor": processor(),
        "cores": os.cpu_count(),
        "load": round(os.getloadavg()[0], 2) if hasattr(os, "getloadavg") else None,
        "system": f"{platform.system()} {platform.machine()}",
        "python": platform.python_version(),
        **{name: version(name) for name in ("numpy", "numba", "llvmlite")},
        "softshadow": softshadow.__version__,
    }
    if with_mesa and mesa_available():
        facts["mesa"] = mesa_version()
    return facts


def processor() -> str:
    """Return the name of the processor if the system reports it, else its architecture."""
    information = Path("/proc/cpuinfo")
    if information.exists():
        for line in information.read_text(encoding="utf-8", errors="replace").splitlines():
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    return platform.processor() or platform.machine()
