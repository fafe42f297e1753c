"""Sample patterns in the unit square and cube, from which points of area lights are made."""

import numpy as np

# Joe & Kuo 2008, "Constructing Sobol sequences with better two-dimensional projections": degree s and coefficients a of
# the primitive polynomial, and the first direction numbers m, of the second and the third dimension
SOBOL = ((1, 0, (1,)), (2, 1, (1, 3)))
BITS = 32


def strata(n: int, columns: int, inside: np.ndarray) -> np.ndarray:
    """Return one point in each of n parts of the unit square that have equal areas.

    The square is divided into columns, and each column into parts of equal height. The first columns have one part
    more, and are wider, if n is not divisible.

    Parameters
    ----------
    inside : (n, 2) float64      place within each part, 0 to 1

    Returns
    -------
    (n, 2) float64               column by column
    """
    parts = np.full(columns, n // columns)
    parts[: n % columns] += 1
    left = np.concatenate([[0], np.cumsum(parts)])[:-1]
    column = np.repeat(np.arange(columns), parts)
    row = np.arange(n) - left[column]
    u = (left[column] + inside[:, 0] * parts[column]) / n
    return np.stack([u, (row + inside[:, 1]) / parts[column]], axis=1)


def sobol(n: int, dimensions: int, seed: int) -> np.ndarray:
    """Return the first n points (n, dimensions) of the Sobol sequence, shifted by random bits; up to 3 dimensions.

    References
    ----------
    Sobol 1967; Antonov & Saleev 1979 (Gray code order is not used, so the first 2**k points are the same set).
    """
    index = np.arange(n, dtype=np.uint64)
    shifts = np.random.default_rng(seed).integers(0, 1 << BITS, dimensions, dtype=np.uint64)
    points = np.empty((n, dimensions))
    for dimension in range(dimensions):
        values = np.full(n, shifts[dimension])
        for bit, direction in enumerate(_direction_numbers(dimension)):
            values ^= ((index >> np.uint64(bit)) & np.uint64(1)) * np.uint64(direction)
        points[:, dimension] = values.astype(np.float64) / (1 << BITS)
    return points


def _direction_numbers(dimension: int) -> list[int]:
    """Return the numbers v_1, v_2 ... of Joe & Kuo, scaled to BITS bits; dimension 0 is van der Corput's."""
    if dimension == 0:
        return [1 << (BITS - 1 - bit) for bit in range(BITS)]
    degree, coefficients, first = SOBOL[dimension - 1]
    m = list(first)
    for k in range(degree, BITS):
        new = m[k - degree] ^ (m[k - degree] << degree)
        for i in range(1, degree):
            if coefficients >> (degree - 1 - i) & 1:
                new ^= m[k - i] << i
        m.append(new)
    return [m[bit] << (BITS - 1 - bit) for bit in range(BITS)]


def square_to_disc(points: np.ndarray) -> np.ndarray:
    """Return points (n, 2) of the unit square moved to the unit disc around 0; equal areas stay equal.

    Squares around the centre become circles, so that neighbours stay neighbours.

    References
    ----------
    Shirley & Chiu 1997, "A low distortion map between disk and square".
    """
    a, b = (2 * points - 1).T
    radius = np.where(np.abs(a) > np.abs(b), a, b)
    ratio = np.divide(np.where(radius == a, b, a), radius, out=np.zeros(len(points)), where=radius != 0)
    angle = np.pi / 4 * np.where(np.abs(a) > np.abs(b), ratio, 2 - ratio)
    return np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)


def cube_to_ball(points: np.ndarray) -> np.ndarray:
    """Return points (n, 3) of the unit cube moved into the unit ball, so that from every side they fill a disc evenly.

    The density at distance r is proportional to 1 / sqrt(1 - r r): its integral along any line through the ball is the
    same. Points spread evenly over the surface would crowd at the rim of the disc, and points spread evenly in the ball
    at its centre.
    """
    # the share of points within r is (2 / pi) (t - sin t cos t) with r = sin t; solved for t by bisection
    low, high = np.zeros(len(points)), np.full(len(points), np.pi / 2)
    for _ in range(50):
        middle = (low + high) / 2
        is_below = middle - np.sin(middle) * np.cos(middle) < np.pi / 2 * points[:, 2]
        low, high = np.where(is_below, middle, low), np.where(is_below, high, middle)
    distance = np.sin(low)
    height, angle = 2 * points[:, 0] - 1, 2 * np.pi * points[:, 1]
    across = np.sqrt(1 - height**2)
    return distance[:, None] * np.stack([across * np.cos(angle), across * np.sin(angle), height], axis=1)
