"""The limits of a student's program: time and memory."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Limits:
    """What a program may use until it is ended.

    Attributes
    ----------
    seconds : float              from the first line of the student's file to the last buffer that is read
    megabytes : int              address space, beyond what the process has before the student's file is read
    """

    seconds: float = 60.0
    megabytes: int = 2048

    def __post_init__(self) -> None:
        if not 0 < self.seconds < float("inf"):
            raise ValueError(f"seconds={self.seconds}: expected more than 0, and finite")
        if self.megabytes < 1:
            raise ValueError(f"megabytes={self.megabytes}: expected 1 or more")
