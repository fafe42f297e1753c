"""A failure and its cure side by side, with a ring around the pixel that tells them apart."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from softshadow.inspection.pictures import color_picture

if TYPE_CHECKING:
    from PIL.Image import Image as Picture

    from softshadow.failures.failure import Failure

LABEL, GAP, LEAST_WIDTH = 16, 6, 320  # pixels: the line above a picture, between the pictures, of a picture
RING = 7  # radius in pixels of the picture
RED = (0xD5, 0x5E, 0x00)  # Okabe & Ito's vermilion, on a white ring that dark shadows show


def side_by_side(failure: Failure) -> Picture:
    """Return the picture with the failure on the left and with the cure on the right, each with its number."""
    from PIL import Image, ImageDraw

    width, height = failure.size
    times = max(1, -(-LEAST_WIDTH // width))
    sheet = Image.new("RGB", (2 * width * times + GAP, height * times + LABEL), "white")
    draw: Any = ImageDraw.Draw(sheet)
    x, y = failure.pixel
    panels = (
        (failure.wrong, f"{failure.name}: {failure.number_wrong} wrong pixels"),
        (failure.cured, f"cured: {failure.number_cured}"),
    )
    for panel, (run, label) in enumerate(panels):
        left = panel * (width * times + GAP)
        draw.text((left + 1, 2), label, fill=(34, 34, 34))
        scaled = color_picture(run.image).resize((width * times, height * times), Image.Resampling.NEAREST)
        sheet.paste(scaled, (left, LABEL))
        centre = left + (x + 0.5) * times, LABEL + (y + 0.5) * times
        for radius, color in ((RING + 1, "white"), (RING, RED), (RING - 2, "white")):
            box = [centre[0] - radius, centre[1] - radius, centre[0] + radius, centre[1] + radius]
            draw.ellipse(box, outline=color, width=1 if color == "white" else 2)
    return sheet
