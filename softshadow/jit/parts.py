"""Kernels that other kernels call are compiled as parts of these.

Numba compiles each function for Python: with a wrapper that unpacks Python's arguments, and to machine code. Where only
kernels call a function, nobody uses either, as each caller contains the function's intermediate code. So a kernel is
compiled up to that code when another kernel asks for it; and completely, when Python calls it.
"""

import re
from functools import cache
from types import BuiltinFunctionType, CodeType, FunctionType
from typing import Any, ClassVar

from llvmlite import binding as llvm
from numba import types
from numba.core import dispatcher
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import CompilerBase, DefaultPassBuilder, Flags, compile_extra
from numba.core.typed_passes import NopythonRewrites
from numba.core.typing import Context as TypingContext
from numba.core.untyped_passes import InlineClosureLikes

PART = "part"  # kind of a stored library
# what may differ between a part and a complete kernel, without any effect on what they call
ONLY_FOR_PARTS = {"no_compile": False, "no_cpython_wrapper": False}
FLAGS_HASH = hash(Flags())
ROOM = 1 << 16  # values of a frame that takes little more than half of a block, the rest of which is for calls
PYTHON = ("_operator", "builtins")  # modules of operators, and of min, max, bool, range ...
SLOWED_DOWN = {"skylake-avx512", "cascadelake", "cooperlake", "cannonlake"}  # LLVM's names of processors
# of a function, cut where attributes may stand
DEFINITION = re.compile(r"^(define [^\n]*\)(?: (?:local_)?unnamed_addr)?)([^\n)]*\{)$", re.MULTILINE)


class KernelFlags(Flags):
    """Numba's flags, compared faster: it looks for each operator of a kernel whether it is known under equal flags.

    That took a tenth of the compile time, as all options were asked for their values each time.
    """

    def values(self) -> dict[str, Any]:
        """Return the values of all options."""
        return {**DEFAULTS, **self._values}

    def __hash__(self) -> int:
        return FLAGS_HASH  # in Numba, it depends on the names of the options only

    def __eq__(self, other: object) -> bool:
        if self is other:
            return True
        return isinstance(other, Flags) and {**self.values(), **ONLY_FOR_PARTS} == {**other.values(), **ONLY_FOR_PARTS}


DEFAULTS = {name: option.default for name, option in KernelFlags.options.items()}


class KernelPasses(CompilerBase):
    """Numba's steps without the search for expressions of whole arrays, and for functions within functions."""

    def define_pipelines(self) -> list[Any]:
        """Return the list of steps."""
        passes: Any = DefaultPassBuilder.define_nopython_pipeline(self.state)
        encloses = any(isinstance(each, CodeType) for each in self.state.func_id.code.co_consts)
        left_out = [NopythonRewrites] if encloses else [NopythonRewrites, InlineClosureLikes]
        passes.passes = [each for each in passes.passes if each[0] not in left_out]
        return [passes]


class KernelTyping(TypingContext):
    """Numba's typing, which remembers the types of operators and of Python's own functions.

    Looking for them anew in each kernel took a sixth of the compile time.
    """

    found: ClassVar[dict[Any, Any]] = {}

    def resolve_function_type(self, func: Any, args: Any, kws: Any) -> Any:
        """Return the signature of a call."""
        if kws or not is_python_function(func):
            return super().resolve_function_type(func, args, kws)
        call = func, tuple(args)
        signature = self.found.get(call)
        if signature is None:
            signature = super().resolve_function_type(func, args, kws)
            if signature is not None:
                self.found[call] = signature
        return signature


def is_python_function(func: Any) -> bool:
    """Return whether this, or what it is Numba's type of, is an operator or a function or class of Python itself."""
    key = func.typing_key if type(func) is types.Function else func
    return getattr(key, "__module__", None) in PYTHON and isinstance(key, BuiltinFunctionType | type)


@cache
def typing_for_kernels(context: Any) -> KernelTyping:
    """Return the typing context that shares everything with one of Numba's; Numba knows overloads by context."""
    typing = KernelTyping.__new__(KernelTyping)
    typing.__dict__ = context.__dict__
    return typing


def with_wide_vectors(module: Any) -> Any:
    """Return a module whose functions may use vectors of 64 bytes, if the processor has them and is as fast with them.

    LLVM takes 32 bytes on Intel's processors, because the first ones with AVX-512 run slower while they use more.
    """
    if llvm.get_host_cpu_name() in SLOWED_DOWN:
        return module
    wide = llvm.parse_assembly(DEFINITION.sub(r'\1 "prefer-vector-width"="512"\2', str(module)))
    wide.name = module.name
    return wide


class WholeLibrary(JITCodeLibrary):
    """Machine code, optimized once it contains all that the kernel calls.

    Numba would run the optimizer on each function before, and on each part, which changes nothing. And it would keep
    all functions as they are, as if others could call them. Where LLVM knows that nobody does, it leaves out arguments
    that are not used (of those of an array, most are not) and checks of results that are always the same.

    Attributes
    ----------
    is_wide : bool           see `with_wide_vectors`
    """

    is_wide = False

    def _optimize_functions(self, module: Any) -> None:
        module.data_layout = self._codegen._data_layout  # what remains of Numba's method

    def _optimize_final_module(self) -> None:
        for each in self._final_module.functions:
            if each.linkage == llvm.Linkage.linkonce_odr and not each.is_declaration:  # of a part
                each.linkage = llvm.Linkage.internal
        if self.is_wide:
            self._final_module = with_wide_vectors(self._final_module)
        passes, builder = self._codegen._module_pass_manager()
        passes.run(self._final_module, builder)


class PartLibrary(WholeLibrary):
    """Intermediate code that callers contain. If it is from disk, it is parsed when a caller is compiled.

    There it is optimized; here, only unused addresses of this process are removed, with which it could not be stored.
    """

    bitcode = b""

    def _optimize_final_module(self) -> None:
        passes: Any = llvm.create_new_module_pass_manager()
        passes.add_sroa_pass()
        passes.add_dead_code_elimination_pass()
        passes.add_global_dead_code_eliminate_pass()
        passes.run(self._final_module, self._codegen._pass_builder())

    def _get_module_for_linking(self) -> Any:
        if self._shared_module is None and self.bitcode:
            self._shared_module = llvm.parse_bitcode(self.bitcode)
        return super()._get_module_for_linking()

    def _finalize_final_module(self) -> None:
        """Finish without machine code."""
        self._finalize_dynamic_globals()
        self._verify_declare_only_symbols()
        self._finalized = True

    def serialize_using_object_code(self) -> tuple[str, str, tuple[bytes, bytes]]:
        """Return what is stored, in the form in which Numba stores machine code."""
        return self.name, PART, (b"", self._get_module_for_linking().as_bitcode())


# type checkers do not see it; where another version of Numba lacks it, `KernelDispatcher` keeps that version's own
NumbaCompiler: Any = getattr(dispatcher, "_FunctionCompiler", object)


class KernelCompiler(NumbaCompiler):
    """Compiles a kernel as a part of others if `for_kernels` is set, or for Python."""

    for_kernels: bool
    is_wide = False

    def _compile_core(self, args: Any, return_type: Any) -> Any:
        is_for_kernels, target = self.for_kernels, self.targetdescr.target_context
        flags: Any = KernelFlags(Flags())
        self.targetdescr.options.parse_as_flags(flags, self.targetoptions)
        if is_for_kernels:
            flags.no_compile = flags.no_cpython_wrapper = True
            library: WholeLibrary = PartLibrary(target.codegen(), self.py_func.__qualname__)
        else:
            library = WholeLibrary(target.codegen(), self.py_func.__qualname__)
            library.is_wide = self.is_wide
            library.enable_object_caching()
        result = call_with_room(
            compile_extra, typing_for_kernels(self.targetdescr.typing_context), target, self.py_func, args, return_type,
            flags, self.locals, library, KernelPasses,
        )  # fmt: skip
        if is_for_kernels:
            return as_part(result)
        # parts set no environments: they have no machine code
        for environment in result._find_referenced_environments():
            result.codegen.set_env(environment.env_name, environment)
        return result


def _call(function: Any, *arguments: Any) -> Any:
    return function(*arguments)


# The same with a large frame. Python takes blocks of memory for frames from the system: of 16 KB, or of what a frame
# needs, rounded up to a power of two. A call at the end of a block gets a new one each time. In the compiler, which
# calls deep, that took a tenth of the time.
call_with_room = FunctionType(_call.__code__.replace(co_stacksize=ROOM), globals())


def as_part(result: Any) -> Any:
    """Return the result as other kernels find it, by its environment in place of an entry point."""
    part = result._replace(entry_point=result.environment)
    part.target_context.insert_user_function(part.entry_point, part.fndesc, [part.library])
    return part


def is_part(result: Any) -> bool:
    """Return whether only kernels can call this."""
    return isinstance(result.library, PartLibrary)
