"""The journal: what it has is not measured again, whatever ended the sweep."""

import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import pytest

import softshadow
from softshadow import SoftShadowError
from softshadow.sweeps import Point, Progress, Result, execute
from softshadow.sweeps.dask_engine import refuse_other_versions
from softshadow.sweeps.journal import Journal
from softshadow.sweeps.task import package_digest

POINTS = [Point("map", "boxes", {"map_size": size}) for size in range(16, 26)]


class Counting:
    """An engine that counts how often it measured each point, and stops after some."""

    def __init__(self, most: int = 1000) -> None:
        self.most = most
        self.measured: list[Point] = []

    def __call__(self, points: Sequence[Point]) -> Iterator[tuple[Point, Result]]:
        for point in reversed(points):  # any order will do
            if len(self.measured) == self.most:
                raise KeyboardInterrupt
            self.measured.append(point)
            bad = point.options["map_size"] == 20
            yield point, Result({"size": point.options["map_size"], "status": "error" if bad else "ok"}, b"picture")


def test_rows_stand_in_the_order_of_the_points(tmp_path: Path) -> None:
    rows = execute(POINTS, tmp_path / "a.journal", Counting())
    assert [row["size"] for row in rows] == list(range(16, 26))


def test_sweep_goes_on_where_it_was_interrupted_and_measures_no_point_twice(tmp_path: Path) -> None:
    first, second, third = Counting(4), Counting(), Counting()
    with pytest.raises(KeyboardInterrupt):
        execute(POINTS, tmp_path / "a.journal", first)
    rows = execute(POINTS, tmp_path / "a.journal", second, resume=True)
    assert sorted(p.key for p in first.measured + second.measured) == sorted(p.key for p in POINTS)
    assert execute(POINTS, tmp_path / "a.journal", third, resume=True) == rows
    assert third.measured == []


def test_line_that_a_crash_has_cut_off_is_measured_again(tmp_path: Path) -> None:
    path = tmp_path / "a.journal"
    rows = execute(POINTS, path, Counting())
    whole = path.read_bytes()
    for cut in (1, 10, len(whole.splitlines()[-1])):
        path.write_bytes(whole[:-cut])
        engine = Counting()
        assert execute(POINTS, path, engine, resume=True) == rows
        assert len(engine.measured) == 1
        assert path.read_bytes() == whole


def test_progress_counts_done_and_failed_points(tmp_path: Path) -> None:
    seen: list[Progress] = []
    execute(POINTS, tmp_path / "a.journal", Counting(), report=seen.append)
    assert seen[0] == Progress(0, 0, 10)
    assert seen[-1] == Progress(10, 1, 10)
    assert [each.done for each in seen] == list(range(11))


def test_journal_of_an_earlier_sweep_is_not_overwritten(tmp_path: Path) -> None:
    execute(POINTS[:1], tmp_path / "a.journal", Counting())
    with pytest.raises(SoftShadowError, match=r"a.journal: an earlier journal is here; expected --resume"):
        execute(POINTS, tmp_path / "a.journal", Counting())


def test_two_sweeps_do_not_write_one_journal(tmp_path: Path) -> None:
    pytest.importorskip("fcntl")
    with Journal(tmp_path / "a.journal") as journal:
        journal.open(resume=False)
        with pytest.raises(SoftShadowError, match="another process writes this journal now"):
            execute(POINTS, tmp_path / "a.journal", Counting(), resume=True)


def test_another_file_is_not_taken_for_a_journal(tmp_path: Path) -> None:
    (tmp_path / "a.journal").write_text('{"format": "another"}\n')
    with pytest.raises(SoftShadowError, match="expected the journal of a sweep"):
        execute(POINTS, tmp_path / "a.journal", Counting(), resume=True)
    assert (tmp_path / "a.journal").read_text() == '{"format": "another"}\n'


FULL = """
import resource, sys
from pathlib import Path
from sweeps.test_sweep_journals import POINTS, Counting
import softshadow
from softshadow import SoftShadowError
from softshadow.sweeps import execute
resource.setrlimit(resource.RLIMIT_FSIZE, (700, 700))  # bytes in a file: as a full disk
try:
    execute(POINTS, Path(sys.argv[1]), Counting())
except SoftShadowError as error:
    print(error)
"""


def test_full_disk_ends_the_sweep_with_all_earlier_points_safe(tmp_path: Path) -> None:
    pytest.importorskip("resource")
    path = tmp_path / "a.journal"
    command = [sys.executable, "-c", FULL, str(path)]
    ended = subprocess.run(command, capture_output=True, text=True, cwd=Path(__file__).parents[1], check=True)
    assert "could not be written" in ended.stdout
    assert "all earlier ones are safe, and --resume goes on" in ended.stdout
    assert path.read_bytes().endswith(b"}\n")
    safe = len(path.read_bytes().splitlines()) - 1
    assert 0 < safe < len(POINTS)
    engine = Counting()
    execute(POINTS, path, engine, resume=True)
    assert len(engine.measured) == len(POINTS) - safe


def test_key_tells_points_apart_and_notices_an_edited_model(tmp_path: Path) -> None:
    model = tmp_path / "a.obj"
    model.write_text("v 0 0 0\n")
    point = Point("map", str(model))
    before = point.key
    assert Point("map", str(model)).key == before
    model.write_text("v 0 0 1\n\n")
    assert point.key != before
    assert len({each.key for each in POINTS}) == len(POINTS)


def test_rows_of_other_sources_of_the_package_are_not_taken(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    before = POINTS[0].key
    monkeypatch.setattr("softshadow.sweeps.point.package_digest", lambda: "after an edit")
    assert POINTS[0].key != before


def test_digest_of_the_package_changes_with_any_of_its_sources(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "techniques").mkdir()
    for name in ("__init__.py", "techniques/map.py"):
        (tmp_path / name).write_text("a = 1\n")
    monkeypatch.setattr(softshadow, "__file__", str(tmp_path / "__init__.py"))
    digest = package_digest.__wrapped__
    seen = [digest()]
    (tmp_path / "techniques/map.py").write_text("a = 2\n")
    seen.append(digest())
    (tmp_path / "techniques/map.py").rename(tmp_path / "techniques/other.py")
    seen.append(digest())
    assert len(set(seen)) == 3
    assert digest() == seen[-1]


def test_worker_with_other_sources_is_refused() -> None:
    class Client:
        def run(self, function: Callable[[], str]) -> dict[str, str]:
            return {"tcp://a:1": function(), "tcp://b:1": "softshadow 0.1.0 (sources 0123)"}

    with pytest.raises(SoftShadowError, match=r"workers have .*softshadow 0.1.0 \(sources 0123\).*; expected softsh"):
        refuse_other_versions(Client())
