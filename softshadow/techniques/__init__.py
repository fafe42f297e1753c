"""The shadow techniques, and the register that lists them by name.

Each technique is a file that reads like its slide: a generator ``steps(gl, scene, *, size, ...)`` of OpenGL calls,
which yields the title of each finished step, some with named maps. Its other keyword arguments are the options. `gl` is
`softshadow.gl`, or any other namespace with the same names.
"""

from collections.abc import Callable

from softshadow.errors import nearest
from softshadow.techniques import (
    blob,
    map,
    map_cube,
    map_distance,
    map_exponential,
    map_pcf,
    map_pcss,
    map_sampled,
    map_silhouette,
    map_variance,
    planar,
    planar_accumulated,
    planar_nested,
    shadow_polygons,
    volume_parity,
    volume_sampled,
    volume_wedges,
    volume_zfail,
    volume_zpass,
    volume_zpass_plus,
)
from softshadow.techniques.technique import Option, Range, Steps, Technique, technique_of

__all__ = ["Option", "Range", "Steps", "Technique", "describe", "get", "is_built_in", "names", "register"]

REGISTER = {
    technique.name: technique
    for technique in (
        Technique(
            "shadow-polygons",
            "Own- and cast-shadow polygons",
            "planar",
            "Atherton, Weiler & Greenberg 1978, Polygon shadow generation",
            shadow_polygons.steps,
        ),
        Technique(
            "planar",
            "Projected planar shadows",
            "planar",
            "Blinn 1988, Me and my (fake) shadow",
            planar.steps,
        ),
        Technique(
            "planar-accumulated",
            "Soft planar shadows by accumulation",
            "planar",
            "Heckbert & Herf 1997, Simulating soft shadows with graphics hardware",
            planar_accumulated.steps,
        ),
        Technique(
            "planar-nested",
            "Nested planar shadows",
            "planar",
            "Gooch et al. 1999, Interactive technical illustration",
            planar_nested.steps,
        ),
        Technique(
            "blob",
            "Blob shadows",
            "planar",
            "none: older than the papers about it",
            blob.steps,
        ),
        Technique(
            "volume-zpass",
            "Shadow volumes, z-pass",
            "volume",
            "Heidmann 1991, Real shadows, real time",
            volume_zpass.steps,
        ),
        Technique(
            "volume-zfail",
            "Shadow volumes, z-fail",
            "volume",
            "Everitt & Kilgard 2002, Practical and robust stenciled shadow volumes",
            volume_zfail.steps,
        ),
        Technique(
            "volume-zpass-plus",
            "Shadow volumes, z-pass from the near-plane count",
            "volume",
            "Hornus et al. 2005, ZP+: correct Z-pass stencil shadows",
            volume_zpass_plus.steps,
        ),
        Technique(
            "volume-parity",
            "Shadow volumes, parity",
            "volume",
            "Heidmann 1991, Real shadows, real time (with one bit for the counter)",
            volume_parity.steps,
        ),
        Technique(
            "volume-sampled",
            "Shadow volumes of points of the light",
            "volume",
            "Brotman & Badler 1984, Generating soft shadows with a depth buffer algorithm",
            volume_sampled.steps,
        ),
        Technique(
            "volume-wedges",
            "Penumbra wedges",
            "volume",
            "Assarsson & Akenine-Möller 2003, A geometry-based soft shadow volume algorithm using graphics hardware",
            volume_wedges.steps,
        ),
        Technique(
            "map",
            "Shadow map",
            "map",
            "Williams 1978, Casting curved shadows on curved surfaces",
            map.steps,
        ),
        Technique(
            "map-distance",
            "Shadow map of distances",
            "map",
            "Brabec, Annen & Seidel 2002, Practical shadow mapping",
            map_distance.steps,
        ),
        Technique(
            "map-pcf",
            "Shadow map, percentage-closer filtering",
            "map",
            "Reeves, Salesin & Cook 1987, Rendering antialiased shadows with depth maps",
            map_pcf.steps,
        ),
        Technique(
            "map-sampled",
            "Shadow maps of points of the light",
            "map",
            "Haeberli & Akeley 1990, The accumulation buffer",
            map_sampled.steps,
        ),
        Technique(
            "map-pcss",
            "Shadow map, percentage-closer soft shadows",
            "map",
            "Fernando 2005, Percentage-closer soft shadows",
            map_pcss.steps,
        ),
        Technique(
            "map-variance",
            "Variance shadow map",
            "map",
            "Donnelly & Lauritzen 2006, Variance shadow maps",
            map_variance.steps,
        ),
        Technique(
            "map-exponential",
            "Exponential shadow map",
            "map",
            "Annen et al. 2008, Exponential shadow maps",
            map_exponential.steps,
        ),
        Technique(
            "map-cube",
            "Shadow maps to all six sides",
            "map",
            "Gerasimov 2004, Omnidirectional shadow mapping",
            map_cube.steps,
        ),
        Technique(
            "map-silhouette",
            "Shadow silhouette map",
            "map",
            "Sen, Cammarano & Hanrahan 2003, Shadow silhouette maps",
            map_silhouette.steps,
        ),
    )
}


BUILT_IN = frozenset(REGISTER)


def names() -> list[str]:
    """Return the names of all techniques: the built-in ones, then those that were registered.

    Examples
    --------
    >>> print(*names())
    shadow-polygons planar planar-accumulated planar-nested blob volume-zpass volume-zfail volume-zpass-plus
    volume-parity volume-sampled volume-wedges map map-distance map-pcf map-sampled map-pcss map-variance
    map-exponential map-cube map-silhouette
    """
    return list(REGISTER)


def is_built_in(name: str) -> bool:
    """Return whether a technique comes with the package; the command line knows no others."""
    return name in BUILT_IN


def register(technique: Technique | Callable[..., Steps], name: str = "") -> Technique:
    """Give a technique of your own a place beside the built-in ones: `run` finds it by its name.

    It may stand above the function as a decorator. A second technique of the same name takes the place of the first.

    Parameters
    ----------
    technique : Technique, or a generator function ``steps(gl, scene, *, size, option=default ...)``
    name : str                   by default that of the function, with hyphens

    Raises
    ------
    ValueError                   a built-in technique has this name
    TypeError                    see `technique_of`
    """
    added = technique if isinstance(technique, Technique) else technique_of(technique, name)
    if added.name in BUILT_IN:
        raise ValueError(f"technique {added.name!r} is built in; expected another name")
    REGISTER[added.name] = added
    return added


def get(technique: str | Technique | Callable[..., Steps]) -> Technique:
    """Return the technique of a name, the technique that a generator of steps makes, or the technique itself.

    Raises
    ------
    ValueError                   unknown name; the message has the nearest one
    TypeError                    see `technique_of`
    """
    if isinstance(technique, Technique):
        return technique
    if not isinstance(technique, str):
        return technique_of(technique)
    if technique not in REGISTER:
        raise ValueError(f"unknown technique {technique!r}: {nearest(technique, REGISTER)}")
    return REGISTER[technique]


def describe(name: str | Technique | Callable[..., Steps]) -> str:
    """Return a text on a technique: what it does, its paper, its known failures and its options.

    Raises
    ------
    ValueError                   unknown name; the message has the nearest one
    """
    technique = get(name)
    lines = [f"{technique.name}: {technique.title}", "", technique.description, "", "Options:"]
    for key, option in technique.options.items():
        default = "chosen to fit" if option.default is None else option.default
        lines += [f"  {key} = {default}", f"      {option.help} ({option.expected})"]
    return "\n".join(lines)
