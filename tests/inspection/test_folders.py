"""Folders appear whole or not at all, whenever the process that writes them is killed."""

import os
import random
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from softshadow.errors import SoftShadowError
from softshadow.inspection.files import HOST, make_parents, write_folder, write_whole

NAMES = ("a.txt", "b/c.txt", "d.txt")
WRITER = """
import itertools, sys
from pathlib import Path
from softshadow.inspection.files import write_folder, write_whole

def write(folder):
    (folder / "b").mkdir()
    for name in ("a.txt", "b/c.txt", "d.txt"):
        (folder / name).write_text(str(number))

print("ready", flush=True)
for number in itertools.count():
    write_folder(Path(sys.argv[1]), write, lambda entry: entry.name != "mine.txt")
    write_whole(Path(sys.argv[1]).parent / "whole.txt", lambda path: path.write_text(f"made by softshadow {number}\\n"))
"""


def write_version(version: str):
    def write(folder: Path) -> None:
        (folder / "b").mkdir()
        for name in NAMES:
            (folder / name).write_text(version)

    return write


def contents(folder: Path) -> set[str]:
    return {(folder / name).read_text() for name in NAMES}


def kill_a_writer(target: Path, after: float) -> None:
    process = subprocess.Popen([sys.executable, "-c", WRITER, str(target)], stdout=subprocess.PIPE)
    assert process.stdout is not None
    assert process.stdout.readline()
    time.sleep(after)
    process.send_signal(signal.SIGKILL)
    process.wait()
    process.stdout.close()


def check_after_kills(target: Path, n: int) -> None:
    rng = random.Random(7)
    write_folder(target, write_version("first"), lambda entry: True)
    (target / "mine.txt").write_text("kept")
    for _ in range(n):
        kill_a_writer(target, rng.uniform(0.001, 0.05))
        assert len(contents(target)) == 1
        assert (target / "mine.txt").read_text() == "kept"
    write_folder(target, write_version("last"), lambda entry: entry.name != "mine.txt")
    assert contents(target) == {"last"}
    assert {path.name for path in target.parent.iterdir()} <= {target.name, "whole.txt"}  # nothing temporary is left
    assert {path.name for path in target.iterdir()} == {"a.txt", "b", "d.txt", "mine.txt"}


@pytest.mark.slow
def test_a_killed_writer_leaves_a_whole_folder_and_the_next_one_tidies_up(tmp_path):
    check_after_kills(tmp_path / "folder", 2)


@pytest.mark.slow
def test_many_killed_writers_leave_whole_folders(tmp_path):
    check_after_kills(tmp_path / "folder", 100)


def test_a_failed_write_leaves_the_earlier_folder(tmp_path):
    write_folder(tmp_path / "folder", write_version("1"), lambda entry: True)

    def fail(folder: Path) -> None:
        (folder / "a.txt").write_text("2")
        raise OSError(28, "No space left on device")

    with pytest.raises(SoftShadowError, match=r"folder: cannot be written \(No space left on device\)"):
        write_folder(tmp_path / "folder", fail, lambda entry: True)
    assert contents(tmp_path / "folder") == {"1"}
    assert [path.name for path in tmp_path.iterdir()] == ["folder"]


def test_the_current_folder_is_written_in_its_place(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.txt").write_text("kept")
    for version in ("1", "2"):
        write_folder(Path(), write_version(version), lambda entry: entry.name != "mine.txt")
    assert contents(tmp_path) == {"2"}
    assert Path("mine.txt").read_text() == "kept"
    assert len(list(tmp_path.iterdir())) == 4


def test_what_is_kept_keeps_its_kind(tmp_path):
    folder = tmp_path / "folder"
    (folder / "deep" / "er").mkdir(parents=True)
    (folder / "deep" / "er" / "x").write_text("x")
    (folder / "link").symlink_to("nowhere")
    (folder / "b").mkdir()
    (folder / "b" / "y").write_text("y")
    write_folder(folder, write_version("1"), lambda entry: False)
    assert (folder / "deep" / "er" / "x").read_text() == "x"
    assert (folder / "b" / "y").read_text() == "y"
    assert os.readlink(folder / "link") == "nowhere"
    assert contents(folder) == {"1"}


def test_temporary_files_of_living_processes_stay(tmp_path):
    living = tmp_path / f".softshadow-{HOST}-{os.getpid()}-x"
    elsewhere = tmp_path / ".softshadow-another-4194303-x"
    abandoned = tmp_path / f".softshadow-{HOST}-4194303-x"  # no process has such a number
    for folder in (living, elsewhere, abandoned):
        folder.mkdir()
    write_whole(tmp_path / "a.txt", lambda path: path.write_text("a"))
    assert (living.exists(), elsewhere.exists(), abandoned.exists()) == (True, True, False)


@pytest.mark.parametrize("kind", ["fifo", "device", "name too long", "zero byte", "below a file"])
def test_odd_places_are_named(kind, tmp_path):
    (tmp_path / "file").write_text("x")
    path = {
        "fifo": tmp_path / "fifo.png",
        "device": Path("/dev/null"),
        "name too long": tmp_path / ("x" * 300 + ".png"),
        "zero byte": tmp_path / "a\0b.png",
        "below a file": tmp_path / "file" / "a.png",
    }[kind]
    if kind == "fifo":
        os.mkfifo(path)
    for force in (False, True):
        with pytest.raises(SoftShadowError, match=r"not a regular file|cannot be written|does not exist"):
            write_whole(path, lambda temporary: temporary.write_text("x"), force)
    if kind in ("name too long", "below a file"):
        with pytest.raises(SoftShadowError, match=r"cannot be made|cannot be written|is a file"):
            make_parents(path / "folder")


def test_a_full_disk_is_named_and_leaves_nothing(tmp_path):
    def fill(path: Path) -> None:
        path.write_bytes(bytes(1 << 20))

    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    ignored = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (1 << 16, before[1]))
    try:
        with pytest.raises(SoftShadowError, match=r"a.png: cannot be written \(File too large\)"):
            write_whole(tmp_path / "a.png", fill)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
        signal.signal(signal.SIGXFSZ, ignored)
    assert list(tmp_path.iterdir()) == []
