"""What a notebook displays for a run: its report to click through, a picture of all steps, and a text.

The report is a page of its own in a frame, so its style and script do not meet those of the notebook, and it works
without a kernel: in an exported notebook, and in one that was closed and opened again. Places that show no frames, such
as a notebook that is not trusted, have the picture.
"""

from __future__ import annotations

from html import escape
from pathlib import Path
from tempfile import TemporaryDirectory

from softshadow.inspection.pictures import Shown, notebook_display
from softshadow.inspection.step import sheet_of
from softshadow.runs.archive import RunRecord
from softshadow.runs.saving import write_file

LARGEST_REPORT = 5_000_000  # characters; a notebook keeps every output, and editors become slow with large ones
MOST_PIXELS = 8_000_000  # of all steps together; a report of more is not even begun
FRAME_HEIGHT = 640  # CSS pixels; the page scrolls in it


def report_html(run: RunRecord) -> str:
    """Return the report of a run: a page without links to other files."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "report.html"
        write_file(run, path)
        return path.read_text(encoding="utf-8")


def mimebundle(run: RunRecord, text: str, alt: str) -> Shown:
    """Return what a notebook displays: the report, or a sentence in its place if it is too large; picture; text."""
    shown, metadata = notebook_display(text, sheet_of(run.steps), alt)
    width, height = run.frame.size
    page = report_html(run) if width * height * len(run.steps) <= MOST_PIXELS else ""
    if page and len(page) <= LARGEST_REPORT:
        return {"text/html": framed(page, text), **shown}, metadata
    return {"text/html": _too_large(len(page), shown["image/png"], alt), **shown}, metadata


def framed(page: str, text: str) -> str:
    """Return a page in a frame, with a line below it for places that show no frames."""
    title = escape(text.splitlines()[0])
    return (
        f'<iframe srcdoc="{escape(page)}" title="{title}" loading="lazy" '
        f'style="width:100%;height:{FRAME_HEIGHT}px;border:1px solid #8886"></iframe>'
        f"<p><small><code>{title}</code>: if no report is above, the notebook is not trusted; run the cell, or "
        f'<code>run.save("report.html")</code>.</small></p>'
    )


def _too_large(length: int, png: str, alt: str) -> str:
    size = f"has {length / 1e6:.1f} MB" if length else "would have many megabytes"
    return (
        f'<img src="data:image/png;base64,{png}" alt="{escape(alt)}">'
        f"<p>The report of this run {size}, too much for a notebook: "
        f'<code>run.save("report.html")</code> writes it to a file.</p>'
    )
