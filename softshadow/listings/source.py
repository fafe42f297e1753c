"""The source of a listing as printed or as corrected, with the steps in which each line is executed.

The program is run once, and the lines of this block that it executes are recorded. The switches of the corrections are
resolved as they were in this run: what is left is the listing without the questions that choose between its versions.
"""

import ast
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from types import CodeType, FrameType
from typing import Any

from softshadow.listings.listing import Listing
from softshadow.listings.stage import SIZE

FOLDER = Path(__file__).parent
# what the slides call without showing it, like dibuixa(escena), and a shader, which runs when its draw is carried out
SCAFFOLD = ("stage.py", "listing.py", "source.py", "slide_shader.py")


@dataclass(frozen=True)
class Line:
    """A line of source: its number in the file, its text, and the indices of the steps that execute it."""

    number: int
    text: str
    steps: tuple[int, ...]


@dataclass(frozen=True)
class Excerpt:
    """A function of a listing: the name of its file, its own name, and its lines."""

    file: str
    function: str
    lines: tuple[Line, ...]

    def __str__(self) -> str:
        lines = [f"{' '.join(map(str, line.steps)):>7} {line.number:4d}  {line.text}".rstrip() for line in self.lines]
        return "\n".join([f"{self.file}: {self.function}", *lines])


@dataclass
class Executed:
    """What a run executed: steps by file and line, the corrections that each function got, and the titles."""

    steps: dict[tuple[str, int], set[int]]
    corrected: dict[tuple[str, str], frozenset[str]]
    titles: list[str]


def titles_of(listing: Listing, corrected: Iterable[str] | None = None) -> list[str]:
    """Return the titles of the steps of a listing, with some corrections or, by default, all of them."""
    return executed(listing, corrected).titles


def code_of(listing: Listing, corrected: Iterable[str] | None = None) -> list[Excerpt]:
    """Return the functions that a listing executes, in the order of their first lines, with its switches resolved.

    Parameters
    ----------
    corrected                    numbers of the corrections to apply; all of them by default

    Examples
    --------
    >>> from softshadow import listings
    >>> print(code_of(listings.get("stencil-quads"))[0])
    depth_and_stencil.py: two_quads
    ...
    """
    run = executed(listing, corrected)
    excerpts: dict[tuple[str, str], Excerpt] = {}
    for file, number in run.steps:
        function = next((each for each in functions_of(file) if each.lineno <= number <= (each.end_lineno or 0)), None)
        if function is not None and (file, function.name) not in excerpts:
            lines = resolved(file, function, run.corrected.get((file, function.name)))
            steps = by_statement(function, {at: found for (of, at), found in run.steps.items() if of == file})
            excerpts[file, function.name] = Excerpt(
                file,
                function.name,
                tuple(Line(at, text, tuple(sorted(steps.get(at, ())))) for at, text in lines.items()),
            )
    return list(excerpts.values())


def executed(listing: Listing, corrected: Iterable[str] | None = None) -> Executed:
    """Run a listing in a context of its own, and return what it executed."""
    from softshadow import gl

    run = Executed({}, {}, [])

    def trace(frame: FrameType, event: str, argument: Any) -> Any:
        path = Path(frame.f_code.co_filename)
        if path.parent != FOLDER or path.name in SCAFFOLD:
            return None
        if event == "call" and isinstance(frame.f_locals.get("corrected"), frozenset):
            run.corrected[path.name, frame.f_code.co_name] = frame.f_locals["corrected"]
        if event == "line" and is_of_function(frame.f_code):
            run.steps.setdefault((path.name, frame.f_lineno), set()).add(len(run.titles))
        return trace

    with gl.create_context(*SIZE):
        steps = listing.steps(gl, corrected)
        while True:
            with tracing(trace):
                item = next(steps, None)
            if item is None:
                break
            run.titles.append(item if isinstance(item, str) else item[0])
    last = len(run.titles) - 1  # what follows the last step, such as a return, belongs to it
    run.steps = {line: {min(step, last) for step in steps} for line, steps in run.steps.items()}
    return run


@contextmanager
def tracing(trace: Any) -> Iterator[None]:
    """Call a function for every line inside the block; an earlier trace, as of a debugger, is set again after it."""
    before = sys.gettrace()
    sys.settrace(trace)
    try:
        yield
    finally:
        sys.settrace(before)


def is_of_function(code: CodeType) -> bool:
    """Return whether code belongs to a function, not to a class or a module."""
    return code.co_name not in ("<module>", "Stage", "Thing")


# -- source ------------------------------------------------------------------------------------------------------------
@cache
def lines_of(file: str) -> tuple[str, ...]:
    """Return the lines of a file of this block."""
    return tuple((FOLDER / file).read_text(encoding="utf-8").splitlines())


@cache
def functions_of(file: str) -> tuple[ast.FunctionDef, ...]:
    """Return the functions of a file of this block."""
    tree = ast.parse("\n".join(lines_of(file)))
    return tuple(node for node in tree.body if isinstance(node, ast.FunctionDef))


def by_statement(function: ast.FunctionDef, steps: dict[int, set[int]]) -> dict[int, set[int]]:
    """Return the steps of each line: all lines of a statement have those of any of them."""
    result = {}
    for node in ast.walk(function):
        if isinstance(node, ast.stmt) and node is not function:
            body = getattr(node, "body", None)
            last = body[0].lineno - 1 if body else node.end_lineno or node.lineno
            numbers = range(node.lineno, max(last, node.lineno) + 1)
            found = set().union(*(steps.get(number, set()) for number in numbers))
            result.update(dict.fromkeys(numbers, found))
    return result


def resolved(file: str, function: ast.FunctionDef, corrected: frozenset[str] | None) -> dict[int, str]:
    """Return the lines of a function by number, without the switches of the corrections."""
    last = function.end_lineno or function.lineno
    lines = {number: lines_of(file)[number - 1] for number in range(function.lineno, last + 1)}
    if corrected is not None:
        for node in sorted(switches(function, corrected), key=lambda each: (-each.lineno, -each.col_offset)):
            (replace_branch if isinstance(node, ast.If) else replace_expression)(lines, node, corrected)
    return lines


def switches(node: ast.AST, corrected: frozenset[str]) -> Iterator[Any]:
    """Yield the statements and the outermost expressions under a node that depend on the corrections alone."""
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.If) and truth_of(child.test, corrected) is not None:
            yield child
            for statement in (*child.body, *child.orelse):
                yield from switches(ast.Module([statement], []), corrected)
        elif depends(child, corrected):
            yield child
        else:
            yield from switches(child, corrected)


def depends(node: ast.AST, corrected: frozenset[str]) -> bool:
    """Return whether an expression is a choice between corrections, or a condition with a question about them."""
    if isinstance(node, ast.IfExp):
        return truth_of(node.test, corrected) is not None
    return isinstance(node, ast.BoolOp | ast.Compare) and simplified(node, corrected) is not node


def truth_of(test: ast.expr, corrected: frozenset[str]) -> bool | None:
    """Return whether a condition holds, or None if that does not depend on the corrections alone."""
    simple = simplified(test, corrected)
    return simple.value if isinstance(simple, ast.Constant) and isinstance(simple.value, bool) else None


def simplified(test: ast.expr, corrected: frozenset[str]) -> ast.expr:
    """Return a condition with its questions about corrections answered: the node itself if it has none."""
    if isinstance(test, ast.Compare) and isinstance(test.left, ast.Constant):
        if ast.unparse(test.comparators[0]) != "corrected":
            return test
        return ast.Constant((test.left.value in corrected) is isinstance(test.ops[0], ast.In))
    if not isinstance(test, ast.BoolOp):
        return test
    decides = isinstance(test.op, ast.Or)  # what one part must be to decide alone
    parts = [simplified(each, corrected) for each in test.values]
    if all(part is each for part, each in zip(parts, test.values, strict=True)):
        return test
    answers = [part.value for part in parts if isinstance(part, ast.Constant)]
    left = [part for part in parts if not isinstance(part, ast.Constant)]
    if decides in answers or not left:
        return ast.Constant(decides in answers if decides else decides not in answers)
    return left[0] if len(left) == 1 else ast.BoolOp(test.op, left)


def replace_expression(lines: dict[int, str], node: Any, corrected: frozenset[str]) -> None:
    """Replace a choice by what is chosen, or a condition by what is left of it."""
    if isinstance(node, ast.IfExp):
        chosen: Any = node.body if truth_of(node.test, corrected) else node.orelse
    else:
        chosen = simplified(node, corrected)
    first, last = lines[node.lineno].encode(), lines[node.end_lineno].encode()
    text = first[: node.col_offset] + ast.unparse(chosen).encode() + last[node.end_col_offset :]
    lines[node.lineno] = text.decode()
    for number in range(node.lineno + 1, node.end_lineno + 1):
        del lines[number]


def replace_branch(lines: dict[int, str], node: ast.If, corrected: frozenset[str]) -> None:
    """Replace a conditional statement by the branch that is taken."""
    taken = node.body if truth_of(node.test, corrected) else node.orelse
    start = (node.body[-1].end_lineno or 0) + 1 if taken is node.orelse else node.body[0].lineno
    numbers = range(start, (taken[-1].end_lineno or 0) + 1) if taken else range(0)
    for number in range(node.lineno, (node.end_lineno or 0) + 1):
        if number not in lines:
            continue
        line = lines[number]
        if number not in numbers or (taken is node.orelse and line.strip().startswith("else:")):
            del lines[number]
        else:
            lines[number] = line[taken[0].col_offset - node.col_offset :] if line.strip() else line
