"""Errors in a scene file, one line each: the place, what was expected, and the value."""

import re
from collections.abc import Iterator
from contextlib import contextmanager

from pydantic import BaseModel, ValidationError

from softshadow.errors import SceneError, nearest

# what a message expects, by the last key of the place
EXPECTED = {
    **dict.fromkeys(("eye", "target", "up", "position", "direction", "move", "corner", "across"), "[x, y, z]"),
    **dict.fromkeys(("color", "specular", "emission", "ambient", "background"), "[red, green, blue], each 0 to 1"),
    "attenuation": "[constant, linear, quadratic]",
    "fov_y": "degrees between 0 and 180",
    "near": "a positive distance",
    "far": "a positive distance",
    "shininess": "a number from 0 to 128",
    "turn": "[angle in degrees, x, y, z]",
    "scale": "a positive number or [x, y, z]",
    "material": "the name of a [materials.NAME] table, or a table with color, specular, shininess, emission",
    "camera": "a table [camera] with eye and target",
    "light": "one or more tables [[light]]",
    "object": "at most 500 tables [[object]]",
    "receiver": "at most 500 tables [[receiver]]",
    "materials": "tables [materials.NAME]",
    "parameters": "a table of numbers",
    **dict.fromkeys(("casts", "receives"), "true or false"),
    **dict.fromkeys(("name", "title", "shape", "mesh"), "text in quotes"),
}


def error_lines(error: ValidationError, tables: dict[str, type[BaseModel]]) -> list[str]:
    """Return one line per error that pydantic found.

    Parameters
    ----------
    tables : dict      the model of each table in the file by its key, and the model of the whole file under ""
    """
    lines = []
    for item in error.errors(include_url=False):
        place = "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in item["loc"]).lstrip(".")
        keys = [part for part in item["loc"] if isinstance(part, str)]
        if item["type"] == "value_error":
            for text in str(item["ctx"]["error"]).split("\n"):
                # "key: text" belongs to that key of the table
                inner = re.match(r"[a-z_]+(\.\w+)*(\[\d+\])?: ", text)
                lines.append(f"{place}{'.' if inner and place else ': ' if place else ''}{text}")
        elif item["type"] == "extra_forbidden":
            table = tables[keys[0] if len(keys) > 1 else ""]
            lines.append(f"{place}: unknown key; {nearest(keys[-1], list(table.model_fields))}")
        else:
            value = "but it is missing" if item["type"] == "missing" else f"got {item['input']!r}"
            lines.append(f"{place}: expected {EXPECTED.get(keys[-1] if keys else '', item['msg'])}, {value}")
    return lines


class ErrorCollector:
    """A context manager that collects the errors of one table, and raises them together as a ValueError at its end."""

    def __init__(self) -> None:
        self.lines: list[str] = []

    def __enter__(self) -> "ErrorCollector":
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: object) -> None:
        if self.lines and kind is None:
            raise ValueError("\n".join(self.lines))

    def add(self, line: str) -> None:
        """Add an error; a line `key: text` belongs to that key of the table."""
        self.lines.append(line)

    @contextmanager
    def catch(self, name: str = "") -> Iterator[None]:
        """Add the SceneError that the block raises, without `name: ` at its beginning."""
        try:
            yield
        except SceneError as error:
            self.lines.append(str(error).removeprefix(f"{name}: "))
