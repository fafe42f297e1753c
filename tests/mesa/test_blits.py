"""glBlitFramebuffer leaves the bits of Mesa: random rectangles, scaled, mirrored and clipped."""

import numpy as np
import pytest

from softshadow.testing import compare

pytestmark = pytest.mark.mesa

SIZE = (40, 30)
OBJECT_SIZE = (24, 32)


def drawn(gl, rng, size):
    """Fill the bound framebuffer with triangles, depths and stencil values."""
    gl.glViewport(0, 0, *size)
    gl.glClearColor(*rng.random(4).tolist())
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)
    gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glStencilOp(gl.GL_INCR, gl.GL_INCR, gl.GL_INCR)
    gl.glBegin(gl.GL_TRIANGLES)
    for x, y, z in rng.uniform(-1, 1, (12, 3)).tolist():
        gl.glColor4f(*(rng.integers(0, 256, 4) / 255).tolist())
        gl.glVertex3f(x, y, z)
    gl.glEnd()


def framebuffer(gl, color, depth):
    """Create and bind a framebuffer object with a colour and a depth (and stencil) renderbuffer; return its name."""
    name = gl.glGenFramebuffers(1)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, name)
    packed = depth == gl.GL_DEPTH24_STENCIL8
    for point, format in (
        (gl.GL_COLOR_ATTACHMENT0, color),
        (gl.GL_DEPTH_STENCIL_ATTACHMENT if packed else gl.GL_DEPTH_ATTACHMENT, depth),
    ):
        buffer = gl.glGenRenderbuffers(1)
        gl.glBindRenderbuffer(gl.GL_RENDERBUFFER, buffer)
        gl.glRenderbufferStorage(gl.GL_RENDERBUFFER, format, *OBJECT_SIZE)
        gl.glFramebufferRenderbuffer(gl.GL_FRAMEBUFFER, point, gl.GL_RENDERBUFFER, buffer)
    return name


def corners(rng, size):
    """Return a random rectangle, often mirrored or partly outside the buffer, sometimes the whole buffer."""
    if rng.random() < 0.3:
        return [0, 0, *size]
    return rng.integers(-6, max(size) + 6, 4).tolist()


def program_of(seed):
    def program(gl):
        rng = np.random.default_rng(seed)
        drawn(gl, rng, SIZE)
        depth = rng.choice([gl.GL_DEPTH24_STENCIL8, gl.GL_DEPTH24_STENCIL8, gl.GL_DEPTH_COMPONENT24])
        color = rng.choice([gl.GL_RGBA8, gl.GL_RGBA8, gl.GL_RGBA32F, gl.GL_RGB8, gl.GL_RGBA16F])
        objects = [0, framebuffer(gl, int(color), int(depth)), framebuffer(gl, gl.GL_RGBA8, int(depth))]
        for name in objects[1:]:
            gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, name)
            drawn(gl, rng, OBJECT_SIZE)
        answers = []
        for _ in range(4):
            read, draw = rng.permutation(objects)[:2].tolist()
            gl.glBindFramebuffer(gl.GL_READ_FRAMEBUFFER, read)
            gl.glBindFramebuffer(gl.GL_DRAW_FRAMEBUFFER, draw)
            source = corners(rng, OBJECT_SIZE if read else SIZE)
            size = OBJECT_SIZE if draw else SIZE
            target = source if rng.random() < 0.2 else corners(rng, size)
            (gl.glEnable if rng.random() < 0.3 else gl.glDisable)(gl.GL_SCISSOR_TEST)
            gl.glScissor(*rng.integers(0, 20, 4).tolist())
            if rng.random() < 0.4:
                mask, texture_filter = gl.GL_COLOR_BUFFER_BIT, gl.GL_LINEAR
            else:
                mask, texture_filter = gl.GL_DEPTH_BUFFER_BIT, gl.GL_NEAREST
                mask |= int(rng.choice([gl.GL_COLOR_BUFFER_BIT, 0])) | int(rng.choice([gl.GL_STENCIL_BUFFER_BIT, 0]))
            gl.glBlitFramebuffer(*source, *target, mask, texture_filter)
            gl.glDisable(gl.GL_SCISSOR_TEST)
            gl.glBindFramebuffer(gl.GL_READ_FRAMEBUFFER, draw)
            answers.append(gl.glReadPixels(0, 0, *size, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE))
            answers.append(gl.glReadPixels(0, 0, *size, gl.GL_DEPTH_COMPONENT, gl.GL_UNSIGNED_INT))
        return answers

    return program


@pytest.mark.parametrize("seed", range(12))
def test_blits_have_the_bits_of_mesa(seed):
    comparison = compare(program_of(seed), SIZE)
    assert comparison, str(comparison)


@pytest.mark.parametrize("target", [(9, 3, 20, 21), (20, 21, 9, 3), (9, 21, 20, 39), (2, 3, 24, 39)])
def test_linear_filter_is_for_scaled_blits_of_floats_only(target):
    width, height = OBJECT_SIZE
    texels = np.random.default_rng(1).random((height, width, 4), np.float32)

    def program(gl):
        names = []
        for _ in range(2):
            names.append(gl.glGenFramebuffers(1))
            gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, names[-1])
            texture = gl.glGenTextures(1)
            gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
            gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA32F, width, height, 0, gl.GL_RGBA, gl.GL_FLOAT, texels)
            gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, texture, 0)
        gl.glBindFramebuffer(gl.GL_READ_FRAMEBUFFER, names[0])
        gl.glBlitFramebuffer(3, 4, 14, 22, *target, gl.GL_COLOR_BUFFER_BIT, gl.GL_LINEAR)
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, names[1])
        return [gl.glReadPixels(0, 0, width, height, gl.GL_RGBA, gl.GL_FLOAT)]

    comparison = compare(program, SIZE)
    assert comparison, str(comparison)
    copied = np.isin(comparison.ours.returned[0], texels).all()
    assert copied == (abs(target[2] - target[0]) == 11 and abs(target[3] - target[1]) == 18)


def filled(gl, brightness):
    """Create and bind a framebuffer object with a texture of the window's size, of one colour; return its name."""
    name = gl.glGenFramebuffers(1)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, name)
    texture = gl.glGenTextures(1)
    gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
    texels = np.full((SIZE[1], SIZE[0], 4), brightness, np.uint8)
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA8, *SIZE, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, texels)
    gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, texture, 0)
    return name


@pytest.mark.parametrize(
    ("reads_window", "draws_window", "source", "target", "box"),
    [
        (False, False, (-5, 27, 17, 53), (12, -5, 34, 21), (19, 5, 16, 22)),  # in the box, no row has a texel
        (True, False, (7, 55, 50, 27), (0, 31, 7, -9), (0, 0, 3, 28)),
        (False, True, (38, 41, 21, 25), (18, 5, 26, 46), (0, 0, *SIZE)),
        (False, True, (2, 27, -9, 33), (-12, 37, 19, -5), (0, 0, *SIZE)),
        (False, True, (25, -14, 30, 7), (38, 21, 43, 42), (28, 11, 18, 15)),
    ],
)
def test_where_clipping_leaves_no_texel_nothing_is_written(reads_window, draws_window, source, target, box):
    def program(gl):
        gl.glClearColor(0.4, 0.4, 0.4, 0.4)
        gl.glClear(gl.GL_COLOR_BUFFER_BIT)
        read, draw = filled(gl, 200), filled(gl, 100)
        read, draw = 0 if reads_window else read, 0 if draws_window else draw
        gl.glBindFramebuffer(gl.GL_READ_FRAMEBUFFER, read)
        gl.glBindFramebuffer(gl.GL_DRAW_FRAMEBUFFER, draw)
        gl.glEnable(gl.GL_SCISSOR_TEST)
        gl.glScissor(*box)
        gl.glBlitFramebuffer(*source, *target, gl.GL_COLOR_BUFFER_BIT, gl.GL_NEAREST)
        gl.glBindFramebuffer(gl.GL_READ_FRAMEBUFFER, draw)
        return gl.glReadPixels(0, 0, *SIZE, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)

    comparison = compare(program, SIZE)
    assert comparison, str(comparison)
