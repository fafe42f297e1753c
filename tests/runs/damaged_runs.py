"""Saved runs with one thing wrong: damage as by disks and transfers, and files that somebody has made to look whole."""

import json
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from softshadow.inspection.files import DESCRIPTION
from softshadow.runs.members import HASH, SUFFIX, write_members

WRONG_VALUES: list[Any] = [
    None, True, -1, 0, 1, 7, 2**31, -(2**63), 2**70, 1.5, float("nan"), float("inf"), "", "x", "Draw", [], [1], {},
    {"array": 0}, {"array": -1}, {"array": 10**6}, {"object": 0}, {"object": 10**9}, {"object": "0"},
    {"dtype": "object"}, {"warning": "Warning", "message": 3}, {"mapping": [[1, 2, 3]]}, {"tuple": 4}, {"list": None},
    {"other": []},
]  # fmt: skip


class Damager:
    """Makes damaged copies of a saved run, the same one for the same seed."""

    def __init__(self, good: Path) -> None:
        self.content = good.read_bytes()
        with zipfile.ZipFile(good) as archive:
            self.members = {name: archive.read(name) for name in archive.namelist()}
            self.comment = archive.comment
        with np.load(good, allow_pickle=False) as stored:
            self.arrays = {name: stored[name] for name in stored.files}
        self.description = json.loads(str(self.arrays[DESCRIPTION]))

    def damaged(self, seed: int, folder: Path) -> tuple[Path, str]:
        """Return a damaged file and what was done to it."""
        rng = np.random.default_rng([31, seed])
        ways: list[Callable[[np.random.Generator, Path], None]] = [
            self.flip_bits, self.cut, self.overwrite, self.change_member, self.change_header,
            self.change_list_of_members, *[self.change_json] * 3, *[self.change_array] * 2, self.nest_deeply,
        ]  # fmt: skip
        way = ways[seed % len(ways)]
        path = folder / "damaged.npz"
        path.unlink(missing_ok=True)
        way(rng, path)
        return path, way.__name__

    # -- bytes of the file ---------------------------------------------------------------------------------------------
    def flip_bits(self, rng: np.random.Generator, path: Path) -> None:
        content = bytearray(self.content)
        for at in rng.integers(0, len(content), rng.integers(1, 9)):
            content[at] ^= 1 << rng.integers(8)
        path.write_bytes(content)

    def cut(self, rng: np.random.Generator, path: Path) -> None:
        at, end = sorted(rng.integers(0, len(self.content), 2).tolist())
        path.write_bytes(self.content[: at + 1] if rng.random() < 0.5 else self.content[:at] + self.content[end + 1 :])

    def overwrite(self, rng: np.random.Generator, path: Path) -> None:
        content = bytearray(self.content)
        n = int(rng.integers(1, 600))
        at = int(rng.integers(0, len(content) - n)) if rng.random() < 0.5 else len(content) - n  # the list of members
        content[at : at + n] = bytes(n) if rng.random() < 0.5 else rng.bytes(n)
        path.write_bytes(content)

    # -- members, under a new list of members --------------------------------------------------------------------------
    def rezip(self, members: list[tuple[str, bytes]], path: Path) -> None:
        with zipfile.ZipFile(path, "w") as archive:
            for name, content in members:
                archive.writestr(name, content)
            archive.comment = HASH + bytes(32)

    def change_member(self, rng: np.random.Generator, path: Path) -> None:
        names = list(self.members)
        name, other = (names[i] for i in rng.integers(0, len(names), 2))
        content = self.members[name]
        changed = [b"", content[: len(content) // 2], content + b"\0", self.members[other], rng.bytes(300)]
        self.rezip(list({**self.members, name: changed[int(rng.integers(5))]}.items()), path)

    def change_header(self, rng: np.random.Generator, path: Path) -> None:
        name = list(self.members)[int(rng.integers(len(self.members)))]
        headers = [
            "{'descr': '|O', 'fortran_order': False, 'shape': (3,), }", "{'descr': '<f4', 'shape': (3,), }", "(" * 5000,
            "{'descr': '<f8', 'fortran_order': False, 'shape': (100000000000, 100000), }", "[" * 90 + "1", "import os",
            "{'descr': [('a', '|O')], 'fortran_order': False, 'shape': (), }", "{'descr': '<f4', 'fortran_order':",
            "{'descr': '<U99999999', 'fortran_order': False, 'shape': (), }", "'''", "-" * 9999, "{'descr': '<m8'}",
            "{'descr': '<f4', 'fortran_order': False, 'shape': (-1,), }",
            f"{{'descr': '<i8', 'fortran_order': False, 'shape': ({'9' * 5000},), }}",
        ]  # fmt: skip
        header = headers[int(rng.integers(len(headers)))].encode() + b"\n"
        version = bytes([1, 0]) if rng.random() < 0.7 else bytes([int(rng.integers(5)), int(rng.integers(3))])
        length = len(header).to_bytes(2 if version[0] == 1 else 4, "little")
        self.rezip(list({**self.members, name: b"\x93NUMPY" + version + length + header}.items()), path)

    def change_list_of_members(self, rng: np.random.Generator, path: Path) -> None:
        members = list(self.members.items())
        at = int(rng.integers(len(members)))
        name, content = members.pop(at)
        more = [[], [(name.upper(), content)], [("../" + name, content)], [(name, content), ("x" + SUFFIX, content)]]
        self.rezip(members + more[int(rng.integers(4))], path)

    # -- contents, with the right hash ---------------------------------------------------------------------------------
    def reseal(self, path: Path, description: Any = None, **changed: np.ndarray) -> None:
        text = description if isinstance(description, str) else json.dumps(description or self.description)
        write_members(path, {**self.arrays, **changed, DESCRIPTION: np.array(text)})

    def change_json(self, rng: np.random.Generator, path: Path) -> None:
        description = json.loads(json.dumps(self.description))
        for _ in range(int(rng.integers(1, 3))):
            places = list(_places(description))
            if rng.random() < 0.3:
                places = [place for place in places if place[0] is description]
            holder, key = places[int(rng.integers(len(places)))]
            if rng.random() < 0.2:
                del holder[key]
            else:
                holder[key] = WRONG_VALUES[int(rng.integers(len(WRONG_VALUES)))]
        self.reseal(path, json.dumps(description))

    def change_array(self, rng: np.random.Generator, path: Path) -> None:
        names = [name for name in self.arrays if name != DESCRIPTION]
        name = names[int(rng.integers(len(names)))]
        array = self.arrays[name]
        with np.errstate(over="ignore"):
            huge = np.full(array.shape, 2**30).astype(array.dtype)
            changes = [
                array.astype(np.float16), array.astype(str), array.ravel(), array[..., :1], array[:0],
                array[np.newaxis], huge, huge * huge, np.asfortranarray(array), np.zeros((), array.dtype),
                array.astype(bool), array.astype(array.dtype.newbyteorder()),
            ]  # fmt: skip
        self.reseal(path, **{name: changes[int(rng.integers(len(changes)))]})

    def nest_deeply(self, rng: np.random.Generator, path: Path) -> None:
        depth, (opening, closing) = int(rng.integers(500, 200_000)), ["[]", ('{"list":[', "]}")][int(rng.integers(2))]
        text = json.dumps({**self.description, "scene": "HERE"})
        self.reseal(path, text.replace('"HERE"', opening * depth + "1" + closing * depth))


def _places(value: Any) -> Any:
    """Yield (holder, key or index) of every value in a JSON tree."""
    items = (
        list(value.items()) if isinstance(value, dict) else list(enumerate(value)) if isinstance(value, list) else []
    )
    for key, item in items:
        yield value, key
        yield from _places(item)
