"""Nothing in the repository belongs to one machine, and what is said in several places is the same."""

import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

import softshadow

ROOT = Path(__file__).parents[2]
# split so that this file does not contain what it looks for
FOREIGN = re.compile(
    "|".join(
        [
            r"(?<![\w.~-])/(?:work|root|home|opt|farm|Users)/" + r"\w",
            "files" + r"\.pythonhosted",
            "pypi" + r"\.(?:org|python)",
            "registry" + r"\.npmjs",
            "deb" + r"\.debian\.org",
        ]
    )
)


def tracked_texts() -> list[Path]:
    """Return the tracked files that are text."""
    listing = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True)
    if listing.returncode != 0:
        pytest.skip("not a git clone: there is no list of tracked files")
    files = [ROOT / name for name in listing.stdout.split("\0") if name]
    return [file for file in files if file.is_file() and b"\0" not in file.read_bytes()[:4096]]


def test_no_file_names_a_machine_or_a_registry() -> None:
    found = [
        f"{file.relative_to(ROOT)}:{number}: {line.strip()[:100]}"
        for file in tracked_texts()
        for number, line in enumerate(file.read_text(encoding="utf-8", errors="replace").splitlines(), 1)
        if FOREIGN.search(line)
    ]
    assert found == []


def test_tested_versions_are_the_ones_uv_reads() -> None:
    done = subprocess.run([sys.executable, ROOT / ".ci" / "constraints"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_extra_and_group_test_install_the_same() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    assert project["dependency-groups"]["test"] == ["softshadow[test]"]
    assert {"test", "mesa"} <= set(project["project"]["optional-dependencies"])


def test_version_stands_in_changelog_and_citation() -> None:
    assert softshadow.__version__ in (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    assert f"version: {softshadow.__version__}" in (ROOT / "CITATION.cff").read_text(encoding="utf-8")


def test_pages_that_the_sources_point_at_exist() -> None:
    missing = [
        f"{file.relative_to(ROOT)}: {name}"
        for top in ("softshadow", "tests", "docs")
        for file in sorted((ROOT / top).rglob("*.py"))
        for name in re.findall(r"[\w/]+\.md\b", file.read_text(encoding="utf-8"))
        if not (ROOT / name).exists() and not (ROOT / "docs" / name).exists()
    ]
    assert missing == []
