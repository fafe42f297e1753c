"""A Python file executed as a module, and the traceback of its error cut to the lines of its folder."""

from __future__ import annotations

import ast
import sys
import tokenize
from pathlib import Path
from traceback import FrameSummary, StackSummary, extract_tb, format_exception_only
from types import ModuleType
from typing import Any


def execute(path: Path, name: str) -> dict[str, Any]:
    """Return the names that a Python file defines; it is executed as a module, with its folder on the import path.

    Raises
    ------
    OSError                      it cannot be read
    BaseException                anything that it raises
    """
    with tokenize.open(path) as file:
        text = file.read()
    module = ModuleType(name)
    module.__file__ = str(path)
    sys.modules[name] = module  # dataclasses look their module up
    sys.path.insert(0, str(path.parent))
    exec(compile(text, str(path), "exec", dont_inherit=True), vars(module))
    return vars(module)


def is_script(path: Path, function: str) -> bool:
    """Return whether a file is a program for PyOpenGL: it imports OpenGL, and has no function of this name.

    The file is read, not run. What is no Python is no script.
    """
    try:
        tree = ast.parse(path.read_bytes())
    except (OSError, SyntaxError, ValueError, RecursionError, MemoryError):
        return False
    imported: list[str] = []
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            imported += [each.name for each in node.names]
        elif isinstance(node, ast.ImportFrom) and node.module:
            imported.append(node.module)
    defined = {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}
    return function not in defined and any(name.partition(".")[0] == "OpenGL" for name in imported)


def frames_of(error: BaseException, path: Path) -> list[FrameSummary]:
    """Return the calls that led to an error, only those in files of the folder of `path`."""
    return [frame for frame in extract_tb(error.__traceback__) if Path(frame.filename).parent == path.parent]


def line_of(error: BaseException, path: Path) -> int | None:
    """Return the line of a file at which an error happened, None if it happened elsewhere."""
    if isinstance(error, SyntaxError) and error.filename == str(path):
        return error.lineno
    return next((frame.lineno for frame in reversed(frames_of(error, path)) if frame.filename == str(path)), None)


def cut_traceback(error: BaseException, path: Path) -> str:
    """Return the traceback of an error, without the lines of Python's and this package's files."""
    frames = StackSummary.from_list(
        [FrameSummary(Path(each.filename).name, each.lineno, each.name, line=each.line)
         for each in frames_of(error, path)]
    )  # fmt: skip
    head = ["Calls in your lines, the innermost last:\n"] if frames else []
    text = "".join([*head, *frames.format(), *format_exception_only(error)])
    return text.replace(str(path.parent) + "/", "").rstrip()
