"""README.md keeps what it promises: its commands, its example, its table and its links."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

import softshadow
from softshadow import techniques

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def block(info: str) -> str:
    """Return the text of the first fenced block with this info string."""
    match = re.search(rf"^```{re.escape(info)}\n(.*?)^```$", README, re.DOTALL | re.MULTILINE)
    assert match, f"README.md has no block ```{info}"
    return match[1]


def test_quickstart_is_two_commands() -> None:
    tour, tests = block("sh quickstart").splitlines()
    assert tour == "python3 -m pip install --target .tools uv && .tools/bin/uv run softshadow tour"
    assert tests == ".tools/bin/uv run pytest"


def test_first_sentence_says_what_is_not_needed() -> None:
    first = next(line for line in README.splitlines()[1:] if line)
    for word in ("No GPU", "no display", "no driver"):
        assert word in first


def test_python_example_runs_as_printed(tmp_path: Path) -> None:
    done = subprocess.run([sys.executable, "-c", block("python")], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "zfail.npz").exists()
    assert len(block("python").splitlines()) <= 12


def test_pixel_says_what_is_printed() -> None:
    run = softshadow.run("volume-zfail", "torus", size=(320, 240))
    assert " ".join(block("text").split()) == run.explain(160, 180)


def test_table_lists_the_techniques_of_the_register() -> None:
    listed = re.findall(r"^\| `([a-z-]+)` \|", README, re.MULTILINE)
    assert sorted(listed) == sorted(techniques.names())


@pytest.mark.parametrize("page", ["README.md", "CONTRIBUTING.md", "CHANGELOG.md"])
def test_every_linked_file_exists(page: str) -> None:
    text = (ROOT / page).read_text(encoding="utf-8")
    targets = [target for target in re.findall(r"\]\(([^)#\s]+)", text) if "://" not in target]
    assert all((ROOT / target).exists() for target in targets), targets
