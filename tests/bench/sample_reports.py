"""Reports with invented numbers."""

from softshadow.bench.results import Limits, PeerTimes, Ratio, Report, Summary, WorkloadResult


def times(renderer: str, threads: int, seconds: float, spread: float = 0.01) -> PeerTimes:
    summary = Summary(seconds, spread)
    return PeerTimes(renderer, threads, 0.1, 2 * seconds, summary, summary)


def result(
    name: str = "w4", seconds: float = 0.05, spread: float = 0.01, size: tuple[int, int] = (8, 6)
) -> WorkloadResult:
    peers = (
        times("softshadow", 1, seconds, spread),
        times("softshadow", 2, seconds / 2, spread),
        times("llvmpipe", 1, 2 * seconds),
    )
    ratio = Ratio("llvmpipe", 1, Summary(2.0, 0.1), Summary(2.1, 0.05))
    equal = {"color": 0, "depth": 0}
    amounts = {"triangles": 12}
    return WorkloadResult(
        name, size, amounts, 2.5, 3, 12, 10_000, {"softshadow": equal, "llvmpipe": equal}, peers, (ratio,)
    )


def report(*results: WorkloadResult, speed: float = 1e9) -> Report:
    limits = (Limits(1, 1e10, speed), Limits(2, 1.5e10, 2 * speed))
    return Report({"processor": "abacus"}, limits, results, {"w4": {"cold process": 9.0}})
