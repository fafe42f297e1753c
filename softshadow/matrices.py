"""Every 4x4 matrix of the course: M @ v with column vectors, angles in degrees.

The makers of GL's own matrices give, in float32, the bits of Mesa 22.3.6: each operation is rounded on its own, in the
order written there; with ``real=numpy.float64`` they are as exact as that goes.
"""

import ctypes
import ctypes.util
import math
from collections.abc import Callable, Sequence
from functools import cache

import numpy as np

Real = type[np.floating]
FLOAT: Real = np.float32
# overflow is as good as any number in GL, where it makes infinities without a word
silent = np.errstate(all="ignore")
NO_LENGTH = 1e-4  # an axis shorter than this is none (Mesa, math/m_matrix.c)


@silent
def multiply(left: np.ndarray, right: np.ndarray) -> np.ndarray:
    """Return ``left @ right`` (4, 4) in GL's order: ((l0 r0 + l1 r1) + l2 r2) + l3 r3, nothing fused."""
    product = left[:, 0:1] * right[0] + left[:, 1:2] * right[1]
    product += left[:, 2:3] * right[2]
    product += left[:, 3:4] * right[3]
    return product


@silent
def translate(base: np.ndarray, x: float, y: float, z: float) -> np.ndarray:
    """Return `base` times a translation, as glTranslate computes it."""
    real = base.dtype.type
    made = base.copy()
    made[:, 3] = ((base[:, 0] * real(x) + base[:, 1] * real(y)) + base[:, 2] * real(z)) + base[:, 3]
    return made


@silent
def scale(base: np.ndarray, x: float, y: float, z: float) -> np.ndarray:
    """Return `base` times a scale, as glScale computes it."""
    return base * np.array([x, y, z, 1], base.dtype)


@silent
def rotation(angle: float, x: float, y: float, z: float, real: Real = FLOAT) -> np.ndarray:
    """Return glRotate's matrix: `angle` degrees about the axis (x, y, z); a turn about a coordinate axis is exact
    there.

    Sine and cosine are the C library's in single precision: NumPy's differ in the last place.
    """
    sine, cosine = _sine_and_cosine(angle, real)
    return _rotation(sine, cosine, real(x), real(y), real(z))


def _rotation(sine: np.floating, cosine: np.floating, x: np.floating, y: np.floating, z: np.floating) -> np.ndarray:
    real = type(x)
    made = np.eye(4, dtype=real)
    if not x and not y and z:
        _turn(made, 0, 1, cosine, sine if z > 0 else -sine)
    elif not x and not z and y:
        _turn(made, 2, 0, cosine, sine if y > 0 else -sine)
    elif x and not y and not z:
        _turn(made, 1, 2, cosine, sine if x > 0 else -sine)
    else:
        length = np.sqrt(x * x + y * y + z * z)
        if length <= real(NO_LENGTH):
            return made
        x, y, z = x / length, y / length, z / length
        rest = real(1) - cosine
        made[0, :3] = rest * (x * x) + cosine, rest * (x * y) - z * sine, rest * (z * x) + y * sine
        made[1, :3] = rest * (x * y) + z * sine, rest * (y * y) + cosine, rest * (y * z) - x * sine
        made[2, :3] = rest * (z * x) - y * sine, rest * (y * z) + x * sine, rest * (z * z) + cosine
    return made


def _turn(made: np.ndarray, i: int, j: int, cosine: np.floating, sine: np.floating) -> None:
    made[i, i] = made[j, j] = cosine
    made[i, j], made[j, i] = -sine, sine


def _sine_and_cosine(angle: float, real: Real) -> tuple[np.floating, np.floating]:
    radians = float(real(angle)) * math.pi / 180
    if real is np.float64:
        return np.float64(math.sin(radians)), np.float64(math.cos(radians))
    sinf, cosf = _single_precision_functions()
    return real(sinf(radians)), real(cosf(radians))


@cache
def _single_precision_functions() -> tuple[Callable[[float], float], Callable[[float], float]]:
    """Return the C library's sinf and cosf; where there is none, the rounded double precision ones."""
    try:
        library = ctypes.CDLL(ctypes.util.find_library("m") or "libm.so.6")
        functions = library.sinf, library.cosf
    except (OSError, AttributeError):
        return math.sin, math.cos
    for function in functions:
        function.restype, function.argtypes = ctypes.c_float, [ctypes.c_float]
    return functions


@silent
def frustum(
    left: float, right: float, bottom: float, top: float, near: float, far: float, real: Real = FLOAT
) -> np.ndarray:
    """Return glFrustum's matrix."""
    l, r, b, t, n, f = (real(v) for v in (left, right, bottom, top, near, far))  # noqa: E741 - GL's own letters
    made = np.zeros((4, 4), real)
    made[0, 0], made[0, 2] = (real(2) * n) / (r - l), (r + l) / (r - l)
    made[1, 1], made[1, 2] = (real(2) * n) / (t - b), (t + b) / (t - b)
    made[2, 2], made[2, 3] = -(f + n) / (f - n), -((real(2) * f) * n) / (f - n)
    made[3, 2] = -1
    return made


@silent
def ortho(
    left: float, right: float, bottom: float, top: float, near: float, far: float, real: Real = FLOAT
) -> np.ndarray:
    """Return glOrtho's matrix."""
    l, r, b, t, n, f = (real(v) for v in (left, right, bottom, top, near, far))  # noqa: E741 - GL's own letters
    made = np.eye(4, dtype=real)
    made[0, 0], made[0, 3] = real(2) / (r - l), -(r + l) / (r - l)
    made[1, 1], made[1, 3] = real(2) / (t - b), -(t + b) / (t - b)
    made[2, 2], made[2, 3] = -real(2) / (f - n), -(f + n) / (f - n)
    return made


@silent
def perspective(fov_y: float, aspect: float, near: float, far: float, real: Real = FLOAT) -> np.ndarray:
    """Return gluPerspective's matrix: in double precision, then rounded. `fov_y` in degrees."""
    radians = fov_y / 2 * math.pi / 180
    focal = math.cos(radians) / math.sin(radians)
    made = np.zeros((4, 4))
    made[0, 0], made[1, 1] = focal / aspect, focal
    made[2, 2], made[2, 3] = -(far + near) / (far - near), -2 * near * far / (far - near)
    made[3, 2] = -1
    return made.astype(real)


@silent
def look_at(base: np.ndarray, eye: Sequence[float], center: Sequence[float], up: Sequence[float]) -> np.ndarray:
    """Return `base` times gluLookAt's matrix: a rotation in the precision of `base`, then a translation by -eye."""
    real = base.dtype.type
    forward = _normalized((np.asarray(center, np.float64) - np.asarray(eye, np.float64)).astype(real))
    side = _normalized(_cross(forward, np.asarray(up, np.float64).astype(real)))
    made = np.eye(4, dtype=real)
    made[0, :3], made[1, :3], made[2, :3] = side, _cross(side, forward), -forward
    return translate(multiply(base, made), *(-float(v) for v in eye))


def _normalized(v: np.ndarray) -> np.ndarray:
    length = np.sqrt((v[0] * v[0] + v[1] * v[1]) + v[2] * v[2])
    return v / length if length else v


def _cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]], a.dtype)


def planar_shadow(plane: np.ndarray, light: np.ndarray) -> np.ndarray:
    """Return the matrix that flattens a point onto a plane along the ray from a light.

    S(Λ) = (π·Λ) I − Λ πᵀ, with the plane turned so that π·Λ > 0: a point then keeps w' > 0 as long as it is on the
    plane's side of the light, and the pipeline draws it; with the other sign it would clip everything away.

    Parameters
    ----------
    plane : (4,)                 π = (a, b, c, d), points with a·x + b·y + c·z + d = 0, either orientation
    light : (4,)                 Λ homogeneous: (L, 1) a point, (D, 0) the direction D towards the light

    Returns
    -------
    (4, 4) float64               S·S = (π·Λ)·S; S P is on the plane, on the line through P and the light

    Raises
    ------
    ValueError                   the light lies in the plane: there is no such matrix

    References
    ----------
    Blinn 1988, "Me and my (fake) shadow".
    """
    plane, light = np.asarray(plane, np.float64), np.asarray(light, np.float64)
    height = float(plane @ light)
    if height == 0:
        raise ValueError(f"planar_shadow: the light {light.tolist()} lies in the plane {plane.tolist()}")
    if height < 0:
        plane, height = -plane, -height
    return height * np.eye(4) - np.outer(light, plane)


def infinite_perspective(fov_y: float, aspect: float, near: float) -> np.ndarray:
    """Return the projection of gluPerspective in the limit of an infinitely far far plane.

    Points at infinity (w = 0) get the depth 1 and are kept, as shadow volumes need it.

    Parameters
    ----------
    fov_y : float                degrees
    aspect : float               width / height
    near : float                 distance of the near plane

    Returns
    -------
    (4, 4) float64

    References
    ----------
    Everitt & Kilgard 2002, "Practical and robust stenciled shadow volumes", sec. 3.
    """
    focal = 1 / np.tan(np.radians(fov_y) / 2)
    return np.array([[focal / aspect, 0, 0, 0], [0, focal, 0, 0], [0, 0, -1, -2 * near], [0, 0, -1, 0]])
