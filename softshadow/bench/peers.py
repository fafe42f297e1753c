"""Renderers to measure: softshadow or a driver of Mesa, each with a number of threads."""

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
        """Return a session with the workload prepared on this renderer; the caller closes it.

        Raises
        ------
        MesaError                Mesa is missing, or the program fails there
        """
        if self.renderer == OWN:
            return OwnSession(workload.program, workload.size, self.threads)
        return MesaSession(workload.program, workload.size, self.renderer, self.threads)


def peers_for(against: list[str], threads: list[int]) -> list[Peer]:
    """Return the peers of a benchmark: softshadow and each renderer in `against`, with each number of threads.

    softpipe always has one thread.

    Raises
    ------
    ValueError                   unknown renderer; the message suggests the nearest
    """
    peers = [Peer(OWN, number) for number in threads]
    for name in against:
        if name not in DRIVERS:
            raise ValueError(f"--against {name}: {nearest(name, DRIVERS)}, or a file of `softshadow bench --json`")
        driver = DRIVERS[name]
        peers += [Peer(driver, number) for number in ([1] if driver == "softpipe" else threads)]
    return list(dict.fromkeys(peers))
