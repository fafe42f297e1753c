"""Shadow maps: CA:508-637 (set-up, pass 1, texture matrix, shaders), and the pseudo code of RO2:24-85.

The shaders are programs of the register: the slide's own ("slide-shadow-map"), and where a correction asks for it
"shadow-map", which first checks whether the light sees a point at all. Surfaces have their plain colour, no lighting.
"""

from typing import Any

import numpy as np

from softshadow.listings.listing import Listing, Steps
from softshadow.listings.slide_shader import NAME as SLIDE_SHADER
from softshadow.listings.stage import AMBIENT, STAGE, Stage, begin_frame, draw, set_camera

MAP_SIZE = 192  # SHADOW_MAP_WIDTH and SHADOW_MAP_HEIGHT: larger than the window
LIGHT_FOV, LIGHT_NEAR, LIGHT_FAR = 34.0, 1.0, 12.0  # the floor's corners lie outside
SHADOW_FACTOR = 0.5  # RO2:85, 0 < factor_umbra < 1
BRIGHT = 0.98  # share of the colour in light: at 1, 0.9 would be half-way between two levels of 255
ALMOST_NO_BIAS = 0.0005  # in the map's depth, 0 to 1: the least that E52 needs besides a slope offset


# -- CA ----------------------------------------------------------------------------------------------------------------
def shadow_map(
    gl: Any, corrected: frozenset[str], stage: Stage = STAGE, *, offset: bool = True, map_size: int = MAP_SIZE
) -> Steps:
    """CA:498-637: the four slides as one program; returns the map of pass 1, (h, w) float32."""
    begin_frame(gl, stage)
    gl.glDisable(gl.GL_LIGHTING)
    texture = set_up(gl, corrected, map_size=map_size)
    yield "the set-up"

    # Pas 1. Actualització del shadow map
    if "E62" in corrected:
        framebuffer = begin_framebuffer(gl, texture)
        draw_from_light(gl, stage, offset, map_size)
        end_framebuffer(gl, framebuffer)
    else:
        draw_from_light(gl, stage, offset, map_size)
        # 3. Guardar el z-buffer en una textura; E62: only as many pixels as the window has can be copied
        gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
        gl.glCopyTexSubImage2D(gl.GL_TEXTURE_2D, 0, 0, 0, 0, 0, map_size, map_size)
    stored = gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT)
    yield "Pas 1: the shadow map", {"shadow map": stored}

    # Restaurar càmera i viewport
    restore(gl, stage)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)

    # Pas 2, with the matrix of CA:559-575 and the shaders of CA:577-637
    program = gl.program("shadow-map" if "E47" in corrected else SLIDE_SHADER)  # E47: tests q > 0 and 0 <= s, t <= 1
    # E48: "només si no hem usat glPolygonOffset", and pass 1 has used it
    use(gl, program, light_matrix(gl, stage), 0.0 if offset and "E48" in corrected else 0.01, AMBIENT)
    draw(gl, stage.scene, unlit=1.0)
    gl.glUseProgram(0)
    yield "Pas 2: the scene, compared with the map"
    return [stored]


def map_with_bias(gl: Any, corrected: frozenset[str]) -> Steps:
    """CA:620: the bias alone, "només si no hem usat glPolygonOffset"."""
    # E49: 0.01 of the depth range is a different distance at every depth; an offset follows the slope
    return (yield from shadow_map(gl, frozenset({"E46", "E47", "E48", "E62"}), offset="E49" in corrected))


def set_up(gl: Any, corrected: frozenset[str], start: float = 0.0, map_size: int = MAP_SIZE) -> int:
    """CA:508-522, Shadow mapping - setup: return the bound texture.

    The slide passes NULL: texels that no copy reaches are then undefined, here they hold `start`.
    """
    wrap = gl.GL_CLAMP_TO_BORDER if "E47" in corrected else gl.GL_CLAMP_TO_EDGE  # E47: edge texels smear
    filtering = (
        gl.GL_NEAREST if "E46" in corrected else gl.GL_LINEAR
    )  # E46: the mean of two depths is the depth of nothing
    gl.glActiveTexture(gl.GL_TEXTURE0)
    texture: int = gl.glGenTextures(1)
    gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_WRAP_S, wrap)
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_WRAP_T, wrap)
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, filtering)
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MAG_FILTER, filtering)
    gl.glTexParameterfv(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_BORDER_COLOR, (1.0, 1.0, 1.0, 1.0))
    gl.glTexImage2D(
        gl.GL_TEXTURE_2D, 0, gl.GL_DEPTH_COMPONENT32, map_size, map_size, 0, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT,
        np.full((map_size, map_size), start, np.float32),
    )  # fmt: skip
    return texture


def draw_from_light(gl: Any, stage: Stage, offset: bool = True, map_size: int = MAP_SIZE) -> None:
    """CA:528-546: the camera at the light, the scene with an offset of (1, 1)."""
    gl.glViewport(0, 0, map_size, map_size)
    gl.glMatrixMode(gl.GL_PROJECTION)
    gl.glLoadIdentity()
    gl.gluPerspective(LIGHT_FOV, 1.0, LIGHT_NEAR, LIGHT_FAR)
    gl.glMatrixMode(gl.GL_MODELVIEW)
    gl.glLoadIdentity()
    look_from_light(gl, stage)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
    gl.glPolygonOffset(1, 1)
    if offset:
        gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
    draw(gl, stage.scene)
    gl.glDisable(gl.GL_POLYGON_OFFSET_FILL)


def look_from_light(gl: Any, stage: Stage) -> None:
    """Multiply the current matrix by ViewS, "cu observatorul in pozitia sursei"."""
    gl.gluLookAt(*stage.light[:3], *stage.target, 0.0, 1.0, 0.0)


def light_matrix(gl: Any, stage: Stage) -> np.ndarray:
    """CA:559-575, Generació de coords de textura: world space to (s, t, p, q), in GL's memory order."""
    gl.glPushMatrix()
    gl.glLoadIdentity()
    gl.glTranslated(0.5, 0.5, 0.5)
    gl.glScaled(0.5, 0.5, 0.5)
    gl.gluPerspective(LIGHT_FOV, 1.0, LIGHT_NEAR, LIGHT_FAR)
    look_from_light(gl, stage)
    matrix: np.ndarray = gl.glGetFloatv(gl.GL_MODELVIEW_MATRIX)
    gl.glPopMatrix()
    return matrix


def restore(gl: Any, stage: Stage) -> None:
    """Set viewport and camera back to those of the window, whose size the scissor box still has."""
    gl.glViewport(*gl.glGetIntegerv(gl.GL_SCISSOR_BOX))
    set_camera(gl, stage)


def use(gl: Any, program: int, matrix: np.ndarray, bias: float, factor: float) -> None:
    """Use a shadow map program; in shadow the colour is multiplied by `factor`."""
    gl.glUseProgram(program)
    gl.glUniformMatrix4fv(gl.glGetUniformLocation(program, "lightMatrix"), 1, gl.GL_FALSE, matrix)
    gl.glUniform1i(gl.glGetUniformLocation(program, "shadowMap"), 0)
    gl.glUniform1f(gl.glGetUniformLocation(program, "bias"), bias)
    gl.glUniform4f(gl.glGetUniformLocation(program, "ambient"), factor, factor, factor, 1.0)


def begin_framebuffer(gl: Any, texture: int) -> int:
    """Draw into a depth texture from now on: "un buffer ZS ca buffer de adancime" (RO2:32-36)."""
    framebuffer: int = gl.glGenFramebuffers(1)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, framebuffer)
    gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_DEPTH_ATTACHMENT, gl.GL_TEXTURE_2D, texture, 0)
    gl.glDrawBuffer(gl.GL_NONE)
    gl.glReadBuffer(gl.GL_NONE)
    return framebuffer


def end_framebuffer(gl: Any, framebuffer: int) -> None:
    """Draw into the window again."""
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
    gl.glDeleteFramebuffers(1, [framebuffer])


# -- RO2 ---------------------------------------------------------------------------------------------------------------
def two_stages(gl: Any, corrected: frozenset[str], stage: Stage = STAGE) -> Steps:
    """RO2:24-85, Etapa I and Etapa II; returns ZS, (h, w) float32."""
    begin_frame(gl, stage)
    gl.glDisable(gl.GL_LIGHTING)
    stored = first_stage(gl, corrected, stage)
    yield "Etapa I: ZS from the light", {"ZS": stored}

    # Etapa II
    matrix = light_matrix(gl, stage) if "E50" in corrected else view_of_light(gl, stage)
    bias = ALMOST_NO_BIAS if "E52" in corrected else 0.0  # E52: else rounding decides whether a surface shadows itself
    program = gl.program("shadow-map" if "E47" in corrected else SLIDE_SHADER)  # E47, as above
    if "E53" in corrected:
        draw(gl, stage.scene)  # E53: ambient light reaches shadows, too; the factor is for the direct light only
        gl.glEnable(gl.GL_BLEND)
        gl.glBlendFunc(gl.GL_ONE, gl.GL_ONE)
        gl.glDepthFunc(gl.GL_EQUAL)
        use(gl, program, matrix, bias, 0.0)
        draw(gl, stage.scene, unlit=1 - AMBIENT)
    else:
        use(gl, program, matrix, bias, SHADOW_FACTOR)
        draw(gl, stage.scene, unlit=1.0)
    gl.glUseProgram(0)
    yield "Etapa II: the picture from the eye"
    return [stored]


def pixel_loop(gl: Any, corrected: frozenset[str], stage: Stage = STAGE) -> Steps:
    """SK:345-357: the loop over the pixels [u, v] of depth w, with A = H[x, y] and B = z as maps; returns H.

    The slide's loop is one array operation here. A and B are window depths of the light's view (E69), 0 to 1.
    """
    begin_frame(gl, stage)
    gl.glDisable(gl.GL_LIGHTING)
    # 1. Zobraz scénu z pohľadu svetelného zdroja; hĺbkovú mapu odlož do H
    stored = first_stage(gl, corrected | {"E50", "E51"}, stage)
    yield "1. H from the light", {"H": stored}

    # 2. Zobraz scénu z pohľadu kamery
    draw(gl, stage.scene, unlit=BRIGHT)
    _, _, width, height = gl.glGetIntegerv(gl.GL_VIEWPORT)
    w = np.asarray(gl.glReadPixels(0, 0, width, height, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT), np.float64)
    picture = gl.glReadPixels(0, 0, width, height, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)
    yield "2. the scene from the camera"

    # 3. Pre všetky pixely [u, v] s hĺbkou w: (a) [u, v, w] -> [x, y, z]
    projection, view = (
        np.asarray(gl.glGetFloatv(name), np.float64).reshape(4, 4).T
        for name in (gl.GL_PROJECTION_MATRIX, gl.GL_MODELVIEW_MATRIX)
    )
    to_light = np.asarray(light_matrix(gl, stage), np.float64).reshape(4, 4).T @ np.linalg.inv(projection @ view)
    u, v = np.meshgrid((np.arange(width) + 0.5) / width, (np.arange(height) + 0.5) / height)
    depth = w.reshape(height, width)
    ndc = np.stack([2 * u - 1, 2 * v - 1, 2 * depth - 1, np.ones_like(u)], axis=-1)
    s, t, p, q = np.moveaxis(ndc @ to_light.T, -1, 0)
    x, y = (np.floor(MAP_SIZE * each / q).astype(int) for each in (s, t))
    known = (depth < 1) & (x >= 0) & (x < MAP_SIZE) & (y >= 0) & (y < MAP_SIZE)
    farthest = MAP_SIZE - 1
    a = stored[np.clip(y, 0, farthest), np.clip(x, 0, farthest)]  # (b) A = H[x, y]
    b = p / q  # (c) B = z
    bias = ALMOST_NO_BIAS if "E52" in corrected else 0.0
    in_shadow = (a < b - bias) & (depth < 1)  # (d) ak (A < B) tak je pixel [u, v] v tieni
    if "E47" in corrected:
        in_shadow &= known  # E47: the slide does not say what H is outside
    image = np.frombuffer(np.asarray(picture).tobytes(), np.uint8).reshape(height, width, 4).copy()
    image[in_shadow, :3] = image[in_shadow, :3] * AMBIENT
    gl.glDisable(gl.GL_DEPTH_TEST)
    gl.glWindowPos2i(0, 0)
    gl.glDrawPixels(width, height, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, image)
    gl.glEnable(gl.GL_DEPTH_TEST)
    yield (
        "3. A < B for every pixel",
        {"A": a.astype(np.float32), "B": b.astype(np.float32), "in shadow": in_shadow.astype(np.uint8)},
    )
    return [stored]


def first_stage(gl: Any, corrected: frozenset[str], stage: Stage) -> np.ndarray:
    """RO2:24-47: ZS from the light, no colour written; "daca z < ZS[y][x] atunci ZS[y][x] = z"."""
    # ZS[y][x] is one texel, whatever is outside
    texture = set_up(gl, corrected | {"E46"}, start=0.0)
    framebuffer = begin_framebuffer(gl, texture)
    gl.glViewport(0, 0, MAP_SIZE, MAP_SIZE)
    gl.glMatrixMode(gl.GL_PROJECTION)
    gl.glLoadIdentity()
    if "E50" in corrected:
        gl.gluPerspective(LIGHT_FOV, 1.0, LIGHT_NEAR, LIGHT_FAR)  # E50: ViewS alone does not map to pixels of ZS
    gl.glMatrixMode(gl.GL_MODELVIEW)
    gl.glLoadIdentity()
    look_from_light(gl, stage)
    if "E51" in corrected:
        gl.glClear(gl.GL_DEPTH_BUFFER_BIT)  # E51: if ZS starts at 0, no z is less
    if "E52" in corrected:
        gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
        gl.glPolygonOffset(1, 1)
    draw(gl, stage.scene)
    gl.glDisable(gl.GL_POLYGON_OFFSET_FILL)
    end_framebuffer(gl, framebuffer)
    restore(gl, stage)
    stored: np.ndarray = gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT)
    return stored


def view_of_light(gl: Any, stage: Stage) -> np.ndarray:
    """Return ViewS as it is printed for Etapa II, in GL's memory order."""
    gl.glPushMatrix()
    gl.glLoadIdentity()
    look_from_light(gl, stage)
    matrix: np.ndarray = gl.glGetFloatv(gl.GL_MODELVIEW_MATRIX)
    gl.glPopMatrix()
    return matrix


LISTINGS = (
    Listing(
        "map", "Shadow map: set-up, pass 1, texture matrix, shaders", "maps", "CA:508-637", shadow_map,
        {
            "E46": "depths are not filtered: GL_NEAREST",
            "E47": "what the light does not see is lit: border of depth 1, test of s, t and q",
            "E48": "no bias besides the polygon offset",
            "E62": "the map is drawn into its texture, not copied from a smaller window",
        },
    ),
    Listing(
        "map-bias", "Shadow map: a constant bias instead of the offset", "maps", "CA:620", map_with_bias,
        {"E49": "an offset that follows the slope, not 0.01 of the depth range"},
    ),
    Listing(
        "map-two-stages", "Shadow map: Etapa I and Etapa II", "maps", "RO2:24-85", two_stages,
        {
            "E47": "what the light does not see is lit: border of depth 1, test of s, t and q",
            "E50": "projection and scale to the map besides the view",
            "E51": "ZS is cleared to 1",
            "E52": "an offset in the map and a bias",
            "E53": "the factor is for the direct light alone",
        },
    ),
    Listing(
        "map-loop", "Shadow map: the loop over the pixels", "maps", "SK:345-357", pixel_loop,
        {"E47": "what the light does not see is lit", "E52": "an offset in the map and a bias"},
    ),
)  # fmt: skip
