"""What glBitmap keeps for characters: small bitmaps only, so that pictures of bits take no memory.

What is kept gives the same vertices as before. The characters of a text are drawn together, and leave the same bits.
"""

import numpy as np
import pytest

from softshadow import gl
from softshadow.gl import bitmaps, raster_draws
from softshadow.pipeline.commands import Draw

KEPT = (bitmaps._kept_pixels, raster_draws._kept_rows, raster_draws._normals, raster_draws._indices)


@pytest.mark.parametrize(("side", "keeps"), [(8, True), (192, False)])
def test_only_characters_are_kept(side: int, keeps: bool) -> None:
    for kept in KEPT:
        kept.cache_clear()
    bits = np.random.default_rng(1).integers(0, 256, (side, side // 8), np.uint8)
    with gl.create_context(side, side) as context:
        gl.glPixelStorei(gl.GL_UNPACK_ALIGNMENT, 1)
        gl.glRasterPos2f(-1, -1)
        gl.glBitmap(side, side, 0, 0, 0, 0, bits)
        drawn = context.storage.window.color.view[::-1, :, 0] > 0
    assert np.array_equal(drawn, np.unpackbits(bits, axis=1).astype(bool))
    assert [kept.cache_info().currsize > 0 for kept in KEPT] == [keeps] * len(KEPT)


@pytest.mark.parametrize("precision", ["mesa", "exact"])
def test_places_of_characters(precision: str) -> None:
    """Corners are those of moved quads, bit for bit: inside, near and far outside of the window, and drawn again."""
    rng = np.random.default_rng(2)
    characters = [bitmaps.PixelQuads(bitmaps.runs(rng.random((9, 7)) < 0.5)) for _ in range(3)]
    places = [(0, 0), (11, 5), (-3, 30), (-bitmaps.MARGIN - 5, 0), (0, 40 + bitmaps.MARGIN), (2**40, -(2**40))]
    with gl.create_context(64, 40, precision=precision) as context:
        for step in range(40):
            if step % 10 == 0:
                gl.glColor3f(*rng.random(3))
                gl.glRasterPos2f(0, 0)
            character, (left, bottom) = characters[rng.integers(3)], places[rng.integers(len(places))]
            draw = bitmaps.draw_of_pixels(context, character, left, bottom)
            moved = character.quads + np.array([left, bottom, left, bottom])
            expected = raster_draws.positions(moved, (64, 40), context.real)
            assert draw.vertices.position.tobytes() == expected.tobytes()
            assert draw.vertices.position.dtype == expected.dtype
            color = np.array(context.current.raster.color, context.real)
            assert np.array_equal(draw.vertices.color, np.broadcast_to(color, (len(expected), 4)))


def test_a_text_that_is_drawn_again_has_the_same_vertices() -> None:
    character = bitmaps.PixelQuads(bitmaps.runs(np.eye(5, dtype=bool)))
    with gl.create_context(32, 32) as context:
        gl.glRasterPos2f(0, 0)
        first, again = (bitmaps.draw_of_pixels(context, character, 3, 4).vertices for _ in range(2))
    assert first is again
    assert len(character._placed) == 1


def test_few_places_of_a_character_are_kept() -> None:
    character = bitmaps.PixelQuads(bitmaps.runs(np.eye(5, dtype=bool)))
    with gl.create_context(32, 32) as context:
        gl.glRasterPos2f(0, 0)
        for left in range(3 * bitmaps.KEPT_PLACES):
            bitmaps.draw_of_pixels(context, character, left, 0)
    assert len(character._placed) <= bitmaps.KEPT_PLACES


class RandomText:
    """Characters between changes of the state, in a random order that depends on a seed."""

    def __init__(self, seed: int) -> None:
        self.rng = np.random.default_rng(seed)
        self.characters = [self.rng.bytes(12) for _ in range(4)]

    def draw(self) -> None:
        gl.glPixelStorei(gl.GL_UNPACK_ALIGNMENT, 1)
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, 1, 1, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, bytes([255] * 4))
        gl.glRasterPos2f(-0.9, 0)
        gl.glPushAttrib(gl.GL_ALL_ATTRIB_BITS)
        for _ in range(60):
            self._step(int(self.rng.integers(24)))
        gl.glFinish()

    def _step(self, kind: int) -> None:
        numbers = self.rng.uniform(-1, 1, 4).tolist()
        if kind == 0:
            gl.glColor4f(*numbers)
        elif kind == 1:
            gl.glRasterPos3f(numbers[0], numbers[1], numbers[2] if numbers[3] > 0 else 0.5)
        elif kind == 2:
            (gl.glEnable if numbers[0] > 0 else gl.glDisable)(gl.GL_BLEND)
            gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE)
        elif kind == 3:
            gl.glScissor(4, 2, 40 + int(9 * numbers[0]), 30)
            gl.glEnable(gl.GL_SCISSOR_TEST)
        elif kind == 4:
            gl.glBegin(gl.GL_TRIANGLES)
            for x, y in ((-1, -1), (1, -1), (0, 1)):
                gl.glVertex3f(x * numbers[0], y * numbers[1], numbers[2])
            gl.glEnd()
        elif kind == 5:
            gl.glPushDebugGroup(gl.GL_DEBUG_SOURCE_APPLICATION, 0, -1, "text")
        elif kind == 6:
            gl.glPopDebugGroup()
            gl.glPushDebugGroup(gl.GL_DEBUG_SOURCE_APPLICATION, 0, -1, "other text")
        elif kind == 7:
            gl.glClear(gl.GL_DEPTH_BUFFER_BIT)
        elif kind == 8:
            gl.glLogicOp(gl.GL_XOR)
            (gl.glEnable if numbers[0] > 0 else gl.glDisable)(gl.GL_COLOR_LOGIC_OP)
        elif kind == 9:
            (gl.glEnable if numbers[0] > 0 else gl.glDisable)(gl.GL_TEXTURE_2D)
        elif kind == 10:
            texel = self.rng.bytes(4)
            gl.glTexSubImage2D(gl.GL_TEXTURE_2D, 0, 0, 0, 1, 1, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, texel)
        elif kind == 11:
            gl.glPopAttrib()
            gl.glPushAttrib(gl.GL_ALL_ATTRIB_BITS)
        elif kind == 12:
            gl.glColorMask(*[number > -0.5 for number in numbers])
        elif kind == 13:
            gl.glDrawPixels(2, 1, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, bytes(range(6)))
        elif kind == 14:
            gl.glDepthFunc(gl.GL_LEQUAL if numbers[0] > 0 else gl.GL_GREATER)
        else:
            width = int(self.rng.integers(1, 9))
            character = self.characters[int(self.rng.integers(4))]
            gl.glBitmap(width, 12, numbers[0], numbers[1], width * numbers[2], numbers[3], character)


def drawn_text(seed: int) -> tuple[list[Draw], list[bytes]]:
    """Return the draws of a random text, and the buffers after it."""
    text = RandomText(seed)
    with gl.create_context(48, 32) as context:
        gl.glPushDebugGroup(gl.GL_DEBUG_SOURCE_APPLICATION, 0, -1, "first")
        text.draw()
        window = context.storage.window
        draws = [command for command in context.frame.commands if isinstance(command, Draw)]
        return draws, [window.color.view.tobytes(), window.depth.view.tobytes()]


@pytest.mark.parametrize("seeds", [range(start, start + 4) for start in range(0, 40, 4)], ids=str)
def test_characters_that_are_drawn_together_leave_the_bits_of_single_draws(seeds, monkeypatch):
    together = {seed: drawn_text(seed) for seed in seeds}
    monkeypatch.setattr(bitmaps.Text, "add", lambda *_: False)
    n_draws = n_singles = 0
    for seed, (draws, buffers) in together.items():
        singles, expected = drawn_text(seed)
        assert buffers == expected, seed
        n_draws, n_singles = n_draws + len(draws), n_singles + len(singles)
        of_label = [
            {label: sum(len(each.vertices.position) for each in some if each.label == label) for label in LABELS}
            for some in (draws, singles)
        ]
        assert of_label[0] == of_label[1], seed
    assert n_draws < n_singles  # in each seed but one, in which all characters are outside of the window


@pytest.mark.parametrize("in_window", [True, False])
@pytest.mark.parametrize(
    ("place", "is_seen"),
    [
        ((-3, 0), True), ((-4, 0), False), ((6, 0), True), ((7, 0), False),
        ((0, -2), True), ((0, -3), False), ((0, 4), True), ((0, 5), False), ((-4, -3), False),
    ],
)  # fmt: skip
def test_a_bitmap_outside_of_the_framebuffer_is_not_drawn(place, is_seen, in_window):
    """One of 3 x 2 set bits, behind an unset column and row: it moves the raster position all the same."""
    with gl.create_context(8, 6) as context:
        if not in_window:
            gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
            gl.glBindRenderbuffer(gl.GL_RENDERBUFFER, gl.glGenRenderbuffers(1))
            gl.glRenderbufferStorage(gl.GL_RENDERBUFFER, gl.GL_RGBA8, 8, 6)
            gl.glFramebufferRenderbuffer(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_RENDERBUFFER, 1)
        gl.glRasterPos2f(-1, -1)
        gl.glBitmap(0, 0, 0, 0, *place, None)
        gl.glBitmap(4, 3, 0, 0, 5, 2, bytes([0, 0, 0, 0, 112, 0, 0, 0, 112, 0, 0, 0]))
        pixels = gl.glReadPixels(0, 0, 8, 6, gl.GL_RGB, gl.GL_UNSIGNED_BYTE)
        position = gl.glGetFloatv(gl.GL_CURRENT_RASTER_POSITION)
        draws = [command for command in context.frame.commands if isinstance(command, Draw)]
    assert position[:2].tolist() == [place[0] + 5, place[1] + 2]
    assert len(draws) == is_seen
    rows, columns = (range(max(side + 1, 0), min(side + 1 + size, most)) for side, size, most in
                     ((place[1], 2, 6), (place[0], 3, 8)))  # fmt: skip
    expected = np.zeros((6, 8, 3), np.uint8)
    expected[np.ix_(rows, columns)] = 255
    np.testing.assert_array_equal(pixels, expected)


LABELS = ("first", "first/text", "first/other text", "other text")


def test_a_text_of_lists_is_one_draw_and_what_follows_comes_after_it() -> None:
    with gl.create_context(64, 16) as context:
        gl.glPixelStorei(gl.GL_UNPACK_ALIGNMENT, 1)
        base = gl.glGenLists(2)
        for n in range(2):
            gl.glNewList(base + n, gl.GL_COMPILE)
            gl.glBitmap(8, 4, 0, 0, 9, 0, bytes([0b10101010, 0xFF] * 2))
            gl.glEndList()
        gl.glListBase(base)
        gl.glColor3f(1, 0, 0)
        gl.glRasterPos2f(-1, -1)
        gl.glCallLists(6, gl.GL_UNSIGNED_BYTE, bytes([0, 1, 1, 0, 1, 0]))
        gl.glColor3f(0, 1, 0)
        gl.glRectf(-1, -1, 0, 1)  # over the first half
        gl.glBitmap(8, 4, 0, 0, 0, 0, bytes([0xFF] * 4))
        pixels = np.array(gl.glReadPixels(0, 0, 64, 1, gl.GL_RGB, gl.GL_UNSIGNED_BYTE)).reshape(64, 3)
        draws = [command for command in context.frame.commands if isinstance(command, Draw)]
    assert [len(draw.vertices.position) // 4 for draw in draws] == [6 * 10, 1, 4]
    assert (pixels[:32] == (0, 255, 0)).all()
    assert [tuple(pixel) for pixel in pixels[36:44]] == [(255, 0, 0), (0, 0, 0)] * 4  # of the fifth character
    assert (pixels[54:62] == (255, 0, 0)).all()  # what is drawn last


def test_rectangles_of_pixels_have_the_same_state_until_calls_change_it() -> None:
    """Then all that was derived from the state is found again."""
    with gl.create_context(16, 12) as context:
        for blend in (False, False, True, False):
            (gl.glEnable if blend else gl.glDisable)(gl.GL_BLEND)
            gl.glDrawPixels(1, 1, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, np.full(4, 99, np.uint8))
        states = [command.state for command in context.frame.commands if isinstance(command, Draw)]
    assert [state is states[0] for state in states] == [True, True, False, True]
    assert [state.blend.enabled for state in states] == [False, False, True, False]


def test_lines_of_a_text_in_one_color_are_one_draw() -> None:
    with gl.create_context(64, 40) as context:
        for row, color in enumerate((1, 1, 1, 0.5, 0.5)):
            gl.glColor3f(color, color, color)
            gl.glRasterPos2f(-0.9, row / 3 - 0.9)
            for _ in range(3):
                gl.glBitmap(8, 2, 0, 0, 9, 0, b"\xaa\0\0\0\x55\0\0\0")
        draws = [command for command in context.frame.commands if isinstance(command, Draw)]
    assert [len(draw.vertices.position) for draw in draws] == [4 * 8 * 9, 4 * 8 * 6]
