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


@pytest.mark.parametrize("target", ["GL_PROXY_TEXTURE_2D", "GL_PROXY_TEXTURE_CUBE_MAP"])
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


SHAPES = [(5, 1, 1), (1, 5, 3), (16384, 1, 1), (16385, 1, 1), (2048, 1, 1), (1, 2, 2048), (1, 2, 2049), (0, 2, 3)]


def test_proxies_of_other_dimensions_answer_as_on_mesa() -> None:
    def program(gl: Any) -> list[np.ndarray]:
        answers, layout = [], (0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, None)
        for width, height, depth in SHAPES:
            gl.glTexImage1D(gl.GL_PROXY_TEXTURE_1D, 0, gl.GL_RGBA8, width, *layout)
            gl.glTexImage2D(gl.GL_PROXY_TEXTURE_RECTANGLE, 0, gl.GL_RGBA8, width, height, *layout)
            gl.glTexImage3D(gl.GL_PROXY_TEXTURE_3D, 0, gl.GL_RGBA8, width, height, depth, *layout)
            for target in ("1D", "RECTANGLE", "3D"):
                token = getattr(gl, f"GL_PROXY_TEXTURE_{target}")
                values = [gl.glGetTexLevelParameteriv(token, 0, getattr(gl, f"GL_TEXTURE_{p}")) for p in PROPERTIES]
                answers.append(np.array([int(value) for value in values]))
        return answers

    comparison = compare(program, (4, 4))
    assert comparison, str(comparison)
