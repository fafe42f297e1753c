"""Import of the libraries of the extra `softshadow[notebook]`, with a message that names it where they are missing."""

from __future__ import annotations

from importlib import import_module
from typing import Any


def needed(module: str, by: str) -> Any:
    """Return a module of the extra.

    Raises
    ------
    ImportError                  it is not installed; the message has the command that installs it
    """
    try:
        return import_module(module)
    except ModuleNotFoundError as error:
        library = module.partition(".")[0]
        if (error.name or "").partition(".")[0] != library:
            raise
        raise ImportError(
            f"softshadow.notebook.{by} needs {library}, which is not installed: pip install 'softshadow[notebook]'",
            name=library,
        ) from None
