"""Comparison of reports: slower, faster or the same, with invented numbers."""

from bench.sample_reports import report, result
from softshadow.bench.regression import TimeChange, time_changes
from softshadow.bench.results import Report


def verdicts(now: Report, then: Report) -> list[str]:
    return [change.verdict for change in time_changes(now, then)]


def test_half_the_speed_is_slower_and_twice_the_speed_is_faster() -> None:
    then = report(result(seconds=0.05))
    assert verdicts(report(result(seconds=0.10)), then) == ["slower", "slower"]
    assert verdicts(report(result(seconds=0.05)), then) == ["same", "same"]
    assert verdicts(report(result(seconds=0.02)), then) == ["faster", "faster"]


def test_a_slower_machine_is_no_slower_workload() -> None:
    then = report(result(seconds=0.05), speed=2e9)
    assert verdicts(report(result(seconds=0.10), speed=1e9), then) == ["same", "same"]
    assert verdicts(report(result(seconds=0.05), speed=4e9), then) == ["slower", "slower"]


def test_a_change_within_the_noise_counts_as_the_same() -> None:
    then = report(result(seconds=0.05, spread=0.1))
    assert verdicts(report(result(seconds=0.07, spread=0.1)), then) == ["same", "same"]
    assert verdicts(report(result(seconds=0.07)), report(result(seconds=0.05))) == ["slower", "slower"]


def test_only_the_same_size_and_amounts_are_compared() -> None:
    then = report(result("w4"), result("w5"))
    assert time_changes(report(result("w4", size=(4, 3))), then) == []
    assert [each.workload for each in time_changes(report(result("w5")), then)] == ["w5", "w5"]
    assert time_changes(report(result("w3-pcf")), then) == []


def test_change_tells_the_factor_it_was_judged_by() -> None:
    (one, _) = time_changes(report(result(seconds=0.06)), report(result(seconds=0.05)))
    assert (one.workload, one.threads, round(one.factor, 6)) == ("w4", 1, 1.2)
    assert TimeChange("w4", 1, 1.14, 1.15).verdict == "same"
