"""A row of a pixel history: one fragment, one clear, one culled or clipped triangle."""

from __future__ import annotations

from dataclasses import dataclass

from softshadow.inspection.map_lookups import MapLookup

CULLED, CLIPPED, CLEARED, WRITTEN = "culled", "clipped", "clear", "written"

Color = tuple[float, ...]


@dataclass(frozen=True)
class HistoryRow:
    """The effect of one fragment, one clear, or one triangle without a fragment on a pixel.

    The fields are those of the dictionaries of `PixelHistory.to_dicts`, too.

    Attributes
    ----------
    step, title                  index and title of the step
    draw : int or None           index of the draw in the frame; None for clears and copies
    framebuffer : int            name of the framebuffer, 0 for the window
    object : str                 the innermost debug group around the draw
    triangle : int or None       number of the triangle in the draw, before clipping
    front_facing : bool or None
    part : str                   what the triangle is: "volume side", "near cap", "far cap", "flattened face", "shadow
                                 polygon", "wedge" ...; "" for a surface of the scene
    caster : str                 the object that it was made from; "" for a surface
    face, edge : int or None     the face or the edge of the caster that it was made from
    z, z_before_offset : float or None    window z in [0, 1]; the second only where a polygon offset has moved it
    stored_z : float or None     what the depth buffer held before
    verdict : str                passed, scissor, alpha failed, stencil failed, depth failed, culled, clipped, clear,
                                 written
    stencil_before, stencil_after : int
    depth_after : float or None
    alpha : float or None        of the fragment, before it is rounded; None where it was not shaded
    color_source : tuple or None what was written or blended: red, green, blue
    color_before, color_after : tuple     red, green, blue: 0-255, or floats of a float buffer
    color_written : bool
    lights : tuple of str        those that the draw adds to the surface
    lookups : tuple of MapLookup the depths that it has looked up in maps; where it has read another pass's result,
                                 those of the fragment that has left the result
    reason : str                 the tests, with the numbers they have compared
    """

    step: int
    title: str
    draw: int | None
    object: str
    triangle: int | None
    front_facing: bool | None
    z: float | None
    stored_z: float | None
    verdict: str
    stencil_before: int
    stencil_after: int
    depth_after: float | None
    color_after: Color
    reason: str
    color_written: bool = False
    framebuffer: int = 0
    part: str = ""
    caster: str = ""
    face: int | None = None
    edge: int | None = None
    z_before_offset: float | None = None
    alpha: float | None = None
    color_source: Color | None = None
    color_before: Color = ()
    lights: tuple[str, ...] = ()
    lookups: tuple[MapLookup, ...] = ()

    @property
    def name(self) -> str:
        """What the triangle is, in words.

        Examples
        --------
        "torus, triangle 10"; "front face of the volume of torus, edge 112"; "near cap of torus, face 10"
        """
        number = "" if self.triangle is None else f"triangle {self.triangle}"
        if not self.part:
            return ", ".join(filter(None, [self.object or f"draw {self.draw}", number]))
        feature = f"edge {self.edge}" if self.edge is not None else "" if self.face is None else f"face {self.face}"
        return origin_name(self.part, self.caster, self.front_facing, feature)


def origin_name(part: str, caster: str, front_facing: bool | None, feature: str) -> str:
    """Return what a triangle is that was made from a caster; `feature` is its edge or face, such as "edge 112"."""
    facing = {True: "front face", False: "back face", None: "face"}[front_facing]
    if part == "volume side":
        words = f"{facing} of the volume of {caster}"
    elif part in ("near cap", "far cap"):
        words = f"{part} ({facing}) of the volume of {caster}"
    else:
        words = f"{part} of {caster}" if caster else part
    return ", ".join(filter(None, [words, feature]))
