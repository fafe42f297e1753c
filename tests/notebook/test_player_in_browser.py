"""The player's browser side in Chromium, with the Python side as its model."""

import numpy as np
import pytest

import softshadow as ss
from widget_page import browser_page, widget_page

SIZE = (64, 48)
ROWS = "document.querySelectorAll('tbody tr').length"


@pytest.fixture(scope="module")
def player():
    return ss.notebook.play("map", "torus", SIZE, map_size=64)


@pytest.fixture
def page(player):
    player.pixel, player.view = None, "colour"
    player.values = {control["key"]: control["value"] for control in player.controls}
    with widget_page(player, viewport={"width": 900, "height": 700}) as page:
        yield page
        assert page.errors == []


def test_a_slider_moves_the_light_and_the_picture_follows(page, player):
    before = page.locator("img").get_attribute("src")
    page.locator("input[name='light.x']").evaluate(
        "(slider) => { slider.value = -1.234; slider.dispatchEvent(new Event('input')); }"
    )
    page.wait_for_function(f"document.querySelector('img').src !== {before!r}")
    assert player.run.scene.lights[0].position[0] == pytest.approx(-1.23)
    assert page.locator("label:has([name='light.x']) output").inner_text() == "-1.23"
    assert " ms" in page.locator(".status").inner_text()


def test_a_click_gives_the_pixel_and_shows_its_history(page, player):
    box = page.locator("img").bounding_box()
    page.locator("img").click(position={"x": (30 + 0.5) * box["width"] / 64, "y": (35 + 0.5) * box["height"] / 48})
    page.wait_for_function(f"{ROWS} > 0")
    assert player.pixel == [30, 35]
    assert page.locator(".explanation").inner_text() == player.run.explain(30, 35)
    assert page.locator("tbody tr").count() == len(player.run.pixel(30, 35))
    assert page.locator(".mark").is_visible()


def test_arrow_keys_move_the_pixel_and_stop_at_the_edge(page, player):
    player.pixel = [1, 20]
    page.push()
    page.locator(".frame").focus()
    page.keyboard.press("ArrowUp")
    page.wait_for_function(f"{ROWS} > 0")
    assert player.pixel == [1, 19]
    page.keyboard.press("Shift+ArrowLeft")
    page.wait_for_timeout(100)
    assert player.pixel == [0, 19]


def test_maps_can_be_viewed_and_have_no_pixels_of_the_window(page, player):
    page.locator("select[name=view]").select_option("ZS")
    page.wait_for_function("document.querySelector('img').naturalHeight === 64")
    assert player.view == "ZS"
    page.locator("img").click()
    assert player.pixel is None
    assert "no pixels of the window" in page.locator(".status").inner_text()


def test_errors_are_shown_and_reset_brings_the_picture_back(page, player):
    player.values = player.values | {"map_size": 0}
    page.push()
    assert "option map_size=0" in page.locator(".message.error").inner_text()
    page.get_by_role("button", name="Reset").click()
    page.wait_for_function("!document.querySelector('.message')")
    assert player.run.options["map_size"] == 64


def test_values_set_in_python_move_the_sliders(page, player):
    player.values = player.values | {"bias": 0.015}
    page.push()
    assert page.locator("label:has([name=bias]) output").inner_text() == "0.015"


def test_quick_moves_leave_out_pictures_and_end_at_the_last_value(page, player):
    drawn = player.drawn
    page.evaluate("""() => { const slider = document.querySelector("input[name='light.z']");
        for (let i = 0; i <= 50; i++) { slider.value = i / 50; slider.dispatchEvent(new Event("input")); } }""")
    page.wait_for_timeout(700)
    assert player.run.scene.lights[0].position[2] == 1
    assert player.drawn - drawn == 2


def test_names_with_html_are_shown_as_text():
    scene = ss.Scene.named("torus")
    things = [ss.SceneObject(thing.mesh, thing.object_to_world, name=f"<b>{thing.name}") for thing in scene.objects]
    scene = ss.Scene("<img src=x onerror=alert(1)>", scene.camera, scene.lights, things)
    player = ss.notebook.play("volume-zfail", scene, SIZE)
    player.pixel = [30, 35]
    with widget_page(player) as page:
        assert "<img src=x" in page.locator("h4").inner_text()
        assert "<b>floor" in page.locator("tbody").inner_text()
        assert "<b>floor" in page.locator(".explanation").inner_text()
        assert page.locator("tbody b").count() == 0
        assert page.errors == []


@pytest.mark.slow
@pytest.mark.parametrize("dark", [False, True])
def test_text_can_be_read_on_light_and_dark_pages(player, dark):
    with widget_page(player, dark) as page:
        colors = page.evaluate("""() => ["label", "button", "select", "h4"].map(
            (name) => getComputedStyle(document.querySelector(".softshadow-player " + name)).color)""")
        expected = "rgb(238, 238, 238)" if dark else "rgb(17, 17, 17)"
        assert set(colors) == {expected}


def test_nothing_serious_for_screen_readers_and_a_narrow_page_does_not_scroll_sideways(player):
    axe = pytest.importorskip("axe_playwright_python.sync_playwright")
    player.pixel = [30, 35]
    with widget_page(player, viewport={"width": 380, "height": 800}) as page:
        found = axe.Axe().run(page).response["violations"]
        assert [each["id"] for each in found if each["impact"] in ("serious", "critical")] == []
        assert page.evaluate("document.documentElement.scrollWidth") <= 380


@pytest.mark.parametrize("name", ["map", "volume-zfail"])
def test_the_report_of_a_displayed_run_works_in_a_page_without_network(name):
    run = ss.run(name, "torus", SIZE)
    with browser_page(viewport={"width": 1000, "height": 900}) as page:
        page.set_content(run._repr_mimebundle_()[0]["text/html"])
        inside = page.frame_locator("iframe")
        inside.locator("body").wait_for()
        assert name in inside.locator("body").inner_text()
        assert page.errors == []
    assert np.asarray(run.image).any()
