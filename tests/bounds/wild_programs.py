"""Random sequences of calls with values that GL accepts and nobody expects: huge, negative, infinite, NaN, empty.

A sequence need not be a sensible program: calls may fail, buffers may be missing, rectangles lie anywhere.
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from mesa.gl_calls import Call
from mesa.random_images import INTERNAL_FORMATS, PIXEL_FORMATS, PIXEL_TYPES, WRAPS
from mesa.random_mipmaps import MIN_FILTERS
from mesa.random_writer import COMPARISONS, FACES, LOGIC_OPS, SOURCE_FACTORS, STENCIL_OPS
from strategies import ATTRIBUTE_BITS, CAPABILITIES, COLOR_PARAMETERS, EQUATIONS, MATRIX_MODES

NUMBERS = [
    0.0, -0.0, 1.0, -1.0, 0.5, 1e-45, 1e-30, 255.5, 1e4, -1e5, 1e7, -8388608.5, 2.0**31, -(2.0**31), 1e10, -1e20,
    3e38, -3e38, 1e300, float("inf"), float("-inf"), float("nan"),
]  # fmt: skip
INTEGERS = [0, 1, -1, 2, 255, 256, -40000, 65536, 16384, 2**30, 2**31 - 1, -(2**31)]
SIDES = [0, 1, 1, 2, 3, 7, 15, 16, 17, 31, 32, 33, 48, 63, 64, 65, 100, 129]
WIDTHS = [1, 15, 31, 33, 48, 64, 65, 90, 100, 129]  # of attachments
WINDOWS = [(1, 1), (3, 2), (31, 33), (32, 17), (33, 20), (48, 40), (64, 48), (65, 16), (100, 30), (130, 10)]
MODES = [
    "GL_POINTS", "GL_LINES", "GL_LINE_STRIP", "GL_LINE_LOOP", "GL_TRIANGLES", "GL_TRIANGLES", "GL_TRIANGLE_STRIP",
    "GL_TRIANGLE_FAN", "GL_QUADS", "GL_QUAD_STRIP", "GL_POLYGON",
]  # fmt: skip
CUBE_FACES = [f"GL_TEXTURE_CUBE_MAP_{sign}_{axis}" for axis in "XYZ" for sign in ("POSITIVE", "NEGATIVE")]
TEXTURE_TARGETS = ["GL_TEXTURE_2D", "GL_TEXTURE_2D", "GL_TEXTURE_CUBE_MAP"]
DEPTHS = [
    "GL_DEPTH_COMPONENT", "GL_DEPTH_COMPONENT16", "GL_DEPTH_COMPONENT24", "GL_DEPTH_COMPONENT32",
    "GL_DEPTH_COMPONENT32F", "GL_DEPTH24_STENCIL8", "GL_DEPTH32F_STENCIL8",
]  # fmt: skip
POINTS = [*(f"GL_COLOR_ATTACHMENT{n}" for n in range(3)), "GL_DEPTH_ATTACHMENT", "GL_STENCIL_ATTACHMENT"]
PLANES = ["GL_COLOR_BUFFER_BIT", "GL_DEPTH_BUFFER_BIT", "GL_STENCIL_BUFFER_BIT", "GL_ACCUM_BUFFER_BIT"]
ASKED = [
    "GL_LINE_WIDTH", "GL_POINT_SIZE", "GL_POLYGON_OFFSET_FACTOR", "GL_MODELVIEW_MATRIX", "GL_CURRENT_COLOR",
    "GL_CURRENT_NORMAL", "GL_FOG_START", "GL_DEPTH_CLEAR_VALUE", "GL_ALPHA_TEST_REF", "GL_VIEWPORT", "GL_SCISSOR_BOX",
    "GL_BLEND_COLOR", "GL_ACCUM_CLEAR_VALUE", "GL_LIGHT_MODEL_AMBIENT", "GL_STENCIL_REF", "GL_TEXTURE_BINDING_2D",
]  # fmt: skip
ARRAYS = {
    "GL_VERTEX_ARRAY": ("glVertexPointer", (2, 3, 4)),
    "GL_COLOR_ARRAY": ("glColorPointer", (3, 4)),
    "GL_NORMAL_ARRAY": ("glNormalPointer", ()),
    "GL_TEXTURE_COORD_ARRAY": ("glTexCoordPointer", (1, 2, 3, 4)),
}

# What the arguments of state calls may be: f a number, c one that is mostly from 0 to 1, i an integer, b a byte,
# ? a truth, w a width of lines or points; else a name in CHOICES. A digit repeats the argument in front of it.
CHOICES: dict[str, list[Any]] = {
    "capability": [*CAPABILITIES, *["GL_DEPTH_TEST", "GL_STENCIL_TEST", "GL_BLEND", "GL_TEXTURE_2D"] * 4],
    "function": COMPARISONS,
    "operation": STENCIL_OPS,
    "face": FACES,
    "factor": SOURCE_FACTORS,
    "equation": list(EQUATIONS),
    "logic": LOGIC_OPS,
    "winding": ["GL_CW", "GL_CCW"],
    "fill": ["GL_POINT", "GL_LINE", "GL_FILL", "GL_FILL"],
    "shade": ["GL_FLAT", "GL_SMOOTH"],
    "light": ["GL_LIGHT0", "GL_LIGHT3"],
    "light vector": ["GL_POSITION", "GL_AMBIENT", "GL_DIFFUSE", "GL_SPECULAR"],
    "light number": [
        "GL_SPOT_EXPONENT", "GL_SPOT_CUTOFF", "GL_CONSTANT_ATTENUATION", "GL_LINEAR_ATTENUATION",
        "GL_QUADRATIC_ATTENUATION",
    ],
    "material": list(COLOR_PARAMETERS),
    "fog mode": ["GL_LINEAR", "GL_EXP", "GL_EXP2"],
    "fog number": ["GL_FOG_DENSITY", "GL_FOG_START", "GL_FOG_END"],
    "plane": ["GL_CLIP_PLANE0", "GL_CLIP_PLANE2"],
    "unit": ["GL_TEXTURE0", "GL_TEXTURE0", "GL_TEXTURE1"],
    "texture": ["GL_TEXTURE_2D", "GL_TEXTURE_CUBE_MAP"],
    "texture name": ["texture 0", "texture 1", "texture 2", 0],
    "matrix": list(MATRIX_MODES),
    "bits": list(ATTRIBUTE_BITS),
    "min filter": MIN_FILTERS,
    "mag filter": MIN_FILTERS[:2],
    "wrap": WRAPS,
    "wrapped": ["GL_TEXTURE_WRAP_S", "GL_TEXTURE_WRAP_T", "GL_TEXTURE_WRAP_R"],
    "compare": ["GL_NONE", "GL_COMPARE_R_TO_TEXTURE"],
    "lod": ["GL_TEXTURE_MIN_LOD", "GL_TEXTURE_MAX_LOD", "GL_TEXTURE_LOD_BIAS"],
    "level parameter": ["GL_TEXTURE_BASE_LEVEL", "GL_TEXTURE_MAX_LEVEL"],
    "level": [0, 0, 1, 2, 5, 13, 14, 1000, 2**31 - 1, -1],
    "environment": ["GL_MODULATE", "GL_REPLACE", "GL_DECAL", "GL_BLEND", "GL_ADD"],
    "coordinate": ["GL_S", "GL_T", "GL_R", "GL_Q"],
    "generated": ["GL_OBJECT_LINEAR", "GL_EYE_LINEAR", "GL_SPHERE_MAP", "GL_REFLECTION_MAP", "GL_NORMAL_MAP"],
    "generating plane": ["GL_OBJECT_PLANE", "GL_EYE_PLANE"],
    "color buffer": ["GL_BACK", "GL_NONE", "GL_COLOR_ATTACHMENT0", "GL_COLOR_ATTACHMENT1", "GL_COLOR_ATTACHMENT2"],
    "framebuffer": ["framebuffer 0", "framebuffer 1", 0, 0],
    "bound framebuffer": ["GL_FRAMEBUFFER", "GL_DRAW_FRAMEBUFFER", "GL_READ_FRAMEBUFFER"],
    "accumulation": ["GL_ACCUM", "GL_LOAD", "GL_ADD", "GL_MULT", "GL_RETURN"],
    "pixel store": [
        f"GL_{way}_{what}" for way in ("PACK", "UNPACK")
        for what in ("ALIGNMENT", "ROW_LENGTH", "SKIP_ROWS", "SKIP_PIXELS")
    ],
    "stored": [0, 1, 1, 2, 4, 8, 3, 40, 2**20],
    "GL_FOG_MODE": ["GL_FOG_MODE"], "GL_FOG_COLOR": ["GL_FOG_COLOR"], "GL_SHININESS": ["GL_SHININESS"],
    "GL_SPOT_DIRECTION": ["GL_SPOT_DIRECTION"], "GL_TEXTURE_ENV": ["GL_TEXTURE_ENV"],
    "GL_TEXTURE_ENV_MODE": ["GL_TEXTURE_ENV_MODE"], "GL_TEXTURE_ENV_COLOR": ["GL_TEXTURE_ENV_COLOR"],
    "GL_TEXTURE_GEN_MODE": ["GL_TEXTURE_GEN_MODE"], "GL_TEXTURE_MIN_FILTER": ["GL_TEXTURE_MIN_FILTER"],
    "GL_TEXTURE_MAG_FILTER": ["GL_TEXTURE_MAG_FILTER"], "GL_TEXTURE_COMPARE_MODE": ["GL_TEXTURE_COMPARE_MODE"],
    "GL_TEXTURE_COMPARE_FUNC": ["GL_TEXTURE_COMPARE_FUNC"], "GL_TEXTURE_BORDER_COLOR": ["GL_TEXTURE_BORDER_COLOR"],
    "GL_GENERATE_MIPMAP": ["GL_GENERATE_MIPMAP"], "GL_LIGHT_MODEL_AMBIENT": ["GL_LIGHT_MODEL_AMBIENT"],
    "GL_LIGHT_MODEL_TWO_SIDE": ["GL_LIGHT_MODEL_TWO_SIDE"],
    "GL_LIGHT_MODEL_LOCAL_VIEWER": ["GL_LIGHT_MODEL_LOCAL_VIEWER"],
}  # fmt: skip
STATE_CALLS = """
    glEnable: capability | glEnable: capability | glEnable: capability | glDisable: capability
    glDepthFunc: function | glDepthMask: ? | glClearDepth: c | glDepthRange: c, c | glAlphaFunc: function, c
    glStencilFunc: function, i, i | glStencilFuncSeparate: face, function, i, i
    glStencilOp: operation, operation, operation | glStencilOpSeparate: face, operation, operation, operation
    glStencilMask: i | glStencilMaskSeparate: face, i | glClearStencil: i | glColorMask: ?, ?, ?, ?
    glClearColor: c, c, c, c | glClearAccum: c, c, c, c | glBlendFunc: factor, factor | glBlendColor: c, c, c, c
    glBlendEquation: equation | glLogicOp: logic | glCullFace: face | glFrontFace: winding
    glPolygonMode: face, fill | glPolygonOffset: f, f | glLineWidth: w | glPointSize: w | glShadeModel: shade
    glLightfv: light, light vector, f4 | glLightfv: light, GL_SPOT_DIRECTION, f3 | glLightf: light, light number, f
    glLightModelfv: GL_LIGHT_MODEL_AMBIENT, f4 | glLightModeli: GL_LIGHT_MODEL_TWO_SIDE, ?
    glLightModeli: GL_LIGHT_MODEL_LOCAL_VIEWER, ?
    glMaterialfv: face, material, f4 | glMaterialf: face, GL_SHININESS, f | glColorMaterial: face, material
    glFogi: GL_FOG_MODE, fog mode | glFogf: fog number, f | glFogfv: GL_FOG_COLOR, f4 | glClipPlane: plane, f4
    glColor4f: c, c, c, c | glColor4d: f, f, f, f | glNormal3f: f, f, f | glTexCoord4f: f, f, f, f
    glMultiTexCoord2f: unit, f, f | glActiveTexture: unit | glBindTexture: texture, texture name
    glMatrixMode: matrix | glPushMatrix: | glPopMatrix: | glLoadIdentity: | glTranslatef: f, f, f
    glScalef: f, f, f | glScaled: f, f, f | glRotatef: f, f, f, f | glFrustum: f, f, f, f, f, f
    glOrtho: f, f, f, f, f, f | glLoadMatrixf: f16 | glMultMatrixd: f16 | gluPerspective: f, f, f, f
    gluLookAt: f, f, f, f, f, f, f, f, f | gluOrtho2D: f, f, f, f
    glPushAttrib: bits | glPopAttrib: | glRectf: f, f, f, f | glRecti: i, i, i, i
    glTexParameteri: texture, GL_TEXTURE_MIN_FILTER, min filter | glTexParameterf: texture, lod, f
    glTexParameteri: texture, GL_TEXTURE_MAG_FILTER, mag filter | glTexParameteri: texture, wrapped, wrap
    glTexParameteri: texture, GL_TEXTURE_COMPARE_MODE, compare | glTexParameteri: texture, level parameter, level
    glTexParameteri: texture, GL_TEXTURE_COMPARE_FUNC, function | glTexParameteri: texture, GL_GENERATE_MIPMAP, ?
    glTexParameterfv: texture, GL_TEXTURE_BORDER_COLOR, f4
    glTexEnvi: GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, environment | glTexEnvfv: GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR, f4
    glTexGeni: coordinate, GL_TEXTURE_GEN_MODE, generated | glTexGenfv: coordinate, generating plane, f4
    glBindFramebuffer: bound framebuffer, framebuffer | glDrawBuffer: color buffer | glReadBuffer: color buffer
    glAccum: accumulation, f | glPixelStorei: pixel store, stored | glFinish: | glFlush:
"""
SIGNATURES = [
    (name.strip(), [argument.strip() for argument in arguments.split(",") if argument.strip()])
    for line in STATE_CALLS.strip().splitlines()
    for name, _, arguments in (part.partition(":") for part in line.split(" | "))
]


class WildWriter:
    """Writes the calls of one sequence; `wildness` is the part of the numbers that are not ordinary."""

    def __init__(self, rng: np.random.Generator) -> None:
        self.rng = rng
        self.calls: list[Call] = []
        self.size: tuple[int, int] = self.pick(WINDOWS)
        self.wildness: float = self.pick([0.0, 0.01, 0.05, 0.1, 0.4])

    def call(self, name: str, *arguments: Any) -> None:
        self.calls.append((name, arguments))

    def pick(self, choices: Any) -> Any:
        return choices[int(self.rng.integers(len(choices)))]

    def chance(self, probability: float) -> bool:
        return bool(self.rng.random() < probability)

    def number(self, low: float = -2.0, high: float = 2.0) -> float:
        return self.pick(NUMBERS) if self.chance(self.wildness) else round(float(self.rng.uniform(low, high)), 3)

    def integer(self, low: int, high: int) -> int:
        return self.pick(INTEGERS) if self.chance(self.wildness) else int(self.rng.integers(low, high + 1))

    def box(self) -> list[int]:
        """Return a rectangle about the window: x, y, width, height."""
        width, height = self.size
        corner = [self.integer(-20, width), self.integer(-20, height)]
        return [*corner, self.integer(0, 2 * width), self.integer(0, 2 * height)]

    def argument(self, kind: str) -> Any:
        if kind in CHOICES:
            return self.pick(CHOICES[kind])
        if len(kind) > 1:
            return [self.argument(kind[0]) for _ in range(int(kind[1:]))]
        makers: dict[str, Callable[[], Any]] = {
            "f": self.number,
            "c": lambda: self.number(0, 1),
            "i": lambda: self.integer(-3, 300),
            "w": lambda: self.number(0, 12),
            "?": lambda: self.chance(0.6),
        }
        return makers[kind]()

    # -- state ---------------------------------------------------------------------------------------------------------
    def state(self) -> None:
        name, kinds = self.pick(SIGNATURES)
        self.call(name, *map(self.argument, kinds))

    def boxes(self) -> None:
        self.call(self.pick(["glViewport", "glScissor"]), *self.box())

    def sane_view(self) -> None:
        """Matrices and viewport that show something again."""
        for mode in ("GL_PROJECTION", "GL_MODELVIEW"):
            self.call("glMatrixMode", mode)
            self.call("glLoadIdentity")
        self.call("glViewport", 0, 0, *self.pick([self.size, (32, 32), (100, 60)]))
        if self.chance(0.5):
            self.call("gluPerspective", 60.0, 1.3, 0.1, self.pick([10.0, 1e6]))
            self.call("glTranslatef", 0.0, 0.0, -2.0)
        for capability in ("GL_SCISSOR_TEST", "GL_CULL_FACE", "GL_COLOR_LOGIC_OP", "GL_CLIP_PLANE0", "GL_CLIP_PLANE2"):
            if self.chance(0.7):
                self.call("glDisable", capability)

    def counting(self) -> None:
        """The state of shadow volumes: only the stencil buffer changes."""
        self.call("glEnable", "GL_STENCIL_TEST")
        self.call("glEnable", "GL_DEPTH_TEST")
        self.call("glDepthMask", False)
        self.call("glColorMask", False, False, False, False)
        self.call("glStencilFunc", "GL_ALWAYS", 0, 255)
        self.call("glStencilMask", 255)
        self.call("glStencilOpSeparate", "GL_FRONT", "GL_KEEP", "GL_KEEP", "GL_INCR_WRAP")
        self.call("glStencilOpSeparate", "GL_BACK", "GL_KEEP", "GL_DECR_WRAP", "GL_DECR_WRAP")

    def plain(self) -> None:
        """The state of most draws: nothing but a depth test."""
        for capability in ("GL_STENCIL_TEST", "GL_ALPHA_TEST", "GL_BLEND", "GL_COLOR_LOGIC_OP"):
            self.call("glDisable", capability)
        self.call("glEnable", "GL_DEPTH_TEST")
        self.call("glDepthFunc", "GL_LESS")
        self.call("glDepthMask", True)
        self.call("glColorMask", True, True, True, True)

    # -- drawing -------------------------------------------------------------------------------------------------------
    def vertices(self, count: int, size: int = 4) -> np.ndarray:
        spread = self.pick([0.05, 0.3, 1.0, 3.0, 100.0])
        places = self.rng.uniform(-spread, spread, (count, 4)) + self.rng.uniform(-1, 1, 4)
        if self.chance(0.7):
            places[:, 3] = 1
        wild = self.rng.random((count, 4)) < self.wildness * 0.3
        places[wild] = self.rng.choice(NUMBERS, int(wild.sum()))
        return places[:, :size]

    def immediate(self) -> None:
        self.call("glBegin", self.pick(MODES))
        for vertex in self.vertices(self.pick([0, 1, 2, 3, 4, 6, 9, 24])).round(4).tolist():
            if self.chance(0.3):
                self.call("glColor4f", *(self.number(0, 1) for _ in range(4)))
            if self.chance(0.3):
                self.call("glTexCoord4f", *(self.number() for _ in range(3)), self.pick([1.0, self.number()]))
            if self.chance(0.2):
                self.call("glNormal3f", *(self.number() for _ in range(3)))
            self.call("glVertex4f", *vertex)
        self.call("glEnd")

    def arrays(self) -> None:
        count = self.pick([0, 1, 3, 4, 12, 40])
        for array in ["GL_VERTEX_ARRAY", *ARRAYS]:
            if array != "GL_VERTEX_ARRAY" and self.chance(0.7):
                continue
            call, sizes = ARRAYS[array]
            size = self.pick(sizes) if sizes else 3
            self.call("glEnableClientState", array)
            values = self.vertices(count, size).astype(np.float32)
            self.call(call, *((size,) if sizes else ()), "GL_FLOAT", 0, values)
        mode = self.pick(MODES)
        if self.chance(0.5):
            first = int(self.rng.integers(0, count + 1))
            self.call("glDrawArrays", mode, first, self.pick([0, count - first, count - first]))
        else:
            n = self.pick([0, 3, 12]) if count else 0
            indices = self.rng.integers(0, max(count, 1), n, dtype=np.uint32)
            self.call("glDrawElements", mode, n, "GL_UNSIGNED_INT", indices)
        for array in ARRAYS:
            if self.chance(0.9):
                self.call("glDisableClientState", array)

    def odd_arrays(self) -> None:
        """Arrays of any type and stride, in client memory or in a buffer object, perhaps too short or empty."""
        count, stride = self.pick([0, 1, 3, 12]), self.pick([0, 0, 16, 40])
        if self.chance(0.4):
            self.call("glBindBuffer", "GL_ARRAY_BUFFER", "buffer 0")
            self.call(
                "glBufferData", "GL_ARRAY_BUFFER", self.rng.integers(0, 256, count * 40, np.uint8), "GL_STATIC_DRAW"
            )
            pointers: list[Any] = [None, 0, 4, 400]
        else:
            kind = self.pick([np.float32, np.int16, np.float64])
            pointers = [self.vertices(count).astype(np.float32).astype(kind) if self.chance(0.9) else []]
        with_color = self.chance(0.5)
        for array in ("GL_VERTEX_ARRAY", "GL_COLOR_ARRAY")[: 1 + with_color]:
            self.call("glEnableClientState", array)
            kind = self.pick(["GL_FLOAT", "GL_SHORT", "GL_DOUBLE", "GL_INT"])
            self.call(ARRAYS[array][0], self.pick(ARRAYS[array][1]), kind, stride, self.pick(pointers))
        self.call("glBindBuffer", "GL_ARRAY_BUFFER", 0)
        mode = self.pick(MODES)
        first, n = self.pick([0, 0, 1]), self.pick([0, 1, count])
        self.pick([
            lambda: self.call("glDrawArrays", mode, first, n),
            lambda: self.call("glMultiDrawArrays", mode, [0, first], [n, 0], 2),
            lambda: self.call("glDrawElements", mode, n, "GL_UNSIGNED_BYTE", np.arange(n, dtype=np.uint8)),
            lambda: self.call("glDrawRangeElements", mode, 0, n, n, "GL_UNSIGNED_SHORT", np.arange(n, dtype=np.uint16)),
        ])()  # fmt: skip
        for array in ("GL_VERTEX_ARRAY", "GL_COLOR_ARRAY"):
            self.call("glDisableClientState", array)

    def delete(self) -> None:
        """Delete an object that may be bound, attached or in use."""
        kind = self.pick(["Textures", "Textures", "Framebuffers", "Renderbuffers", "Queries", "Buffers"])
        singular = {"Queries": "query"}.get(kind, kind[:-1].lower())
        number = self.pick([0, 0, 1, 3, 4])
        self.call(f"glDelete{kind}", 1, [f"{singular} {number}"])

    def ask(self) -> None:
        """Ask for a value, also as another type than it has."""
        kind = self.pick(["Floatv", "Integerv", "Doublev", "Booleanv"])
        self.call(f"glGet{kind}", self.pick(ASKED))

    def clear(self) -> None:
        self.call("glClear", " | ".join(plane for plane in PLANES if self.chance(0.6)) or PLANES[0])

    def scene(self) -> None:
        """Draws that likely reach the buffers, with a little unusual state."""
        if self.chance(0.5):
            self.framebuffer() if self.chance(0.8) else self.call("glBindFramebuffer", "GL_FRAMEBUFFER", 0)
        self.sane_view()
        self.pick([self.plain, self.plain, self.counting])()
        for _ in range(self.pick([0, 0, 1, 2])):
            self.pick([self.state, self.state, self.boxes])()
        for _ in range(self.pick([1, 3, 6])):
            self.pick([self.immediate, self.immediate, self.arrays])()
        if self.chance(0.2):
            self.clear()

    # -- images --------------------------------------------------------------------------------------------------------
    def texture(self) -> None:
        target = self.pick(TEXTURE_TARGETS)
        self.call("glBindTexture", target, self.pick(CHOICES["texture name"][:3]))
        width, height, level = self.pick(SIDES), self.pick(SIDES), self.pick([0, 0, 0, 0, 1, 2])
        faces = ["GL_TEXTURE_2D"]
        if target != "GL_TEXTURE_2D":
            faces, height = CUBE_FACES[: self.pick([6, 6, 1])], width
        internal, pixel_format, kind, pixels = self.image(width, height)
        for face in faces:
            image = (internal, width, height, 0, pixel_format, kind, pixels)
            self.call("glTexImage2D", face, level, *image)
        if self.chance(0.3):
            self.call("glGenerateMipmap", target)
        if self.chance(0.6):
            self.call("glTexParameteri", target, "GL_TEXTURE_MIN_FILTER", self.pick(MIN_FILTERS))
        if self.chance(0.2):
            self.call("glGetTexImage", self.pick(faces), self.pick([0, level, 1]), pixel_format, kind)

    def image(self, width: int, height: int) -> tuple[Any, str, str, np.ndarray | None]:
        """Return internal format, format, type and pixels; often None."""
        if self.chance(0.3):
            internal, pixel_format, kind = self.pick(DEPTHS), "GL_DEPTH_COMPONENT", self.pick(list(PIXEL_TYPES))
            if internal.endswith("STENCIL8"):
                return internal, "GL_DEPTH_STENCIL", "GL_UNSIGNED_INT_24_8", None
        else:
            internal, pixel_format = self.pick(INTERNAL_FORMATS), self.pick(list(PIXEL_FORMATS))
            kind = self.pick(list(PIXEL_TYPES))
        if self.chance(0.3):
            return internal, pixel_format, kind, None
        return internal, pixel_format, kind, self.pixels(width, height, pixel_format, kind)

    def pixels(self, width: int, height: int, pixel_format: str, kind: str) -> np.ndarray:
        shape = (height, width, PIXEL_FORMATS.get(pixel_format, 1))
        dtype = np.dtype(PIXEL_TYPES[kind])
        if dtype.kind == "f":
            values = self.rng.uniform(-0.1, 1.1, shape)
            values[self.rng.random(shape) < self.wildness * 0.3] = self.pick(NUMBERS)
            with np.errstate(over="ignore"):
                return values.astype(dtype)
        return self.rng.integers(np.iinfo(dtype).min, np.iinfo(dtype).max, shape, dtype=dtype, endpoint=True)

    def change_texture(self) -> None:
        """Copy into a texture, replace a part of it, or make its mipmaps."""
        target = self.pick(["GL_TEXTURE_2D", *CUBE_FACES[:2]])
        level = self.pick([0, 0, 1, 2])
        internal, pixel_format, kind, pixels = self.image(8, 5)
        x, y = self.integer(-3, 40), self.integer(-3, 40)
        width, height = self.pick(SIDES), self.pick(SIDES)
        way = self.pick(["copy", "copy part", "part", "mipmaps", "get"])
        if way == "copy":
            self.call("glCopyTexImage2D", target, level, internal, x, y, width, height, 0)
        elif way == "copy part":
            place = (self.integer(0, 9), self.integer(0, 9))
            self.call("glCopyTexSubImage2D", target, level, *place, x, y, width, height)
        elif way == "part" and pixels is not None:
            place = (self.integer(0, 9), self.integer(0, 9))
            self.call("glTexSubImage2D", target, level, *place, self.pick([0, 8]), 5, pixel_format, kind, pixels)
        elif way == "mipmaps":
            self.call("glGenerateMipmap", self.pick(TEXTURE_TARGETS))
        else:
            self.call("glGetTexImage", target, level, pixel_format, kind)

    def framebuffer(self) -> None:
        """A framebuffer object; its attachments differ in size and format, or are missing."""
        self.call(
            "glBindFramebuffer",
            self.pick(CHOICES["bound framebuffer"]),
            self.pick(["framebuffer 0"] * 2 + ["framebuffer 1"]),
        )
        points = [point for point in POINTS if self.chance(0.5)]
        self.rng.shuffle(points)
        if self.chance(0.7):
            color = self.pick([["GL_COLOR_ATTACHMENT0"], POINTS[:2], []])
            points = [*color, "GL_DEPTH_STENCIL_ATTACHMENT"][:: self.pick([1, -1])]
        for number, point in enumerate(points):
            self.attach(point, number)
        if not any(point.startswith("GL_COLOR") for point in points):
            self.call("glDrawBuffer", "GL_NONE")
            self.call("glReadBuffer", "GL_NONE")
        self.call("glCheckFramebufferStatus", "GL_FRAMEBUFFER")
        self.call("glClear", "GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT | GL_COLOR_BUFFER_BIT")

    def attach(self, point: str, number: int) -> None:
        formats = {"GL_DEPTH_ATTACHMENT": DEPTHS, "GL_STENCIL_ATTACHMENT": ["GL_STENCIL_INDEX8", DEPTHS[-2]]}
        formats["GL_DEPTH_STENCIL_ATTACHMENT"] = DEPTHS[-2:]
        internal = self.pick(formats.get(point, ["GL_RGBA8", "GL_RGBA8", "GL_RGBA32F", "GL_R8", "GL_RGB8"]))
        side = (self.pick(WIDTHS), self.pick(WIDTHS[1:]))
        if self.chance(self.wildness * 0.2):
            side = (self.pick([0, 16384, 16385, -1]), self.pick([0, 1]))
        if self.chance(0.7):
            name = f"renderbuffer {number}"
            self.call("glBindRenderbuffer", "GL_RENDERBUFFER", name)
            self.call("glRenderbufferStorage", "GL_RENDERBUFFER", internal, *side)
            self.call("glFramebufferRenderbuffer", "GL_FRAMEBUFFER", point, "GL_RENDERBUFFER", name)
            return
        name, level = f"texture {3 + number}", self.pick([0, 0, 0, 1])
        kind = ("GL_RGBA", "GL_UNSIGNED_BYTE") if point.startswith("GL_COLOR") else ("GL_DEPTH_COMPONENT", "GL_FLOAT")
        if internal.endswith("STENCIL8"):
            kind = ("GL_DEPTH_STENCIL", "GL_UNSIGNED_INT_24_8")
        self.call("glBindTexture", "GL_TEXTURE_2D", name)
        self.call("glTexImage2D", "GL_TEXTURE_2D", level, internal, *side, 0, *kind, None)
        self.call("glFramebufferTexture2D", "GL_FRAMEBUFFER", point, "GL_TEXTURE_2D", name, level)

    def blit(self) -> None:
        for target in ("GL_READ_FRAMEBUFFER", "GL_DRAW_FRAMEBUFFER"):
            if self.chance(0.5):
                self.call("glBindFramebuffer", target, self.pick(CHOICES["framebuffer"]))
        corners = [self.integer(-30, 130) for _ in range(8)]
        mask = self.pick([*PLANES[:3], "GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT"])
        self.call("glBlitFramebuffer", *corners, mask, self.pick(["GL_NEAREST", "GL_LINEAR"]))

    def read(self) -> None:
        pixel_format = self.pick([*PIXEL_FORMATS, "GL_DEPTH_COMPONENT", "GL_STENCIL_INDEX"])
        x, y = self.integer(-30, 130), self.integer(-30, 130)
        kind = self.pick(list(PIXEL_TYPES))
        self.call("glReadPixels", x, y, self.pick(SIDES), self.pick(SIDES), pixel_format, kind)

    # -- structure -----------------------------------------------------------------------------------------------------
    def listed(self) -> None:
        number = self.pick([1, 2])
        self.call("glNewList", number, self.pick(["GL_COMPILE", "GL_COMPILE_AND_EXECUTE"]))
        for _ in range(self.pick([0, 1, 3])):
            self.pick([self.state, self.state, self.immediate, self.arrays])()
        self.call("glEndList")
        self.call("glCallList", self.pick([number, 1, 2, 3]))

    def counted(self) -> None:
        self.call("glBeginQuery", "GL_SAMPLES_PASSED", "query 0")
        self.pick([self.immediate, self.arrays, self.clear])()
        self.call("glEndQuery", "GL_SAMPLES_PASSED")
        self.call("glGetQueryObjectuiv", "query 0", "GL_QUERY_RESULT")

    def unprojected(self) -> None:
        call = self.pick(["gluProject", "gluUnProject"])
        matrices = [np.array([self.number() for _ in range(16)]).reshape(4, 4) for _ in range(2)]
        view = np.array([0, 0, *self.pick([(64, 48), (0, 0), (1, 2**31 - 1)])], np.int32)
        self.call(call, *(self.number() for _ in range(3)), *self.pick([(), (*matrices, view)]))


OFTEN: dict[Callable[[WildWriter], None], int] = {
    WildWriter.state: 14, WildWriter.immediate: 6, WildWriter.arrays: 3, WildWriter.boxes: 1, WildWriter.sane_view: 2,
    WildWriter.scene: 8, WildWriter.counting: 2, WildWriter.plain: 2, WildWriter.clear: 1, WildWriter.texture: 2,
    WildWriter.change_texture: 1, WildWriter.framebuffer: 2, WildWriter.blit: 1, WildWriter.read: 1,
    WildWriter.odd_arrays: 2, WildWriter.delete: 1, WildWriter.ask: 1, WildWriter.listed: 1, WildWriter.counted: 1,
    WildWriter.unprojected: 1,
}  # fmt: skip
ACTIONS = [action for action, often in OFTEN.items() for _ in range(often)]


def wild_program(seed: int) -> tuple[list[Call], tuple[int, int]]:
    """Return the sequence of a seed and the (width, height) of its window; the same ones each time."""
    writer = WildWriter(np.random.default_rng([12, seed]))
    for _ in range(int(writer.rng.integers(3, 25))):
        writer.pick(ACTIONS)(writer)
    return writer.calls, writer.size
