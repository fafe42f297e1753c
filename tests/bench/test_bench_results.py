"""Reports: medians and spreads, ratios of interleaved frames, JSON, shares of the limit."""

import json
from dataclasses import replace

import pytest

from bench.sample_reports import report, result
from softshadow.bench.results import Summary, from_json, ratio_of, to_json
from softshadow.bench.tables import limit_rows, result_rows, start_rows
from softshadow.testing.timing import Timing


def test_report_comes_back_from_json_as_it_was() -> None:
    original = report(result(), result("w5"))
    assert from_json(json.loads(json.dumps(to_json(original)))) == original


@pytest.mark.parametrize("contents", [{}, [], {"schema": "softshadow/steps/1"}, None])
def test_what_is_no_report_is_refused(contents: object) -> None:
    with pytest.raises(ValueError, match="expected a file of `softshadow bench --json`"):
        from_json(contents)  # type: ignore[arg-type]


def test_report_that_is_not_whole_is_refused() -> None:
    contents = to_json(report(result()))
    del contents["workloads"][0]["peers"][0]["wall"]
    with pytest.raises(ValueError, match=r"incomplete report .*: 'wall'"):
        from_json(contents)


def test_one_slow_frame_moves_neither_median_nor_spread_much() -> None:
    quiet, disturbed = Summary.of([1.0, 1.01, 0.99, 1.0, 1.0]), Summary.of([1.0, 1.01, 0.99, 1.0, 50.0])
    assert disturbed.median == quiet.median
    assert disturbed.spread < 0.02


def test_ratio_of_neighbouring_frames_does_not_see_what_slows_both() -> None:
    ours = [Timing(1.0, 1.0), Timing(10.0, 1.0), Timing(1.0, 1.0)]
    theirs = [Timing(3.0, 3.0), Timing(30.0, 3.0), Timing(3.0, 3.0)]
    assert ratio_of("llvmpipe", 1, ours, theirs).wall == Summary(3.0, 0.0)


def test_share_is_fragments_a_second_over_those_of_the_plainest_loop() -> None:
    original = report(result(seconds=0.05), speed=1e6)
    assert original.share(original.workloads[0], 1) == pytest.approx(10_000 / 0.05 / 1e6)
    assert original.share(original.workloads[0], 7) is None


def test_softpipe_may_differ_but_llvmpipe_may_not() -> None:
    one = result()
    assert one.equal
    assert replace(one, differing={**one.differing, "softpipe": {"depth": 9}}).equal
    assert not replace(one, differing={**one.differing, "llvmpipe": {"depth": 1}}).equal
    assert not replace(one, differing={**one.differing, "softshadow": {"depth": 1}}).equal


def test_tables_have_a_cell_for_every_column() -> None:
    original = report(result(), result("w5"))
    for columns, rows in (limit_rows(original), result_rows(original), start_rows(original)):
        assert rows
        assert all(len(row) == len(columns) for row in rows)
    assert "2.00" in result_rows(original)[1][2]
