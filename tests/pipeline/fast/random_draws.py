"""Random programs of draws that a batch takes, or takes only in part."""

from functools import partial

import numpy as np

from softshadow import gl
from softshadow.context import Context

SIZE = 32
MODES = (
    gl.GL_TRIANGLES, gl.GL_TRIANGLE_STRIP, gl.GL_TRIANGLE_FAN, gl.GL_QUADS, gl.GL_QUAD_STRIP, gl.GL_POLYGON,
    gl.GL_LINES, gl.GL_LINE_STRIP, gl.GL_LINE_LOOP, gl.GL_POINTS,
)  # fmt: skip


class Program:
    """A random program: a few states, and under each of them draws that differ in what a run allows."""

    def __init__(self, seed: int) -> None:
        self.rng = np.random.default_rng(seed)
        self.environment = np.random.default_rng([seed, 1])  # of its own: seeds of examples keep their programs
        self.corners = np.random.default_rng([seed, 2])  # the same, for what concerns single corners
        self.planes = np.random.default_rng([seed, 3])
        self.mode = self.one_of(*MODES)

    def draw(self, states: int = 3, draws: int = 5, *, changes_tests: bool = False) -> Context:
        """Carry the program out in a new context; `changes_tests`: before each draw, what concerns fragments only."""
        context = gl.create_context(SIZE, SIZE, depth_format=str(self.rng.choice(["d24", "d32f"])))
        self.make_textures()
        gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)
        for _ in range(states):
            self.set_state()
            self.set_lighting()
            self.set_textures()
            for _ in range(draws):
                if changes_tests:
                    self.set_tests()
                self.set_planes()
                self.set_matrices()
                self.draw_something()
        gl.glFinish()
        return context

    def chance(self, p: float = 0.5) -> bool:
        return bool(self.rng.random() < p)

    def switch(self, cap: int, p: float = 0.5) -> None:
        (gl.glEnable if self.chance(p) else gl.glDisable)(cap)

    def one_of(self, *values: int) -> int:
        return int(self.rng.choice(values))

    def numbers(self, n: int, low: float = -1, high: float = 1) -> list[float]:
        return self.rng.uniform(low, high, n).tolist()

    def make_textures(self) -> None:
        for texture, size in enumerate((8, 4, 8), 1):
            gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
            gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_LINEAR)
            image = self.rng.integers(0, 256, (size, size, 4), np.uint8)
            gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, size, size, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, image)

    def set_state(self) -> None:
        for cap, p in (
            (gl.GL_DEPTH_TEST, 0.7), (gl.GL_CULL_FACE, 0.2), (gl.GL_BLEND, 0.3), (gl.GL_STENCIL_TEST, 0.3),
            (gl.GL_FOG, 0.3), (gl.GL_ALPHA_TEST, 0.2), (gl.GL_POLYGON_OFFSET_FILL, 0.2), (gl.GL_DEPTH_CLAMP, 0.1),
            (gl.GL_CLIP_PLANE0, 0.2), (gl.GL_CLIP_PLANE3, 0.1),
        ):  # fmt: skip
            self.switch(cap, p)
        for plane in (gl.GL_CLIP_PLANE0, gl.GL_CLIP_PLANE3):
            gl.glClipPlane(plane, self.numbers(4))
        gl.glBlendFunc(self.one_of(gl.GL_ONE, gl.GL_SRC_ALPHA), self.one_of(gl.GL_ONE, gl.GL_ONE_MINUS_SRC_ALPHA))
        gl.glStencilFunc(self.one_of(gl.GL_ALWAYS, gl.GL_EQUAL), self.one_of(0, 1), 255)
        gl.glStencilOp(gl.GL_KEEP, self.one_of(gl.GL_KEEP, gl.GL_INVERT), self.one_of(gl.GL_INCR, gl.GL_DECR_WRAP))
        gl.glAlphaFunc(gl.GL_GREATER, 0.4)
        gl.glLineWidth(self.one_of(1, 1, 2, 5))
        gl.glPointSize(self.one_of(1, 2, 3))
        gl.glPolygonOffset(*self.numbers(2, -2, 2))
        mode = self.one_of(gl.GL_LINE, gl.GL_POINT) if self.chance(0.3) else gl.GL_FILL
        gl.glPolygonMode(gl.GL_FRONT_AND_BACK, mode)
        if self.chance(0.1):
            gl.glPolygonMode(gl.GL_BACK, self.one_of(gl.GL_LINE, gl.GL_POINT, gl.GL_FILL))
        for cap in (gl.GL_POLYGON_OFFSET_LINE, gl.GL_POLYGON_OFFSET_POINT):
            self.switch(cap, 0.2)
        for cap in (
            gl.GL_LINE_SMOOTH, gl.GL_POINT_SMOOTH, gl.GL_LINE_STIPPLE, gl.GL_POLYGON_STIPPLE, gl.GL_POINT_SPRITE,
        ):  # fmt: skip
            self.switch(cap, 0.1)
        gl.glTexEnvi(gl.GL_POINT_SPRITE, gl.GL_COORD_REPLACE, self.chance())
        gl.glPointParameteri(gl.GL_POINT_SPRITE_COORD_ORIGIN, self.one_of(gl.GL_UPPER_LEFT, gl.GL_LOWER_LEFT))
        gl.glPointParameterfv(gl.GL_POINT_DISTANCE_ATTENUATION, [1.0, 0.2 * self.chance(0.2), 0.0])
        gl.glLineStipple(2, 0x3B5D)
        gl.glPolygonStipple(self.rng.bytes(128))
        gl.glFogi(gl.GL_FOG_MODE, self.one_of(gl.GL_LINEAR, gl.GL_EXP))
        gl.glFogi(gl.GL_FOG_COORD_SRC, int(self.environment.choice((gl.GL_FRAGMENT_DEPTH, gl.GL_FOG_COORD))))
        (gl.glEnable if self.environment.random() < 0.3 else gl.glDisable)(gl.GL_COLOR_SUM)
        gl.glColorMask(*[self.chance(0.9)] * 4)
        conventions = gl.GL_FIRST_VERTEX_CONVENTION, gl.GL_LAST_VERTEX_CONVENTION
        gl.glProvokingVertex(int(self.corners.choice(conventions, p=(0.3, 0.7))))
        gl.glEdgeFlag(self.corners.random() < 0.9)
        if self.corners.random() > 0.85:  # outlines of dashes
            gl.glPolygonMode(gl.GL_FRONT_AND_BACK, gl.GL_LINE)
            gl.glEnable(gl.GL_LINE_STIPPLE)
            gl.glDisable(gl.GL_LINE_SMOOTH)

    def set_tests(self) -> None:
        """Change a few of the settings that many small draws of ordinary programs change in between."""
        kind = int(self.rng.integers(10))
        if kind == 0:
            self.switch(gl.GL_SCISSOR_TEST)
            gl.glScissor(*self.rng.integers(0, SIZE, 4).tolist())
        elif kind == 1:
            self.switch(gl.GL_BLEND)
            gl.glBlendFunc(self.one_of(gl.GL_ONE, gl.GL_SRC_ALPHA), self.one_of(gl.GL_ONE, gl.GL_ZERO))
        elif kind == 2:
            self.switch(gl.GL_STENCIL_TEST)
            gl.glStencilFunc(gl.GL_NOTEQUAL, self.one_of(0, 1, 2), 255)
        elif kind == 3:
            gl.glDepthMask(self.chance())
        elif kind == 4:
            gl.glColorMask(*[self.chance(0.7)] * 4)
        elif kind == 5:
            self.switch(gl.GL_ALPHA_TEST, 0.3)
            self.switch(gl.GL_DEPTH_CLAMP, 0.3)
        elif kind == 6:
            gl.glBindTexture(gl.GL_TEXTURE_2D, self.one_of(0, *range(1, 4)))
            self.switch(gl.GL_TEXTURE_2D)
        elif kind == 7:
            self.switch(gl.GL_LIGHTING)
        elif kind == 8:
            gl.glPointSize(self.rng.uniform(0.1, 6))
            gl.glLineWidth(self.environment.uniform(0.1, 6))
        else:
            gl.glViewport(*self.rng.integers(-4, SIZE, 2).tolist(), *self.rng.integers(1, SIZE, 2).tolist())
            gl.glDepthRange(*self.rng.random(2).tolist())

    def set_planes(self) -> None:
        """Change a clip plane before some draws, switch it or both."""
        plane = int(self.planes.choice((gl.GL_CLIP_PLANE0, gl.GL_CLIP_PLANE3)))
        if self.planes.random() < 0.2:
            gl.glClipPlane(plane, self.planes.uniform(-1, 1, 4).tolist())
        if self.planes.random() < 0.15:
            (gl.glEnable if self.planes.random() < 0.6 else gl.glDisable)(plane)

    def set_lighting(self) -> None:
        self.switch(gl.GL_LIGHTING, 0.7)
        for cap in (gl.GL_NORMALIZE, gl.GL_RESCALE_NORMAL, gl.GL_COLOR_MATERIAL):
            self.switch(cap)
        gl.glColorMaterial(
            self.one_of(gl.GL_FRONT, gl.GL_BACK, gl.GL_FRONT_AND_BACK),
            self.one_of(gl.GL_AMBIENT_AND_DIFFUSE, gl.GL_SPECULAR, gl.GL_EMISSION, gl.GL_DIFFUSE),
        )
        gl.glShadeModel(gl.GL_SMOOTH if self.chance(0.8) else gl.GL_FLAT)
        for parameter in (gl.GL_LIGHT_MODEL_LOCAL_VIEWER, gl.GL_LIGHT_MODEL_TWO_SIDE):
            gl.glLightModeli(parameter, int(self.chance(0.3)))
        separate = gl.GL_SEPARATE_SPECULAR_COLOR if self.chance(0.3) else gl.GL_SINGLE_COLOR
        gl.glLightModeli(gl.GL_LIGHT_MODEL_COLOR_CONTROL, separate)
        for light in range(3):
            self.set_light(gl.GL_LIGHT0 + light)

    def set_light(self, light: int) -> None:
        self.switch(light)
        for parameter in (gl.GL_AMBIENT, gl.GL_DIFFUSE, gl.GL_SPECULAR):
            gl.glLightfv(light, parameter, self.numbers(4, 0))
        gl.glLightfv(light, gl.GL_POSITION, [*self.numbers(3, -2, 2), self.one_of(0, 0, 1, 2)])
        gl.glLightfv(light, gl.GL_SPOT_DIRECTION, self.numbers(3))
        gl.glLightf(light, gl.GL_SPOT_CUTOFF, self.one_of(180, 180, 80, 30))
        gl.glLightf(light, gl.GL_SPOT_EXPONENT, self.one_of(0, 1, 7))
        for parameter, low in ((gl.GL_CONSTANT_ATTENUATION, 1), (gl.GL_LINEAR_ATTENUATION, 0)):
            gl.glLightf(light, parameter, low if self.chance() else 0.7)

    def set_textures(self) -> None:
        self.switch(gl.GL_TEXTURE_2D, 0.4)
        caps = {gl.GL_S: gl.GL_TEXTURE_GEN_S, gl.GL_T: gl.GL_TEXTURE_GEN_T, gl.GL_R: gl.GL_TEXTURE_GEN_R}
        for coordinate, cap in caps.items():
            self.switch(cap, 0.1 if coordinate == gl.GL_R else 0.4)
            maps = (
                gl.GL_REFLECTION_MAP,
                gl.GL_NORMAL_MAP,
                gl.GL_REFLECTION_MAP if coordinate == gl.GL_R else gl.GL_SPHERE_MAP,
            )
            gl.glTexGeni(coordinate, gl.GL_TEXTURE_GEN_MODE, self.one_of(gl.GL_OBJECT_LINEAR, gl.GL_EYE_LINEAR, *maps))
            gl.glTexGenfv(coordinate, gl.GL_EYE_PLANE, self.numbers(4))
            gl.glTexGenfv(coordinate, gl.GL_OBJECT_PLANE, self.numbers(4))
        self.set_environment()

    def set_environment(self) -> None:
        """Set the texture function; half of the combinations read the primary colour."""
        choose = self.environment.choice
        modes = gl.GL_MODULATE, gl.GL_MODULATE, gl.GL_REPLACE, gl.GL_COMBINE, gl.GL_COMBINE
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, int(choose(modes)))
        for function in (gl.GL_COMBINE_RGB, gl.GL_COMBINE_ALPHA):
            gl.glTexEnvi(gl.GL_TEXTURE_ENV, function, int(choose((gl.GL_MODULATE, gl.GL_ADD_SIGNED, gl.GL_REPLACE))))
        for source in (gl.GL_SRC0_RGB, gl.GL_SRC1_RGB, gl.GL_SRC0_ALPHA, gl.GL_SRC1_ALPHA):
            sources = gl.GL_TEXTURE, gl.GL_PREVIOUS, gl.GL_PRIMARY_COLOR, gl.GL_CONSTANT
            gl.glTexEnvi(gl.GL_TEXTURE_ENV, source, int(choose(sources)))

    def set_matrices(self) -> None:
        if self.chance(0.7):
            gl.glMatrixMode(gl.GL_PROJECTION)
            gl.glLoadIdentity()
            gl.gluPerspective(60, 1, 0.5, 10)
            gl.glMatrixMode(gl.GL_MODELVIEW)
            gl.glLoadIdentity()
            gl.glTranslatef(0, 0, -2.5)
        if self.chance():
            gl.glRotatef(*self.numbers(1, -180, 180), *self.numbers(3))
        if self.chance(0.4):
            gl.glScalef(*([1.5] * 3 if self.chance() else self.numbers(3, 0.3, 2)))
        if self.chance(0.1):
            gl.glMultMatrixf(self.numbers(16))
        if self.chance(0.2):
            gl.glMatrixMode(gl.GL_TEXTURE)
            gl.glTranslatef(*self.numbers(3))
            gl.glMatrixMode(gl.GL_MODELVIEW)

    def set_secondary(self) -> None:
        """Set the secondary colour and the fog coordinate, or one of them, or none."""
        if self.environment.random() < 0.2:
            gl.glSecondaryColor3f(*self.environment.uniform(-0.5, 1.5, 3).tolist())
        if self.environment.random() < 0.2:
            gl.glFogCoordf(self.environment.uniform(-1, 1))

    def set_material(self) -> None:
        """Set a parameter of a material, as between two vertices."""
        choose = self.environment.choice
        side = int(choose((gl.GL_FRONT, gl.GL_FRONT, gl.GL_BACK, gl.GL_FRONT_AND_BACK)))
        if self.environment.random() < 0.3:
            gl.glMaterialf(side, gl.GL_SHININESS, int(choose((0, 0, 7, 100))))
            return
        colors = gl.GL_AMBIENT, gl.GL_DIFFUSE, gl.GL_SPECULAR, gl.GL_EMISSION, gl.GL_AMBIENT_AND_DIFFUSE
        gl.glMaterialfv(side, int(choose(colors)), self.environment.random(4).tolist())

    def draw_something(self) -> None:
        gl.glColor4f(*self.numbers(4, 0))
        gl.glNormal3f(*self.numbers(3))
        self.set_secondary()
        if self.chance(0.2):
            side = self.one_of(gl.GL_FRONT, gl.GL_BACK, gl.GL_FRONT_AND_BACK)
            gl.glMaterialfv(side, self.one_of(gl.GL_SPECULAR, gl.GL_DIFFUSE), self.numbers(4, 0))
            gl.glMaterialf(side, gl.GL_SHININESS, self.one_of(0, 5, 100))
        if self.chance(0.4):
            self.mode = self.one_of(*MODES)
        mode, n = self.mode, int(self.rng.integers(0, 14))
        if self.chance(0.3):
            materials, edges = self.environment.random() < 0.5, self.corners.random() < 0.3
            gl.glBegin(mode)
            for _ in range(n):
                gl.glTexCoord2f(*self.numbers(2))
                self.set_secondary()
                if materials and self.environment.random() < 0.5:
                    self.set_material()
                if edges:
                    gl.glEdgeFlag(self.corners.random() < 0.5)
                gl.glVertex3f(*self.numbers(3))
            gl.glEnd()
            return
        arrays = (
            (gl.GL_COLOR_ARRAY, gl.glColorPointer, 4, (4, gl.GL_FLOAT, 0), 0.3),
            (gl.GL_NORMAL_ARRAY, gl.glNormalPointer, 3, (gl.GL_FLOAT, 0), 0.7),
            (gl.GL_TEXTURE_COORD_ARRAY, gl.glTexCoordPointer, 2, (2, gl.GL_FLOAT, 0), 0.5),
            (gl.GL_VERTEX_ARRAY, gl.glVertexPointer, 3, (3, gl.GL_FLOAT, 0), 1),
        )
        for array, point, width, arguments, p in arrays:
            gl.glDisableClientState(array)
            if self.chance(p):
                gl.glEnableClientState(array)
                point(*arguments, np.array(self.numbers(16 * width), np.float32).reshape(-1, width))
        for array, point, width in (
            (gl.GL_SECONDARY_COLOR_ARRAY, partial(gl.glSecondaryColorPointer, 3), 3),
            (gl.GL_FOG_COORD_ARRAY, gl.glFogCoordPointer, 1),
        ):
            gl.glDisableClientState(array)
            if self.environment.random() < 0.3:
                gl.glEnableClientState(array)
                point(gl.GL_FLOAT, 0, self.environment.uniform(-0.5, 1.5, (16, width)).astype(np.float32))
        gl.glDisableClientState(gl.GL_EDGE_FLAG_ARRAY)
        if self.corners.random() < 0.2:
            gl.glEnableClientState(gl.GL_EDGE_FLAG_ARRAY)
            gl.glEdgeFlagPointer(0, self.corners.random(16) < 0.7)
        if self.chance():
            indices = self.rng.integers(0, 16, n).astype(np.uint32)
            gl.glDrawElements(mode, n, gl.GL_UNSIGNED_INT, indices)
        else:
            gl.glDrawArrays(mode, 0, n)


def same_buffers(a: Context, b: Context) -> bool:
    """Return whether colour, depth and stencil of two windows are equal, bit for bit."""
    pairs = zip(a.storage.window.attachments.values(), b.storage.window.attachments.values(), strict=True)
    return all(one.image.view.tobytes() == other.image.view.tobytes() for one, other in pairs)
