"""Time of the first frame in a new process: with an empty kernel cache, and with a full one.

``python -m softshadow.bench.starts WORKLOAD WxH`` is this process; it prints its times in seconds as JSON.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import time

from softshadow.bench.workload import Workload

PARTS = ("process", "imports", "prepare", "first frame")


def measure_starts(workload: Workload) -> dict[str, float]:
    """Return the seconds until the first frame is drawn.

    Returns
    -------
    dict                         "cold process", "cold imports", "cold prepare", "cold first frame", "warm process" ...:
                                 the whole process and its parts, cold (kernels are compiled) and warm (from the cache)

    Raises
    ------
    subprocess.CalledProcessError      the process failed
    """
    width, height = workload.size
    command = [sys.executable, "-m", __name__, workload.name, f"{width}x{height}"]
    times: dict[str, float] = {}
    with tempfile.TemporaryDirectory() as folder:
        environment = {**os.environ, "NUMBA_CACHE_DIR": folder}
        for name in ("cold", "warm"):
            start = time.perf_counter()
            output = subprocess.run(command, env=environment, check=True, capture_output=True, text=True).stdout
            seconds = {"process": time.perf_counter() - start, **json.loads(output.splitlines()[-1])}
            times.update({f"{name} {part}": seconds[part] for part in PARTS})
    return times


def main(name: str, size: str) -> None:
    """Draw the first frame of a workload, and print the times of its parts."""
    start = time.perf_counter()
    from softshadow import gl
    from softshadow.bench.workloads import get
    from softshadow.testing.timing import timed

    width, height = map(int, size.split("x"))
    imports = time.perf_counter() - start
    gl.create_context(width, height)
    frame, prepare = timed(gl, lambda: get(name).resized((width, height)).program(gl))
    _, first = timed(gl, frame)
    print(json.dumps({"imports": imports, "prepare": prepare.wall, "first frame": first.wall}))


if __name__ == "__main__":
    main(*sys.argv[1:])
