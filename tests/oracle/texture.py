"""Texture sampling, one coordinate at a time in NumPy scalars (float32), from the rules of the sampler.

Imports nothing from the package. Texels outside the image have the border colour.
"""

import numpy as np

F = np.float32
HALF, ONE = F(0.5), F(1)


def nearest(s: np.float32, size: int, wrap: str) -> int:
    """Return the texel on one axis; -1 and `size` are the border."""
    if wrap == "GL_REPEAT":
        if bin(size).count("1") == 1:
            return int(np.floor(s * F(size))) % size
        return int(min(s - np.floor(s), F(1) - F(2) ** -24) * F(size))
    if wrap == "GL_MIRRORED_REPEAT":
        return min(int(mirror(s) * F(size)), size - 1)
    texel = int(np.floor(s * F(size)))
    if wrap == "GL_CLAMP_TO_BORDER":
        return max(-1, min(texel, size))
    return max(0, min(texel, size - 1))


def mirror(s: np.float32) -> np.float32:
    half = s * HALF
    fraction = half - np.rint(half)
    return abs(fraction + fraction)


def pair(s: np.float32, size: int, wrap: str) -> tuple[int, int, np.float32]:
    """Return the two texels on one axis and the weight of the second."""
    power_of_two = bin(size).count("1") == 1
    if wrap == "GL_REPEAT":
        u = (s if power_of_two else s - np.floor(s)) * F(size) - HALF
    elif wrap == "GL_MIRRORED_REPEAT":
        u = mirror(s) * F(size) - HALF
    elif wrap == "GL_CLAMP_TO_EDGE":
        u = max(min(s * F(size), F(size)) - HALF, F(0))
    elif wrap == "GL_CLAMP":
        u = min(max(s * F(size), F(0)), F(size)) - HALF
    else:
        u = s * F(size) - HALF
    first = int(np.floor(u))
    second, weight = first + 1, F(u - np.floor(u))
    if wrap == "GL_REPEAT":
        return first % size, second % size, weight
    if wrap in ("GL_MIRRORED_REPEAT", "GL_CLAMP_TO_EDGE"):
        return max(first, 0), min(second, size - 1), weight
    return first, second, weight


def fixed_pair(s: np.float32, size: int, wrap: str) -> tuple[int, int, int]:
    """Return the two texels on one axis and the weight of the second in 1/256."""
    if wrap == "GL_REPEAT" and bin(size).count("1") != 1:
        k = int(np.rint((s - np.floor(s)) * F(size) * F(256))) - 128
    else:
        k = int(np.rint(s * F(256 * size))) - 128
    first, weight = divmod(k, 256)
    if wrap == "GL_REPEAT":
        return first % size, (first + 1) % size, weight
    return max(0, min(first, size - 1)), max(0, min(first + 1, size - 1)), weight


def texel(image: np.ndarray, i: int, j: int, border: np.ndarray) -> np.ndarray:
    height, width = image.shape[:2]
    return image[j, i] if 0 <= i < width and 0 <= j < height else border


def lerp(weight: np.float32, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return weight * (b - a) + a


def sample(image: np.ndarray, s: np.float32, t: np.float32, wraps: tuple[str, str], linear: bool, border: np.ndarray):
    """Return the channels (C,) of a float32 image (H, W, C) at one coordinate."""
    height, width = image.shape[:2]
    if not linear:
        return texel(image, nearest(s, width, wraps[0]), nearest(t, height, wraps[1]), border)
    i0, i1, x = pair(s, width, wraps[0])
    j0, j1, y = pair(t, height, wraps[1])
    rows = [lerp(x, texel(image, i0, j, border), texel(image, i1, j, border)) for j in (j0, j1)]
    return lerp(y, *rows)


def sample_fixed(image: np.ndarray, s: np.float32, t: np.float32, wraps: tuple[str, str]) -> np.ndarray:
    """Return the channels (C,) uint8 of a uint8 image (H, W, C), filtered in integers."""
    i0, i1, x = fixed_pair(s, image.shape[1], wraps[0])
    j0, j1, y = fixed_pair(t, image.shape[0], wraps[1])

    def lerp8(weight: int, a: np.ndarray, b: np.ndarray) -> np.ndarray:
        return a + (weight * (b - a) * 128 + 2**14) // 2**15

    cells = image.astype(np.int64)
    return lerp8(y, *(lerp8(x, cells[j, i0], cells[j, i1]) for j in (j0, j1)))


TESTS = {
    "GL_NEVER": lambda r, d: False,
    "GL_LESS": lambda r, d: r < d,
    "GL_EQUAL": lambda r, d: r == d,
    "GL_LEQUAL": lambda r, d: r <= d,
    "GL_GREATER": lambda r, d: r > d,
    "GL_NOTEQUAL": lambda r, d: r != d,
    "GL_GEQUAL": lambda r, d: r >= d,
    "GL_ALWAYS": lambda r, d: True,
}


def compare(
    depths: np.ndarray, s: np.float32, t: np.float32, r: np.float32, wraps: tuple[str, str], linear: bool, func: str,
    border: np.float32,
) -> np.float32:  # fmt: skip
    """Return the weighted share of texels that pass the comparison; depths (H, W) float32 in [0, 1]."""
    height, width = depths.shape
    r = min(max(r, F(0)), F(1))

    def passed(i: int, j: int) -> bool:
        return TESTS[func](r, texel(depths, i, j, border))

    if not linear:
        return F(passed(nearest(s, width, wraps[0]), nearest(t, height, wraps[1])))
    i0, i1, x = pair(s, width, wraps[0])
    j0, j1, y = pair(t, height, wraps[1])
    lower, upper = (F(0) + (x if passed(i1, j) else F(0)) + ((ONE - x) if passed(i0, j) else F(0)) for j in (j0, j1))
    return lerp(y, lower, upper)
