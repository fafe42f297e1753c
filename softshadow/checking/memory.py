"""The memory limit of a process, where the system has one (not on Windows)."""

from __future__ import annotations

import sys
from pathlib import Path

MEGABYTE = 1 << 20


def limit_memory(megabytes: int) -> None:
    """Let this process have so much more address space than it has now; the rest of its allocations fail."""
    if not sys.platform.startswith("linux"):  # macOS accepts the limit and ignores it
        return
    import resource

    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
    limit = pages * resource.getpagesize() + megabytes * MEGABYTE
    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (limit if hard == resource.RLIM_INFINITY else min(limit, hard), hard))


def unlimit_memory() -> None:
    """Undo `limit_memory`, so that a report can be written."""
    if not sys.platform.startswith("linux"):
        return
    import resource

    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (hard, hard))
