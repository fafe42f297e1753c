"""The gallery of the documentation: pictures, reports and answers, made when the page is read."""

from __future__ import annotations

import inspect
import warnings
from collections.abc import Iterable
from html import escape
from pathlib import Path

import numpy as np
from PIL import Image

import softshadow as ss
from softshadow import techniques
from softshadow.errors import SceneError
from softshadow.gallery import Failure
from softshadow.gallery.failure_page import write_page
from softshadow.inspection.hard_truth import hard_visibility
from softshadow.inspection.words import colors_in_words, place_in_words, visibility_in_words
from softshadow.runs import Run
from softshadow.scene import Scene, scene_title

SIZE = (160, 120)
DIFFERS = 0.1  # of the light; pictures have steps of 1/255, so that smaller differences are not seen
REPORTED = "torus"  # the scene of which every technique has a report
LARGEST_REPORT = 1_000_000  # bytes of the report of a failure; the command makes larger ones


def gallery(text: str, folder: Path, scenes: Iterable[str], failures: Iterable[Failure]) -> str:
    """Write the pictures and reports into a folder, `gallery/` beside the page, and return the page with them."""
    folder.mkdir(parents=True, exist_ok=True)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # what a technique cannot do is what the page shows
        sections = {
            "failures": "\n".join(failure_block(each, folder) for each in failures),
            "scenes": "\n".join(scene_block(name, folder) for name in scenes),
            "programs": "\n".join(map(program_block, techniques.names())),
        }
    for name, section in sections.items():
        text = text.replace(f"<!-- {name} -->", section)
    return text


def failure_block(failure: Failure, folder: Path) -> str:
    """Return a failing picture, with its answer behind a click."""
    page = folder / f"failure-{failure.name}.html"
    write_page(failure, page)
    command = f"<code>softshadow failures {failure.name} -o report.html</code>"
    report = f'<a href="gallery/{page.name}">Report of both</a>, {command}'
    if page.stat().st_size > LARGEST_REPORT:
        page.unlink()
        report = f"{command} makes a report of both."
    for side, run in (("wrong", failure.wrong), ("cured", failure.cured)):
        save(run.image, folder / f"failure-{failure.name}-{side}.webp")
    about = f"Scene {failure.scene.name}, drawn by {failure.technique}"
    differ = place_in_words((failure.wrong.image != failure.cured.image).any(axis=-1), "differ from the right picture")
    before = f"{about}, with a mistake: {failure.number_wrong:,} pixels are wrong; {differ}"
    after = f"{about}, with the cure: {failure.number_cured:,} pixels are wrong; {colors_in_words(failure.cured.image)}"
    counts = f"{failure.number_wrong} wrong pixels before, {failure.number_cured} after. {failure.remark}"
    pictures = [f"failure-{failure.name}-{side}.webp" for side in ("wrong", "cured")]
    return html(
        f'<div class="failure" id="failure-{failure.name}">',
        figure(pictures[0], before, f"<code>{failure.technique}</code>", failure.size),
        "<details><summary>What is wrong, and why?</summary>",
        figure(pictures[1], after, "with the cure", failure.size),
        f"<p><strong>{escape(failure.title)}.</strong> {escape(failure.reason)} {escape(counts)}</p>",
        f"<p>{report}</p>",
        "</details></div>",
    )


def scene_block(name: str, folder: Path) -> str:
    """Return the pictures of a scene by all techniques that can draw it, after the one of ray casting."""
    scene = Scene.named(name)
    visibilities, seen = hard_visibility(scene, SIZE)
    truth = np.mean(visibilities, axis=0)
    save(np.where(seen, 255 * truth, 128).astype(np.uint8), folder / f"{name}.webp")
    words = f"Scene {name} by ray casting, lit pixels white, shadows black: {visibility_in_words(truth, seen)}"
    figures = [figure(f"{name}.webp", words, "ray casting", SIZE)]
    for technique in techniques.names():
        try:
            run = ss.run(technique, scene, size=SIZE)
        except SceneError:  # as a cube map with a light at infinity
            continue
        figures.append(run_figure(run, scene, truth, folder))
    text = f"### {name}\n\n{scene_title(name)} `softshadow render TECHNIQUE --scene {name} -o report.html`\n"
    return text + html('<div class="thumbnails">', *figures, "</div>")


def run_figure(run: Run, scene: Scene, truth: np.ndarray, folder: Path) -> str:
    """Return the picture of a run, with the number of pixels that differ from the truth."""
    stem = f"{scene.name}-{run.technique}"
    save(run.image, folder / f"{stem}.webp")
    words = f"Scene {scene.name}, shadows by {run.technique}: {visibility_in_words(run.visibility, run.valid)}"
    caption = f'<a href="#program-{run.technique}"><code>{run.technique}</code></a>'
    if not any(light.shape for light in scene.lights):
        differs = int(np.count_nonzero((np.abs(run.visibility - truth) > DIFFERS) & run.valid))
        caption += f"<br>{differs} differ"
        words += f"; {differs} pixels differ from ray casting"
    report = ""
    if scene.name == REPORTED:
        report = f"{stem}.html"
        run.save(folder / report, force=True)
    return figure(f"{stem}.webp", words, caption, run.size, report)


def program_block(technique: str) -> str:
    """Return the file of a technique, behind a click."""
    module = inspect.getmodule(techniques.get(technique).steps)
    assert module is not None
    summary = f'<details id="program-{technique}"><summary><code>{technique}</code></summary>'
    return f"{html(summary)}\n```python\n{inspect.getsource(module)}```\n{html('</details>')}"


def figure(picture: str, words: str, caption: str, size: tuple[int, int], report: str = "") -> str:
    """Return a picture of the folder with its caption; with a report, it is a link."""
    width, height = size
    image = f'<img src="gallery/{picture}" alt="{escape(words)}" width="{width}" height="{height}" loading="lazy">'
    shown = f'<a class="report" href="gallery/{report}">{image}</a>' if report else image
    return f"<figure>{shown}<figcaption>{caption}</figcaption></figure>"


def save(picture: np.ndarray, path: Path) -> None:
    """Write a picture (H, W) or (H, W, 3) uint8, small enough for a page with hundreds."""
    Image.fromarray(picture).save(path, quality=85)


def html(*lines: str) -> str:
    """Return lines as a block of HTML, which Markdown leaves as it is."""
    return "\n".join(["", "```{raw} html", *lines, "```", ""])
