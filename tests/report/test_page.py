"""The report of one run: one file that needs nothing else, with the exact values in it."""

import base64
import json
import re
import zlib
from dataclasses import replace
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import softshadow as ss
from report.pages import Page, read_page
from softshadow.inspection.pictures import UNDEFINED, stencil_palette
from softshadow.report.page import SHOWN_COUNTS, depth_caption, legend

SIZE = (32, 24)
TECHNIQUES = ["planar", "volume-zfail", "map"]


@pytest.fixture(scope="module", params=TECHNIQUES)
def run(request: pytest.FixtureRequest) -> ss.Run:
    return ss.run(request.param, "torus", SIZE)


@pytest.fixture(scope="module")
def file(run: ss.Run, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return run.save(tmp_path_factory.mktemp("report") / "run.html")


@pytest.fixture(scope="module")
def page(file: Path) -> Page:
    return read_page(file)


def decoded(url: str) -> Image.Image:
    """Return the picture of a data URL."""
    assert url.startswith("data:image/png;base64,")
    return Image.open(BytesIO(base64.b64decode(url.split(",", 1)[1])))


def test_page_loads_nothing_from_anywhere(file: Path, page: Page) -> None:
    assert {url.split(":")[0] for _, _, url in page.urls} == {"data"}
    text = file.read_text(encoding="utf-8")
    assert not re.search(r"https?://|@import|url\(|fetch\(|\bimport\(", text)


def test_every_step_has_its_title_state_and_three_pictures(run: ss.Run, page: Page) -> None:
    assert {f"step-{step.index}" for step in run.steps} <= page.ids
    for step in run.steps:
        assert step.title in page.text
    assert "glEnable(GL_DEPTH_TEST)" in page.text
    assert len(page.images) == sum(3 + len(step.maps) for step in run.steps)
    assert all(image["alt"] for image in page.images)
    for image in page.images:
        with decoded(image["src"]) as picture:
            assert picture.size == (int(image["width"]), int(image["height"]))


def test_pictures_are_the_buffers(run: ss.Run, page: Page) -> None:
    images = iter(page.images)
    for step in run.steps:
        with decoded(next(images)["src"]) as picture:
            np.testing.assert_array_equal(np.asarray(picture), step.image)
        next(images)  # depth is stretched over its range: see the pictures' own tests
        with decoded(next(images)["src"]) as picture:
            assert picture.mode == "P"
            np.testing.assert_array_equal(np.asarray(picture), step.stencil)
        for name in step.maps:
            image = next(images)
            assert f"map {name} " in image["alt"]


def test_visibility_is_shown_as_light_and_shadow(run: ss.Run, page: Page) -> None:
    shown = next(image for image in page.images if "map visibility" in image["alt"])
    with decoded(shown["src"]) as picture:
        pixels = np.asarray(picture)
    assert (pixels[run.shadow_mask] == 0).all()
    assert (pixels[run.valid & ~run.shadow_mask] == 255).all()
    assert (pixels[~run.valid] == UNDEFINED).all()
    assert "white lit, black in shadow" in page.text


def test_packed_buffers_are_the_exact_ones(run: ss.Run, page: Page) -> None:
    script = "".join(page.scripts)
    size, packed = re.search(r"const size = (\[.*?\]), packed = (\[.*?\]);\n", script, re.DOTALL).groups()
    assert json.loads(size) == list(SIZE)
    for step, buffers in zip(run.steps, json.loads(packed), strict=True):
        raw = {name: zlib.decompress(base64.b64decode(text)) for name, text in buffers.items()}
        assert raw["colour"] == step.image.tobytes()
        assert raw["stencil"] == step.stencil.tobytes()
        bytes_of_depth = np.frombuffer(raw["depth"], np.uint8).reshape(4, -1).T
        assert bytes_of_depth.tobytes() == step.depth.tobytes()


def test_ledger_and_command_are_on_the_page(run: ss.Run, page: Page) -> None:
    for row in run.ledger.to_dicts():
        assert str(row["fragments"]) in page.text
    assert f"softshadow pixel {run.technique} X Y --scene torus --size 32x24" in page.text


def test_names_and_titles_are_text_and_no_markup(tmp_path: Path) -> None:
    evil = "<script>alert('1')</script>"
    scene = replace(ss.Scene.named("open-tube"), title=evil, name=evil)
    with pytest.warns(ss.OpenMesh):
        run = ss.run("planar", scene, (8, 6))
    page = read_page(run.save(tmp_path / "run.html"))
    assert len(page.scripts) == 1
    assert evil in page.text
    assert "OpenMesh: " in page.text


def test_legend_counts_every_pixel_and_sums_up_what_is_rare() -> None:
    stencil = np.repeat(np.arange(20, dtype=np.uint8), 3).reshape(6, 10)
    rows = legend(stencil)
    assert rows[1] == ("1", "#{:02x}{:02x}{:02x}".format(*stencil_palette()[1]), 3)
    assert rows[-1] == ("more", "transparent", 3 * (20 - SHOWN_COUNTS))
    assert sum(pixels for _, _, pixels in rows) == stencil.size


def test_caption_of_depths_tells_their_range() -> None:
    assert depth_caption(np.array([[0.25, 0.5, 1]], np.float32)) == "depth (window z), 0.2500 to 0.5000"
    assert depth_caption(np.ones((2, 2), np.float32)) == "depth (window z), all clear"
