"""What a tour does to the folder it is written into: all of it or nothing, and nothing of somebody else's is lost."""

from pathlib import Path

import pytest

import softshadow as ss
from softshadow.errors import SoftShadowError
from softshadow.tour.stops import STOPS
from softshadow.tour.writing import write_tour


@pytest.fixture(autouse=True)
def one_stop(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let tours be short."""
    monkeypatch.setattr("softshadow.tour.writing.STOPS", STOPS[:1])


def write(folder: Path, force: bool = False) -> Path:
    return write_tour(ss.Scene.named("boxes"), (8, 6), folder, force=force)


def names(folder: Path) -> set[str]:
    return {str(path.relative_to(folder)) for path in folder.rglob("*")}


def test_second_tour_replaces_the_first(tmp_path: Path) -> None:
    write(tmp_path / "tour")
    first = names(tmp_path)
    (tmp_path / "tour" / STOPS[0].name).rename(tmp_path / "tour" / "stop-of-an-older-version")
    write(tmp_path / "tour")
    assert names(tmp_path) == first


def test_empty_folder_is_filled_and_stays_the_same_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    for _ in range(2):
        assert write(Path(".")) == Path("index.html")
        assert Path.cwd().samefile(tmp_path)
        assert {path.name for path in tmp_path.iterdir()} == {"index.html", STOPS[0].name}


@pytest.mark.parametrize("foreign", ["notes.txt", f"{STOPS[0].name}/notes.txt", "link"])
def test_tour_with_something_foreign_in_it_is_not_replaced(foreign: str, tmp_path: Path) -> None:
    write(tmp_path / "tour")
    if foreign == "link":
        (tmp_path / "elsewhere").mkdir()
        (tmp_path / "tour" / "link").symlink_to(tmp_path / "elsewhere")
    else:
        (tmp_path / "tour" / foreign).write_text("my homework")
    before = names(tmp_path)
    with pytest.raises(SoftShadowError, match="holds files that are not of a tour; force=True"):
        write(tmp_path / "tour")
    assert names(tmp_path) == before
    write(tmp_path / "tour", force=True)
    assert names(tmp_path) == before


def test_folder_of_saved_runs_is_no_tour(tmp_path: Path) -> None:
    ss.run("planar", "boxes", (8, 6)).save(f"{tmp_path}/runs/")
    with pytest.raises(SoftShadowError, match="holds files that are not of a tour"):
        write(tmp_path / "runs")


def test_places_that_are_none_are_named(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(SoftShadowError, match="is a file, expected the name of a folder"):
        write(tmp_path / "file")
    with pytest.raises(SoftShadowError, match=r"the folder .*no does not exist"):
        write(tmp_path / "no" / "tour")
