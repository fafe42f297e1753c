"""Every 4x4 matrix of the course: M @ v with column vectors, angles in degrees."""

import numpy as np


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
