"""Two pictures side by side, with a ring around the pixel that shows the difference."""

from __future__ import annotations

from typing import Any

import numpy as np
from PIL import Image, ImageDraw

from softshadow.inspection.pictures import LABEL_COLOR, resized

LABEL_HEIGHT, GAP, MIN_WIDTH = 16, 6, 320  # pixels: above a picture, between the pictures, of a picture
RING = 7  # radius in pixels of the enlarged picture
RED = (0xD5, 0x5E, 0x00)  # Okabe & Ito's vermilion; white rings beside it make it visible on dark shadows


def side_by_side(panels: list[tuple[str, np.ndarray]], pixel: tuple[int, int]) -> Image.Image:
    """Return pictures (H, W, 3) side by side, enlarged, each with a label above and a ring around a pixel (x, y)."""
    height, width = panels[0][1].shape[:2]
    times = max(1, -(-MIN_WIDTH // width))
    width, height = width * times, height * times
    sheet = Image.new("RGB", (len(panels) * (width + GAP) - GAP, height + LABEL_HEIGHT), "white")
    draw: Any = ImageDraw.Draw(sheet)
    for panel, (label, picture) in enumerate(panels):
        left = panel * (width + GAP)
        draw.text((left + 1, 2), label, fill=LABEL_COLOR)
        sheet.paste(Image.fromarray(resized(picture, width, height)), (left, LABEL_HEIGHT))
        x, y = left + (pixel[0] + 0.5) * times, LABEL_HEIGHT + (pixel[1] + 0.5) * times
        for radius, color in ((RING + 1, "white"), (RING, RED), (RING - 2, "white")):
            box = [x - radius, y - radius, x + radius, y + radius]
            draw.ellipse(box, outline=color, width=1 if color == "white" else 2)
    return sheet
