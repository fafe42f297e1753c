"""New texels of textures wait among late draws, in their place: each draw reads the texels of its time."""

from random import Random

import numpy as np
import pytest

from softshadow import gl
from softshadow.context import late_draws
from softshadow.gl import pair_numbers
from softshadow.pipeline import queue, use_short_cuts
from softshadow.pipeline.commands import Command, DefineImage, Draw, UpdateImage

SIZE, SIDE = (24, 16), 4
TEXTURES = 1, 2, 3
ATTACHED = gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D


def update(texture: int, value: int, side: int = SIDE, corner: int = 0) -> None:
    gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
    texels = np.full((side, side, 4), value, np.uint8)
    gl.glTexSubImage2D(gl.GL_TEXTURE_2D, 0, corner, corner, side, side, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, texels)


def define(texture: int, value: int, side: int = SIDE) -> None:
    gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
    texels = np.full((side, side, 4), value, np.uint8)
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, side, side, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, texels)


def quad(left: float, mode: int = gl.GL_QUADS) -> None:
    """Draw a quad under a matrix of its own, so that it is late."""
    gl.glPushMatrix()
    gl.glTranslatef(left, 0.0, 0.0)
    gl.glBegin(mode)
    for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)):
        gl.glTexCoord2f(x, y)
        gl.glVertex2f(x / 2, 2 * y - 1)
    gl.glEnd()
    gl.glPopMatrix()


def prepare() -> None:
    for texture in TEXTURES:
        gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, SIDE, SIDE, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, None)
        update(texture, 40 * texture)
    gl.glEnable(gl.GL_TEXTURE_2D)
    gl.glLineStipple(1, 0x0FF0)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 1)
    gl.glFramebufferTexture2D(*ATTACHED, TEXTURES[-1], 0)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
    gl.glGenQueries(1)
    gl.glBeginQuery(gl.GL_SAMPLES_PASSED, 1)
    gl.glEndQuery(gl.GL_SAMPLES_PASSED)
    gl.glNewList(1, gl.GL_COMPILE)
    quad(0.25)
    gl.glEndList()


@pytest.fixture
def context():
    with gl.create_context(*SIZE) as context:
        prepare()
        gl.glBindTexture(gl.GL_TEXTURE_2D, 1)
        gl.glFinish()
        yield context


def waiting(context) -> int:
    context.separate()
    return len(context.stream.late.draws)


def kinds(context, count: int) -> list[type]:
    """Return the types of the last commands that are recorded."""
    gl.glFinish()
    return [type(command) for command in context.frame.commands[-count:]]


def colors(context, lefts: list[float]) -> list[int]:
    """Return the red of the window where quads begin, which begins at -1."""
    gl.glFinish()
    row = context.storage.window.color.cells[SIZE[1] // 2, :, 0]
    return [int(row[int((left + 1.05) / 2 * SIZE[0])]) for left in lefts]


def test_they_wait_in_their_place(context):
    lefts = [-1.0, -0.5, 0.0, 0.5]
    for number, left in enumerate(lefts):
        update(1, 50 * number + 10)
        quad(left)
        assert waiting(context) == number + 1
    assert kinds(context, 7) == [Draw, UpdateImage] * 3 + [Draw]
    assert colors(context, lefts) == [10, 60, 110, 160]


def test_so_does_an_image_of_the_same_shape(context):
    lefts = [-1.0, -0.5, 0.0]
    for number, left in enumerate(lefts):
        define(1, 50 * number + 10)
        quad(left)
        assert waiting(context) == number + 1
    define(1, 200, side=2)
    assert waiting(context) == 0
    quad(0.5)
    assert kinds(context, 7) == [Draw, DefineImage] * 3 + [Draw]
    assert colors(context, [*lefts, 0.5]) == [10, 60, 110, 200]


def test_several_come_one_after_the_other(context):
    quad(-1.0)
    update(1, 100)
    update(2, 120)
    update(1, 200)
    quad(0.0)
    assert waiting(context) == 2
    assert kinds(context, 5) == [Draw, UpdateImage, UpdateImage, UpdateImage, Draw]
    assert colors(context, [-1.0, 0.0]) == [40, 200]


def test_whoever_reads_a_texture_sees_the_new_texels(context):
    quad(-1.0)
    update(1, 77)
    assert (gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE) == 77).all()
    quad(-1.0)
    update(1, 99)
    gl.glCopyTexSubImage2D(gl.GL_TEXTURE_2D, 0, 0, 0, 0, 0, 1, 1)
    texels = gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)
    assert texels[0, 0, 0] == 77
    assert (texels.reshape(-1, 4)[1:] == 99).all()


def test_mipmaps_are_made_of_them(context):
    gl.glBindTexture(gl.GL_TEXTURE_2D, 2)
    quad(-1.0)
    update(1, 120)  # which no draw reads
    gl.glGenerateMipmap(gl.GL_TEXTURE_2D)
    assert (gl.glGetTexImage(gl.GL_TEXTURE_2D, 1, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE) == 120).all()


def test_those_of_a_texture_that_is_drawn_to_come_between_its_draws(context):
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 1)
    gl.glViewport(0, 0, SIDE, SIDE)
    gl.glDisable(gl.GL_TEXTURE_2D)
    quad(-1.0)
    update(TEXTURES[-1], 30)
    quad(0.0)
    assert waiting(context) == 2
    gl.glFinish()
    cells = context.storage.textures[TEXTURES[-1]].images[0, 0].cells[0, :SIDE, 0]
    assert cells.tolist() == [30, 30, 255, 30]


@pytest.mark.parametrize("limit", ["MOST_BYTES", "MOST_UPDATES"])
def test_many_do_not_wait(context, monkeypatch, limit):
    monkeypatch.setattr(late_draws, limit, {"MOST_BYTES": 4 * SIDE * SIDE, "MOST_UPDATES": 1}[limit])
    quad(-1.0)
    update(1, 90)
    assert waiting(context) == 1
    update(1, 91)
    assert waiting(context) == 0
    quad(0.0)
    assert colors(context, [-1.0, 0.0]) == [40, 91]


def test_a_pattern_goes_on_over_them(context):
    gl.glEnable(gl.GL_LINE_STIPPLE)
    for left in (-0.25, -2.0):  # the first line of the second strip is outside
        quad(left, gl.GL_LINE_STRIP)
        update(1, 90)
    assert waiting(context) == 2
    assert kinds(context, 4) == [Draw, UpdateImage] * 2
    strips = context.frame.commands[-4::2]
    assert [strip.stipple_place > 0 for strip in strips] == [False, True]


def test_a_pattern_behind_them_goes_on(context):
    quad(-1.0)
    update(1, 90)
    gl.glEnable(gl.GL_LINE_STIPPLE)
    for left in (-0.25, -2.0):  # the first line of the second strip is outside
        quad(left, gl.GL_LINE_STRIP)
    gl.glFinish()
    strips = [command for command in context.frame.commands if type(command) is Draw][-2:]
    assert [strip.stipple_place > 0 for strip in strips] == [False, True]


def test_none_wait_while_draws_depend_on_a_query(context):
    gl.glBeginConditionalRender(1, gl.GL_QUERY_WAIT)
    quad(-1.0)
    update(1, 90)
    gl.glEndConditionalRender()
    quad(0.0)
    assert colors(context, [-1.0, 0.0]) == [0, 90]


def test_more_than_may_wait_in_the_queue_are_carried_out_before(context, monkeypatch):
    monkeypatch.setattr(queue, "MOST_BYTES", 4 * 4 * SIDE * SIDE)
    lefts = [-1.0, -0.5, 0.0, 0.5]
    for number, left in enumerate(lefts):
        update(1, 50 * number + 10)
        quad(left)
        if number == 1:
            context.flush()  # to the queue
    assert colors(context, lefts) == [10, 60, 110, 160]


def test_a_bounded_recording_counts_them():
    with gl.create_context(*SIZE, history_mb=0.25) as context:
        prepare()
        for number in range(400):
            for left in (-1.0, 0.0):
                update(1 + number % 2, number % 256)
                quad(left)
            gl.glFinish()
        assert context.frame.dropped > 0
        assert context.frame.bytes <= 0.25 * 2**20


def draw_to(framebuffer: int) -> None:
    """Draw to a framebuffer; what is drawn to framebuffer 1 reads no texture, as it would read what it writes."""
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, framebuffer)
    (gl.glDisable if framebuffer else gl.glEnable)(gl.GL_TEXTURE_2D)


def random_program(random: Random) -> list[tuple]:
    """Return calls: small draws, new texels among them, and sometimes something else."""
    calls: list[tuple] = []
    for _ in range(random.randrange(5, 60)):
        kind = random.random()
        if kind < 0.5:
            calls.append((quad, random.uniform(-2.0, 1.5), random.choice([gl.GL_QUADS, gl.GL_QUADS, gl.GL_LINE_STRIP])))
        elif kind < 0.75:
            side = random.randint(1, SIDE)
            corner = random.randint(0, SIDE - side)
            calls.append((update, random.choice(TEXTURES), random.randrange(256), side, corner))
        else:
            calls.append(
                random.choice(
                    [
                        (gl.glBindTexture, gl.GL_TEXTURE_2D, random.choice(TEXTURES)),
                        (gl.glCallList, 1),
                        (gl.glColor3f, random.random(), 1.0, 1.0),
                        (gl.glEnable, gl.GL_BLEND),
                        (gl.glEnable, gl.GL_LINE_STIPPLE),
                        (gl.glEnable, gl.GL_LINE_STIPPLE),
                        (gl.glDisable, random.choice([gl.GL_BLEND, gl.GL_LINE_STIPPLE])),
                        (gl.glBlendFunc, gl.GL_ONE, gl.GL_ONE),
                        (draw_to, random.randrange(2)),
                        (gl.glCopyTexSubImage2D, gl.GL_TEXTURE_2D, 0, 0, 0, 3, 3, 2, 2),
                        (gl.glGenerateMipmap, gl.GL_TEXTURE_2D),
                        (define, random.choice(TEXTURES), random.randrange(256), random.choice([SIDE, SIDE, 2])),
                        (gl.glClear, gl.GL_COLOR_BUFFER_BIT),
                        (gl.glReadPixels, 1, 1, 1, 1, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE),
                        (gl.glBeginConditionalRender, 1, gl.GL_QUERY_WAIT),
                        (gl.glEndConditionalRender,),
                    ]
                )
            )
    return calls


def carried_out(calls: list[tuple]) -> tuple[list[str], list[bytes]]:
    """Return the commands that calls become, and the images that they leave."""
    with gl.create_context(*SIZE, raise_errors=False) as context:
        prepare()
        for call, *arguments in calls:
            call(*arguments)
        textures = context.storage.textures
        images = [context.storage.window.color, *[textures[texture].images[0, 0] for texture in TEXTURES]]
        named = [*map(described, context.frame.commands)]
        return named, [image.cells.tobytes() for image in images]


def described(command: Command) -> str:
    if not isinstance(command, Draw):
        return repr(command)
    return f"{command.mode} {command.modelview} {command.stipple_place} {command.state.lines.stippled}"


@pytest.mark.parametrize("seed", range(60))
def test_they_change_no_bit(seed, monkeypatch):
    calls = random_program(Random(seed))
    if seed % 3 == 0:
        monkeypatch.setattr(late_draws, "MOST_UPDATES", 2)
    late = carried_out(calls)
    with use_short_cuts(False):
        assert carried_out(calls) == late
    monkeypatch.setattr(pair_numbers, "FEW", 0)
    monkeypatch.setattr(late_draws.LateDraws, "add_texels", lambda self, command: False)
    assert carried_out(calls) == late
