"""The 3-D view in a browser: what it counts is what the stencil buffer has, and nothing is loaded."""

import html
import re
import shutil
import warnings

import numpy as np
import pytest

import softshadow as ss
from softshadow.report import view3d_document
from softshadow.report.view3d import counting_of
from softshadow.scene import Light, Scene

SIZE = (96, 72)
SIMPLE = 300_000  # bytes: what a view may add to a report
SOFTWARE_WEBGL = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]


@pytest.fixture(scope="module")
def browser():
    chromium = shutil.which("chromium")
    if chromium is None:
        pytest.skip("needs chromium: apt-get install chromium")
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        running = playwright.chromium.launch(executable_path=chromium, args=SOFTWARE_WEBGL)
        yield running
        running.close()


def opened(browser, path, **options):
    """Return a page that shows a view, and what it has complained of or asked for."""
    page = browser.new_page(viewport={"width": 900, "height": 600}, **options)
    complaints = []
    page.on("console", lambda message: complaints.append(message.text) if message.type == "error" else None)
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.on("request", lambda request: complaints.append(request.url) if request.url != path.as_uri() else None)
    page.goto(path.as_uri())
    page.wait_for_function("window.view3d !== undefined")
    return page, complaints


def drawn(technique, scene, **options):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ss.Warning)
        return ss.run(technique, scene, SIZE, **options)


@pytest.mark.slow
def test_the_page_shows_the_crossings_of_the_history(browser, tmp_path):
    run = drawn("volume-zfail", "torus")
    y, x = (int(each) for each in np.argwhere(run.stencil == run.stencil.max())[3])
    view = run.view3d(x, y)
    assert view.crossings[-1].count == run.stencil[y, x]
    page, complaints = opened(browser, view.save(tmp_path / "view.html"))
    rows = [row.split("\t") for row in page.inner_text("#crossings table").splitlines()]
    shown = [(int(change.replace("−", "-")), int(count)) for _, change, count, _ in rows[: len(view.crossings)]]
    assert shown == [(each.change, each.count) for each in view.crossings]
    assert page.title() == "softshadow: volume-zfail on torus: 3-D view"
    assert complaints == []
    page.uncheck("input[name=volume]")
    page.fill("#pixel-x", "5")
    assert page.evaluate("document.getElementById('crossings').dataset.count") == "0"
    assert complaints == []
    page.close()


@pytest.mark.thin(2)
@pytest.mark.parametrize(
    ("technique", "scene", "options"),
    [
        ("volume-zfail", "torus", {}),
        pytest.param("volume-zfail", "sunlight", {"cap": "finite"}, marks=pytest.mark.slow),
        pytest.param("volume-zpass", "overlapping", {}, marks=pytest.mark.slow),
        ("volume-zpass", "eye-in-shadow", {"start": "near-plane"}),
        pytest.param("volume-zpass-plus", "eye-in-shadow", {}, marks=pytest.mark.slow),
        pytest.param("volume-parity", "overlapping", {}, marks=pytest.mark.slow),
    ],
)
def test_crossings_that_the_page_computes_are_those_of_the_stencil_buffer(browser, technique, scene, options, tmp_path):
    run = drawn(technique, scene, **options)
    page, complaints = opened(browser, run.view3d().save(tmp_path / "view.html"))
    # away from edges, where rasterization has rules that a ray has not: all neighbours have the pixel's value
    shifted = [np.roll(run.stencil, (dy, dx), (0, 1)) for dy in (-1, 0, 1) for dx in (-1, 0, 1)]
    inner = np.all([each == run.stencil for each in shifted], axis=0) & (run.depth < 1)
    random = np.random.default_rng(5)
    pixels = [*random.permutation(np.argwhere(inner & (run.stencil > 0)))[:40]]
    pixels += [*random.permutation(np.argwhere(inner & (run.stencil == 0)))[:20]]
    assert len(pixels) > 30
    for y, x in np.array(pixels).tolist():
        line = page.evaluate(f"window.view3d.lineOf({x}, {y})")
        assert line["end"] == run.stencil[y, x], (x, y, line)
        point = run.line_of_sight(x, y).point
        assert np.linalg.norm(np.array(line["point"]) - point) < 1e-3
    assert complaints == []
    page.close()


def test_the_page_around_a_view_chooses_the_pixel(browser, tmp_path):
    run = drawn("volume-zpass", "boxes")
    y, x = (int(each) for each in np.argwhere(run.stencil == 1)[40])
    outer = tmp_path / "report.html"
    outer.write_text(
        f'<iframe id="view" srcdoc="{html.escape(view3d_document(run))}" style="width:900px;height:400px"></iframe>'
        '<script>addEventListener("message", e => { if (e.data.softshadow === "view3d") document.title = "ready"; });'
        "</script>",
        encoding="utf-8",
    )
    page = browser.new_page(viewport={"width": 1000, "height": 600})
    page.goto(outer.as_uri())
    page.wait_for_function("document.title === 'ready'")
    page.evaluate(
        f"document.getElementById('view').contentWindow.postMessage({{softshadow: 'pixel', x: {x}, y: {y},"
        "stencil: 7}, '*')"
    )
    frame = page.frames[1]
    frame.wait_for_selector("#crossings table")
    assert frame.input_value("#pixel-x") == str(x)
    assert "The line counts 1 and the stencil buffer has 7" in frame.inner_text("#crossings")
    page.close()


def test_nothing_serious_is_wrong_for_screen_readers(browser, tmp_path):
    from axe_playwright_python.sync_playwright import Axe

    page, _ = opened(browser, drawn("volume-zfail", "boxes").view3d(50, 40).save(tmp_path / "view.html"))
    found = [each for each in Axe().run(page).response["violations"] if each["impact"] in ("serious", "critical")]
    assert found == []
    page.close()


def test_a_view_is_small_and_a_notebook_shows_it_in_a_frame():
    run = drawn("volume-zfail", "torus")
    view = run.view3d(48, 40)
    frame = view._repr_html_()
    assert len(frame) < SIMPLE
    assert frame.startswith('<iframe title="volume-zfail on torus: 3-D view" srcdoc="')
    assert re.search(r"https?:", frame) is None
    assert repr(view) == f"View3D('volume-zfail' on 'torus', pixel 48, 40: {len(view.crossings)} crossings)"


def test_names_with_html_in_them_are_text(browser, tmp_path):
    plain = Scene.named("boxes")
    scene = Scene("</script><b>bold", plain.camera, [Light((-2, 4, 2), name="<i>lamp")], plain.objects)
    page, complaints = opened(browser, drawn("volume-zpass", scene).view3d(40, 40).save(tmp_path / "view.html"))
    assert "</script><b>bold" in page.inner_text("#panel summary")
    assert page.query_selector("b, i") is None
    assert complaints == []
    page.close()


def test_saving_takes_pages_and_models_and_nothing_else(tmp_path):
    view = drawn("volume-zfail", "boxes").view3d(40, 40)
    assert b"line of sight" in view.save(tmp_path / "view.glb").read_bytes()
    view.save(tmp_path / "view.html")
    view.save(tmp_path / "view.html")  # its own page is overwritten
    with pytest.raises(ValueError, match=r"expected a name that ends in .html, .glb or .ply"):
        view.save(tmp_path / "view.pdf")
    with pytest.raises(ValueError, match="expected both x and y"):
        drawn("volume-zfail", "boxes").view3d(40)


def test_each_technique_counts_in_its_own_way():
    ways = {
        name: counting_of(drawn(name, "boxes")) for name in ("volume-zpass", "volume-zfail", "volume-parity", "map")
    }
    assert ways == {"volume-zpass": "passing", "volume-zfail": "failing", "volume-parity": "parity", "map": None}
    assert counting_of(drawn("volume-zpass-plus", "boxes")) == "passing"
