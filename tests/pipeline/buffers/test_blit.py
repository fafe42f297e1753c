"""Which texels blits copy: what is found without drawing is what a drawn rectangle shows."""

import numpy as np
import pytest

from softshadow import gl
from softshadow.framebuffer import DEFAULT, Attachment, Framebuffer
from softshadow.image import FORMATS, Image
from softshadow.pipeline import draw
from softshadow.pipeline.buffers import blit
from softshadow.pipeline.buffers.blit import Rectangles, drawn_texels, nearest_texels, rectangles_of, unscaled_texels
from softshadow.pipeline.commands import BlitFramebuffer
from softshadow.state import Scissor


def framebuffer(rng: np.random.Generator) -> Framebuffer:
    """Return a framebuffer of a random size: a window, or an object."""
    image = Image.new(FORMATS[gl.GL_RGBA8], *rng.integers(1, 60, 2).tolist())
    return Framebuffer(DEFAULT if rng.random() < 0.5 else 1, {gl.GL_COLOR_ATTACHMENT0: Attachment(image)})


def random_rectangles(rng: np.random.Generator, scaled: bool) -> tuple[Image, Image, Rectangles | None]:
    """Return the images of a blit and its rectangles, which may be mirrored, clipped and partly outside."""
    source, target = framebuffer(rng), framebuffer(rng)
    x0, y0, x1, y1 = rng.integers(-10, 70, 4).tolist()
    to_x, to_y = rng.integers(-10, 50, 2).tolist()
    corners = [to_x, to_y, to_x + x1 - x0, to_y + y1 - y0]
    if rng.random() < 0.3:
        corners = [corners[2], corners[1], corners[0], corners[3]]
    if rng.random() < 0.3:
        corners = [corners[0], corners[3], corners[2], corners[1]]
    if scaled:
        corners = rng.integers(-10, 70, 4).tolist()
    box = Scissor(bool(rng.random() < 0.3), *rng.integers(0, 40, 4).tolist())
    command = BlitFramebuffer(
        source.name, target.name, (x0, y0, x1, y1), (*corners,), gl.GL_COLOR_BUFFER_BIT, gl.GL_NEAREST, box
    )
    images = source.colors[0], target.colors[0]
    return *images, rectangles_of(command, source, target)


def expanded(image: Image, index: tuple) -> np.ndarray:
    """Return the numbers of the pixels of an index, in their order."""
    numbers = np.arange(image.width * image.height).reshape(image.height, image.width)
    return numbers[index].ravel()


@pytest.mark.parametrize("scaled", [False, True])
def test_texels_are_those_of_a_drawn_rectangle(scaled: bool) -> None:
    rng, found = np.random.default_rng(3), 0
    for _ in range(300):
        source, target, rectangles = random_rectangles(rng, scaled)
        if rectangles is None or not (scaled or not rectangles.scaled):
            continue
        found += 1
        drawn = drawn_texels(source, target, rectangles, draw)
        for _ in range(2):  # the second time, scaled ones are known
            quick = nearest_texels(source, target, rectangles, draw)
            for image, one, other in zip((target, source), quick, drawn, strict=True):
                assert (expanded(image, one) == expanded(image, other)).all(), rectangles
    assert found > 30


def test_rectangles_too_large_for_exact_centres_are_drawn(monkeypatch: pytest.MonkeyPatch) -> None:
    image, drawn = Image.new(FORMATS[gl.GL_RGBA8], 8, 8), []
    near = Rectangles((0, 0, 8, 8), (0, 0, 8, 8), (0, 0, 8, 8), False, False)

    def note_drawn(*_: object) -> object:
        drawn.append(True)
        return unscaled_texels(image, image, near)

    monkeypatch.setattr(blit, "drawn_texels", note_drawn)
    nearest_texels(image, image, near, draw)
    assert not drawn
    nearest_texels(image, image, near._replace(source=(0, 0, 1 << 15, 8), target=(0, 0, 1 << 15, 8)), draw)
    assert drawn
