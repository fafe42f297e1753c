"""The camera of a scene: its position, its direction and its clipping planes."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from softshadow.errors import SceneError
from softshadow.scene.validate import set_fields, validate_number, validate_numbers


@dataclass(frozen=True, eq=False, init=False)
class Camera:
    """A perspective camera with the parameters of gluLookAt and gluPerspective.

    Attributes
    ----------
    eye, target, up : (3,) float64     world space
    fov_y : float                      degrees between bottom and top of the picture
    near, far : float                  distances of the clipping planes along the view direction

    Raises
    ------
    SceneError                         eye equal to target, `up` parallel to the view, fov_y, near or far out of range
    """

    eye: np.ndarray
    target: np.ndarray
    up: np.ndarray
    fov_y: float
    near: float
    far: float

    def __init__(
        self,
        eye: ArrayLike,
        target: ArrayLike,
        up: ArrayLike = (0, 1, 0),
        fov_y: float = 45,
        near: float = 0.1,
        far: float = 100,
    ) -> None:
        for key, point in (("eye", eye), ("target", target), ("up", up)):
            set_fields(self, **{key: validate_numbers(f"camera: {key}", point, 3)})
        for key, value in (("fov_y", fov_y), ("near", near), ("far", far)):
            set_fields(self, **{key: validate_number(f"camera: {key}", value)})
        if (self.eye == self.target).all():
            raise SceneError(f"camera: eye and target are both {self.eye.tolist()}; expected two different points")
        if not np.cross(self.target - self.eye, self.up).any():
            raise SceneError(
                f"camera: up {self.up.tolist()} is parallel to the view direction; expected any other direction"
            )
        if not 0 < self.fov_y < 180:
            raise SceneError(f"camera: fov_y: expected degrees between 0 and 180, got {self.fov_y:g}")
        if not 0 < self.near < self.far:
            raise SceneError(f"camera: expected 0 < near < far, got near {self.near:g} and far {self.far:g}")

    @property
    def frame(self) -> np.ndarray:
        """(3, 3) float64: rows are the world directions of eye space x, y and z (right, up, back)."""
        back = self.eye - self.target
        back = back / np.linalg.norm(back)
        right = np.cross(self.up, back)
        right = right / np.linalg.norm(right)
        return np.stack([right, np.cross(back, right), back])

    def near_points(self, window: np.ndarray, size: tuple[int, int]) -> np.ndarray:
        """Return the world points of the near rectangle at window positions.

        Parameters
        ----------
        window : (N, 2) float64      x, y in pixels from the top left corner of the picture, pixel centres at +0.5
        size : (width, height)

        Returns
        -------
        (N, 3) float64               the ray of the pixel starts at the eye and passes this point
        """
        width, height = size
        top = self.near * np.tan(np.radians(self.fov_y) / 2)
        right = top * width / height
        x = (2 * window[:, 0] / width - 1) * right
        y = (1 - 2 * window[:, 1] / height) * top
        eye_space = np.stack([x, y, np.full(len(x), -self.near)], axis=1)
        return self.eye + eye_space @ self.frame
