"""``softshadow sweep``: tables, exit codes, events."""

import json
from pathlib import Path

import pytest

import softshadow as ss
from cli.invocation import error_of, invoke, invoke_ok, usage_error_of

SWEEP = 'technique = "blob"\nsize = ["16x12", "24x18"]\nmeasure = ["counts"]\npicture = true\n'


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("sweep.toml").write_text(SWEEP)


def test_table_plot_and_sheet_are_written_and_the_sheet_opens_reports() -> None:
    pytest.importorskip("matplotlib")
    words = ("--workers", 1, "--plot", "x=width_px,y=fragments", "--sheet")
    shown = invoke_ok("sweep", "sweep.toml", *words)
    assert shown.stdout == "2 points, 2 measured, 0 failed\n"
    assert "2 of 2 points done, 0 failed, 0 left" in shown.stderr
    table = ss.load_sweep("sweep.csv")
    page = Path("sweep.html").read_text()
    for row in table.rows:
        assert f'href="sweep.reports/{row["key"]}.html"' in page
        assert Path(f"sweep.reports/{row['key']}.html").exists()
        assert f'src="sweep.pictures/{row["key"]}.png"' in page
    assert Path("sweep.png").exists()


def test_failed_point_is_exit_code_1_and_is_named() -> None:
    Path("sweep.toml").write_text('technique = "blob"\nscene = ["boxes", "none.obj"]\nsize = "16x12"\nmeasure = []\n')
    ended = invoke("sweep", "sweep.toml", "--workers", 1)
    assert ended.exit_code == 1
    assert ended.stdout == "2 points, 1 measured, 1 failed\n"
    assert (
        "error: softshadow render blob --mesh none.obj --size 16x12: MeshError: none.obj: there is no such"
        in ended.stderr
    )


def test_events_are_json_one_in_a_line() -> None:
    shown = invoke_ok("sweep", "sweep.toml", "--workers", 1, "--json")
    events = [json.loads(line) for line in shown.stdout.splitlines()]
    assert {each["schema"] for each in events} == {"softshadow/sweep/1"}
    assert [each["event"] for each in events] == ["start", "progress", "progress", "progress", "end"]
    assert [each["done"] for each in events[1:4]] == [0, 1, 2]
    assert events[-1]["written"] == ["sweep.csv"]


def test_earlier_sweep_is_not_overwritten_but_resumed() -> None:
    invoke_ok("sweep", "sweep.toml", "--workers", 1)
    before = Path("sweep.csv").read_bytes()
    assert "expected --resume" in error_of("sweep", "sweep.toml", "--workers", 1)
    invoke_ok("sweep", "sweep.toml", "--workers", 1, "--resume")
    assert Path("sweep.csv").read_bytes() == before


def test_foreign_table_is_not_overwritten() -> None:
    Path("sweep.csv").write_text("mine")
    assert "was not written by softshadow" in error_of("sweep", "sweep.toml", "--workers", 1)
    assert not Path("sweep.journal").exists()


def test_wrong_words_are_named() -> None:
    assert "expected x=COLUMN,y=COLUMN" in usage_error_of("sweep", "sweep.toml", "--plot", "x=a")
    assert "expected only one of them" in usage_error_of(
        "sweep", "sweep.toml", "--scheduler", "tcp://a:1", "--workers", 2
    )
    assert "expected a table, one of .csv" in error_of("sweep", "sweep.toml", "-o", "t.xls", "--workers", 1)
    assert "there is no such file" in error_of("sweep", "none.toml")


def test_scheduler_that_does_not_answer_is_named() -> None:
    pytest.importorskip("distributed")
    said = error_of("sweep", "sweep.toml", "--scheduler", "nonsense://127.0.0.1:1")
    assert "--scheduler nonsense://127.0.0.1:1: no scheduler answers" in said
