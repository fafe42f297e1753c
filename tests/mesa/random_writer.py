"""What random programs are written with: state, textures and draws, one call after the other."""

from typing import Any

import numpy as np

from mesa.gl_calls import Call
from mesa.random_vertices import WILD

COMPARISONS = ["GL_NEVER", "GL_LESS", "GL_EQUAL", "GL_LEQUAL", "GL_GREATER", "GL_NOTEQUAL", "GL_GEQUAL", "GL_ALWAYS"]
USUAL_COMPARISONS = ["GL_LESS", "GL_LEQUAL", "GL_ALWAYS"] * 4 + COMPARISONS
STENCIL_OPS = ["GL_KEEP", "GL_ZERO", "GL_REPLACE", "GL_INCR", "GL_DECR", "GL_INVERT", "GL_INCR_WRAP", "GL_DECR_WRAP"]
FACES = ["GL_FRONT", "GL_BACK", "GL_FRONT_AND_BACK"]
SOURCE_FACTORS = [
    "GL_ZERO", "GL_ONE", "GL_SRC_COLOR", "GL_ONE_MINUS_SRC_COLOR", "GL_DST_COLOR", "GL_ONE_MINUS_DST_COLOR",
    "GL_SRC_ALPHA", "GL_ONE_MINUS_SRC_ALPHA", "GL_DST_ALPHA", "GL_ONE_MINUS_DST_ALPHA", "GL_SRC_ALPHA_SATURATE",
]  # fmt: skip
LOGIC_OPS = [
    "GL_CLEAR", "GL_AND", "GL_AND_REVERSE", "GL_COPY", "GL_AND_INVERTED", "GL_NOOP", "GL_XOR", "GL_OR", "GL_NOR",
    "GL_EQUIV", "GL_INVERT", "GL_OR_REVERSE", "GL_COPY_INVERTED", "GL_OR_INVERTED", "GL_NAND", "GL_SET",
]  # fmt: skip
PRIMITIVES = ["GL_TRIANGLES", "GL_QUADS", "GL_TRIANGLE_FAN", "GL_TRIANGLE_STRIP", "GL_QUAD_STRIP", "GL_POLYGON"]
LINES_AND_POINTS = ["GL_POINTS", "GL_LINES", "GL_LINE_STRIP", "GL_LINE_LOOP"]
SIZES_OF_LINES = [1.0, 1.0, 1.0, 2.0, 3.0, 4.0, 1.5, 2.5, 0.3, 7.7, 300.0]
ARRAYS = {
    "vertex": ("GL_VERTEX_ARRAY", "glVertexPointer"),
    "color": ("GL_COLOR_ARRAY", "glColorPointer"),
    "normal": ("GL_NORMAL_ARRAY", "glNormalPointer"),
    "coordinate": ("GL_TEXTURE_COORD_ARRAY", "glTexCoordPointer"),
    "second coordinate": ("GL_TEXTURE_COORD_ARRAY", "glTexCoordPointer"),
}
SIZES = [(64, 48), (40, 30), (33, 47), (90, 70)]  # one, several and partial 64-pixel tiles


class Writer:
    """Writes the calls of one program."""

    def __init__(self, rng: np.random.Generator) -> None:
        self.rng = rng
        self.calls: list[Call] = []
        self.size = self.pick(SIZES)
        self.texture_coordinates = 0  # how many are given per vertex: 0, 2, 3 or 4
        self.second_coordinates = 0  # of texture unit 1: 0 or 2
        self.normals = False
        self.colors = 0.6  # the part of the vertices that bring a colour
        self.color_sizes = [3, 4, 4, 4]  # how many numbers glColor gives
        self.reads_stencil = True
        self.primitives = PRIMITIVES
        self.spread = 1.0  # of object coordinates: about what the projection shows

    def call(self, name: str, *arguments: Any) -> None:
        self.calls.append((name, arguments))

    def pick(self, choices: Any) -> Any:
        return choices[int(self.rng.integers(len(choices)))]

    def chance(self, probability: float) -> bool:
        return bool(self.rng.random() < probability)

    def number(self, low: float, high: float) -> float:
        return round(float(self.rng.uniform(low, high)), 4)

    def integer(self, low: int, high: int) -> int:
        return int(self.rng.integers(low, high + 1))

    def color(self) -> tuple[float, ...]:
        """Return a colour of bytes, or one of tenths and halves of bytes: ties of the rounding to 8 bits."""
        if self.chance(0.5):
            return tuple(round(self.integer(0, 255) / 255, 4) for _ in range(4))
        return tuple(self.pick([self.integer(0, 10) / 10, (self.integer(0, 254) + 0.5) / 255]) for _ in range(4))

    def switch(self, capability: str, probability: float) -> bool:
        enabled = self.chance(probability)
        self.call("glEnable" if enabled else "glDisable", capability)
        return enabled

    # --- state

    def clear(self) -> None:
        planes = "GL_DEPTH_BUFFER_BIT", "GL_STENCIL_BUFFER_BIT", "GL_COLOR_BUFFER_BIT"
        for plane in planes[: self.integer(1, 3)]:
            self.call("glClear", plane)

    def geometry_state(self) -> None:
        width, height = self.size
        if self.chance(0.3):
            x, y = self.integer(-20, 20), self.integer(-20, 20)
            self.call("glViewport", x, y, self.integer(1, 2 * width), self.integer(1, 2 * height))
        if self.switch("GL_CULL_FACE", 0.2):
            self.call("glCullFace", self.pick(FACES))
        self.call("glFrontFace", self.pick(["GL_CCW", "GL_CW"]))
        self.call("glShadeModel", self.pick(["GL_SMOOTH", "GL_FLAT"]))
        self.switch("GL_DEPTH_CLAMP", 0.3)
        self.depth_state()

    def stipple_state(self) -> None:
        """Set stipples and sizes of points by distance, from numbers of their own: other calls stay as they were."""
        stream, self.rng = self.rng, self.rng.spawn(1)[0]
        if self.switch("GL_LINE_STIPPLE", 0.3):
            self.call("glLineStipple", self.integer(0, 5), self.integer(0, 0xFFFF))
        if self.switch("GL_POLYGON_STIPPLE", 0.2):
            self.call("glPolygonStipple", self.rng.integers(0, 256, 128, dtype=np.uint8))
        if self.chance(0.2):
            attenuation = [self.pick([0.0, 0.1, 0.3, 1.0]) for _ in range(3)]
            self.call("glPointParameterfv", "GL_POINT_DISTANCE_ATTENUATION", attenuation)
            self.call("glPointParameterf", "GL_POINT_SIZE_MAX", self.pick([3.0, 10.0]))
        self.rng = stream

    def outline_state(self) -> None:
        self.call("glLineWidth", self.pick(SIZES_OF_LINES))
        self.call("glPointSize", self.pick(SIZES_OF_LINES))
        modes = [self.pick(["GL_POINT", "GL_LINE", "GL_FILL"]) for _ in range(2)]
        for face, mode in zip(("GL_FRONT", "GL_BACK"), modes, strict=True):
            self.call("glPolygonMode", face, mode)
        self.stipple_state()
        capabilities = ("GL_POLYGON_OFFSET_FILL", "GL_POLYGON_OFFSET_LINE", "GL_POLYGON_OFFSET_POINT")
        for capability in capabilities:
            self.switch(capability, 0.3)

    def depth_state(self) -> None:
        if self.switch("GL_DEPTH_TEST", 0.8):
            self.call("glDepthFunc", self.pick(USUAL_COMPARISONS))
        self.call("glDepthMask", self.pick(["GL_TRUE", "GL_TRUE", "GL_TRUE", "GL_FALSE"]))
        if self.chance(0.3):
            self.call("glDepthRange", self.number(0, 1), self.number(0, 1))
        if self.switch("GL_POLYGON_OFFSET_FILL", 0.4):
            self.call(
                "glPolygonOffset", self.pick([0.0, 1.0, -1.0, self.number(-4, 4)]), self.pick([0.0, 1.0, -3.0, 100.0])
            )

    def fragment_state(self) -> None:
        width, height = self.size
        if self.switch("GL_SCISSOR_TEST", 0.3):
            x, y = self.integer(-3, width), self.integer(-3, height)
            self.call("glScissor", x, y, self.integer(0, width), self.integer(0, height))
        if self.switch("GL_ALPHA_TEST", 0.2):
            self.call("glAlphaFunc", self.pick(COMPARISONS), self.color()[0])
        self.depth_state()
        if self.switch("GL_STENCIL_TEST", 0.8):
            self.stencil_state()
        if self.chance(0.3):
            self.call("glColorMask", *(self.pick(["GL_TRUE", "GL_FALSE"]) for _ in range(4)))
        if self.switch("GL_BLEND", 0.3):
            self.blend_state()
        if self.switch("GL_COLOR_LOGIC_OP", 0.1):
            self.call("glLogicOp", self.pick(LOGIC_OPS))

    def stencil_state(self) -> None:
        ops = [self.pick(STENCIL_OPS) for _ in range(6)]
        references = [self.integer(-2, 260) if self.chance(0.2) else self.integer(0, 4) for _ in range(2)]
        masks = [self.pick([255, 255, 0xFFFFFFFF, self.integer(0, 255)]) for _ in range(4)]
        functions = [self.pick(["GL_ALWAYS", *COMPARISONS]) for _ in range(2)]
        if self.chance(0.5):
            self.call("glStencilFunc", functions[0], references[0], masks[0])
            self.call("glStencilOp", *ops[:3])
            self.call("glStencilMask", masks[1])
        else:
            for side, face in enumerate(["GL_FRONT", "GL_BACK"]):
                self.call("glStencilFuncSeparate", face, functions[side], references[side], masks[side])
                self.call("glStencilOpSeparate", face, *ops[3 * side : 3 * side + 3])
                self.call("glStencilMaskSeparate", face, masks[2 + side])

    def blend_state(self) -> None:
        destination_factors = SOURCE_FACTORS[:-1]
        if self.chance(0.5):
            self.call("glBlendFunc", self.pick(SOURCE_FACTORS), self.pick(destination_factors))
        else:
            source, destination = self.pick(SOURCE_FACTORS), self.pick(destination_factors)
            self.call(
                "glBlendFuncSeparate", source, destination, self.pick(SOURCE_FACTORS), self.pick(destination_factors)
            )
        equations = ["GL_FUNC_ADD", "GL_FUNC_ADD", "GL_FUNC_SUBTRACT", "GL_FUNC_REVERSE_SUBTRACT", "GL_MIN", "GL_MAX"]
        self.call("glBlendEquation", self.pick(equations))

    def matrices(self, rotations: bool) -> None:
        near, far = self.number(0.1, 2), self.number(3, 50)
        self.call("glMatrixMode", "GL_PROJECTION")
        self.call("glLoadIdentity")
        kind = self.pick(["perspective", "frustum", "ortho", "infinite"])
        if kind == "perspective":
            self.call("gluPerspective", self.number(20, 120), self.number(0.5, 2), near, far)
        elif kind == "frustum":
            self.call("glFrustum", -near, near * self.number(0.2, 1), -near, near, near, far)
        elif kind == "ortho":
            self.call("glOrtho", -4.0, self.number(1, 5), -4.0, 4.0, near, far)
        else:
            self.call(
                "glLoadMatrixd", np.array([1, 0, 0, 0, 0, 1.3, 0, 0, 0, 0, -1, -1, 0, 0, -2 * near, 0], np.float64)
            )
        self.call("glMatrixMode", "GL_MODELVIEW")
        self.call("glLoadIdentity")
        if self.chance(0.5):
            eye = [self.number(-5, 5) for _ in range(3)]
            self.call("gluLookAt", *eye, 0.0, 0.0, 0.0, *self.pick([(0.0, 1.0, 0.0), (0.3, 0.9, -0.1)]))
        else:
            self.call("glTranslatef", self.number(-1, 1), self.number(-1, 1), self.number(-7, -1))
        if rotations and self.chance(0.6):
            axis = self.pick([(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (0.0, -2.0, 0.0), (0.3, 0.6, -0.7)])
            self.call("glRotatef", self.pick([90.0, 180.0, self.number(-360, 360)]), *axis)
        if self.chance(0.2):
            self.call("glScalef", self.number(0.2, 2), self.number(-2, 2), self.number(0.2, 2))
        for name in ("GL_PROJECTION_MATRIX", "GL_MODELVIEW_MATRIX"):
            self.call("glGetFloatv", name)
        self.spread = 3.0

    # --- textures

    def color_texture(self, name: str) -> None:
        width, height = self.pick([1, 2, 3, 4, 7, 8, 16]), self.pick([1, 2, 4, 5, 8, 16])
        texels = self.rng.integers(0, 256, (height, width, 4), dtype=np.uint8)
        self.call("glBindTexture", "GL_TEXTURE_2D", name)
        self.call(
            "glTexImage2D", "GL_TEXTURE_2D", 0, "GL_RGBA8", width, height, 0, "GL_RGBA", "GL_UNSIGNED_BYTE", texels
        )
        self.sampler(["GL_REPEAT", "GL_CLAMP_TO_EDGE", "GL_MIRRORED_REPEAT", "GL_CLAMP_TO_BORDER"])

    def depth_texture(self, name: str) -> None:
        width, height = self.pick([1, 2, 4, 7, 8, 16]), self.pick([1, 2, 4, 5, 8, 16])
        depths = self.rng.random((height, width), dtype=np.float32)
        self.call("glBindTexture", "GL_TEXTURE_2D", name)
        kind = self.pick(["GL_DEPTH_COMPONENT24", "GL_DEPTH_COMPONENT32F"])
        self.call("glTexImage2D", "GL_TEXTURE_2D", 0, kind, width, height, 0, "GL_DEPTH_COMPONENT", "GL_FLOAT", depths)
        self.compare()

    def sampler(self, wraps: list[str]) -> None:
        texture_filter = self.pick(["GL_NEAREST", "GL_LINEAR"])
        for parameter, value in (
            ("GL_TEXTURE_MIN_FILTER", texture_filter),
            ("GL_TEXTURE_MAG_FILTER", texture_filter),
            ("GL_TEXTURE_WRAP_S", self.pick(wraps)),
            ("GL_TEXTURE_WRAP_T", self.pick(wraps)),
        ):
            self.call("glTexParameteri", "GL_TEXTURE_2D", parameter, value)

    def compare(self) -> None:
        self.sampler(["GL_REPEAT", "GL_CLAMP_TO_EDGE"])
        if self.chance(0.8):
            self.call("glTexParameteri", "GL_TEXTURE_2D", "GL_TEXTURE_COMPARE_MODE", "GL_COMPARE_R_TO_TEXTURE")
            function = self.pick(["GL_LEQUAL", *COMPARISONS])
            self.call("glTexParameteri", "GL_TEXTURE_2D", "GL_TEXTURE_COMPARE_FUNC", function)
        mode = self.pick(["GL_LUMINANCE", "GL_INTENSITY", "GL_ALPHA"])
        self.call("glTexParameteri", "GL_TEXTURE_2D", "GL_DEPTH_TEXTURE_MODE", mode)

    def copy_texture(self, name: str) -> None:
        """Copy a part of the framebuffer into a texture, and draw with it."""
        width, height = 16, 8
        internal, pixel_format, pixel_type = self.pick(
            [("GL_RGBA8", "GL_RGBA", "GL_UNSIGNED_BYTE"), ("GL_DEPTH_COMPONENT24", "GL_DEPTH_COMPONENT", "GL_FLOAT")]
        )
        self.call("glBindTexture", "GL_TEXTURE_2D", name)
        image = (internal, width, height, 0, pixel_format, pixel_type, None)
        self.call("glTexImage2D", "GL_TEXTURE_2D", 0, *image)
        if internal == "GL_RGBA8":
            self.sampler(["GL_REPEAT", "GL_CLAMP_TO_EDGE"])
        else:
            self.compare()
        x, y = self.integer(0, self.size[0] - width), self.integer(0, self.size[1] - height)
        self.call("glCopyTexSubImage2D", "GL_TEXTURE_2D", 0, 0, 0, x, y, width, height)
        self.call("glGetTexImage", "GL_TEXTURE_2D", 0, pixel_format, pixel_type)
        self.call("glEnable", "GL_TEXTURE_2D")
        self.texture_coordinates = self.pick([3, 4])
        self.draw(wild=False)

    def shadow_map(self) -> None:
        """Render depth into a texture through a framebuffer object, and leave the texture bound for comparing."""
        width, height = self.pick([(32, 32), (64, 64), (20, 33)])
        kind = self.pick(["GL_DEPTH_COMPONENT24", "GL_DEPTH_COMPONENT24", "GL_DEPTH_COMPONENT32F"])
        self.call("glBindTexture", "GL_TEXTURE_2D", "texture 0")
        image = (kind, width, height, 0, "GL_DEPTH_COMPONENT", "GL_FLOAT", None)
        self.call("glTexImage2D", "GL_TEXTURE_2D", 0, *image)
        self.compare()
        self.call("glBindFramebuffer", "GL_FRAMEBUFFER", "framebuffer 0")
        attachment = ("GL_DEPTH_ATTACHMENT", "GL_TEXTURE_2D", "texture 0", 0)
        self.call("glFramebufferTexture2D", "GL_FRAMEBUFFER", *attachment)
        self.call("glDrawBuffer", "GL_NONE")
        self.call("glReadBuffer", "GL_NONE")
        self.call("glViewport", 0, 0, width, height)
        self.call("glClear", "GL_DEPTH_BUFFER_BIT")
        for _ in range(self.integer(1, 3)):
            self.matrices(rotations=False)
            self.depth_state()
            self.draw(wild=False)
        self.call("glReadPixels", 0, 0, width, height, "GL_DEPTH_COMPONENT", "GL_FLOAT")
        self.call("glBindFramebuffer", "GL_FRAMEBUFFER", 0)
        self.call("glViewport", 0, 0, *self.size)

    # --- drawing and reading

    def draw(self, wild: bool) -> None:
        mode = self.pick(self.primitives)
        count = self.integer(1, 4) * (4 if mode.startswith("GL_QUAD") else 3)
        attributes = self.attributes(count)
        attributes["vertex"] = self.vertices(count, wild)
        if self.chance(0.3):
            self.draw_arrays(mode, attributes)
        else:
            self.draw_immediate(mode, attributes)

    def attributes(self, count: int) -> dict[str, list[Any]]:
        """Return what the vertices have besides a place, each a list with one vector, or None, per vertex."""
        attributes: dict[str, list[Any]] = {
            "color": [self.color() if self.chance(self.colors) else None for _ in range(count)]
        }
        if self.normals:
            turned = self.chance(0.5)  # one normal for all, or one each
            normals = [tuple(self.number(-1, 1) for _ in range(3)) for _ in range(count)]
            attributes["normal"] = normals if turned else [normals[0]] * count
        if self.texture_coordinates:
            plain = min(3, self.texture_coordinates)
            coordinates = [tuple(self.number(-1, 2) for _ in range(plain)) for _ in range(count)]
            if self.texture_coordinates == 4:
                coordinates = [(*head, self.pick([1.0, self.number(0.5, 2)])) for head in coordinates]
            attributes["coordinate"] = coordinates
        if self.second_coordinates:
            attributes["second coordinate"] = [(self.number(-1, 2), self.number(-1, 2)) for _ in range(count)]
        return attributes

    def draw_immediate(self, mode: str, attributes: dict[str, list[Any]]) -> None:
        length = {"GL_POINTS": 1, "GL_LINES": 2, "GL_TRIANGLES": 3, "GL_QUADS": 4}.get(mode, 0)
        apart = length > 0 and self.chance(0.3)  # a pair of glBegin and glEnd for each: drivers draw them as one
        self.call("glBegin", mode)
        for number, vertex in enumerate(attributes["vertex"]):
            if apart and number and number % length == 0:
                self.call("glEnd")
                self.call("glBegin", mode)
            given = {name: values[number] for name, values in attributes.items() if values[number] is not None}
            if "color" in given:
                numbers = self.pick(self.color_sizes)
                self.call(f"glColor{numbers}f", *given["color"][:numbers])
            if "normal" in given:
                self.call("glNormal3f", *given["normal"])
            if "coordinate" in given:
                self.call(f"glTexCoord{len(given['coordinate'])}f", *given["coordinate"])
            if "second coordinate" in given:
                self.call("glMultiTexCoord2f", "GL_TEXTURE1", *given["second coordinate"])
            self.call("glVertex4f", *vertex)
        self.call("glEnd")

    def draw_arrays(self, mode: str, attributes: dict[str, list[Any]]) -> None:
        count = len(attributes["vertex"])
        enabled = []
        for name, values in attributes.items():
            capability, pointer = ARRAYS[name]
            array = np.array([value or (1, 1, 1, 1) for value in values], np.float32)
            if name == "second coordinate":
                self.call("glClientActiveTexture", "GL_TEXTURE1")
            self.call("glEnableClientState", capability)
            size = () if name == "normal" else (array.shape[1],)
            self.call(pointer, *size, "GL_FLOAT", 0, array)
            enabled.append(capability)
        if self.chance(0.5):
            self.call("glDrawArrays", mode, 0, count)
        else:
            indices = self.rng.integers(0, count, count, dtype=np.uint32)
            self.call("glDrawElements", mode, count, "GL_UNSIGNED_INT", indices)
        if "second coordinate" in attributes:
            self.call("glDisableClientState", "GL_TEXTURE_COORD_ARRAY")
            self.call("glClientActiveTexture", "GL_TEXTURE0")
            self.call("glMultiTexCoord2f", "GL_TEXTURE1", 0.5, 0.25)
        for capability in enabled:
            self.call("glDisableClientState", capability)
        # what an array set is undefined after drawing with it
        self.call("glColor4f", *self.color())
        if self.normals:
            self.call("glNormal3f", 0.0, 0.6, 0.8)

    def vertices(self, count: int, wild: bool) -> list[tuple[float, ...]]:
        """Return object coordinates (x, y, z, w) of one kind: ordinary, or one of those that break rasterizers."""
        ordinary = [
            (*(self.number(-1.2 * self.spread, 1.2 * self.spread) for _ in range(3)), 1.0) for _ in range(count)
        ]
        if not wild or self.chance(0.3):
            return ordinary
        return self.pick(WILD)(self, ordinary)

    def read(self) -> None:
        width, height = self.size
        kinds = [
            ("GL_DEPTH_COMPONENT", "GL_FLOAT"),
            ("GL_DEPTH_COMPONENT", "GL_UNSIGNED_INT"),
            ("GL_DEPTH_COMPONENT", "GL_UNSIGNED_SHORT"),
            ("GL_RGBA", "GL_UNSIGNED_BYTE"),
            ("GL_RGB", "GL_FLOAT"),
            ("GL_STENCIL_INDEX", "GL_UNSIGNED_BYTE"),
        ]
        pixel_format, pixel_type = self.pick(kinds if self.reads_stencil else kinds[:-1])
        self.call("glReadPixels", 0, 0, width, height, pixel_format, pixel_type)
