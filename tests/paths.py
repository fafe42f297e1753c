"""Where the real models of the tests are: outside the repository, so a test that needs one may be skipped."""

import os
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
SCENES = ROOT / "docs" / "scenes"
TRACE = ROOT / "tests" / "recordings" / "data" / "arrays_and_lists.trace"  # of the C program beside it
PROGRAMS = ROOT / "tests" / "recordings" / "programs"  # small programs, and traces of those in C
SHARED_DATA = Path(os.environ.get("SOFTSHADOW_SHARED_DATA", ROOT.parent / "shared" / "data"))


def shared_files(folder: str) -> list[Path]:
    """Return the files of a shared folder, none where it is missing."""
    return sorted((SHARED_DATA / folder).glob("*"))


def shared_file(name: str) -> Path:
    """Return a shared file such as "meshes/Duck.glb"; skip the test where it is missing."""
    file = SHARED_DATA / name
    if not file.is_file():
        pytest.skip(f"{file} is missing (set SOFTSHADOW_SHARED_DATA)")
    return file
