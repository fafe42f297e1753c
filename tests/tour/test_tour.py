"""The folder of a tour: a page, pictures of every step, and buffers that answer as a fresh run does."""

from pathlib import Path

import imageio.v3 as imageio
import numpy as np
import pytest
from PIL import Image

import softshadow as ss
from report.pages import Page, read_page
from softshadow import techniques
from softshadow.report.commands import options_spelled
from softshadow.tour.stops import STOPS, Stop
from softshadow.tour.writing import write_tour

SIZE = (64, 48)
BY_NAME = {stop.name: stop for stop in STOPS}


@pytest.fixture(scope="module")
def scene() -> ss.Scene:
    return ss.Scene.named("torus")


@pytest.fixture(scope="module")
def folder(scene: ss.Scene, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_tour(scene, SIZE, tmp_path_factory.mktemp("tours") / "tour").parent


@pytest.fixture(scope="module")
def page(folder: Path) -> Page:
    return read_page(folder / "index.html")


@pytest.fixture(scope="module", params=BY_NAME)
def stop(request: pytest.FixtureRequest) -> Stop:
    return BY_NAME[request.param]


@pytest.fixture(scope="module")
def fresh(stop: Stop, scene: ss.Scene) -> ss.Run:
    return ss.run(stop.technique, scene, SIZE, **stop.options)


def test_tour_stops_at_every_technique_once_by_name() -> None:
    assert {stop.technique for stop in STOPS} == set(techniques.names())
    assert len(BY_NAME) == len(STOPS)
    for option in techniques.get("planar").options["method"].choices:
        assert any(stop.options.get("method") == option for stop in STOPS)


@pytest.mark.thin(2)
def test_page_tells_of_every_stop_and_step(stop: Stop, fresh: ss.Run, page: Page) -> None:
    assert stop.name in page.ids
    assert stop.title in page.text
    assert stop.look_at in page.text
    assert techniques.get(stop.technique).paper in page.text
    for step in fresh.steps:
        assert step.title in page.text


def test_every_picture_and_link_of_the_page_exists(folder: Path, page: Page) -> None:
    targets = {url for _, _, url in page.urls}
    assert all(url[1:] in page.ids for url in targets if url.startswith("#"))
    files = {url for url in targets if not url.startswith("#")}
    assert all((folder / url).is_file() for url in files)
    written = {str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file()}
    assert written == files | {"index.html"}
    assert all(image["alt"] for image in page.images)


def test_buffers_of_a_stop_are_those_of_a_fresh_run(stop: Stop, fresh: ss.Run, folder: Path) -> None:
    stored = ss.load_run(folder / stop.name / "run.npz")
    assert (stored.technique, dict(stored.options)) == (fresh.technique, dict(fresh.options))
    assert stored.steps.titles == fresh.steps.titles
    for one, other in zip(stored.steps, fresh.steps, strict=True):
        for name in ("image", "depth", "stencil"):
            np.testing.assert_array_equal(getattr(one, name), getattr(other, name))
    np.testing.assert_array_equal(stored.visibility, fresh.visibility)


def test_pictures_of_a_stop_are_the_buffers(stop: Stop, fresh: ss.Run, folder: Path) -> None:
    np.testing.assert_array_equal(imageio.imread(folder / stop.name / "picture.png"), fresh.image)
    for step in fresh.steps:
        with Image.open(folder / stop.name / f"{step.index:02d}-stencil.png") as picture:
            assert picture.mode == "P"
            np.testing.assert_array_equal(np.asarray(picture), step.stencil)


def test_command_of_a_stop_asks_for_its_options(stop: Stop, fresh: ss.Run, page: Page) -> None:
    options = options_spelled(fresh.technique, fresh.options)
    assert f"softshadow render {stop.technique} --scene torus --size 64x48{options} ·" in page.text
