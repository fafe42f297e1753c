"""Valid calls of selection, feedback, evaluators, conditional rendering and GLU's quadrics, as in `facade_calls`."""

from typing import Any

import numpy as np

CURVE = np.array([[0, 0, 0], [0.5, 1, 0], [1, 0, 0]], np.float32)
SURFACE = np.array([[[0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 1]]], np.float32)
INDICES, INDEX_KINDS, BLOCK = np.ones((4, 1), np.float32), ("d", "f", "i", "s", "ub"), np.zeros(8, np.uint8)

# calls of GLU that read memory as large as their other arguments say, or make callbacks: see tests/mesa
OF_GLU = {
    "gluScaleImage", "gluBuild2DMipmaps", "gluBuild2DMipmapLevels", "gluBuild1DMipmaps",
    "gluBuild1DMipmapLevels", "gluBuild3DMipmaps", "gluBuild3DMipmapLevels", "gluUnProject4",
    "gluNewTess", "gluDeleteTess",
    "gluTessProperty", "gluGetTessProperty", "gluTessNormal", "gluTessCallback", "gluTessBeginPolygon",
    "gluTessBeginContour", "gluTessVertex", "gluTessEndContour", "gluTessEndPolygon", "gluBeginPolygon",
    "gluNextContour", "gluEndPolygon",
}  # fmt: skip
MORE_CALLS: dict[str, tuple[Any, ...]] = {
    "glEdgeFlag": (False,), "glEdgeFlagv": ([True],), "glProvokingVertex": ("GL_FIRST_VERTEX_CONVENTION",),
    "glEdgeFlagPointer": (0, np.ones(4, np.uint8)),
    "glSecondaryColorPointer": (3, "GL_FLOAT", 0, np.ones((4, 3), np.float32)),
    "glFogCoordPointer": ("GL_FLOAT", 0, np.ones(4, np.float32)),
    **{f"glSecondaryColor3{kind}": (0.25, 0.5, 1.0) for kind in "fd"},
    **{f"glSecondaryColor3{kind}v": ([0.25, 0.5, 1.0],) for kind in "fd"},
    **{f"glSecondaryColor3{kind}": (1, 2, 3) for kind in ("b", "s", "i", "ub", "us", "ui")},
    **{f"glSecondaryColor3{kind}v": ([1, 2, 3],) for kind in ("b", "s", "i", "ub", "us", "ui")},
    **{f"glFogCoord{kind}": (0.5,) for kind in "fd"}, **{f"glFogCoord{kind}v": ([0.5],) for kind in "fd"},
    "glIndexMask": (7,), "glClearIndex": (3.0,), "glIndexPointer": ("GL_FLOAT", 0, INDICES),
    **{f"glIndex{kind}": (2.5 if kind in "df" else 2,) for kind in INDEX_KINDS},
    **{f"glIndex{kind}v": ([2.5 if kind in "df" else 2],) for kind in INDEX_KINDS},
    **{f"glIndexPointer{kind}": (INDICES,) for kind in ("b", *INDEX_KINDS)},
    "glGetPointerv": ("GL_VERTEX_ARRAY_POINTER",), "glAreTexturesResident": (["@texture"],),
    "glPrioritizeTextures": (1, ["@texture"], [0.5]), "glGetCompressedTexImage": ("GL_TEXTURE_2D", 1),
    "glCompressedTexImage1D": ("GL_TEXTURE_1D", 0, "GL_COMPRESSED_RGB_S3TC_DXT1_EXT", 4, 0, BLOCK),
    "glCompressedTexImage2D": ("GL_TEXTURE_2D", 1, "GL_COMPRESSED_RGB_S3TC_DXT1_EXT", 4, 4, 0, BLOCK),
    "glCompressedTexImage3D": ("GL_TEXTURE_3D", 0, "GL_COMPRESSED_RGB_S3TC_DXT1_EXT", 4, 4, 1, 0, BLOCK),
    "glCompressedTexSubImage1D": ("GL_TEXTURE_1D", 0, 0, 4, "GL_COMPRESSED_RGB_S3TC_DXT1_EXT", BLOCK),
    "glCompressedTexSubImage2D": ("GL_TEXTURE_2D", 1, 0, 0, 4, 4, "GL_COMPRESSED_RGB_S3TC_DXT1_EXT", BLOCK),
    "glCompressedTexSubImage3D": ("GL_TEXTURE_3D", 0, 0, 0, 0, 4, 4, 1, "GL_COMPRESSED_RGB_S3TC_DXT1_EXT", BLOCK),
    "glRenderMode": ("GL_RENDER",), "glSelectBuffer": (16,), "glFeedbackBuffer": (16, "GL_3D"),
    "glPassThrough": (1.5,), "glInitNames": (), "glLoadName": (3,), "glPushName": (3,), "glPopName": (),
    "glBeginConditionalRender": ("@query", "GL_QUERY_WAIT"), "glEndConditionalRender": (),
    "glEvalPoint1": (1,), "glEvalPoint2": (1, 2), "glEvalMesh1": ("GL_LINE", 0, 2),
    "glEvalMesh2": ("GL_FILL", 0, 2, 0, 2),
    "gluPickMatrix": (4.0, 3.0, 2.0, 1.5, [0, 0, 16, 12]), "gluNewQuadric": (), "gluDeleteQuadric": ("@old_quadric",),
    "gluQuadricDrawStyle": ("@quadric", "GLU_LINE"), "gluQuadricNormals": ("@quadric", "GLU_FLAT"),
    "gluQuadricOrientation": ("@quadric", "GLU_INSIDE"), "gluQuadricTexture": ("@quadric", True),
    "gluQuadricCallback": ("@quadric", 100103, abs), "gluSphere": ("@quadric", 0.5, 4, 3),
    "gluCylinder": ("@quadric", 0.5, 0.25, 1.0, 4, 2), "gluDisk": ("@quadric", 0.25, 0.5, 4, 2),
    "gluPartialDisk": ("@quadric", 0.25, 0.5, 4, 2, 30.0, 60.0),
    "gluErrorString": (1280,), "gluGetString": (100800,), "gluCheckExtension": (b"two", b"one two three"),
    **{f"glMap1{kind}": ("GL_MAP1_VERTEX_3", 0.0, 1.0, CURVE.astype(kind)) for kind in "fd"},
    **{f"glMap2{kind}": ("GL_MAP2_VERTEX_3", 0.0, 1.0, 0.0, 1.0, SURFACE.astype(kind)) for kind in "fd"},
    **{f"glMapGrid1{kind}": (3, 0.0, 1.0) for kind in "fd"},
    **{f"glMapGrid2{kind}": (3, 0.0, 1.0, 2, 0.0, 1.0) for kind in "fd"},
    **{f"glEvalCoord1{kind}": (0.5,) for kind in "fd"}, **{f"glEvalCoord1{kind}v": ([0.5],) for kind in "fd"},
    **{f"glEvalCoord2{kind}": (0.5, 0.25) for kind in "fd"},
    **{f"glEvalCoord2{kind}v": ([0.5, 0.25],) for kind in "fd"},
    **{
        f"glGetMap{kind}v": ("GL_MAP1_VERTEX_3", "GL_DOMAIN", np.zeros(90, dtype))
        for kind, dtype in (("f", np.float32), ("d", np.float64), ("i", np.int32))
    },
}  # fmt: skip
