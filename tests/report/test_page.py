"""The report of one run: one file that needs nothing else, with the exact values in it."""

import base64
import json
import re
import zlib
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import softshadow as ss
from report.pages import Page, read_page
from softshadow.inspection.pictures import stencil_palette
from softshadow.report.packing import LIMIT, Packing, packed_array
from softshadow.report.page import SHOWN_COUNTS, depth_caption, legend
from softshadow.report.script import script_of

SIZE = (32, 24)
TECHNIQUES = ["planar", "volume-zfail", "map"]
KINDS = [np.uint8, np.uint16, np.int32, np.float32, np.float64]


@pytest.fixture(scope="module", params=TECHNIQUES)
def run(request: pytest.FixtureRequest) -> ss.Run:
    return ss.run(request.param, "torus", SIZE)


@pytest.fixture(scope="module")
def file(run: ss.Run, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return run.save(tmp_path_factory.mktemp("report") / "run.html")


@pytest.fixture(scope="module")
def page(file: Path) -> Page:
    return read_page(file)


@pytest.fixture(scope="module")
def data(page: Page) -> Any:
    return json.loads(page.scripts[0])


def unpacked(packed: dict[str, Any]) -> np.ndarray:
    """Return a packed array, undone step by step as templates/arrays.js does it."""
    kind, shape = np.dtype(packed["kind"]), packed["shape"]
    raw = np.frombuffer(zlib.decompress(base64.b64decode(packed["data"])), np.uint8)
    values = np.ascontiguousarray(raw.reshape(kind.itemsize, -1).T).reshape(-1).view(f"u{kind.itemsize}")
    planar = [shape[2], *shape[:2]] if len(shape) == 3 else shape
    grid = values.reshape(-1, planar[-1] if len(planar) > 1 else 1).copy()
    if packed["rows"]:
        if kind.itemsize == 4:
            grid = (grid >> np.uint32(1)) ^ (-(grid & np.uint32(1)).astype(np.int64)).astype(np.uint32)
        grid = np.cumsum(grid, axis=0, dtype=grid.dtype)
    array = grid.view(kind).reshape(planar)
    return np.moveaxis(array, 0, 2) if len(shape) == 3 else array


def test_page_loads_nothing_from_anywhere(file: Path, page: Page) -> None:
    assert page.urls == []
    text = file.read_text(encoding="utf-8")
    assert not re.search(r"https?://|@import|url\(|fetch\(|\bimport\(|^import ", text, re.MULTILINE)


def test_every_step_has_its_title_state_and_pictures(run: ss.Run, data: Any) -> None:
    (described,) = data["runs"]
    for step, each in zip(run.steps, described["steps"], strict=True):
        assert each["title"] == step.title
        assert [call for call, change in each["state"] if change != "gone"] == step.state.calls()
        names = [picture["title"] for picture in each["pictures"]]
        assert names == ["colour", "depth", "stencil", *step.maps]


def test_packed_buffers_are_the_exact_ones(run: ss.Run, data: Any) -> None:
    for step, each in zip(run.steps, data["runs"][0]["steps"], strict=True):
        buffers = (step.image, step.depth, step.stencil, *step.maps.values())
        for picture, buffer in zip(each["pictures"], buffers, strict=True):
            np.testing.assert_array_equal(unpacked(data["arrays"][picture["array"]]), buffer)


def test_fragments_per_pixel_are_those_of_the_histories(run: ss.Run, data: Any) -> None:
    rng = np.random.default_rng(0)
    for x, y in zip(rng.integers(0, 32, 8).tolist(), rng.integers(0, 24, 8).tolist(), strict=True):
        rows = [row for row in run.pixel(x, y) if row.draw is not None]
        for step, each in enumerate(data["runs"][0]["steps"]):
            of_step = [row.verdict for row in rows if row.step == step]
            counts = {name: unpacked(data["arrays"][number])[y, x] for name, number in each["counts"].items()}
            assert counts == {
                "drawn": of_step.count("passed"),
                "depth failed": of_step.count("depth failed"),
                "stencil failed": of_step.count("stencil failed"),
            }
            last = data["fates"][unpacked(data["arrays"][each["last"]])[y, x]]
            expected = of_step[-1] if of_step else "no fragment"
            assert last == expected or (expected == "passed" and last in ("drawn", "passed, no colour"))


def test_changed_calls_are_marked(data: Any) -> None:
    steps = data["runs"][0]["steps"]
    for before, now in pairwise(steps):
        earlier = {call for call, change in before["state"] if change != "gone"}
        for call, change in now["state"]:
            assert change == ("gone" if [call, "gone"] in now["state"] else "same" if call in earlier else "new")


def test_ledger_and_command_are_on_the_page(run: ss.Run, page: Page) -> None:
    for row in run.ledger.to_dicts():
        assert str(row["fragments"]) in page.text
    assert f"softshadow pixel {run.technique} X Y --scene torus --size 32x24" in page.text


def test_names_and_titles_are_text_and_no_markup(tmp_path: Path) -> None:
    evil = "</script><script>alert('1')</script>"
    scene = ss.Scene.named("open-tube")
    objects = [replace(each, name=f"<b onclick=alert(1)>{number}") for number, each in enumerate(scene.objects)]
    scene = replace(scene, title=evil, name=evil, objects=objects)
    with pytest.warns(ss.OpenMesh):
        run = ss.run("planar", scene, (8, 6))
    page = read_page(run.save(tmp_path / "run.html"))
    assert len(page.scripts) == 2
    assert evil in page.text
    assert "OpenMesh: " in page.text
    events = json.loads(page.scripts[0])["runs"][0]["history"]["events"]
    assert events[-1]["object"].startswith("<b onclick")
    assert ".innerHTML" not in page.scripts[1]


def test_a_page_too_large_says_so_and_offers_less(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    run = ss.run("volume-zfail", "torus", SIZE)
    monkeypatch.setattr("softshadow.report.run_page.LIMIT", 7000)
    page = read_page(run.save(tmp_path / "run.html"))
    data = json.loads(page.scripts[0])
    assert "This page does not have the histories of the pixels: the page would exceed 0.007 MB." in page.text
    assert data["runs"][0]["history"] is None
    assert data["runs"][0]["steps"][-1]["colour"] is not None
    assert sum(len(array["data"]) for array in data["arrays"]) <= 7000 < LIMIT


def test_too_many_fragments_are_left_out(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("softshadow.report.fragment_record.MOST_FRAGMENTS", 10)
    page = read_page(ss.run("planar", "torus", SIZE).save(tmp_path / "run.html"))
    assert "This page does not have the histories of the pixels: draw 0 has more than 10 fragments." in page.text


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("shape", [(5,), (7, 4), (3, 6, 3)])
def test_arrays_survive_packing(kind: Any, shape: tuple[int, ...]) -> None:
    rng = np.random.default_rng(len(shape))
    for array in (
        np.frombuffer(rng.bytes(int(np.prod(shape)) * np.dtype(kind).itemsize), kind).reshape(shape),
        np.arange(np.prod(shape)).reshape(shape).astype(kind),
        np.zeros(shape, kind),
    ):
        assert unpacked(packed_array(array)).tobytes() == array.tobytes()


def test_equal_arrays_are_stored_once_and_a_part_has_all_or_none() -> None:
    packing, one = Packing(limit=400), np.arange(12, dtype=np.float32).reshape(3, 4)
    assert packing.add("a", [one, one + 1, one.copy()]) == [0, 1, 0]
    used = packing.used
    assert packing.add("b", [one, np.frombuffer(np.random.default_rng(0).bytes(4000), np.uint8)]) is None
    assert (packing.used, len(packing.arrays)) == (used, 2)
    assert packing.notices == ["This page does not have the b: the page would exceed 0.0004 MB."]


def test_script_has_each_module_once_before_those_that_import_it() -> None:
    script = script_of("report.js")
    modules = re.findall(r"^// -- (\w+\.js)$", script, re.MULTILINE)
    assert modules[-1] == "report.js"
    assert len(modules) == len(set(modules))
    names = re.findall(r"^(?:async )?(?:function|class|const|let) (\w+)", script, re.MULTILINE)
    assert len(names) == len(set(names))
    folder = Path(str(ss.__file__)).parent / "report" / "templates"
    assert {path.name for path in folder.glob("*.js")} == {*modules, "slides.js", "tour.js", "view3d.js"}


def test_legend_counts_every_pixel_and_sums_up_what_is_rare() -> None:
    stencil = np.repeat(np.arange(20, dtype=np.uint8), 3).reshape(6, 10)
    rows = legend(stencil)
    assert rows[1] == ("1", "#{:02x}{:02x}{:02x}".format(*stencil_palette()[1]), 3)
    assert rows[-1] == ("more", "transparent", 3 * (20 - SHOWN_COUNTS))
    assert sum(pixels for _, _, pixels in rows) == stencil.size


def test_caption_of_depths_tells_their_range() -> None:
    assert depth_caption(np.array([[0.25, 0.5, 1]], np.float32)) == "depth (window z), 0.2500 to 0.5000"
    assert depth_caption(np.ones((2, 2), np.float32)) == "depth (window z), all clear"
