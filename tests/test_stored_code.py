"""Kernels whose machine code is on disk: the same results, without the compiler."""

import operator
import os
import subprocess
import sys
from pathlib import Path
from typing import Any, NamedTuple

import numba
import numpy as np
import pytest
from numba import types
from numba.core.compiler import Flags
from numba.core.registry import cpu_target

from softshadow.jit.parts import KernelFlags, typing_for_kernels
from softshadow.jit.stored_code import type_of

KERNELS = """
import sys
import numpy as np
from softshadow.jit import allocating_kernel, kernel, stored_code

@kernel
def inner(x):
    return x * 2 + 1

@kernel
def outer(x):
    return inner(x) + 100

@kernel
def outermost(x):
    return outer(x) - 7

@kernel
def many_calls(x):
    return inner(0) + inner(1) + inner(x)

@kernel
def row_sum(array):
    total = 0.0
    for i in range(array.shape[0]):
        row = array[i]
        total += row[0] + row[1]
    return total

@allocating_kernel
def several(array, names):
    if array.shape[0] == 0:
        raise ValueError("empty")
    copy = np.empty(array.shape[0])
    for i in range(array.shape[0]):
        copy[i] = array[i] * names[0]
    return copy, names, array[0] > 0

@allocating_kernel
def checked(x):
    if x < 0:
        raise ValueError("negative", x)
    return x

@allocating_kernel
def sum_with_one(x):
    return checked(x) + 1

@allocating_kernel
def sum_with_two(x):
    return checked(x) + 2

def make(number):
    @kernel
    def closed(x):
        return x + number
    return closed

def calling(number):
    part = make(number)
    @kernel
    def caller(x):
        return part(x) * 10
    return caller

@kernel
def with_a_function(x):
    def twice(y):
        return y + y
    return twice(x)

def compiler_started():
    return "numba.np.arrayobj" in sys.modules
"""
RUN = """
print(inner(3), several(np.ones(2), (4.0, 2))[0], make(5)(1), make(6)(1), compiler_started())
try:
    several(np.ones(0), (4.0, 2))
except ValueError as error:
    print(error)
"""
RESULT = "7 [4. 4.] 6 7 {}\nempty"


class Pair(NamedTuple):
    """As pipeline/records.py has many."""

    first: Any
    second: Any


@pytest.fixture
def run(tmp_path: Path) -> Any:
    """Run code after the kernels in a process of its own, with an own cache; return what it prints."""
    script = tmp_path / "kernels.py"  # Numba's cache asks for a file

    def run_code(code: str) -> str:
        (tmp_path / "code.py").write_text(f"from kernels import *\n{code}")
        script.write_text(KERNELS)
        environment = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path / "cache")}
        environment["PYTHONPATH"] = os.pathsep.join([str(tmp_path), *(entry or os.getcwd() for entry in sys.path)])
        environment.pop("NUMBA_DISABLE_JIT", None)
        os.utime(script, (1, 1))  # the same file for Numba's cache, though it was written anew
        done = subprocess.run(
            [sys.executable, "-P", str(tmp_path / "code.py")], env=environment, capture_output=True, text=True
        )
        assert done.returncode == 0, done.stderr
        return done.stdout.strip()

    return run_code


def test_machine_code_from_disk_gives_the_same_without_the_compiler(run: Any) -> None:
    assert run(RUN) == RESULT.format(True)
    assert run(RUN) == RESULT.format(False)


def test_a_kernel_that_is_compiled_later_calls_one_from_disk(run: Any) -> None:
    assert run("print(inner(3))") == "7"
    assert run("print(inner(3), compiler_started(), outer(3), compiler_started())") == "7 False 107 True"


@pytest.mark.slow
def test_a_name_that_is_missing_in_the_process_starts_the_compiler(run: Any) -> None:
    run(RUN)
    missing = "stored_code.llvm.address_of_symbol = lambda name: None\n"
    assert run(missing + RUN) == RESULT.format(True)


def test_another_version_of_numba_loads_kernels_in_its_own_way(run: Any) -> None:
    run(RUN)
    other = "del stored_code.StoredResults.rebuild_without_compiler\n"
    assert run(other + RUN) == RESULT.format(True)


@pytest.mark.slow
def test_another_version_of_numba_compiles_in_its_own_way(run: Any) -> None:
    late = """
@kernel
def part(x):
    return x * 2
@kernel
def late(x):
    return part(x) + part(1)
print(type(late._compiler).__name__, late(3))
"""
    assert run("stored_code.KernelCompiler = lambda *arguments: arguments.missing" + late) == "_FunctionCompiler 8"
    assert run(late) == "KernelCompiler 8"


def files_of(folder: Path, ending: str) -> list[Path]:
    found = sorted((folder / "cache").rglob(f"*{ending}"))
    assert found
    return found


DAMAGE = {
    "a flipped bit": lambda content: content[:-9] + bytes([content[-9] ^ 4]) + content[-8:],
    "flipped bits in the middle": lambda content: bytes(
        byte ^ 255 if i % 97 == 50 else byte for i, byte in enumerate(content)
    ),
    "the first half": lambda content: content[: len(content) // 2],
    "nothing": lambda content: b"",
    "something else": lambda content: b"kernel" * 500,
    "zeros": lambda content: bytes(len(content)),
}


@pytest.mark.parametrize(
    ("ending", "damage"),
    [
        pytest.param(
            ending,
            damage,
            marks=[] if (ending, damage) == (".nbi", "flipped bits in the middle") else [pytest.mark.slow],
        )
        for ending in (".nbi", ".nbc")
        for damage in DAMAGE
    ],
)
def test_damaged_files_are_compiled_anew(run: Any, tmp_path: Path, damage: str, ending: str) -> None:
    run("print(inner(3))")
    for file in files_of(tmp_path, ending):
        file.write_bytes(DAMAGE[damage](file.read_bytes()))
    code = "print(inner(3), compiler_started())"
    assert run(code) == "7 True"
    assert run(code) == "7 False"


def test_code_of_another_kernel_under_a_name_in_the_index_is_not_used(run: Any, tmp_path: Path) -> None:
    run("inner(3), inner(0.5)")
    one, other = files_of(tmp_path, ".nbc")
    one.write_bytes(other.read_bytes())
    assert run("print(inner(3), inner(0.5))") == "7 2.0"


@pytest.mark.slow
def test_files_that_are_folders_are_done_without(run: Any, tmp_path: Path) -> None:
    run("inner(3)")
    for file in [*files_of(tmp_path, ".nbi"), *files_of(tmp_path, ".nbc")]:
        file.unlink()
        file.mkdir()
    assert run("print(inner(3))") == "7"


FULL = """
import resource, signal
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, ({size}, {size}))
"""


@pytest.mark.parametrize("size", [0, *(pytest.param(size, marks=pytest.mark.slow) for size in (200, 3000))])
def test_a_full_disk_only_costs_time(run: Any, tmp_path: Path, size: int) -> None:
    assert run(FULL.format(size=size) + "print(inner(3))") in ("7", "")  # nothing may be printed to a file either
    assert run("print(inner(3))") == "7"
    assert not list((tmp_path / "cache").rglob("*.tmp.*"))


@pytest.mark.slow
def test_a_deleted_folder_only_costs_time(run: Any, tmp_path: Path) -> None:
    assert run(f"import shutil; shutil.rmtree({str(tmp_path / 'cache')!r})\nprint(inner(3))") == "7"


@pytest.mark.slow
def test_constant_arguments_do_not_compile_a_kernel_again(run: Any) -> None:
    assert run("print(many_calls(2), len(inner.signatures))") == "9 1"


def test_only_allocating_kernels_count_references(run: Any) -> None:
    code = "several(np.ones(2), (4.0, 2)); row_sum(np.ones((2, 2)))\n"
    code += "print(*['NRT_decref' in next(iter(each.inspect_llvm().values())) for each in (several, row_sum)])"
    assert run(code) == "True False"


@pytest.mark.slow
def test_wrong_arguments_have_numbas_own_message(run: Any) -> None:
    code = "try:\n    inner(object())\nexcept Exception as error:\n    print(type(error).__name__)"
    assert run(code) == "TypingError"


COMPILATIONS = """
from numba.core import event
compiled = []

class Count(event.Listener):
    def on_start(self, event):
        compiled.append(event.data["dispatcher"].py_func.__name__)

    def on_end(self, event):
        pass

event.register("numba:compile", Count())
"""


def test_a_kernel_called_by_another_one_first_and_then_by_python_is_complete(run: Any) -> None:
    numbers = "print(outer(3), many_calls(2), inner(3), inner(4), len(inner.signatures), compiler_started())\n"
    wrapped = "print(*['PyArg' in code for code in inner.inspect_llvm().values()])\n"
    assert run(f"outer(3)\n{wrapped}{numbers}{wrapped}") == "False\n107 9 7 9 1 True\nTrue"
    assert run(numbers) == "107 9 7 9 1 False"


def test_a_part_from_disk_is_not_compiled_again_for_another_caller(run: Any) -> None:
    assert run("print(outer(3))") == "107"
    code = COMPILATIONS + "print(many_calls(2), compiled)\nprint(inner(3), compiled)"
    assert run(code) == "9 ['many_calls']\n7 ['many_calls', 'inner']"


def test_kernels_that_enclose_kernels_are_found_on_disk(run: Any) -> None:
    code = "print(calling(5)(1), calling(6)(1), compiler_started())"
    assert run(code) == "60 70 True"
    assert run(code) == "60 70 False"


def test_parts_are_stored_without_addresses_of_the_process(run: Any) -> None:
    # Numba warns where it cannot store
    code = "import warnings; warnings.simplefilter('error')\nprint(outermost(3), calling(5)(1))"
    assert run(code) == "100 60"


@pytest.mark.slow
def test_a_function_within_a_kernel_is_compiled_with_it(run: Any) -> None:
    assert run("print(with_a_function(4))") == "8"


def test_operators_and_functions_of_python_have_numbas_types() -> None:
    numbas = cpu_target.typing_context
    ours = typing_for_kernels(numbas)
    ours.refresh()
    functions = [operator.add, operator.lt, operator.truediv, *map(numbas.resolve_value_type, (operator.sub, min, max))]
    for func in functions:
        for each in ((types.int32, types.uint64), (types.float32, types.int64), (types.float32, types.float64)):
            expected = numbas.resolve_function_type(func, each, {})
            # looked for, and then known
            assert expected == ours.resolve_function_type(func, each, {}) == ours.resolve_function_type(func, each, {})
    for cls in (bool, int):
        of_class = numbas.resolve_value_type(cls)
        expected = numbas.resolve_function_type(of_class, (types.float32,), {})
        assert expected == ours.resolve_function_type(of_class, (types.float32,), {})
    assert ours is typing_for_kernels(numbas)


@pytest.mark.slow
def test_an_error_raised_in_a_part_has_its_values(run: Any) -> None:
    code = """
for number in (2, -2):
    try:
        print(sum_with_one(number))
    except ValueError as error:
        print(error)
"""
    assert run(code) == "3\n('negative', -2)"
    assert run(code) == "3\n('negative', -2)"
    later = code.replace("sum_with_one", "sum_with_two")  # compiled with the part from disk
    assert run(later) == "4\n('negative', -2)"


def test_flags_of_kernels_are_compared_as_numbas() -> None:
    plain = Flags()
    plain.nrt, plain.error_model = True, "numpy"
    ours, other = KernelFlags(plain), KernelFlags(plain)
    other.boundscheck = True
    assert hash(ours) == hash(plain)
    assert ours.values() == plain.values()
    assert ours == plain == ours
    assert ours != other
    assert plain != other


def test_a_part_has_the_flags_of_a_complete_kernel() -> None:
    complete, part = KernelFlags(), KernelFlags()
    part.no_compile = part.no_cpython_wrapper = True
    assert complete == part


@pytest.mark.parametrize(
    "value",
    [
        1, -1, 2**40, 2**63, 0.5, True, None, np.float32(1), np.uint8(1), np.int64(1), np.bool_(True),
        (), (1, 2), (1, 0.5), Pair(1, np.zeros(3)), Pair(1, 2), ((1, 2), (np.zeros((2, 2)),)),
        np.zeros((2, 3), np.float32), np.zeros((2, 3)).T, np.zeros((4, 4))[::2, ::2], np.zeros(0, np.uint8),
        np.zeros(()), np.zeros(2, [("x", "f4"), ("y", "i4")]), np.broadcast_to(np.float32(1), (2, 2)),
    ],
    ids=lambda value: repr(value).replace("\n", ""),
)  # fmt: skip
def test_types_of_arguments_are_numbas(value: Any) -> None:
    ours, theirs = type_of(value), numba.typeof(value)
    assert ours == theirs
    assert hash(ours) == hash(theirs)
