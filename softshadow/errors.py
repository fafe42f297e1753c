"""What softshadow raises and warns of: one message says what was wrong, where, and what was expected."""

import builtins
import difflib
from collections.abc import Iterable


class SoftShadowError(Exception):
    """Base of all errors of this package that a user's input can cause."""


class SceneError(SoftShadowError):
    """A scene or scene file is wrong: names the file, the key and what was expected."""


class MeshError(SceneError):
    """A model file or mesh cannot be used: names the file and what was expected."""


class StateError(SoftShadowError):
    """A GL state or a buffer does not allow the operation."""


class Warning(builtins.UserWarning):
    """Base of all warnings: legal but surprising input, and what will look wrong."""


class OpenMesh(Warning):
    """A caster has boundary edges: every face casts, re-oriented towards the light."""


class TJunction(Warning):
    """Vertices of a caster lie within boundary edges: single pixels along such an edge may leak light or shadow."""


class UnweldedMesh(Warning):
    """Boundary vertices of a caster lie next to others, not at equal positions: the mesh is open by a hair."""


class NonManifoldMesh(Warning):
    """More than two faces meet in an edge."""


class MisorientedMesh(Warning):
    """Neighbouring faces disagree about the outside: every face casts, re-oriented towards the light."""


class DegenerateFaces(Warning):
    """Triangles without area: they are not seen and cast nothing."""


class FarFromOrigin(Warning):
    """The coordinates of a caster are much larger than the caster: float32 has few digits left for its shape."""


class LightInsideCaster(Warning):
    """A light lies inside a closed caster: volumes let its light out, maps and rays keep it in."""


class InsideOutMesh(Warning):
    """The triangles of a closed caster run clockwise seen from outside."""


class PartlyReadFile(Warning):
    """A model file has parts that are left out: says which and why."""


class NearClipZPass(Warning):
    """The near rectangle cuts a shadow volume: z-pass counts from a wrong start value."""


class OutsideLightFrustum(Warning):
    """A point light stands among its casters: what its one shadow map does not see counts as lit."""


class CounterSaturated(Warning):
    """A stencil counter reached its largest value (or wrapped): counts above it are lost."""


def nearest(name: str, choices: Iterable[str]) -> str:
    """Return the end of an "unknown name" message: the nearest name in either case of letters, and what there is.

    Examples
    --------
    >>> nearest("volume-zfial", ["planar", "volume-zfail"])
    "did you mean 'volume-zfail'? (there are: planar, volume-zfail)"
    >>> nearest("teapot", ["planar", "volume-zfail"])
    'expected one of planar, volume-zfail'
    """
    known = list(choices)
    listed = ", ".join(known)
    spelled = {each.lower(): each for each in known}
    close = difflib.get_close_matches(name.lower(), spelled, n=1, cutoff=0.5)
    return f"did you mean {spelled[close[0]]!r}? (there are: {listed})" if close else f"expected one of {listed}"
