"""Names on the command line: of techniques, scenes, failures and listings, checked and completed by the shell.

The registers are imported when a name is checked or completed, so that ``--help`` stays fast.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Collection
from typing import Any

import click
from click.shell_completion import CompletionItem


class Name(click.ParamType, ABC):
    """A name of a register."""

    kind = ""

    @abstractmethod
    def names(self) -> Collection[str]:
        """Return all names."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """Return the name; an unknown one is an error that tells the nearest."""
        from softshadow.errors import nearest

        known = self.names()
        if value not in known:
            raise click.UsageError(f"unknown {self.kind} {value!r}: {nearest(value, known)}", ctx)
        return str(value)

    def shell_complete(self, ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
        """Return the names that begin like what is typed."""
        return [CompletionItem(name) for name in self.names() if name.startswith(incomplete)]


class TechniqueName(Name):
    """A technique."""

    name = kind = "technique"

    def names(self) -> Collection[str]:
        """Return the names of all techniques."""
        from softshadow import techniques

        return techniques.names()


class TechniqueChoice(TechniqueName):
    """A technique, with options if wanted: NAME:KEY=VALUE,KEY=VALUE; or a scene, which the command judges."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """Return the text; an unknown name is an error that tells the nearest."""
        name = str(value).partition(":")[0]
        if not is_scene(name):
            super().convert(name, param, ctx)
        return str(value)


def is_scene(name: str) -> bool:
    """Return whether a word on the command line names a scene, built in or in a file; no technique has such a name."""
    from softshadow.scene import scene_names

    return name in scene_names() or name.lower().endswith(".toml")


class FailureName(Name):
    """A failure of the gallery."""

    name = kind = "failure"

    def names(self) -> Collection[str]:
        """Return the names of all failures."""
        from softshadow import failures

        return failures


class ListingName(Name):
    """A listing of the course."""

    name = kind = "listing"

    def names(self) -> Collection[str]:
        """Return the names of all listings."""
        from softshadow import listings

        return listings.names()


class SceneName(Name):
    """A built-in scene, or a file."""

    name = kind = "scene"

    def names(self) -> Collection[str]:
        """Return the names of the built-in scenes."""
        from softshadow.scene import scene_names

        return scene_names()

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """Return the name or the path of a file, which is read later."""
        return str(value) if "." in value else super().convert(value, param, ctx)

    def shell_complete(self, ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
        """Return the names that begin like what is typed; if there is none, files."""
        return super().shell_complete(ctx, param, incomplete) or complete_files(ctx, param, incomplete)


class ErratumNumber(Name):
    """An error in the slides."""

    name = kind = "error"

    def names(self) -> Collection[str]:
        """Return the numbers of all errors in the slides."""
        from softshadow import course

        return course.ERRATA


def complete_files(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Let the shell complete the path of a file."""
    return [CompletionItem(incomplete, type="file")]


def complete_options(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Return the options of the techniques that stand before, each as KEY=, and its choices as KEY=VALUE."""
    from softshadow import techniques

    words = [ctx.params.get("technique"), *(ctx.params.get("names") or ()), *ctx.args]  # args: what is not parsed yet
    names = [name for word in words if word and (name := word.partition(":")[0]) in techniques.names()]
    texts = [
        f"{key}={choice}"
        for name in names
        for key, option in techniques.get(name).options.items()
        for choice in option.choices or ("",)
    ]
    return [CompletionItem(text) for text in dict.fromkeys(texts) if text.startswith(incomplete)]
