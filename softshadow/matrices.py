"""Every 4x4 matrix of the course: M @ v with column vectors, angles in degrees.

In float32, GL's own matrices have the bits of Mesa 22.3.6: each operation is rounded separately, in Mesa's order. With
``real=numpy.float64`` they are computed in double precision.
"""

import ctypes
import ctypes.util
import math
from collections.abc import Callable, Sequence
from ctypes import c_float
from functools import cache, lru_cache

import numpy as np

Real = type[np.floating]
FLOAT: Real = np.float32
# in GL, overflow gives infinities without an error
silent = np.errstate(all="ignore")
LEAST_W = 1 / 1024  # of `receiver_view`: this share of the way from the light to the receiver's plane is cut off
SHORTEST_AXIS = 1e-4  # glRotate ignores an axis that is not longer (Mesa, math/m_matrix.c)


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
    product = base.copy()
    product[:, 3] = ((base[:, 0] * real(x) + base[:, 1] * real(y)) + base[:, 2] * real(z)) + base[:, 3]
    return product


@silent
def scale(base: np.ndarray, x: float, y: float, z: float) -> np.ndarray:
    """Return `base` times a scale, as glScale computes it."""
    return base * np.array([x, y, z, 1], base.dtype)


@silent
def rotation(angle: float, x: float, y: float, z: float, real: Real = FLOAT) -> np.ndarray:
    """Return glRotate's matrix: `angle` degrees about the axis (x, y, z).

    A rotation about a coordinate axis has exact zeros and ones. Sine and cosine are the C library's single precision
    functions: NumPy's differ in the last bit.
    """
    sine, cosine = sine_and_cosine(angle, real is np.float32)
    return rotation_of(real(sine), real(cosine), real(x), real(y), real(z))


def rotation_of(sine: np.floating, cosine: np.floating, x: np.floating, y: np.floating, z: np.floating) -> np.ndarray:
    """Return glRotate's matrix for the sine and cosine of its angle, in their precision."""
    real = type(x)
    matrix = np.eye(4, dtype=real)
    if not x and not y and z:
        _set_rotation(matrix, 0, 1, cosine, sine if z > 0 else -sine)
    elif not x and not z and y:
        _set_rotation(matrix, 2, 0, cosine, sine if y > 0 else -sine)
    elif x and not y and not z:
        _set_rotation(matrix, 1, 2, cosine, sine if x > 0 else -sine)
    else:
        length = np.sqrt(x * x + y * y + z * z)
        if length <= real(SHORTEST_AXIS):
            return matrix
        x, y, z = x / length, y / length, z / length
        versine = real(1) - cosine
        matrix[0, :3] = versine * (x * x) + cosine, versine * (x * y) - z * sine, versine * (z * x) + y * sine
        matrix[1, :3] = versine * (x * y) + z * sine, versine * (y * y) + cosine, versine * (y * z) - x * sine
        matrix[2, :3] = versine * (z * x) - y * sine, versine * (y * z) + x * sine, versine * (z * z) + cosine
    return matrix


def _set_rotation(matrix: np.ndarray, i: int, j: int, cosine: np.floating, sine: np.floating) -> None:
    matrix[i, i] = matrix[j, j] = cosine
    matrix[i, j], matrix[j, i] = -sine, sine


@lru_cache(maxsize=4096)
def sine_and_cosine(angle: float, single: bool) -> tuple[float, float]:
    """Return sine and cosine of an angle in degrees; if `single`, the angle and both are rounded to float32."""
    radians = _finite((c_float(angle).value if single else float(angle)) * math.pi / 180)
    if not single:
        return math.sin(radians), math.cos(radians)
    sinf, cosf = _single_precision_functions()
    return sinf(radians), cosf(radians)


def _finite(radians: float) -> float:
    """Return a finite angle, or NaN: in C, sine and cosine of infinity are NaN; in Python they are an error."""
    return radians if math.isfinite(radians) else math.nan


@cache
def _single_precision_functions() -> tuple[Callable[[float], float], Callable[[float], float]]:
    """Return the C library's sinf and cosf; without them, Python's double precision functions."""
    try:
        try:
            library = ctypes.CDLL("libm.so.6")  # find_library would start a process
        except OSError:
            library = ctypes.CDLL(ctypes.util.find_library("m") or "libm.so.6")
        functions = library.sinf, library.cosf
    except (OSError, AttributeError):
        return math.sin, math.cos
    for function in functions:
        function.restype, function.argtypes = c_float, [c_float]
    return functions


@silent
def frustum(
    left: float, right: float, bottom: float, top: float, near: float, far: float, real: Real = FLOAT
) -> np.ndarray:
    """Return glFrustum's matrix."""
    l, r, b, t, n, f = (real(v) for v in (left, right, bottom, top, near, far))  # noqa: E741 - GL's own letters
    matrix = np.zeros((4, 4), real)
    matrix[0, 0], matrix[0, 2] = (real(2) * n) / (r - l), (r + l) / (r - l)
    matrix[1, 1], matrix[1, 2] = (real(2) * n) / (t - b), (t + b) / (t - b)
    matrix[2, 2], matrix[2, 3] = -(f + n) / (f - n), -((real(2) * f) * n) / (f - n)
    matrix[3, 2] = -1
    return matrix


@silent
def ortho(
    left: float, right: float, bottom: float, top: float, near: float, far: float, real: Real = FLOAT
) -> np.ndarray:
    """Return glOrtho's matrix."""
    l, r, b, t, n, f = (real(v) for v in (left, right, bottom, top, near, far))  # noqa: E741 - GL's own letters
    matrix = np.eye(4, dtype=real)
    matrix[0, 0], matrix[0, 3] = real(2) / (r - l), -(r + l) / (r - l)
    matrix[1, 1], matrix[1, 3] = real(2) / (t - b), -(t + b) / (t - b)
    matrix[2, 2], matrix[2, 3] = -real(2) / (f - n), -(f + n) / (f - n)
    return matrix


@silent
def perspective(fov_y: float, aspect: float, near: float, far: float, real: Real = FLOAT) -> np.ndarray:
    """Return gluPerspective's matrix, computed in double precision and then rounded; `fov_y` in degrees."""
    return perspective_of(*perspective_elements(fov_y, aspect, near, far), real=real)


def perspective_elements(fov_y: float, aspect: float, near: float, far: float) -> tuple[float, float, float, float]:
    """Return the elements (0, 0), (1, 1), (2, 2) and (2, 3) of gluPerspective's matrix, in double precision."""
    radians = _finite(fov_y / 2 * math.pi / 180)
    focal = math.cos(radians) / math.sin(radians)
    depth = far - near
    return focal / aspect, focal, -(far + near) / depth, -2 * near * far / depth


def perspective_of(x_scale: float, y_scale: float, z_scale: float, z_shift: float, real: Real = FLOAT) -> np.ndarray:
    """Return the perspective projection with these elements, and w = -z."""
    matrix = np.zeros((4, 4))
    matrix[0, 0], matrix[1, 1] = x_scale, y_scale
    matrix[2, 2], matrix[2, 3] = z_scale, z_shift
    matrix[3, 2] = -1
    return matrix.astype(real)


@silent
def look_at(base: np.ndarray, eye: Sequence[float], center: Sequence[float], up: Sequence[float]) -> np.ndarray:
    """Return `base` times gluLookAt's matrix: a rotation in the precision of `base`, then a translation by -eye."""
    real = base.dtype.type
    forward = _normalized((np.asarray(center, np.float64) - np.asarray(eye, np.float64)).astype(real))
    side = _normalized(_cross(forward, np.asarray(up, np.float64).astype(real)))
    matrix = np.eye(4, dtype=real)
    matrix[0, :3], matrix[1, :3], matrix[2, :3] = side, _cross(side, forward), -forward
    return translate(multiply(base, matrix), *(-float(v) for v in eye))


def _normalized(v: np.ndarray) -> np.ndarray:
    length = np.sqrt((v[0] * v[0] + v[1] * v[1]) + v[2] * v[2])
    return v / length if length else v


def _cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]], a.dtype)


def receiver_view(world_to_receiver: np.ndarray, plane: np.ndarray, light: np.ndarray, highest: float) -> np.ndarray:
    """Return the projection that sees a flat receiver from a light; the receiver's outline fills the clip volume.

    It is the planar shadow matrix followed by the receiver's own coordinates, and its depths are so that clipping
    leaves what casts properly: depth -1 is the receiver's plane, 1 almost the light. What lies behind the plane would
    cast a false shadow, and what lies behind the light an anti-shadow; both are outside.

    Parameters
    ----------
    world_to_receiver : (4, 4)   world space to (u, v, 0, 1); 0 <= u, v <= 1 is the receiver's outline
    plane : (4,)                 of the receiver, with a normal of length 1; either orientation
    light : (4,)                 (L, 1) a point, (D, 0) the direction towards the light
    highest : float              for a direction: distance from the plane at which casters are cut off, in world units

    Returns
    -------
    (4, 4) float64

    Raises
    ------
    ValueError                   the light lies in the plane

    References
    ----------
    Heckbert & Herf 1997, "Simulating soft shadows with graphics hardware", CMU-CS-97-104.
    """
    flattened = planar_shadow(plane, light)
    oriented = np.asarray(plane, np.float64) * np.sign(plane @ light)
    height = float(oriented @ light)
    view = world_to_receiver @ flattened / height
    # for a point light, 1 - w is the share of the way from the plane to the light, and z w = (1 - w) / (1/least - 1)
    view[2] = oriented / (highest if light[3] == 0 else height / light[3] * (1 / LEAST_W - 1))
    to_clip = np.diag([2.0, 2.0, 2.0, 1.0])
    to_clip[:3, 3] = -1
    return np.asarray(to_clip @ view)


def planar_shadow(plane: np.ndarray, light: np.ndarray) -> np.ndarray:
    """Return the matrix that flattens a point onto a plane along the ray from a light.

    S(Λ) = (π·Λ) I − Λ πᵀ, with π oriented so that π·Λ > 0. Points on the plane's side of the light then keep w' > 0
    and are drawn; with the other sign, all of them would be clipped.

    Parameters
    ----------
    plane : (4,)                 π = (a, b, c, d): points with a·x + b·y + c·z + d = 0; either orientation
    light : (4,)                 Λ homogeneous: (L, 1) a point, (D, 0) the direction D towards the light

    Returns
    -------
    (4, 4) float64               S·S = (π·Λ)·S; S P lies in the plane, on the line through P and the light

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
    """Return gluPerspective's matrix with the far plane at infinity.

    Points at infinity (w = 0) get depth 1 and are not clipped, as shadow volumes need.

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
