"""The register: names, options and what it says when they are wrong."""

from collections.abc import Iterator
from typing import Annotated, Any, Literal

import pytest

from softshadow import techniques
from softshadow.techniques.technique import Option, Range, Technique


def test_options_are_declared_in_the_signature_of_the_steps() -> None:
    def steps(
        gl: Any,
        scene: Any,
        *,
        size: tuple[int, int],
        side: Annotated[int, "texels", Range(1, 8)] = 2,
        reach: Annotated[float | None, "how far"] = None,
        method: Annotated[Literal["fast", "slow"], "how"] = "slow",
        plain: bool = True,
        bare=0.5,
    ) -> Iterator[str]:
        yield "draw"

    assert Technique("own", "", "", "", steps).options == {
        "side": Option(2, int, "texels", minimum=1, maximum=8),
        "reach": Option(None, float, "how far"),
        "method": Option("slow", str, "how", choices=("fast", "slow")),
        "plain": Option(True, bool, ""),
        "bare": Option(0.5, float, ""),
    }
    assert Technique("own", "", "", "", steps, {}).options == {}


def test_an_option_of_a_type_that_cannot_be_given_is_refused() -> None:
    def steps(gl: Any, scene: Any, *, size: tuple[int, int], sides: Annotated[list, "several"] = ()) -> Iterator[str]:
        yield "draw"

    with pytest.raises(TypeError, match=r"option sides: <class 'list'>; expected bool, int, float, str or a Literal"):
        Technique("own", "", "", "", steps)


@pytest.mark.parametrize("name", techniques.names())
def test_every_option_of_the_register_has_a_line_of_help(name: str) -> None:
    assert all(option.help for option in techniques.get(name).options.values())


@pytest.mark.parametrize("name", techniques.names())
def test_every_default_is_allowed(name: str) -> None:
    technique = techniques.get(name)
    for key, option in technique.options.items():
        assert option.validate(key, option.default) == option.default
        assert option.default is None or isinstance(option.default, option.kind)


@pytest.mark.parametrize("name", techniques.names())
def test_a_description_has_paper_failures_and_options(name: str) -> None:
    text = techniques.describe(name)
    for words in ("Paper:", "Slides:", "Known failures:", *techniques.get(name).options):
        assert words in text


def test_unknown_technique_is_answered_with_the_nearest_name() -> None:
    with pytest.raises(ValueError, match=r"'volume-zfial'.*did you mean 'volume-zfail'"):
        techniques.get("volume-zfial")


def test_unknown_option_is_answered_with_the_nearest_name() -> None:
    with pytest.raises(ValueError, match=r"'planar' has no option 'metod'.*did you mean 'method'"):
        techniques.get("planar").validate_options({"metod": "stencil"})


@pytest.mark.parametrize(
    ("technique", "option", "value", "error"),
    [
        ("planar", "method", "stensil", ValueError),
        ("planar", "method", 3, TypeError),
        ("planar", "clip", 1, TypeError),
        ("planar", "texture_size", 0, ValueError),
        ("planar", "texture_size", True, TypeError),
        ("map", "map_size", 100_000, ValueError),
        ("map", "map_size", 64.0, TypeError),
        ("map", "bias", float("nan"), ValueError),
        ("map", "factor", float("inf"), ValueError),
        ("map", "bias", None, TypeError),
        ("volume-zpass", "reach", -1, ValueError),
        ("volume-zpass", "two_sided", "yes", TypeError),
    ],
)
def test_wrong_value_is_named(technique: str, option: str, value: object, error: type[Exception]) -> None:
    with pytest.raises(error, match=f"option {option}="):
        techniques.get(technique).validate_options({option: value})


def test_a_whole_number_is_a_number_and_nothing_is_from_the_scene() -> None:
    options = techniques.get("volume-zpass").validate_options({"reach": 3})
    assert options["reach"] == 3.0
    assert techniques.get("volume-zpass").validate_options({"reach": None})["reach"] is None


def test_the_earlier_name_of_validate_options_still_works_and_says_so() -> None:
    technique = techniques.get("volume-zpass")
    with pytest.warns(DeprecationWarning, match="validate_options"):
        options = technique.checked_options({"reach": 3})
    assert options == technique.validate_options({"reach": 3})
