"""``softshadow techniques``, ``scenes``, ``doctor`` and ``warmup``."""

import tomllib

import pytest

from cli.invocation import invoke_ok, json_of
from paths import ROOT
from softshadow import techniques
from softshadow.cli import machine
from softshadow.course import explain_codes
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
