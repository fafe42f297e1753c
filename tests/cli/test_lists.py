"""``softshadow techniques``, ``scenes``, ``doctor`` and ``warmup``."""

import logging
import tomllib
from dataclasses import replace
from typing import Any

import pytest

from cli.invocation import invoke_ok, json_of
from paths import ROOT
from softshadow import color_values, gl, techniques
from softshadow.bench.corpus.program import DrawNumberedFrame, Program
from softshadow.bench.corpus.programs import PROGRAMS
from softshadow.cli import machine
from softshadow.context import current
from softshadow.course import explain_codes
from softshadow.pipeline.fast.batch.table import BATCH_KERNELS
from softshadow.pipeline.plan import short_cuts
from softshadow.scene import scene_names


def test_techniques_are_listed_with_title_and_paper() -> None:
    lines = invoke_ok("techniques").stdout.splitlines()
    for name in techniques.names():
        line = next(line for line in lines if line.startswith(f"{name} "))
        assert techniques.get(name).title in line
        assert techniques.get(name).paper in line


def test_json_of_techniques_has_the_options() -> None:
    rows = json_of("techniques")["techniques"]
    assert [row["name"] for row in rows] == techniques.names()
    for row in rows:
        assert list(row["options"]) == list(techniques.get(row["name"]).options)
    assert [row["name"] for row in json_of("techniques", "map")["techniques"]] == ["map"]


@pytest.mark.parametrize("name", techniques.names())
def test_one_technique_is_described_with_its_options(name: str) -> None:
    described = techniques.describe(name)
    codes = explain_codes(described)
    assert invoke_ok("techniques", name).stdout == "\n".join([described, *(["", *codes] if codes else []), ""])


def test_scenes_are_listed_with_titles_and_counts() -> None:
    text = invoke_ok("scenes").stdout
    rows = json_of("scenes")["scenes"]
    assert [row["name"] for row in rows] == list(scene_names())
    for row in rows:
        assert row["title"] in text
        assert min(row["lights"], row["casters"], row["triangles"]) >= 1


def test_doctor_tells_versions_threads_and_extras() -> None:
    facts = json_of("doctor")
    assert {"softshadow", "python", "threads", "cache_folder", "mesa"} <= set(facts)
    assert "missing" not in facts["packages"].values()
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert set(facts["extras"]) == set(machine.EXTRAS) == {*project["optional-dependencies"]} - {"test"}
    text = invoke_ok("doctor").stdout
    for name, version in facts["packages"].items():
        assert any(line.split() == [name, version] for line in text.splitlines())


def test_warmup_draws_every_choice_of_every_technique(monkeypatch: pytest.MonkeyPatch) -> None:
    drawn = []
    monkeypatch.setattr("softshadow.runs.run", lambda name, *where, **options: drawn.append((name, options)))
    monkeypatch.setattr("softshadow.bench.corpus.programs.PROGRAMS", {})
    answer = json_of("warmup")
    assert answer["seconds"] >= 0
    assert {name for name, *_ in drawn} == set(techniques.names())
    for name in techniques.names():
        for key, option in techniques.get(name).options.items():
            others = [choice for choice in option.choices or () if choice != option.default]
            for choice in others:
                (options,) = (
                    options for drawn_name, options in drawn if (drawn_name, options.get(key)) == (name, choice)
                )
                assert set(options) <= {key, *machine.FEWER}
    assert "ready in" in invoke_ok("warmup").stdout


def test_warmup_finishes_frames_of_every_program_under_the_usual_short_cuts(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    drawn: list[tuple[str, int]] = []

    def recorded(program: Program) -> Program:
        def prepare(on: Any, size: tuple[int, int]) -> DrawNumberedFrame:
            assert size == machine.PROGRAM_SIZE
            frame = program.prepare(on, size)

            def numbered(number: int) -> None:
                assert short_cuts.get() is True  # else its draws would not wait for each other
                drawn.append((program.name, number))
                frame(number)

            return numbered

        return replace(program, prepare=prepare)

    runs: list[None] = []
    monkeypatch.setattr(BATCH_KERNELS, "note_compiled", lambda: runs.append(None))  # after each run of draws
    before = gl.create_context(8, 8)
    monkeypatch.setattr("softshadow.runs.run", lambda *_, **__: None)
    monkeypatch.setattr("softshadow.bench.corpus.programs.PROGRAMS", {n: recorded(p) for n, p in PROGRAMS.items()})
    monkeypatch.setattr(BATCH_KERNELS, "_known", False)  # as if nothing were on disk
    assert json_of("warmup")["seconds"] > 0
    assert not caplog.records  # which would say that `warmup` helps
    assert logging.getLogger("softshadow").level == logging.NOTSET
    assert drawn == [(name, number) for name in PROGRAMS for number in range(2)]
    assert current() is before
    assert len(runs) >= len(drawn) / 2  # a few programs draw nothing that can wait


def test_warmup_moves_images_that_kernels_convert(monkeypatch: pytest.MonkeyPatch) -> None:
    converted: list[str] = []
    for name in ("write_rgba", "copy_rgb"):
        kernel = getattr(color_values, name)
        monkeypatch.setattr(color_values, name, lambda *args, name=name, to=kernel: (converted.append(name), to(*args)))
    monkeypatch.setattr("softshadow.runs.run", lambda *_, **__: None)
    monkeypatch.setattr("softshadow.bench.corpus.programs.PROGRAMS", {})
    json_of("warmup")
    assert converted == ["write_rgba", "copy_rgb"]
