"""What a lookup in a shadow map has found, in words."""

from __future__ import annotations

from softshadow.inspection.map_lookups import MapLookup
from softshadow.inspection.reasons import unlike

SAME = 1e-6  # shares that differ by less are one
DIGITS = 5


def lookup_words(lookup: MapLookup) -> str:
    """Return the texel, the two depths and what follows from them."""
    if lookup.lit is None:
        return f"{place_words(lookup)} stores {lookup.stored:.{DIGITS}g}, which no depth is compared with"
    words = one_tap(lookup) if len(lookup.taps) == 1 else filtered(lookup) if not lookup.compare else taps(lookup)
    if lookup.visible is not None and abs(lookup.visible - lookup.lit) > SAME:
        words += (
            f"; yet {lookup.visible:.2g} of the light is visible, since the point lies where the map is not asked: "
            "outside the light's cone, or beside or behind it"
        )
    return words


def drawn_words(lookup: MapLookup) -> str:
    """Return what was drawn into the texel that decides."""
    return f" (drawn by {lookup.caster}, triangle {lookup.caster_triangle})" if lookup.caster else ""


def map_name(lookup: MapLookup) -> str:
    """Return the name of the map: by its light, or the texture's."""
    name = f"the map of {lookup.light}" if lookup.light else f"texture {lookup.texture}"
    return f"face {lookup.face} of {name}" if lookup.face else name


def place_words(lookup: MapLookup) -> str:
    """Return which texel was read."""
    middle = next((tap for tap in lookup.taps if (tap.x, tap.y, tap.face) == (lookup.x, lookup.y, lookup.face)), None)
    if middle is not None and not middle.inside:
        return f"the border of {map_name(lookup)}, beyond its edge,"
    return f"texel ({lookup.x}, {lookup.y}) of {map_name(lookup)}"


def own_depth(lookup: MapLookup, depth: float, digits: str) -> str:
    """Return the depth of the point, or its distance, with the bias that has been subtracted from it."""
    if depth >= lookup.farthest:  # beyond the far plane as on it
        return f"at least {digits}, where the map ends" if lookup.measure == "distance" else digits
    if not lookup.bias:
        return digits
    return f"{depth + lookup.bias:.{DIGITS}g} - {lookup.bias:g} bias"


def outcome(lookup: MapLookup, is_lit: bool) -> str:
    """Return what a comparison means."""
    if lookup.compare in ("LEQUAL", "LESS"):
        return "not farther, so lit" if is_lit else "farther, so in shadow"
    return f"{lookup.compare} is {'true' if is_lit else 'false'}, so {'lit' if is_lit else 'in shadow'}"


def one_tap(lookup: MapLookup) -> str:
    """Return the words for a single comparison."""
    depth = lookup.depth or 0.0
    stored, own = unlike(lookup.stored, depth)
    kind = "distance " if lookup.measure == "distance" else ""
    found = f"{place_words(lookup)} stores {kind}{stored}{drawn_words(lookup)}"
    return f"{found}, this point has {own_depth(lookup, depth, own)}: {outcome(lookup, bool(lookup.lit))}"


def taps(lookup: MapLookup) -> str:
    """Return the words for several comparisons: percentage-closer filtering, soft maps, silhouette maps."""
    counted = [tap for tap in lookup.taps if tap.purpose != "search"]
    search = [tap for tap in lookup.taps if tap.purpose == "search"]
    words = []
    if search:
        blockers = sum(tap.lit is False for tap in search)
        words.append(f"{blockers} of {len(search)} texels of the search are blockers")
    if counted:
        lit, depth = sum(bool(tap.lit) for tap in counted), counted[len(counted) // 2].depth or 0.0
        own = own_depth(lookup, depth, f"{depth:.{DIGITS}g}")
        weighed = len({round(tap.weight, 6) for tap in counted}) > 1 and lookup.silhouette_point is None
        share = f", by weight {lookup.lit:.2g}" if weighed else ""
        least, most = min(tap.stored for tap in counted), max(tap.stored for tap in counted)
        words.append(
            f"{lit} of {len(counted)} taps around {place_words(lookup)} are lit{share}: this point has {own}, "
            f"they store {least:.{DIGITS}g} to {most:.{DIGITS}g}"
        )
    if lookup.silhouette_point is not None:
        s, t = lookup.silhouette_point
        part = "lit" if lookup.lit else "shadowed"
        words.append(f"the silhouette point ({s:.2g}, {t:.2g}) of the cell puts this point into the {part} part")
    return "; ".join(words)


def filtered(lookup: MapLookup) -> str:
    """Return the words for a map of means, which is not compared texel by texel."""
    means = ", ".join(f"{value:.{DIGITS}g}" for value in lookup.values[:2])
    own = own_depth(lookup, lookup.depth or 0.0, f"{lookup.depth or 0.0:.{DIGITS}g}")
    return (
        f"{map_name(lookup)}, filtered, has {means} around texel ({lookup.x}, {lookup.y}), this point has {own}: "
        f"{lookup.lit:.2g} of the light is found visible"
    )
