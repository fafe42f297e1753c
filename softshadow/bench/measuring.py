"""Measure workloads: first compare the buffers of all peers, then time frames in rounds, one frame per peer and round.

Peers are interleaved, so background load hits all equally.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import ExitStack
from typing import Any

import numpy as np

from softshadow.bench.frame_statistics import frame_statistics
from softshadow.bench.peers import OWN, Peer
from softshadow.bench.results import PeerTimes, Ratio, Summary, WorkloadResult, ratio_of
from softshadow.bench.workload import Workload
from softshadow.testing.sessions import Session
from softshadow.testing.timing import Timing

ROUNDS = 7


def measure(
    workload: Workload, peers: list[Peer], rounds: int = ROUNDS, say: Callable[[str], Any] = lambda text: None
) -> WorkloadResult:
    """Return the times of a workload on each peer, and the pixels at which their buffers differ.

    Parameters
    ----------
    peers : list of Peer         softshadow must be among them
    rounds : int                 number of timed frames of each peer, after two frames that are not timed
    say : callable               called with a line of text at each stage

    Raises
    ------
    MesaError                    Mesa is missing, or the program fails there
    """
    with ExitStack() as open_sessions:
        say(f"{workload.name}: preparing {', '.join(map(str, peers))}")
        sessions: dict[Peer, Session] = {}
        for peer in peers:
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
            Summary.of([each.wall for each in timings]), Summary.of([each.cpu for each in timings]),
        )
        for peer, timings in frames.items()
    )  # fmt: skip
    say(f"{workload.name}: counting fragments")
    statistics = frame_statistics(workload)
    return WorkloadResult(
        workload.name, workload.size, dict(workload.amounts), workload.aim,
        statistics.draws, statistics.triangles, statistics.all_fragments, differing, times, tuple(ratios(frames)),
    )  # fmt: skip


def ratios(frames: dict[Peer, list[Timing]]) -> list[Ratio]:
    """Return the times of every other renderer relative to softshadow with the same number of threads."""
    return [
        ratio_of(peer.renderer, peer.threads, frames[Peer(OWN, peer.threads)], timings)
        for peer, timings in frames.items()
        if peer.renderer != OWN and Peer(OWN, peer.threads) in frames
    ]


def differing_pixels(sessions: dict[Peer, Session]) -> dict[str, dict[str, int]]:
    """Return for each renderer and buffer how many pixels differ from the first softshadow peer."""
    expected = next(session for peer, session in sessions.items() if peer.renderer == OWN).buffers()
    differing: dict[str, dict[str, int]] = {}
    for peer, session in sessions.items():
        pixels = {name: count_differing(expected[name], buffer) for name, buffer in session.buffers().items()}
        before = differing.get(peer.renderer, dict.fromkeys(pixels, 0))
        differing[peer.renderer] = {name: max(number, before[name]) for name, number in pixels.items()}
    return differing


def count_differing(ours: np.ndarray, theirs: np.ndarray) -> int:
    """Return the number of pixels at which two buffers (h, w[, c]) differ."""
    differs = ours != theirs
    return int(np.count_nonzero(differs.any(axis=-1) if differs.ndim == 3 else differs))
