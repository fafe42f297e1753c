"""Small versions of the workloads, which take little time."""

from softshadow.bench.workload import Workload
from softshadow.bench.workloads import get

SIZE = (40, 30)
SMALL = {"triangles": 400, "quads": 24, "map_size": 64, "samples": 3}


def small(name: str) -> Workload:
    """Return a workload with a small window and small amounts."""
    workload = get(name).resized(SIZE)
    return workload.with_amounts(**{key: SMALL[key] for key in workload.amounts if key in SMALL})
