"""Who draws: softshadow or a driver of Mesa, each with a number of threads."""

from __future__ import annotations

from dataclasses import dataclass

from softshadow.bench.workload import Workload
from softshadow.errors import nearest
from softshadow.testing.sessions import MesaSession, OwnSession, Session

OWN = "softshadow"
DRIVERS = {"mesa": "llvmpipe", "llvmpipe": "llvmpipe", "softpipe": "softpipe"}


@dataclass(frozen=True)
class Peer:
    """A renderer, "softshadow", "llvmpipe" or "softpipe", with a number of threads."""

    renderer: str
    threads: int = 1

    def __str__(self) -> str:
        return f"{self.renderer}@{self.threads}"

    def open(self, workload: Workload) -> Session:
        """Return the workload prepared on this renderer; close it in the end.

        Raises
        ------
        MesaError                Mesa is missing, or the program fails there
        """
        if self.renderer == OWN:
            return OwnSession(workload.program, workload.size, self.threads)
        return MesaSession(workload.program, workload.size, self.renderer, self.threads)


def peers(against: list[str], thread_counts: list[int]) -> list[Peer]:
    """Return who takes part: softshadow and each renderer named, with each number of threads.

    softpipe knows one thread only.

    Raises
    ------
    ValueError                   unknown renderer; the message has the nearest
    """
    found = [Peer(OWN, threads) for threads in thread_counts]
    for name in against:
        if name not in DRIVERS:
            raise ValueError(f"--against {name}: {nearest(name, DRIVERS)}, or a file of `softshadow bench --json`")
        driver = DRIVERS[name]
        found += [Peer(driver, threads) for threads in ([1] if driver == "softpipe" else thread_counts)]
    return list(dict.fromkeys(found))
