"""The table of a sweep: a row for each point, written as CSV, Parquet or JSON, and read again."""

from __future__ import annotations

import csv
import io
import json
import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from softshadow.errors import SoftShadowError, nearest
from softshadow.inspection.files import MARK, write_whole
from softshadow.sweeps.journal import rows_of
from softshadow.sweeps.task import Row

SUFFIXES = (".csv", ".parquet", ".json")
SCHEMA = "softshadow/sweep-table/1"
# columns of text, which no reader may take for numbers
TEXTS = ("technique", "scene", "status", "error", "warnings", "picture_sha256", "machine", "versions", "recipe", "key")
NEEDS = "a .parquet table needs the package pyarrow: pip install 'softshadow[sweep]'; .csv and .json do not"


@dataclass(frozen=True)
class SweepTable:
    """The rows of a sweep, in the order of its points; `rows` is a list of dicts, as pandas.DataFrame takes it."""

    rows: list[Row]

    @property
    def columns(self) -> list[str]:
        """The names of all columns, in the order of their first appearance."""
        return list(dict.fromkeys(name for row in self.rows for name in row))

    @property
    def failed(self) -> list[Row]:
        """The rows of the points that have an error in place of figures."""
        return [row for row in self.rows if row["status"] != "ok"]

    def __getitem__(self, column: str) -> np.ndarray:
        """Return a column as an array; where a row has no value, there is NaN among numbers, else None."""
        name = self.column(column)
        values = [row.get(name) for row in self.rows]
        if all(value is None or (isinstance(value, int | float) and not isinstance(value, bool)) for value in values):
            return np.array([np.nan if value is None else value for value in values], np.float64)
        return np.array(values, object)

    def __repr__(self) -> str:
        return f"SweepTable({len(self)} points, {len(self.failed)} failed, {len(self.columns)} columns)"

    def __len__(self) -> int:
        return len(self.rows)

    def column(self, name: str) -> str:
        """Return the full name of a column: "map_size" may stand for "option_map_size", "rms" for "hard_rms".

        Raises
        ------
        SoftShadowError              no column has the name, or several
        """
        if name in self.columns:
            return name
        if f"option_{name}" in self.columns:
            return f"option_{name}"
        fitting = [each for each in self.columns if each.endswith(f"_{name}") or each.startswith(f"{name}_")]
        exact = [each for each in fitting if each in (f"soft_{name}", f"hard_{name}")]
        found = exact or fitting
        if len(found) == 1:
            return found[0]
        expected = f"expected one of {', '.join(found)}" if found else nearest(name, self.columns)
        raise SoftShadowError(f"column {name!r}: {expected}")

    def save(self, path: str | os.PathLike[str], force: bool = False) -> Path:
        """Write the table; the suffix selects CSV, Parquet or JSON. An earlier file is replaced as a whole, or kept.

        A file that this package did not write is only replaced with `force`.

        Raises
        ------
        SoftShadowError              another suffix; pyarrow is missing; the file is not ours, or cannot be written
        """
        target = Path(path)
        check_suffix(target)
        contents = {".csv": as_csv, ".json": as_json, ".parquet": as_parquet}[target.suffix](self)
        return write_whole(target, lambda half: half.write_bytes(contents), force)


def check_suffix(path: Path) -> None:
    """Raise an error if no table can have this file name."""
    if path.suffix not in SUFFIXES:
        raise SoftShadowError(f"{path}: expected a table, one of {', '.join(SUFFIXES)}")


def as_csv(table: SweepTable) -> bytes:
    """Return the table as CSV: a cell without value is empty. The column `versions` of each row has the mark."""
    text = io.StringIO(newline="")
    writer = csv.DictWriter(text, table.columns, restval="")
    writer.writeheader()
    writer.writerows(table.rows)
    return text.getvalue().encode()


def as_json(table: SweepTable) -> bytes:
    """Return the table as JSON, with its schema."""
    return json.dumps({"schema": SCHEMA, "made": MARK, "rows": table.rows}, indent=1).encode() + b"\n"


def as_parquet(table: SweepTable) -> bytes:
    """Return the table as Parquet; a column of different types is text."""
    try:
        import pyarrow
        from pyarrow import parquet
    except ModuleNotFoundError:
        raise SoftShadowError(NEEDS) from None
    columns = {name: [row.get(name) for row in table.rows] for name in table.columns}
    buffer = io.BytesIO()
    parquet.write_table(pyarrow.table({name: uniform(values) for name, values in columns.items()}), buffer)
    return buffer.getvalue()


def uniform(values: Sequence[Any]) -> list[Any]:
    """Return values of one type: whole numbers beside others become float, all other mixtures text."""
    kinds = {type(value) for value in values if value is not None}
    if len(kinds) <= 1:
        return list(values)
    kind: type = float if kinds == {int, float} else str
    return [None if value is None else kind(value) for value in values]


def load_sweep(path: str | os.PathLike[str]) -> SweepTable:
    """Return the table of a sweep from a .csv, .parquet or .json file, or what its .journal has so far.

    Raises
    ------
    SoftShadowError              there is no such file, or it is none of these
    """
    source = Path(path)
    try:
        if source.suffix == ".journal":
            return SweepTable(list(rows_of(source)))
        check_suffix(source)
        if source.suffix == ".csv":
            with source.open(newline="", encoding="utf-8") as file:
                reader = csv.DictReader(file)
                if "technique" not in (reader.fieldnames or ()):
                    raise ValueError("no column 'technique'")
                return SweepTable([row_of_csv(row) for row in reader])
        if source.suffix == ".json":
            contents = json.loads(source.read_text(encoding="utf-8"))
            return checked(contents.get("rows") if isinstance(contents, dict) else None, source)
        return checked(rows_of_parquet(source), source)
    except OSError as error:
        raise SoftShadowError(f"{path}: cannot be read: {error.strerror or error}; expected a table") from None
    except (ValueError, csv.Error) as error:
        raise SoftShadowError(f"{path}: expected the table of a sweep: {str(error)[:200]}") from None


def checked(rows: Any, source: Path) -> SweepTable:
    """Return a table of rows, if they are those of a sweep."""
    if not isinstance(rows, list) or not all(isinstance(row, dict) and "technique" in row for row in rows):
        raise SoftShadowError(f"{source}: expected the table of a sweep, with a column 'technique'")
    return SweepTable(rows)


def row_of_csv(cells: dict[str, str]) -> Row:
    """Return a row of a CSV file with numbers and truth values; a column without value is left out."""
    return {name: value_of(name, cell) for name, cell in cells.items() if cell or name in ("error", "warnings")}


def value_of(name: str, cell: str) -> Any:
    """Return a cell of a CSV file as number, truth value or text."""
    if name in TEXTS or cell in ("True", "False"):
        return cell if name in TEXTS else cell == "True"
    for kind in (int, float):
        try:
            return kind(cell)
        except ValueError:
            continue
    return cell


def rows_of_parquet(source: Path) -> list[Row]:
    """Return the rows of a Parquet file; a column without value is left out of a row."""
    try:
        from pyarrow import parquet
    except ModuleNotFoundError:
        raise SoftShadowError(NEEDS) from None
    return [{k: v for k, v in row.items() if v is not None} for row in parquet.read_table(source).to_pylist()]
