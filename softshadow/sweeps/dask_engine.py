"""The engine for several processes and machines: Dask distributes groups of tasks, and results stream back.

Without an address it starts a cluster of its own: one worker process for each core, with one kernel thread each. With
an address it uses a scheduler that runs already (docs/sweeps.md shows how to start one in a class room or under Slurm).
"""

from __future__ import annotations

import asyncio
import concurrent.futures
import os
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from importlib.util import find_spec
from typing import Any

import softshadow
from softshadow.errors import SoftShadowError
from softshadow.sweeps.task import CANNOT_LOAD, Result, Task, Work, package_digest

GROUP_SECONDS = 1.0  # of work in a task: enough that sending it costs little, and little is lost with a worker
LARGEST_GROUP = 64
AHEAD = 2  # tasks that wait for each worker, so that none is idle
LOST = ("lost", "cancelled")  # how the client marks tasks that a scheduler does not know any more
CANCELLED = (asyncio.CancelledError, concurrent.futures.CancelledError)
MOST_LOSSES = 1000
LOST_AFTER = 15.0  # seconds without a connection to the scheduler after which the sweep ends
ONE_AT_A_TIME = threading.Lock()  # of a worker that was started with several threads
NEEDS = "distributing a sweep needs the package distributed: pip install 'softshadow[sweep]'"


@dataclass
class DaskEngine:
    """Computes tasks on the workers of a Dask client; `dashboard` is the address of its page, or None."""

    work: Work
    client: Any
    dashboard: str | None
    _scenes: dict[str, Any] = field(default_factory=dict)
    _losses: int = 0
    _alone: bool = False  # suspects are sent one after the other, when nothing else is left
    _seconds: float = GROUP_SECONDS  # of one task, so that the first groups have one

    def __call__(self, tasks: Sequence[Any]) -> Iterator[tuple[Any, Result]]:
        """Yield each task with its result, in the order in which they are finished.

        Raises
        ------
        SoftShadowError              the scheduler is lost; what has been yielded is complete
        """
        waiting: list[Any] = list(reversed(tasks))
        suspects: list[Any] = []  # were on workers that ended; what else was there may have ended them
        running: dict[Any, tuple[list[Any], float]] = {}
        connected = time.monotonic()
        while waiting or running or suspects:
            if not waiting and not running:
                waiting.append(suspects.pop())
                self._alone = True
            while waiting and len(running) < AHEAD * self.workers():
                yield from self._submit(waiting, running)
            done, connected = self._finished(running, connected)
            for future in done:
                group, sent = running.pop(future)
                if future.status == "finished":
                    self._learn(time.monotonic() - sent, len(group))
                    yield from zip(group, future.result(), strict=True)
                elif future.status in LOST:
                    self._send_again(group, waiting)
                elif is_killed(future) and not self._alone:
                    suspects += reversed(group)
                elif len(group) > 1:  # find out which task it was
                    waiting += reversed(group)
                    self._seconds = GROUP_SECONDS
                else:
                    yield group[0], self.work.failed(group[0], reason_of(future))

    def workers(self) -> int:
        """Return how many workers there are now, at least 1 so that tasks are sent and wait for the next one."""
        try:
            return max(len(self.client.nthreads()), 1)
        except (OSError, RuntimeError, TimeoutError):
            return 1

    def _submit(self, waiting: list[Any], running: dict[Any, Any]) -> Iterator[tuple[Any, Result]]:
        """Send a group of tasks that have one scene; a scene that cannot be loaded makes a row with its error."""
        size = max(1, min(LARGEST_GROUP, int(GROUP_SECONDS / max(self._seconds, 1e-6))))
        group = [waiting.pop()]
        while waiting and len(group) < size and waiting[-1].scene == group[0].scene:
            group.append(waiting.pop())
        try:
            scene = self._scene(group[0])
        except CANNOT_LOAD as error:
            for task in group:
                yield task, self.work.failed(task, error)
            return
        future = self.client.submit(computed_group, self.work.compute, group, scene, pure=False)
        running[future] = (group, time.monotonic())

    def _scene(self, task: Task) -> Any:
        """Return the scene of a task, sent to the workers once; None for one that they have."""
        if task.scene not in self._scenes:
            scene = self.work.load(task)
            self._scenes[task.scene] = None if scene is None else self.client.scatter(scene, broadcast=True, hash=False)
        return self._scenes[task.scene]

    def _finished(self, running: dict[Any, Any], connected: float) -> tuple[list[Any], float]:
        """Return the tasks that have ended, and when the scheduler was last reached."""
        from distributed import wait

        done: list[Any] = []
        with suppress(TimeoutError, *CANCELLED, OSError, RuntimeError), self.client.as_current():
            done = list(wait(list(running), timeout=1, return_when="FIRST_COMPLETED").done)
        if self.client.status == "running":
            return done or [each for each in running if each.status in LOST], time.monotonic()
        if time.monotonic() - connected > LOST_AFTER or self.client.status == "closed":
            raise SoftShadowError("the scheduler is lost; all that was reported is safe, --resume goes on")
        time.sleep(0.2)
        return [], connected

    def _send_again(self, group: list[Any], waiting: list[Any]) -> None:
        """Put tasks back whose group the cluster has lost, with the scenes that it may have lost, too."""
        self._losses += 1
        if self._losses > MOST_LOSSES:
            raise SoftShadowError("the cluster loses tasks again and again; all that was reported is safe")
        self._scenes.clear()
        waiting += reversed(group)

    def _learn(self, seconds: float, tasks: int) -> None:
        self._seconds = 0.5 * self._seconds + 0.5 * seconds / tasks


def computed_group(compute: Callable[[Any, Any], Result], tasks: list[Any], scene: Any) -> list[Result]:
    """Return the results of tasks that have one scene. A process computes one at a time."""
    with ONE_AT_A_TIME:
        return [compute(task, scene) for task in tasks]


def error_of(future: Any) -> BaseException:
    """Return why a task has no result."""
    try:
        return future.exception(timeout=1)
    except Exception as caught:  # the reason itself may be lost
        return caught


def is_killed(future: Any) -> bool:
    """Return whether workers ended with a task, or with another one that waited there with it."""
    return type(error_of(future)).__name__ == "KilledWorker"


def reason_of(future: Any) -> str:
    """Return why a task has no result, as a text."""
    if is_killed(future):
        return "the workers that computed this ended, each time; it may need more memory than they have"
    error = error_of(future)
    return f"{type(error).__name__}: {error}"


def is_installed() -> bool:
    """Return whether the package distributed is there."""
    return find_spec("distributed") is not None


def has_bokeh() -> bool:
    """Return whether the package bokeh is there, without which a scheduler's page has no contents."""
    return find_spec("bokeh") is not None


@contextmanager
def dask_engine(work: Work, scheduler: str | None = None, workers: int | None = None) -> Iterator[DaskEngine]:
    """Connect to a scheduler, or start a cluster on this machine, and close what was started at the end.

    Parameters
    ----------
    work : Work                  how the tasks are computed
    scheduler : str              address, such as "tcp://192.168.1.5:8786"; None starts a cluster
    workers : int                number of worker processes of the cluster; by default one for each core

    Raises
    ------
    SoftShadowError              no scheduler answers, distributed is missing, or a worker has another version
    """
    if not is_installed():
        raise SoftShadowError(NEEDS)
    from distributed import Client, LocalCluster

    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # workers inherit it
    cluster = None
    try:
        if scheduler is None:
            cluster = LocalCluster(
                n_workers=workers or os.cpu_count() or 1, threads_per_worker=1, processes=True,
                dashboard_address="127.0.0.1:0", silence_logs=50,
            )  # fmt: skip
        client = Client(cluster or scheduler, timeout=20, set_as_default=False)
    except (OSError, TimeoutError, ValueError) as error:
        if cluster is not None:
            cluster.close()
        where = f"--scheduler {scheduler}" if scheduler else "the local cluster"
        raise SoftShadowError(
            f"{where}: no scheduler answers ({error}); expected one such as tcp://host:8786"
        ) from None
    try:
        refuse_other_versions(client)
        yield DaskEngine(work, client, client.dashboard_link if client.run_on_scheduler(has_bokeh) else None)
    finally:
        client.close(timeout=5)
        if cluster is not None:
            cluster.close(timeout=5)


def refuse_other_versions(client: Any) -> None:
    """Raise an error if a worker has another version of this package, or other sources: its bits might differ."""
    versions = set(client.run(own_version).values())
    if versions - {own_version()}:
        raise SoftShadowError(f"workers have {', '.join(sorted(versions))}; expected {own_version()}, as here")


def own_version() -> str:
    """Return the version of this package on a worker, and a digest of its sources."""
    return f"softshadow {softshadow.__version__} (sources {package_digest()})"
