"""Measure workloads: buffers are compared first, then every peer draws a frame in turn, round after round."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import ExitStack
from typing import Any

import numpy as np

from softshadow.bench.counting import count_frame
from softshadow.bench.peers import OWN, Peer
from softshadow.bench.results import PeerTimes, Ratio, Summary, WorkloadResult, ratio_of
from softshadow.bench.workload import Workload
from softshadow.testing.sessions import Session
from softshadow.testing.timing import Timing

ROUNDS = 7


def measure(
    workload: Workload, takes_part: list[Peer], rounds: int = ROUNDS, say: Callable[[str], Any] = lambda text: None
) -> WorkloadResult:
    """Return what a workload takes on each peer.

    All peers stay ready and draw one frame each per round, so that what else the machine does meets all of them.

    Parameters
    ----------
    takes_part : peers, with softshadow among them
    rounds : int                 frames of each peer that are timed, after two that are not counted
    say : callable               gets a line of text per stage

    Raises
    ------
    MesaError                    Mesa is missing, or the program fails there
    """
    with ExitStack() as open_sessions:
        say(f"{workload.name}: preparing {', '.join(map(str, takes_part))}")
        sessions: dict[Peer, Session] = {}
        for peer in takes_part:
            sessions[peer] = peer.open(workload)
            open_sessions.callback(sessions[peer].close)
        first = {peer: session.time()[0] for peer, session in sessions.items()}
        differing = differing_pixels(sessions)
        for session in sessions.values():
            session.warm_up()
        frames: dict[Peer, list[Timing]] = {peer: [] for peer in sessions}
        say(f"{workload.name}: drawing {rounds} frames each")
        for _ in range(rounds):
            for peer, session in sessions.items():
                frames[peer] += session.time()
    times = tuple(
        PeerTimes(
            peer.renderer, peer.threads, sessions[peer].prepared.wall, first[peer].wall,
            Summary.of([each.wall for each in taken]), Summary.of([each.cpu for each in taken]),
        )
        for peer, taken in frames.items()
    )  # fmt: skip
    say(f"{workload.name}: counting fragments")
    counts = count_frame(workload)
    return WorkloadResult(
        workload.name, workload.size, dict(workload.amounts), workload.aim,
        counts.draws, counts.triangles, counts.all_fragments, differing, times, tuple(ratios(frames)),
    )  # fmt: skip


def ratios(frames: dict[Peer, list[Timing]]) -> list[Ratio]:
    """Return how every other renderer compares with softshadow with equally many threads."""
    return [
        ratio_of(peer.renderer, peer.threads, frames[Peer(OWN, peer.threads)], taken)
        for peer, taken in frames.items()
        if peer.renderer != OWN and Peer(OWN, peer.threads) in frames
    ]


def differing_pixels(sessions: dict[Peer, Session]) -> dict[str, dict[str, int]]:
    """Return how many pixels of each peer's buffers differ from those of the first softshadow."""
    expected = next(session for peer, session in sessions.items() if peer.renderer == OWN).buffers()
    found: dict[str, dict[str, int]] = {}
    for peer, session in sessions.items():
        counts = {name: count_differing(expected[name], buffer) for name, buffer in session.buffers().items()}
        before = found.get(peer.renderer, dict.fromkeys(counts, 0))
        found[peer.renderer] = {name: max(count, before[name]) for name, count in counts.items()}
    return found


def count_differing(ours: np.ndarray, theirs: np.ndarray) -> int:
    """Return the number of pixels of (h, w[, c]) that differ."""
    differs = ours != theirs
    return int(np.count_nonzero(differs.any(axis=-1) if differs.ndim == 3 else differs))
