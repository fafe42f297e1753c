"""What each penumbra wedge takes of a light or gives back at one pixel, computed again in float64."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from softshadow.scene import Light, Scene
from softshadow.scene.light_coverage import edge_shares
from softshadow.scene.penumbra_wedge import PenumbraWedges, penumbra_wedges, silhouette_edges

WORTH_SAYING = 0.005  # smaller shares are only counted in the sentence


@dataclass(frozen=True, eq=False)
class WedgeContribution:
    """One silhouette edge and its share of a light.

    Attributes
    ----------
    number : int                 of the edge among all silhouette edges of the light, in drawing order
    caster : str
    ends : (2, 3) float64        of the edge, world space
    share : float                of the light: taken if positive, given back if negative
    wedge : PenumbraWedges       its wedge, with the planes and points of each step of the construction
    """

    number: int
    caster: str
    ends: np.ndarray
    share: float
    wedge: PenumbraWedges

    def __str__(self) -> str:
        verb = "takes" if self.share > 0 else "gives back"
        return f"wedge {self.number} of {self.caster} {verb} {abs(self.share):.2g}"


@dataclass(frozen=True, eq=False)
class WedgeContributions:
    """Why a point sees as much of a light as it does: the hard count, and the contributions of the wedges.

    Attributes
    ----------
    light : str
    point : (3,) float64         world space
    count : float                casting faces between the point and the light's centre
    contributions : tuple        all that are not 0, the largest first
    """

    light: str
    point: np.ndarray
    count: float
    contributions: tuple[WedgeContribution, ...]

    @property
    def coverage(self) -> float:
        """Count and shares together: may be less than 0 and more than 1."""
        return self.count + sum(each.share for each in self.contributions)

    @property
    def visibility(self) -> float:
        """The share of the light that is visible, 0 to 1."""
        return float(np.clip(1 - self.coverage, 0, 1))

    def __str__(self) -> str:
        covered = f"{self.count:g} volumes cover it" if self.count > 1 else "a volume covers it" if self.count else ""
        large = [str(each) for each in self.contributions if abs(each.share) >= WORTH_SAYING]
        rest = len(self.contributions) - len(large)
        reasons = ([covered] if covered else []) + large + ([f"and {rest} less than {WORTH_SAYING}"] if rest else [])
        because = ": " + ", ".join(reasons) if reasons else ""
        return f"{self.visibility:.2g} of {self.light} is visible{because}."


def wedge_contributions(scene: Scene, light: Light, point: np.ndarray, count: float) -> WedgeContributions:
    """Return what the wedges of all casters contribute at a world-space point (3,) whose hard count is known."""
    edges = silhouette_edges(scene.casters, light)
    shares = edge_shares(edges.ends, light, point)
    largest = np.argsort(-np.abs(shares), kind="stable")[: np.count_nonzero(shares)]
    radius = light.shape.bounding_radius if light.shape else 0.0
    wedges = penumbra_wedges(edges.ends, light.position[:3], radius)
    return WedgeContributions(
        light.name,
        np.asarray(point, np.float64),
        count,
        tuple(
            WedgeContribution(
                int(number),
                scene.casters[edges.casters[number]].name,
                edges.ends[number],
                float(shares[number]),
                wedges[int(number)],
            )
            for number in largest
        ),
    )
