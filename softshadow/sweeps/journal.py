"""The journal of a sweep or film: each result is on the disk before it is reported, so nothing is computed twice."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import IO, Any

from softshadow.errors import SoftShadowError
from softshadow.sweeps.task import Result, Row

FORMAT = "softshadow sweep journal 1"
PICTURES = (".pictures", ".png")  # ending of the folder, and of the files in it


class Journal:
    """A file of JSON lines, one for each finished task, and a folder of their files beside it.

    Only one process at a time may write it. A line that a crash has cut off is ignored, and removed when the sweep goes
    on.
    """

    def __init__(self, path: Path, files: tuple[str, str] = PICTURES) -> None:
        self.path = path
        folder, self._ending = files
        self.folder = path.with_suffix(folder)
        self._file: IO[bytes] | None = None

    def open(self, resume: bool) -> dict[str, Row]:
        """Open the journal for writing, and return the rows that it has, by the keys of their points.

        Raises
        ------
        SoftShadowError              it exists and `resume` is not set; another process writes it; it is another file
        """
        if self.path.exists() and not resume:
            rows, end = self._read()
            if rows or end < self.path.stat().st_size:  # nothing is lost with one that has no rows
                raise SoftShadowError(
                    f"{self.path}: an earlier journal is here; expected --resume to go on with it, or another output"
                )
        try:
            self.path.parent.mkdir(parents=True, exist_ok=True)
            file = self.path.open(
                "ab", buffering=0
            )  # what cannot be written is not tried again when the file is closed
        except OSError as error:
            raise SoftShadowError(f"{self.path}: the journal cannot be written: {error.strerror}") from None
        self._file = file
        if not lock(file):
            self.close()
            raise SoftShadowError(f"{self.path}: another process writes this journal now; expected it to end first")
        rows, end = self._read()
        if end < self.path.stat().st_size:
            file.truncate(end)
        if end == 0:
            self._append({"format": FORMAT})
        return rows

    def _read(self) -> tuple[dict[str, Row], int]:
        """Return the rows of all whole lines, and where these end."""
        rows: dict[str, Row] = {}
        end = 0
        with self.path.open("rb") as file:
            for number, line in enumerate(file):
                if not line.endswith(b"\n"):
                    break
                try:
                    entry = json.loads(line)
                except ValueError:
                    break
                if number == 0 and entry.get("format") != FORMAT:
                    raise SoftShadowError(f"{self.path}: expected the journal of a sweep")
                if number:
                    rows[entry["key"]] = entry["row"]
                end += len(line)
        return rows, end

    def add(self, key: str, result: Result) -> None:
        """Write a finished point; when this returns, it is on the disk.

        Raises
        ------
        SoftShadowError              the disk is full, or the file is gone; earlier points are safe
        """
        try:
            if result.file is not None:
                self._write_file(key, result.file)
            self._append({"key": key, "row": result.row})
        except OSError as error:
            raise SoftShadowError(
                f"{self.path}: the last result could not be written: {error.strerror}; all earlier ones are safe, and "
                "--resume goes on with them"
            ) from None

    def _append(self, entry: dict[str, Any]) -> None:
        file = self._file
        assert file is not None
        start = file.seek(0, os.SEEK_END)
        try:
            line = json.dumps(entry).encode() + b"\n"
            while line:
                line = line[file.write(line) :]
            os.fsync(file.fileno())
        except OSError:
            file.truncate(start)  # half a line on a full disk
            raise

    def _write_file(self, key: str, contents: bytes) -> None:
        self.folder.mkdir(exist_ok=True)
        target, half = self.file_of(key), self.folder / f".{key}.half"
        try:
            with half.open("wb") as file:
                file.write(contents)
                file.flush()
                os.fsync(file.fileno())
            half.replace(target)
        finally:
            half.unlink(missing_ok=True)

    def file_of(self, key: str) -> Path:
        """Return the place of a task's file."""
        return self.folder / f"{key}{self._ending}"

    def delete(self) -> None:
        """Delete the journal and its files, because what they are for is written."""
        for file in self.folder.glob(f"*{self._ending}"):
            file.unlink()
        with suppress(OSError):  # it is not there, or has files of somebody else
            self.folder.rmdir()
        self.path.unlink(missing_ok=True)

    def close(self) -> None:
        """Close the file, which also ends the lock."""
        if self._file is not None:
            try:
                self._file.close()
            finally:
                self._file = None

    def __enter__(self) -> Journal:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()


def lock(file: IO[bytes]) -> bool:
    """Lock a file for this process; return False if another process has it. Without such locks, return True."""
    try:
        import fcntl
    except ImportError:
        return True
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True


def rows_of(path: Path) -> Iterator[Row]:
    """Yield the rows of a journal, in the order in which their points were finished."""
    journal = Journal(path)
    yield from journal._read()[0].values()
