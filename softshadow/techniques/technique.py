"""What the register says about a technique: its name, its steps, its options and where it comes from.

An option is a keyword argument of the generator of steps and is declared there alone: its type, one sentence of help,
the bounds of a number, and its default.

    map_size: Annotated[int, "texels on a side of the map", Range(1, 8192)] = 512
    cull: Annotated[Literal["none", "front", "back"], "faces left out of the map"] = "none"
    reach: Annotated[float | None, "where the volume ends"] = None
"""

import inspect
import math
import sys
import warnings
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, NamedTuple, Union, get_args, get_origin, get_type_hints

from softshadow.errors import nearest

KINDS = {bool: "True or False", int: "a whole number", float: "a number", str: "a text"}


class Range(NamedTuple):
    """The smallest and the largest value of a number."""

    minimum: float = -math.inf
    maximum: float = math.inf


@dataclass(frozen=True)
class Option:
    """One option of a technique: its default, its type, one sentence of help, and which values it takes.

    `kind` is bool, int, float or str; `choices` lists the values of a str; `minimum` and `maximum` bound a number. With
    a default of None the value is chosen to fit the scene or the other options.
    """

    default: Any
    kind: type
    help: str
    choices: tuple[str, ...] = ()
    minimum: float = -math.inf
    maximum: float = math.inf

    def validate(self, name: str, value: Any) -> Any:
        """Return the value in the option's own type.

        Raises
        ------
        TypeError, ValueError        the message names the option, the value and what was expected
        """
        kind: Any = self.kind  # a type that mypy does not narrow to
        if value is None and self.default is None:
            return None
        if self.kind is float and isinstance(value, int) and not isinstance(value, bool):
            value = float(value)
        if not isinstance(value, kind) or (isinstance(value, bool) and self.kind is not bool):
            raise TypeError(f"option {name}={value!r}: expected {self.expected}, got {type(value).__name__}")
        if self.choices and value not in self.choices:
            raise ValueError(f"option {name}={value!r}: {nearest(value, self.choices)}")
        if self.kind is float and not math.isfinite(value):
            raise ValueError(f"option {name}={value!r}: expected a finite number")
        if self.kind in (int, float) and not self.minimum <= value <= self.maximum:
            raise ValueError(f"option {name}={value!r}: expected {self.expected}")
        return value

    @property
    def expected(self) -> str:
        """The values that the option takes, in words."""
        if self.choices:
            return "one of " + ", ".join(self.choices)
        words = KINDS[self.kind]
        if math.isfinite(self.maximum):
            return f"{words} from {self.minimum:g} to {self.maximum:g}"
        return f"{words} of at least {self.minimum:g}" if math.isfinite(self.minimum) else words


# what a generator of steps yields: the title of the step that has ended, or the title and named maps (arrays, first
# row = bottom)
Steps = Iterator[str | tuple[str, dict[str, Any]]]


@dataclass(frozen=True)
class Technique:
    """A way to draw shadows: its name, its generator of steps, and where it comes from.

    Attributes
    ----------
    name, title, family, paper : str
    steps : callable             ``steps(gl, scene, *, size, **options)`` draws with the calls of `gl`, and yields the
                                 title of each finished step, or a pair of the title and named maps, first row = bottom
    options : dict               by name; without it those that the signature of `steps` declares
    """

    name: str
    title: str
    family: str
    paper: str
    steps: Callable[..., Steps]
    options: Mapping[str, Option] = None  # type: ignore[assignment]  # filled in below

    def __post_init__(self) -> None:
        if self.options is None:
            object.__setattr__(self, "options", options_of(self.steps))

    @property
    def description(self) -> str:
        """What the technique does: the text of its file, or of its function where that is not part of the package."""
        module = sys.modules.get(self.steps.__module__) if hasattr(self.steps, "__module__") else None
        if module is not None and module.__name__.startswith("softshadow.") and module.__doc__:
            return module.__doc__.strip()
        return inspect.getdoc(self.steps) or self.title

    def validate_options(self, values: Mapping[str, Any]) -> dict[str, Any]:
        """Return every option of the technique, with its value from `values` or its default.

        Raises
        ------
        ValueError                   an unknown option (the message has the nearest name), or a value out of range
        TypeError                    a value of the wrong type
        """
        for name in values:
            if name not in self.options:
                raise ValueError(f"technique {self.name!r} has no option {name!r}: {nearest(name, self.options)}")
        return {
            name: option.validate(name, values[name]) if name in values else option.default
            for name, option in self.options.items()
        }

    def checked_options(self, values: Mapping[str, Any]) -> dict[str, Any]:
        """Return what `validate_options` returns (deprecated: its name before 0.1.0)."""
        warnings.warn("Technique.checked_options is now called validate_options", DeprecationWarning, stacklevel=2)
        return self.validate_options(values)


def technique_of(steps: Callable[..., Steps], name: str = "") -> Technique:
    """Return the technique that a generator of steps makes, with the name and the docstring of the function.

    Examples
    --------
    >>> def only_clear(gl, scene, *, size, stencil: Annotated[int, "what to clear to", Range(0, 255)] = 0):
    ...     "Clear the stencil buffer."
    ...     gl.glClearStencil(stencil)
    ...     gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
    ...     yield "clear"
    >>> technique = technique_of(only_clear)
    >>> technique.name, technique.title, list(technique.options)
    ('only-clear', 'Clear the stencil buffer', ['stencil'])

    Raises
    ------
    TypeError                    not a function of these arguments, or an option of another type than bool, int, float,
                                 str or a Literal of str
    """
    try:
        inspect.signature(steps).bind("gl", "scene", size=(1, 1))
    except (TypeError, ValueError) as error:
        raise TypeError(
            f"technique {steps!r}: expected the name of a technique, a Technique, or a generator function "
            f"steps(gl, scene, *, size, option=default ...): {error}"
        ) from None
    own_name = getattr(steps, "__name__", "")
    name = name or (own_name.strip("_").replace("_", "-") if own_name.isidentifier() else "own")
    heading = (inspect.getdoc(steps) or name).splitlines()[0].rstrip(".")
    return Technique(name, heading, "own", "none", steps)


def options_of(steps: Callable[..., Steps]) -> dict[str, Option]:
    """Return the options that a generator of steps declares: its keyword arguments that have a default.

    Examples
    --------
    >>> def steps(gl, scene, *, size, radius: Annotated[float, "of the blob", Range(0)] = 1.0, soft=False):
    ...     yield "draw"
    >>> options = options_of(steps)
    >>> options["radius"]
    Option(default=1.0, kind=<class 'float'>, help='of the blob', choices=(), minimum=0, maximum=inf)
    >>> options["soft"].expected
    'True or False'

    Raises
    ------
    TypeError                    an option of another type than bool, int, float, str or a Literal of str
    """
    types = get_type_hints(steps, include_extras=True)
    return {
        name: option_of(name, types.get(name, type(parameter.default)), parameter.default)
        for name, parameter in inspect.signature(steps).parameters.items()
        if parameter.kind is parameter.KEYWORD_ONLY and parameter.default is not parameter.empty
    }


def option_of(name: str, annotation: Any, default: Any) -> Option:
    """Return the option that an annotated keyword argument declares."""
    kind, *metadata = get_args(annotation) if get_origin(annotation) is Annotated else (annotation,)
    if get_origin(kind) in (Union, UnionType):
        (kind,) = (one for one in get_args(kind) if one is not NoneType)
    choices = get_args(kind) if get_origin(kind) is Literal else ()
    kind = str if choices else kind
    if kind not in KINDS:
        raise TypeError(f"option {name}: {kind!r}; expected bool, int, float, str or a Literal of str")
    text = next((item for item in metadata if isinstance(item, str)), "")
    bounds = next((item for item in metadata if isinstance(item, Range)), Range())
    return Option(default, kind, text, choices, *bounds)
