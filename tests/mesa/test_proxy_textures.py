"""Proxy textures answer as on Mesa."""

from typing import Any

import numpy as np
import pytest

from softshadow.testing import compare

pytestmark = pytest.mark.mesa

PROPERTIES = ["WIDTH", "HEIGHT", "DEPTH", "BORDER", "INTERNAL_FORMAT", "DEPTH_SIZE"]
PROPERTIES += [f"{channel}_SIZE" for channel in ("RED", "GREEN", "BLUE", "ALPHA", "LUMINANCE", "INTENSITY")]
IMAGES = [  # level, internal format, width, height, border, format, type
    (0, "GL_RGB8", 64, 32, 0, "GL_RGB", "GL_UNSIGNED_BYTE"),
    (3, "GL_RGBA", 64, 64, 0, "GL_RGB", "GL_UNSIGNED_SHORT_5_6_5"),
    (0, "GL_RGBA", 1 << 20, 4, 0, "GL_RGBA", "GL_UNSIGNED_BYTE"),
    (0, "GL_RGBA", 16384, 16384, 0, "GL_RGBA", "GL_UNSIGNED_BYTE"),
    (0, "GL_RGBA32F", 16384, 16384, 0, "GL_RGBA", "GL_FLOAT"),
    (0, "GL_RGBA", -1, 4, 0, "GL_RGBA", "GL_UNSIGNED_BYTE"),
    (0, "GL_LUMINANCE8", 63, 31, 0, "GL_RED", "GL_FLOAT"),
    (0, "GL_POINT", 64, 32, 0, "GL_RGB", "GL_UNSIGNED_BYTE"),
    (0, "GL_RGB", 64, 32, 0, "GL_RGB", "GL_DOUBLE"),
    (0, "GL_RGB", 64, 32, 0, "GL_DEPTH_COMPONENT", "GL_UNSIGNED_BYTE"),
    (20, "GL_RGB", 64, 32, 0, "GL_RGB", "GL_UNSIGNED_BYTE"),
    (14, "GL_RGB", 1, 1, 0, "GL_RGB", "GL_UNSIGNED_BYTE"),
    (0, "GL_RGB", 0, 0, 0, "GL_RGB", "GL_UNSIGNED_BYTE"),
    (0, "GL_DEPTH_COMPONENT24", 64, 32, 0, "GL_DEPTH_COMPONENT", "GL_FLOAT"),
]


@pytest.mark.parametrize("target", ["GL_PROXY_TEXTURE_2D", "GL_PROXY_TEXTURE_RECTANGLE", "GL_PROXY_TEXTURE_CUBE_MAP"])
def test_a_proxy_answers_as_on_mesa(target):
    def program(gl: Any) -> list[np.ndarray]:
        token, answers = getattr(gl, target), []
        for level, internal, width, height, border, pixel_format, kind in IMAGES:
            names = (getattr(gl, pixel_format), getattr(gl, kind))
            answer = []
            try:
                gl.glTexImage2D(token, level, getattr(gl, internal), width, height, border, *names, None)
            except gl.GLError as error:
                answer.append(int(error.err))
                gl.glGetError()
            for name in PROPERTIES:
                value = gl.glGetTexLevelParameteriv(token, min(level, 14), getattr(gl, f"GL_TEXTURE_{name}"))
                answer.append(int(value))
            answers.append(np.array(answer))
        return answers

    comparison = compare(program, (4, 4))
    assert comparison, str(comparison)
