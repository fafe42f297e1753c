"""The table that the course leaves to be completed (CA:796-803): technique, receiver, occluder, light, passes.

The numbers of passes are formulas for N lights. A pass draws each of its objects once.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

ANY, FLAT = "any", "planar"
CLOSED = "any closed mesh; open ones by their layers"
POINT, SPOT, AREA = "point or directional", "spot or directional, one frustum", "area"


@dataclass(frozen=True)
class Row:
    """A technique in the table.

    Attributes
    ----------
    technique : str
    receiver, occluder, light : str      what is allowed
    first, each_light : int      passes: `first` + N `each_light`, with one receiver
    in_slides : str              what the slide's cells say, or ""
    options : mapping            of the technique
    unseen : bool                a light that does not see all of the scene takes more passes: one if a part of it is
                                 beside or behind the light, two if the light is a spot
    """

    technique: str
    receiver: str
    occluder: str
    light: str
    first: int
    each_light: int
    in_slides: str = ""
    options: Mapping[str, Any] = field(default_factory=dict)
    unseen: bool = False

    def passes(self, lights: int, unseen: int = 0) -> int:
        """Return the number of passes for some lights.

        Parameters
        ----------
        unseen                   passes for what the lights do not see, if the technique has such

        Examples
        --------
        >>> ROWS[3].passes(1), ROWS[3].passes(3)
        (4, 10)
        """
        return self.first + lights * self.each_light + (unseen if self.unseen else 0)

    @property
    def formula(self) -> str:
        """The number of passes for N lights, in words and symbols."""
        each = "N" if self.each_light == 1 else f"{self.each_light} N"
        more = "; + 1 for a light with a part of the scene beside or behind it, + 2 for a spot" if self.unseen else ""
        return f"{self.first} + {each}{more}"


ROWS = (
    Row("planar", FLAT, ANY, POINT, 2, 1, "×1 planar; ×2 arbitrary; 3 passes", {"method": "offset"}),
    Row("planar", FLAT, ANY, POINT, 2, 2, "×2 planar; ×2 arbitrary", {"method": "stencil"}),
    Row("shadow-polygons", FLAT, ANY, POINT, 1, 2),
    Row("volume-zpass", ANY, CLOSED, POINT, 1, 3, "×2 arbitrary; ×1 simple"),
    Row("volume-zpass", ANY, CLOSED, POINT, 1, 2, "", {"two_sided": True}),
    Row("volume-zfail", ANY, CLOSED, POINT, 1, 3),
    Row("volume-zfail", ANY, CLOSED, POINT, 1, 2, "", {"two_sided": True}),
    Row("volume-parity", ANY, "closed, no overlaps", POINT, 1, 2),
    Row("map", ANY, ANY, SPOT, 1, 2, "×2; not omnidirectional", unseen=True),
    Row("map-distance", ANY, ANY, SPOT, 1, 3),
    Row("map-pcf", ANY, ANY, SPOT, 1, 3),
    Row("map-silhouette", ANY, ANY, SPOT, 1, 3),
    Row("map-pcss", ANY, ANY, AREA, 1, 3),
    Row("map-variance", ANY, ANY, SPOT, 1, 5),
    Row("map-exponential", ANY, ANY, SPOT, 1, 5),
    Row("map-cube", ANY, ANY, "point, all directions", 1, 8),
)
