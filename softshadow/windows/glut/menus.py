"""The menus of a GLUT program: their entries, and which one is chosen."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

from softshadow.errors import StateError


@dataclass
class Entry:
    """An entry: choosing it calls the menu's function with its value, or opens another menu."""

    label: str
    value: int = 0
    submenu: int = 0


@dataclass
class Menu:
    """A menu: a function, and the entries from top to bottom."""

    function: Callable[[int], Any] | None
    entries: list[Entry] = field(default_factory=list)
    data: Any = None


def _text(label: Any) -> str:
    return label.decode(errors="replace") if isinstance(label, bytes) else str(label)


class Menus:
    """All menus of a program, by their numbers; calls change the current one."""

    def __init__(self) -> None:
        self.all: dict[int, Menu] = {}
        self.current = 0
        self._last = 0

    def calls(self) -> dict[str, Callable[..., Any]]:
        """Return GLUT's functions about menus, except those that attach them to a window."""
        return {
            "glutCreateMenu": self.create,
            "glutDestroyMenu": self.destroy,
            "glutGetMenu": lambda: self.current,
            "glutSetMenu": self.select,
            "glutAddMenuEntry": self.add_entry,
            "glutAddSubMenu": self.add_submenu,
            "glutChangeToMenuEntry": self.change_to_entry,
            "glutChangeToSubMenu": self.change_to_submenu,
            "glutRemoveMenuItem": self.remove,
            "glutSetMenuFont": lambda *_: None,  # nobody sees a menu
            "glutGetMenuData": lambda: self.all[self.current].data if self.current else None,
            "glutSetMenuData": self.set_data,
        }

    def create(self, function: Callable[[int], Any] | None) -> int:
        """Make an empty menu the current one; return its number."""
        self._last += 1
        self.all[self._last] = Menu(function)
        self.current = self._last
        return self.current

    def destroy(self, number: int) -> None:
        """Remove a menu."""
        self.all.pop(number, None)
        if self.current == number:
            self.current = 0

    def select(self, number: int) -> None:
        """Make a menu the current one."""
        if number in self.all:
            self.current = number

    def set_data(self, data: Any) -> None:
        """Keep a value with the current menu."""
        if self.current:
            self.all[self.current].data = data

    # -- entries of the current menu -----------------------------------------------------------------------------------
    @property
    def entries(self) -> list[Entry]:
        """The entries of the current menu; without one, a list that is dropped."""
        return self.all[self.current].entries if self.current else []

    def add_entry(self, label: Any, value: int) -> None:
        """Add an entry at the bottom."""
        self.entries.append(Entry(_text(label), int(value)))

    def add_submenu(self, label: Any, submenu: int) -> None:
        """Add an entry that opens another menu."""
        if submenu in self.all:
            self.entries.append(Entry(_text(label), submenu=submenu))

    def change_to_entry(self, item: int, label: Any, value: int) -> None:
        """Replace the item, counted from 1, by an entry with a value."""
        if 1 <= item <= len(self.entries):
            self.entries[item - 1] = Entry(_text(label), int(value))

    def change_to_submenu(self, item: int, label: Any, submenu: int) -> None:
        """Replace the item, counted from 1, by an entry that opens another menu."""
        if 1 <= item <= len(self.entries) and submenu in self.all:
            self.entries[item - 1] = Entry(_text(label), submenu=submenu)

    def remove(self, item: int) -> None:
        """Remove the item, counted from 1."""
        if 1 <= item <= len(self.entries):
            del self.entries[item - 1]

    # -- choosing ------------------------------------------------------------------------------------------------------
    def choose(self, attached: list[int], label: str) -> tuple[int, int]:
        """Return the number of the menu that has an entry, and the entry's value.

        Raises
        ------
        StateError                   no attached menu has the entry
        """
        found = [(path, menu, entry) for number in attached for path, menu, entry in self._within(number, ())]
        for path, menu, entry in found:
            if label in (entry.label, "/".join(path)):
                return menu, entry.value
        labels = ", ".join("/".join(path) for path, _, _ in found) or "none"
        raise StateError(f"Menu:{label}: no attached menu has this entry; there are: {labels}")

    def _within(self, number: int, above: tuple[str, ...]) -> Iterator[tuple[tuple[str, ...], int, Entry]]:
        for entry in self.all[number].entries if number in self.all else ():
            path = (*above, entry.label)
            if not entry.submenu:
                yield path, number, entry
            elif len(above) < len(self.all):  # a menu may contain itself
                yield from self._within(entry.submenu, path)
