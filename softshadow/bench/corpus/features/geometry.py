"""Features of vertices and of primitives."""

from __future__ import annotations

from typing import Any

from softshadow.bench.corpus.features.feature import Feature, feature, setting


def _mode(name: str) -> Feature:
    return setting(
        f"mode-{name.lower()}", f"polygons drawn as GL_{name}", glPolygonMode=("GL_FRONT_AND_BACK", f"GL_{name}")
    )


def _lights(count: int) -> Feature:
    def prepare(gl: Any) -> None:
        for number in range(1, count):
            gl.glEnable(gl.GL_LIGHT0 + number)
            gl.glLightfv(gl.GL_LIGHT0 + number, gl.GL_DIFFUSE, [0.1, 0.05 * number, 0.2, 1.0])
            gl.glLightfv(gl.GL_LIGHT0 + number, gl.GL_POSITION, [float(number), 2.0, 1.0, float(number % 2)])

    return Feature(f"lights-{count}", f"{count} lights", prepare)


def _clip_planes(count: int) -> Feature:
    def prepare(gl: Any) -> None:
        for number in range(count):
            equation = [(-1.0) ** number if number // 2 == axis else 0.1 for axis in range(3)]
            gl.glClipPlane(gl.GL_CLIP_PLANE0 + number, [*equation, 0.9])
            gl.glEnable(gl.GL_CLIP_PLANE0 + number)

    return Feature(f"clip-planes-{count}", f"{count} clip plane{'s' if count > 1 else ''}", prepare)


def highlight(gl: Any) -> None:
    """A highlight of its own colour, with a local viewer."""
    gl.glLightModeli(gl.GL_LIGHT_MODEL_LOCAL_VIEWER, 1)
    gl.glLightModeli(gl.GL_LIGHT_MODEL_COLOR_CONTROL, gl.GL_SEPARATE_SPECULAR_COLOR)
    gl.glMaterialfv(gl.GL_FRONT_AND_BACK, gl.GL_SPECULAR, [0.7, 0.7, 0.7, 1.0])
    gl.glMaterialf(gl.GL_FRONT_AND_BACK, gl.GL_SHININESS, 30.0)


def spot_light(gl: Any) -> None:
    """A spot light that gets weaker with distance."""
    gl.glLightf(gl.GL_LIGHT0, gl.GL_SPOT_CUTOFF, 30.0)
    gl.glLightf(gl.GL_LIGHT0, gl.GL_SPOT_EXPONENT, 8.0)
    gl.glLightf(gl.GL_LIGHT0, gl.GL_LINEAR_ATTENUATION, 0.1)
    gl.glLightfv(gl.GL_LIGHT0, gl.GL_SPOT_DIRECTION, [-0.3, -0.8, -0.5])


def no_light(gl: Any) -> None:
    """No lighting."""
    gl.glDisable(gl.GL_LIGHTING)


def two_sides(gl: Any) -> None:
    """Lighting of both sides."""
    gl.glLightModeli(gl.GL_LIGHT_MODEL_TWO_SIDE, 1)


FEATURES = (
    *map(_mode, ("LINE", "POINT")),
    *map(_lights, (2, 8)),
    *map(_clip_planes, (1, 6)),
    *map(feature, (highlight, spot_light, no_light, two_sides)),
    setting("flat", "flat shading", glShadeModel=("GL_FLAT",)),
    setting("cull-back", "no back faces", "GL_CULL_FACE"),
    setting("cull-front", "no front faces", "GL_CULL_FACE", glCullFace=("GL_FRONT",)),
    setting("polygon-offset", "a polygon offset", "GL_POLYGON_OFFSET_FILL", glPolygonOffset=(1.0, 2.0)),
    setting("polygon-smooth", "smooth polygons", "GL_POLYGON_SMOOTH"),
    setting("color-sum", "a secondary colour", "GL_COLOR_SUM", glSecondaryColor3f=(0.1, 0.2, 0.3)),
)  # fmt: skip
