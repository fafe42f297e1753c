"""The report as its readers use it: slider, click, keys, links, overlays, two runs, questions; accessibility."""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import softshadow as ss
from report.browser import chromium, opened
from softshadow.gallery.failure_page import write_page

SIZE = (64, 48)


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    with chromium() as running:
        yield running


@pytest.fixture(scope="module")
def run() -> ss.Run:
    return ss.run("volume-zfail", "torus", SIZE)


@pytest.fixture(scope="module")
def file(run: ss.Run, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return run.save(tmp_path_factory.mktemp("pages") / "run.html")


@pytest.fixture(scope="module")
def both(run: ss.Run, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return run.save(tmp_path_factory.mktemp("pages") / "both.html", beside=ss.run("volume-zpass", "torus", SIZE))


def click_pixel(page: Any, x: int, y: int, panel: str = "colour") -> None:
    """Click the middle of a pixel of a panel that shows the whole picture."""
    canvas = page.locator(f"[data-panel={panel}] canvas")
    box = canvas.bounding_box()
    canvas.click(position={"x": (x + 0.5) * box["width"] / SIZE[0], "y": (y + 0.5) * box["width"] / SIZE[0]})


def settled(page: Any, expression: str) -> None:
    """Wait until an expression holds on the page."""
    page.wait_for_function(expression, timeout=5000)


def test_slider_buttons_and_keys_choose_the_step(run: ss.Run, file: Path, browser: Any) -> None:
    with opened(browser, file) as page:
        last = len(run) - 1
        assert page.text_content("#title") == f"{last}  {run[last].title}"
        page.focus("#slider")
        page.keyboard.press("ArrowLeft")
        settled(page, f"document.getElementById('title').textContent.startsWith('{last - 1} ')")
        page.click("#previous")
        page.keyboard.press(",")
        settled(page, f"document.getElementById('title').textContent === '0  {run[0].title}'")
        assert page.is_disabled("#previous")
        assert page.evaluate("location.hash") == "#step=0"
        page.evaluate("document.activeElement.blur()")
        page.keyboard.press("ArrowRight")
        settled(page, "document.getElementById('slider').value === '1'")


def test_a_click_shows_values_and_history_and_arrows_move_on(run: ss.Run, file: Path, browser: Any) -> None:
    with opened(browser, file) as page:
        click_pixel(page, 20, 30)
        settled(page, "location.hash.endsWith('x=20&y=30')")
        page.keyboard.press("ArrowRight")
        page.keyboard.press("Shift+ArrowUp")
        settled(page, "location.hash.endsWith('x=21&y=20')")
        settled(page, "document.querySelector('#history-0 h2').textContent.includes('x=21 y=20')")
        values = page.text_content("#values")
        colour = " ".join(str(channel) for channel in run.image[20, 21])
        assert f"x=21 y=20 (GL y=27); colour {colour}; depth " in values
        assert np.float32(re.search(r"depth ([\d.]+)", values)[1]) == run.depth[20, 21]
        assert f"stencil {run.stencil[20, 21]};" in values
        rows = page.locator("#history-0 tbody tr:not(.step)")
        history = run.pixel(21, 20)
        assert rows.count() == len(history)
        assert rows.last.locator(".reason").text_content() == history[-1].reason
        assert page.text_content("#status") == values


def test_link_leads_to_step_and_pixel(run: ss.Run, file: Path, browser: Any) -> None:
    with opened(browser, file, "#step=1&x=20&y=30") as page:
        assert page.input_value("#slider") == "1"
        assert "x=20 y=30" in page.text_content("#values")
        history = [row for row in run.pixel(20, 30) if row.step <= 1]
        assert page.locator("#history-0 tbody tr:not(.step)").count() == len(history)
        page.evaluate("location.hash = '#step=2&x=3&y=4'")
        settled(page, "document.getElementById('values').textContent.includes('x=3 y=4')")
    with opened(browser, file, "#step=99&x=20&y=3000") as page:  # a wrong link is as good as none
        assert page.input_value("#slider") == str(len(run) - 1)
        assert "Choose a pixel" in page.text_content("#values")


def test_every_array_is_the_buffer(run: ss.Run, file: Path, browser: Any) -> None:
    read = """async () => { const all = [];
        for (const step of softshadow.page.runs[0].steps) for (const picture of step.pictures) {
            await softshadow.load([picture.array]);
            all.push(Array.from(softshadow.arrayAt(picture.array).values)); }
        return all; }"""
    with opened(browser, file) as page:
        arrays = iter(page.evaluate(read))
    for step in run.steps:
        for buffer in (step.image, step.depth, step.stencil, *step.maps.values()):
            np.testing.assert_array_equal(np.array(next(arrays)), buffer.reshape(-1).astype(np.float64))


def test_zoomed_pictures_are_linked_and_a_click_finds_the_pixel(file: Path, browser: Any) -> None:
    with opened(browser, file, "#step=2&x=20&y=30") as page:
        page.click("[data-zoom=digits]")
        page.locator("[data-panel=stencil] canvas").hover()
        box = page.locator("[data-panel=depth] canvas").bounding_box()
        page.locator("[data-panel=depth] canvas").click(position={"x": box["width"] / 2, "y": box["height"] / 2})
        settled(page, "location.hash.endsWith('x=20&y=30')")  # the marked pixel is in the middle of every picture
        page.keyboard.press("0")
        click_pixel(page, 5, 6, "stencil")
        settled(page, "location.hash.endsWith('x=5&y=6')")


@pytest.mark.slow
def test_second_run_beside_the_first_with_marker_and_difference(run: ss.Run, both: Path, browser: Any) -> None:
    other = ss.run("volume-zpass", "torus", SIZE)
    with opened(browser, both, "#x=20&y=30") as page:
        page.check("[name=side][value=both]")
        settled(page, "document.querySelectorAll('#panels figure').length >= 6")
        for number, each in enumerate((run, other)):
            rows = page.locator(f"#history-{number} tbody tr:not(.step)")
            assert rows.count() == len(each.pixel(20, 30))
        page.check("[name=side][value=difference]")
        settled(page, "document.querySelector('[data-panel=stencil] .words').textContent.includes('differ')")
        different = int((run.stencil != other.stencil).sum())
        assert f"{different} of {64 * 48} pixels differ" in page.text_content("[data-panel=stencil] .words")
        assert page.evaluate("location.hash").endswith("show=difference")


def test_sizes_of_runs_beside_each_other_are_equal(run: ss.Run, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"beside: sizes differ, \(64, 48\) and \(32, 24\)"):
        run.save(tmp_path / "a.html", beside=ss.run("planar", "torus", (32, 24)))
    with pytest.raises(ValueError, match=r"for reports, expected an ending of \.html"):
        run.save(tmp_path / "a.png", beside=run)


def test_questions_are_answered_by_the_run(run: ss.Run, file: Path, browser: Any) -> None:
    with opened(browser, file) as page:
        questions = page.evaluate("softshadow.page.questions")
        assert len(questions) >= 3
        for question in questions:
            if "be 0 after step" in question["text"]:
                is_0 = run[question["step"]].stencil[question["y"], question["x"]] == 0
                assert question["choices"][question["answer"]] == ("yes" if is_0 else "no")
        page.click("summary:has-text('Predict')")
        wrong = 1 - questions[0]["answer"]
        page.click(f"#question-0 [data-choice='{wrong}']")
        assert page.text_content("#question-0 .answer").startswith("Not so: ")
        settled(page, f"location.hash.includes('x={questions[0]['x']}&y={questions[0]['y']}')")


def test_overlays_have_a_legend_and_lines_are_drawn(file: Path, browser: Any) -> None:
    with opened(browser, file, "#step=1") as page:
        before = page.locator("[data-panel=colour] canvas").screenshot()
        page.select_option("#overlay", "why")
        settled(page, "document.querySelector('[data-panel=colour] .legend').textContent.includes('depth failed: ')")
        overlaid = page.locator("[data-panel=colour] canvas").screenshot()
        page.check("[name=lines][value=silhouettes]")
        assert len({before, overlaid, page.locator("[data-panel=colour] canvas").screenshot()}) == 3


def test_view_in_space_follows_the_pixel(run: ss.Run, file: Path, browser: Any) -> None:
    with opened(browser, file, "#x=20&y=30") as page:
        assert page.locator("#view3d iframe").count() == 0  # unpacked when it is first opened
        page.click("#view3d summary")
        text = "document.querySelector('#view3d iframe')?.contentDocument?.body?.innerText ?? ''"
        for x, y in ((20, 30), (32, 36)):
            page.evaluate("([x, y]) => softshadow.mark([x, y])", [x, y])
            page.wait_for_function(f"({text}).includes('Stencil value {run.stencil[y, x]}')", timeout=15_000)


@pytest.mark.thin(2)
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_page_is_accessible(scheme: str, both: Path, browser: Any) -> None:
    axe = pytest.importorskip("axe_playwright_python.sync_playwright", reason="needs axe-playwright-python")
    with opened(browser, both, "#x=20&y=30&show=both", color_scheme=scheme) as page:
        page.evaluate("for (const each of document.querySelectorAll('details:not(#view3d)')) each.open = true")
        found = axe.Axe().run(page).response["violations"]
        serious = [each for each in found if each["impact"] in ("serious", "critical")]
        assert [(each["id"], each["nodes"][0]["html"]) for each in serious] == []


def test_phone_shows_all_without_scrolling_sideways(file: Path, browser: Any) -> None:
    phone = {"viewport": {"width": 390, "height": 844}, "has_touch": True, "is_mobile": True}
    with opened(browser, file, **phone) as page:
        canvas = page.locator("[data-panel=colour] canvas")
        canvas.tap()
        settled(page, "location.hash.includes('x=')")
        assert page.evaluate("document.documentElement.scrollWidth") <= 390
        page.wait_for_selector("#history-0 td.reason")
        reason = page.locator("#history-0 td.reason").first.bounding_box()
        assert reason["x"] + reason["width"] <= 390


def test_failure_shows_both_runs_at_its_pixel(browser: Any, tmp_path: Path) -> None:
    failure = ss.failures["mask-1"].at((80, 60))
    write_page(failure, tmp_path / "failure.html")
    with opened(browser, tmp_path / "failure.html") as page:
        x, y = failure.pixel
        assert page.locator("#history-0").is_visible()
        assert page.locator("#history-1").is_visible()
        for number, each in enumerate((failure.wrong, failure.cured)):
            reason = page.locator(f"#history-{number} .reason").last.text_content()
            assert reason == each.pixel(x, y)[-1].reason
        page.check("[name=side][value=second]")
        settled(page, "document.getElementById('history-0').hidden")
        assert page.locator("[data-panel='map wrong pixels']").count() == 1


@pytest.mark.slow
@pytest.mark.parametrize("name", list(ss.failures))
def test_page_of_every_failure_opens(name: str, browser: Any, tmp_path: Path) -> None:
    failure = ss.failures[name]
    write_page(failure, tmp_path / "failure.html")
    assert (tmp_path / "failure.html").stat().st_size < 5.5e6
    with opened(browser, tmp_path / "failure.html") as page:
        rows = [row for row in failure.wrong.pixel(*failure.pixel) if row.verdict != "clipped"]  # which pages leave out
        assert page.locator("#history-0 tbody tr:not(.step)").count() == len(rows)
