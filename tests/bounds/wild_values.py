"""What the arguments of wild sequences are drawn from, and which calls change the state.

Numbers that GL accepts and nobody expects: huge, negative, infinite, NaN; sides of images from 0 on.
"""

from typing import Any

from mesa.random_images import WRAPS
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
