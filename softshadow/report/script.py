"""The script of a report: the modules of templates/, in the order of their imports, as one module.

A page that is opened as a file cannot import modules from other files, so their import and export words are removed.
"""

from __future__ import annotations

import re
from functools import cache
from importlib.resources import files

IMPORT = re.compile(r'^import \{[^}]*\} from "\./([\w.]+)";\n', re.MULTILINE)
EXPORT = re.compile(r"^export (?=async |function |class |const )", re.MULTILINE)


@cache
def script_of(main: str) -> str:
    """Return a module of templates/ and all modules that it imports, each before those that import it."""
    texts: dict[str, str] = {}
    _collect(main, texts)
    return "\n".join(f"// -- {name}\n{EXPORT.sub('', IMPORT.sub('', text))}" for name, text in texts.items())


def _collect(name: str, texts: dict[str, str]) -> None:
    """Add a module to `texts`, behind the modules that it imports."""
    text = (files("softshadow.report") / "templates" / name).read_text(encoding="utf-8")
    for imported in IMPORT.findall(text):
        if imported not in texts:
            _collect(imported, texts)
    texts[name] = text
