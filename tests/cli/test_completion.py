"""Completion in the shell: names of techniques, scenes, listings and failures, and options of techniques."""

import pytest
from click.shell_completion import BashComplete, FishComplete, ZshComplete

import softshadow as ss
from softshadow import listings
from softshadow.cli import main


def completed(*words: str) -> list[str]:
    """Return what completes the last word."""
    shell = BashComplete(main, {}, "softshadow", "_SOFTSHADOW_COMPLETE")
    return [item.value for item in shell.get_completions(list(words[:-1]), words[-1])]


@pytest.mark.parametrize(
    ("words", "names"),
    [
        (["render", ""], ss.technique_names()),
        (["compare", "map", "volume-zp"], ["volume-zpass", "volume-zpass-plus"]),
        (["pixel", "map-p"], ["map-pcf", "map-pcss"]),
        (["techniques", "blo"], ["blob"]),
        (["failures", "ac"], ["acne"]),
        (["failures", ""], list(ss.failures)),
        (["listings", ""], listings.names()),
        (["render", "map", "--scene", "soft-"], ["soft-slab", "soft-overlap", "soft-torus"]),
        (["render", "map", "-O", "st"], ["storage=framebuffer", "storage=copy"]),
        (["render", "map", "-O", "map_s"], ["map_size="]),
        (["compare", "map", "map-pcf", "-O", "kern"], ["kernel="]),
        (["rend"], ["render"]),
        (["render", "map", "--op"], ["--option", "--open"]),
    ],
)
def test_names_are_completed(words: list[str], names: list[str]) -> None:
    assert completed(*words) == list(names)


@pytest.mark.parametrize(
    "words", [["render", "map", "--mesh", "x"], ["render", "map", "-o", "x"], ["tour", "--scene", "x.t"]]
)
def test_files_are_left_to_the_shell(words: list[str]) -> None:
    shell = BashComplete(main, {}, "softshadow", "_SOFTSHADOW_COMPLETE")
    assert [item.type for item in shell.get_completions(words[:-1], words[-1])] == ["file"]


@pytest.mark.parametrize("shell", [ZshComplete, FishComplete])
def test_script_of_the_shell_calls_the_program(shell: type) -> None:
    assert "_SOFTSHADOW_COMPLETE" in shell(main, {}, "softshadow", "_SOFTSHADOW_COMPLETE").source()
