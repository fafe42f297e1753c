"""The register: names, options and what it says when they are wrong."""

import inspect

import pytest

from softshadow import techniques


@pytest.mark.parametrize("name", techniques.names())
def test_options_of_the_register_are_the_arguments_of_the_steps(name: str) -> None:
    technique = techniques.get(name)
    parameters = inspect.signature(technique.steps).parameters
    defaults = {key: p.default for key, p in parameters.items() if p.kind is p.KEYWORD_ONLY and key != "size"}
    assert defaults == {key: option.default for key, option in technique.options.items()}


@pytest.mark.parametrize("name", techniques.names())
def test_every_default_is_allowed(name: str) -> None:
    technique = techniques.get(name)
    for key, option in technique.options.items():
        assert option.checked(key, option.default) == option.default
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
        techniques.get("planar").checked_options({"metod": "stencil"})


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
        techniques.get(technique).checked_options({option: value})


def test_a_whole_number_is_a_number_and_nothing_is_from_the_scene() -> None:
    options = techniques.get("volume-zpass").checked_options({"reach": 3})
    assert options["reach"] == 3.0
    assert techniques.get("volume-zpass").checked_options({"reach": None})["reach"] is None
