"""At which angles silhouette edges cross a light that is a segment: how much rounding matters for what they hide."""

from collections.abc import Sequence

import numpy as np

from softshadow.scene import Light, SceneObject, Segment
from softshadow.scene.light_coverage import light_view, project
from softshadow.scene.penumbra_wedge import silhouette_edges


def slants(casters: Sequence[SceneObject], light: Light, points: np.ndarray) -> np.ndarray:
    """Return the smallest sine (N,) of the angles between the segment and the edges that cross it, seen from points.

    It is 1 where no edge does. An edge that moves aside crosses the segment at another place, the farther off, the
    smaller the angle is.
    """
    smallest = []
    assert isinstance(light.shape, Segment)
    edges = silhouette_edges(casters, light).ends - light.position[:3]
    for point in points - light.position[:3]:
        view = light_view(light.shape, point)
        assert view is not None
        (u0, v0, w0, _), (u1, v1, w1, _) = project(edges, view, point).transpose(1, 2, 0)
        along, across = u1 / w1 - u0 / w0, v1 / w1 - v0 / w0
        smallest.append(np.where(v0 * v1 < 0, np.abs(across) / np.hypot(along, across), 1).min())
    return np.array(smallest)
