"""The page of a comparison: a table and a picture of the errors in one HTML file, which loads nothing."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from html import escape
from pathlib import Path

import numpy as np

from softshadow.inspection.files import MARK
from softshadow.inspection.pictures import png
from softshadow.inspection.tables import html_table

HEADS = ("pixels that are", "number", "max", "RMS", "wrong")
PAGE = """<!doctype html>
<html lang="en"><head><meta charset="utf-8"><!-- {mark} -->
<meta name="viewport" content="width=device-width, initial-scale=1"><title>{title}</title>
<style>
:root {{ color-scheme: light dark; }}
body {{ font: 1rem/1.5 system-ui, sans-serif; max-width: 62rem; margin: 2rem auto; padding: 0 1rem; }}
table {{ border-collapse: collapse; margin-bottom: 1.5rem; }}
th, td {{ padding: 0.1rem 0.8rem 0.1rem 0; text-align: right; font-variant-numeric: tabular-nums; }}
th:first-child, td:first-child {{ text-align: left; }}
img {{ max-width: 100%; image-rendering: pixelated; }}
</style></head><body>
<h1>{title}</h1>
<p>An error is a difference of visibilities, from 0 to 1; a pixel is wrong if it is off by more than 0.1. The band is
the outline of the reference's shadows, a pixel wide.</p>
{tables}
<p>Picture, visibility and error of each: red is too much light, blue too little.</p>
<img alt="Picture, visibility and error: {title}" src="data:image/png;base64,{picture}">
</body></html>
"""


def write_page(
    title: str, tables: Sequence[tuple[str, Sequence[Sequence[str]]]], sheet: np.ndarray, path: Path
) -> None:
    """Write the page: for each technique its label and the rows of its errors, and the sheet of pictures."""
    parts = [f"<h2>{escape(label)}</h2>{html_table(HEADS, rows)}" for label, rows in tables]
    picture = base64.b64encode(png(sheet)).decode()
    page = PAGE.format(mark=MARK, title=escape(title), tables="\n".join(parts), picture=picture)
    path.write_text(page, encoding="utf-8")
