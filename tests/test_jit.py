"""The cache of compiled kernels: never stale, and optional."""

import ast
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

import softshadow
from softshadow.kernel_cache import KERNEL_SOURCES

PACKAGE = Path(softshadow.__file__).parent
WATCH = """
import gc
import softshadow.pipeline
from numba.core import event
from softshadow.jit import kernel

meanwhile = []

class Watch(event.Listener):
    def on_start(self, event):
        meanwhile.append(gc.isenabled())

    def on_end(self, event):
        pass

@kernel
def inner(x):
    return x + 1

@kernel
def outer(x):
    return inner(x)

with event.install_listener("numba:compile", Watch()):
    outer(1)
print(meanwhile, gc.isenabled())
gc.disable()
outer(1.5)
print(gc.isenabled())
"""
COUNT_UP = """
import numpy as np
from softshadow.pipeline.raster.fragment_ops import FragmentOps, process_fragment
from softshadow.tokens import GL_ALWAYS, GL_INCR, GL_KEEP
ops = FragmentOps(0, GL_ALWAYS, 1, GL_ALWAYS, GL_KEEP, GL_KEEP, GL_INCR, 255, 0, GL_ALWAYS, 0, 0, 0, 0, 255, 255)
print(process_fragment(ops, True, 0, np.float32(0), np.float32(0), np.uint8(7))[1])
"""
TOKENS_AS_BEFORE = "GL_ALWAYS, GL_INCR, GL_KEEP = 0x0207, 0x1E02, 0x1E00"


def run_with(source: Path, cache: Path, code: str = COUNT_UP) -> str:
    """Run code on a copy of the package in a process of its own."""
    environment = {**os.environ, "PYTHONPATH": str(source), "XDG_CACHE_HOME": str(cache)}
    environment.pop("NUMBA_CACHE_DIR", None)
    environment.pop("NUMBA_DISABLE_JIT", None)
    # Python looks in the current folder first, where there may be another copy of the package
    command = [sys.executable, "-c", code]
    done = subprocess.run(command, env=environment, cwd=source, capture_output=True, text=True, check=True)
    return done.stdout.strip()


def test_an_edit_in_another_file_of_a_kernel_changes_the_next_result(tmp_path):
    # process_fragment's own file stays the same: what is edited is a constant that it gets from elsewhere
    copy = tmp_path / "source" / "softshadow"
    shutil.copytree(PACKAGE, copy, ignore=shutil.ignore_patterns("__pycache__"))
    assert run_with(copy.parent, tmp_path / "cache") == "8"
    assert run_with(copy.parent, tmp_path / "cache") == "8"  # this time from the cache
    constants = copy / "tokens.py"
    text = constants.read_text()
    edited = text.replace("GL_KEEP = 0x1E00", "GL_KEEP = 0x1E02").replace("GL_INCR = 0x1E02", "GL_INCR = 0x1E00")
    assert edited != text
    constants.write_text(edited)
    # 0x1E00 is now spelled GL_INCR, and the code that asks for op 0x1E02 gets GL_KEEP
    asks = COUNT_UP.replace("from softshadow.tokens import GL_ALWAYS, GL_INCR, GL_KEEP", TOKENS_AS_BEFORE)
    assert run_with(copy.parent, tmp_path / "cache", asks) == "7"


def test_code_is_kept_and_read_again(tmp_path):
    run_with(PACKAGE.parent, tmp_path)
    cached = sorted(p.name for p in (tmp_path / "softshadow").rglob("*.nbi"))
    assert any(name.startswith("fragment_ops.process_fragment") for name in cached)


def test_another_copy_of_the_same_version_finds_the_code(tmp_path):
    ask = f"{COUNT_UP}print(sum(process_fragment.stats.cache_hits.values()))"
    for name, hits in ("first", 0), ("second", 1):
        copy = tmp_path / name / "softshadow"
        shutil.copytree(PACKAGE, copy, ignore=shutil.ignore_patterns("__pycache__"), copy_function=shutil.copy)
        assert run_with(copy.parent, tmp_path / "cache", ask).splitlines() == ["8", str(hits)]


@pytest.mark.slow
def test_a_cache_folder_that_cannot_be_written_is_no_error(tmp_path):
    blocked = tmp_path / "a file where the folder should be"
    blocked.write_text("")
    assert run_with(PACKAGE.parent, blocked) == "8"


def test_garbage_is_collected_after_kernels_are_compiled_where_it_was_before(tmp_path):
    script = tmp_path / "watch.py"  # of a file: Numba's cache asks for one
    script.write_text(WATCH)
    code = f"import runpy; runpy.run_path({str(script)!r})"
    assert run_with(PACKAGE.parent, tmp_path, code).splitlines() == ["[False, False] True", "False"]


def test_a_users_own_numba_cache_folder_is_left_as_it_was(tmp_path):
    code = "import numba; numba.config.CACHE_DIR = 'mine'; import softshadow.pipeline; print(numba.config.CACHE_DIR)"
    assert run_with(PACKAGE.parent, tmp_path, code) == "mine"


def test_code_of_old_versions_is_deleted(tmp_path):
    versions = tmp_path / "softshadow"
    for age in range(12):
        old = versions / f"{age:016x}"
        old.mkdir(parents=True)
        os.utime(old, (age, age))
    run_with(PACKAGE.parent, tmp_path)
    left = sorted(entry.name for entry in versions.iterdir())
    assert len(left) == 8
    assert f"{11:016x}" in left  # the last that was used
    assert f"{0:016x}" not in left


@pytest.mark.slow
def test_code_that_is_used_is_recent_though_nothing_new_is_compiled(tmp_path):
    run_with(PACKAGE.parent, tmp_path)
    (folder,) = (tmp_path / "softshadow").iterdir()
    os.utime(folder, (1, 1))
    run_with(PACKAGE.parent, tmp_path)
    assert folder.stat().st_mtime > 1


def sources_of(name: str) -> list[Path]:
    path = PACKAGE / name
    return [path] if path.is_file() else sorted(path.rglob("*.py"))


def imported_by(file: Path) -> set[str]:
    """Return the modules of the package that a file imports from, as "pipeline" or "pixels.py"."""
    blocks = set()
    for node in ast.walk(ast.parse(file.read_text())):
        modules = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
        if isinstance(node, ast.ImportFrom) and node.module:
            modules = [node.module, *(f"{node.module}.{alias.name}" for alias in node.names)]
        for module in modules:
            parts = module.split(".")
            if parts[0] == "softshadow" and len(parts) > 1:
                blocks |= {name for name in (parts[1], f"{parts[1]}.py") if (PACKAGE / name).exists()}
    return blocks


def test_the_hash_takes_in_whatever_kernels_are_made_of():
    for name in KERNEL_SOURCES:
        for file in sources_of(name):
            assert imported_by(file) <= set(KERNEL_SOURCES), file.name


def test_only_hashed_sources_have_kernels():
    hashed = {file for name in KERNEL_SOURCES for file in sources_of(name)}
    for file in set(PACKAGE.rglob("*.py")) - hashed:
        decorators = {"@kernel", "@wide_kernel", "@copied_kernel", "@allocating_kernel", "@inlined"}
        assert not decorators & set(file.read_text().split()), file


MAKES_ARRAYS = {"empty", "zeros", "ones", "full", "arange", "array", "empty_like", "zeros_like", "concatenate"}


def test_kernels_that_make_arrays_say_so():
    for file in PACKAGE.rglob("*.py"):
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if not isinstance(node, ast.FunctionDef) or not {"kernel", "wide_kernel", "copied_kernel"} & set(
                map(ast.unparse, node.decorator_list)
            ):
                continue
            calls = [ast.unparse(call.func) for call in ast.walk(node) if isinstance(call, ast.Call)]
            made = MAKES_ARRAYS & {call.removeprefix("np.") for call in calls if call.startswith("np.")}
            assert not made, f"{file.name}: {node.name} must be an allocating_kernel, which np.{made} needs"


def decorators(node: ast.AST) -> set[str]:
    return set(map(ast.unparse, node.decorator_list)) if isinstance(node, ast.FunctionDef) else set()


def calls_from_python(node: ast.AST) -> Iterator[str]:
    """Yield the names of the functions that are called outside of kernels."""
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.FunctionDef) and any(
            name.endswith(("kernel", "inlined")) for name in decorators(child)
        ):
            continue
        if isinstance(child, ast.Call):
            yield ast.unparse(child.func)
        yield from calls_from_python(child)


def test_only_kernels_call_inlined_functions():
    # they are not cached: a call from Python would compile them in each process, which takes 200 ms
    trees, inlined, imports = {}, {}, {}
    for file in PACKAGE.rglob("*.py"):
        module = ".".join(file.relative_to(PACKAGE.parent).with_suffix("").parts).removesuffix(".__init__")
        tree = trees[module] = ast.parse(file.read_text(encoding="utf-8"))
        nodes = list(ast.walk(tree))
        functions = (node for node in nodes if isinstance(node, ast.FunctionDef))
        inlined[module] = {node.name for node in functions if "inlined" in decorators(node)}
        imports[module] = [node for node in nodes if isinstance(node, ast.ImportFrom)]
    assert "band_range" in inlined["softshadow.pipeline.raster.bins"]
    for module, tree in trees.items():
        names = set(inlined[module])
        for node in imports[module]:
            names |= {each.asname or each.name for each in node.names} & inlined.get(node.module or "", set())
        assert not names or not names & set(calls_from_python(tree)), module
