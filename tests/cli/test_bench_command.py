"""``softshadow bench``: lists, measurements, comparisons and errors."""

import json
from dataclasses import replace
from pathlib import Path

import pytest

from cli.invocation import invoke, invoke_ok, json_of
from softshadow.bench.results import from_json, to_json

TINY = ["--size", "24x18", "--rounds", "1"]


def test_without_names_the_workloads_are_listed() -> None:
    assert "w1-zpass-d24" in invoke_ok("bench").stdout
    listed = json_of("bench")["workloads"]
    assert [each["size"] for each in listed if each["name"] == "w5"] == [[640, 480]]
    assert any(each["name"] == "volume-zfail/torus" for each in listed)


def test_table_has_a_row_for_each_number_of_threads() -> None:
    answer = invoke_ok("bench", "planar/boxes", "--threads", "1,2", *TINY)
    rows = [line for line in answer.stdout.splitlines() if line.startswith("planar/boxes")]
    assert [row.split()[2:4] for row in rows] == [["softshadow", "1"], ["softshadow", "2"]]
    assert "measuring the machine's limits" in answer.stderr


@pytest.mark.slow
def test_calls_are_measured_beside_pyopengl() -> None:
    from softshadow.testing import mesa_available

    answer = json.loads(invoke_ok("bench", "calls", "--rounds", "1", "--json").stdout)
    calls = {each["name"]: each for each in answer["calls"]}
    assert len(calls) >= 15
    assert {"glTranslatef", "glEnable + glDisable", "glClear"} <= set(calls)
    assert all(each["softshadow"] > 0 for each in calls.values())
    assert all((each["ratio"] is not None) == mesa_available() for each in calls.values())


def test_growth_is_told_with_its_exponent() -> None:
    answer = json_of("bench", "planar/boxes", "--scaling", "lights", *TINY)
    (grown,) = answer["growth"]
    assert (grown["workload"], grown["axis"], grown["amounts"]) == ("planar/boxes", "lights", [1, 2, 4, 8])
    assert list(grown["exponents"]) == ["softshadow@1"]
    assert len(answer["workloads"]) == 4


@pytest.mark.slow  # compiles all kernels once more
def test_start_of_a_process_is_measured_cold_and_warm() -> None:
    (result,) = json_of("bench", "planar/boxes", "--starts", *TINY)["starts"].values()
    assert result["cold process"] > result["warm process"] > result["warm imports"] > 0


@pytest.mark.mesa
def test_ratio_to_mesa_stands_beside_equal_buffers() -> None:
    (result,) = json_of("bench", "w5", "--against", "mesa", *TINY)["workloads"]
    assert result["differing"]["llvmpipe"] == {"color": 0, "depth": 0, "stencil": 0}
    assert [(each["renderer"], each["threads"]) for each in result["ratios"]] == [("llvmpipe", 1)]


@pytest.mark.slow
def test_slower_than_an_earlier_report_is_exit_code_1(tmp_path: Path) -> None:
    measured = from_json(json_of("bench", "planar/boxes", *TINY))
    # the earlier machine was this much faster: a thousandth of the speed at the same time means slower now
    for factor, code, verdict in ((1e-3, 1, "slower"), (1e3, 0, "faster")):
        (limits,) = measured.limits
        earlier = replace(measured, limits=(replace(limits, stencil=factor * limits.stencil),))
        (tmp_path / "earlier.json").write_text(json.dumps(to_json(earlier)))
        answer = invoke("bench", "planar/boxes", "--against", str(tmp_path / "earlier.json"), *TINY)
        assert answer.exit_code == code
        assert verdict in answer.stdout


@pytest.mark.parametrize(
    ("words", "code", "said"),
    [
        (["w2-spheer"], 2, "did you mean 'w2-sphere'"),
        (["w5", "--against", "masa"], 2, "--against masa: did you mean 'mesa'"),
        (["w5", "--against", "nowhere.json"], 3, "nowhere.json"),
        (["w5", "--scaling", "lihgts"], 2, "did you mean 'lights'"),
        (["w5", "--threads", "0"], 2, "expected numbers of threads, at least 1, as in 1,2"),
        (["w5", "--threads", "1,two"], 2, "expected numbers of threads, at least 1, as in 1,2"),
        (["w5", "--rounds", "0"], 2, "--rounds"),
    ],
)
def test_what_cannot_be_measured_is_said_in_one_line(words: list[str], code: int, said: str) -> None:
    answer = invoke("bench", *words)
    assert answer.exit_code == code
    assert said in answer.stderr


def test_file_that_is_no_report_is_named(tmp_path: Path) -> None:
    other = tmp_path / "other.json"
    for text in ("{}", "not JSON"):
        other.write_text(text)
        answer = invoke("bench", "w5", "--against", str(other))
        assert answer.exit_code == 3
        assert "other.json: " in answer.stderr
