"""The stops of the tour: every technique, with the options that are worth comparing."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class Stop:
    """One run of the tour: a technique with options, and what to look at in its picture."""

    title: str
    technique: str
    look_at: str
    options: Mapping[str, Any] = field(default_factory=dict)

    @property
    def name(self) -> str:
        """The name of the stop's folder: technique and options."""
        words = [
            self.technique,
            *(f"{key}={value}" if key != "method" else value for key, value in self.options.items()),
        ]
        return re.sub(r"[^\w.]+", "-", "-".join(words))


STOPS = (
    Stop(
        "Planar shadow, depth test off",
        "planar",
        "As on the slides: flattened casters are drawn over the receiver, and over nearer objects, too.",
        {"method": "depth-off"},
    ),
    Stop(
        "Planar shadow, polygon offset",
        "planar",
        "The offset (-1, -1) lifts the flattened casters off the receiver: the depth test works without z-fighting.",
        {"method": "offset"},
    ),
    Stop(
        "Planar shadow, stencil",
        "planar",
        "The stencil marks the receiver and the flattened casters unmark it, so no shadow falls outside the receiver.",
        {"method": "stencil"},
    ),
    Stop(
        "Planar shadow, stencil and blending",
        "planar",
        "Each marked pixel is darkened once, however many flattened triangles cover it.",
        {"method": "stencil-blend"},
    ),
    Stop(
        "Planar shadow, as a texture",
        "planar",
        "The shadow is drawn into a texture of the receiver once, and reused while nothing moves.",
        {"method": "texture"},
    ),
    Stop(
        "Shadow polygons",
        "shadow-polygons",
        "The shadowed parts of each object are cut out as polygons once, and reused for every camera.",
    ),
    Stop(
        "Blob shadow",
        "blob",
        "A dark disc below each caster. It ignores light position and caster shape.",
    ),
    Stop(
        "Shadow volumes, z-pass",
        "volume-zpass",
        "The stencil counts volumes entered minus volumes left in front of each surface; where it is not 0 is shadow.",
    ),
    Stop(
        "Shadow volumes, z-fail",
        "volume-zfail",
        "The same count behind the surface: correct wherever the eye is, but volumes need both caps.",
    ),
    Stop(
        "Shadow volumes, one per polygon",
        "volume-zfail",
        "Without a silhouette: the same counts from many more fragments. Compare the ledgers.",
        {"generator": "per-polygon"},
    ),
    Stop(
        "Shadow volumes, two-sided stencil",
        "volume-zfail",
        "Front and back faces in one draw: the same counts with one pass less.",
        {"two_sided": True},
    ),
    Stop(
        "Shadow volumes, z-pass or z-fail for each pixel",
        "volume-zfail",
        "A plane through each shadow: z-fail behind it, z-pass in front of it. Compare the stencil updates.",
        {"choose": "split-plane"},
    ),
    Stop(
        "Shadow volumes, z-pass from the near-plane count",
        "volume-zpass-plus",
        "Casting faces projected onto the near rectangle start the count: z-pass that is correct wherever the eye is.",
    ),
    Stop(
        "Shadow volumes, parity",
        "volume-parity",
        "One stencil bit, inverted at every face: light leaks in where two volumes overlap.",
    ),
    Stop(
        "Penumbra wedges",
        "volume-wedges",
        "Volumes, corrected by what each silhouette edge hides of an area light; that of a point light is hard.",
    ),
    Stop(
        "Shadow map",
        "map",
        "Depths as the light sees them, compared for each pixel: blocky edges, but no extruded geometry.",
    ),
    Stop(
        "Shadow map, second depth",
        "map",
        "The map stores the far sides of casters: lit faces need no bias, and errors fall where it is dark anyway.",
        {"surface": "back", "factor": 0.0, "units": 0.0},
    ),
    Stop(
        "Shadow map of distances",
        "map-distance",
        "The map stores distances from the light, and the bias is a distance: the same near the light and far from it.",
    ),
    Stop(
        "Shadow map, percentage-closer filtering",
        "map-pcf",
        "The share of 3 x 3 comparisons that are lit: an edge that is equally soft near the caster and far from it.",
    ),
    Stop(
        "Shadow map, percentage-closer soft shadows",
        "map-pcss",
        "The square is as wide as the penumbra of an area light: sharp at the feet of casters, soft far behind them. "
        "A point light has hard shadows.",
    ),
    Stop(
        "Variance shadow map",
        "map-variance",
        "Mean and variance of the depths, blurred once: look for light where one shadow crosses another.",
        {"blur": 4},
    ),
    Stop(
        "Exponential shadow map",
        "map-exponential",
        "Powers of the depths, blurred once: with this small exponent, light leaks in right behind the casters.",
        {"exponent": 20.0},
    ),
    Stop(
        "Shadow maps to all six sides",
        "map-cube",
        "One map for each direction, for lights that stand among their casters; here five of the six are empty.",
    ),
    Stop(
        "Soft shadows by planar shadows of points of the light",
        "planar-accumulated",
        "The mean of planar shadows of 16 points, summed up in a texture of the floor: bands where the points are few.",
    ),
    Stop(
        "Nested planar shadows",
        "planar-nested",
        "Hard shadows on parallel planes, laid over each other: soft far from the light's foot, not far from casters.",
    ),
    Stop(
        "Soft shadows by shadow volumes of points of the light",
        "volume-sampled",
        "One shadow volume for each of nine points: the share of points that are seen is how much light arrives.",
    ),
    Stop(
        "Soft shadows by shadow maps of points of the light",
        "map-sampled",
        "One shadow map for each of nine points: the same picture as with volumes, as far as the texels allow.",
    ),
    Stop(
        "Shadow silhouette map",
        "map-silhouette",
        "The map also stores points of the silhouette: even with this coarse map the edges are straight.",
        {"map_size": 128},
    ),
    Stop(
        "Shadow map without bias",
        "map",
        "Surfaces shadow themselves: a texel holds one depth, but a sloping surface has a range of depths across it.",
        {"factor": 0.0, "units": 0.0},
    ),
)
