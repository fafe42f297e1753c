"""Kernels that other kernels call are compiled as parts of these.

Numba compiles each function for Python: with a wrapper that unpacks Python's arguments, and to machine code. Where only
kernels call a function, nobody uses either, as each caller contains the function's intermediate code. So a kernel is
compiled up to that code when another kernel asks for it; and completely, when Python calls it.
"""

from typing import Any

from llvmlite import binding as llvm
from numba.core import dispatcher
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import Flags, compile_extra

PART = "part"  # kind of a stored library
# what may differ between a part and a complete kernel, without any effect on what they call
ONLY_FOR_PARTS = {"no_compile": False, "no_cpython_wrapper": False}
FLAGS_HASH = hash(Flags())


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


class PartLibrary(JITCodeLibrary):
    """Intermediate code that callers contain. If it is from disk, it is parsed when a caller is compiled."""

    bitcode = b""

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

    def _compile_core(self, args: Any, return_type: Any) -> Any:
        if not self.for_kernels:
            result = super()._compile_core(args, return_type)
            # parts set no environments: they have no machine code
            for environment in result._find_referenced_environments():
                result.codegen.set_env(environment.env_name, environment)
            return result
        target = self.targetdescr.target_context
        flags: Any = self._customize_flags(Flags())
        self.targetdescr.options.parse_as_flags(flags, self.targetoptions)
        flags.no_compile = flags.no_cpython_wrapper = True
        library = PartLibrary(target.codegen(), self.py_func.__qualname__)
        result = compile_extra(
            self.targetdescr.typing_context, target, self.py_func, args, return_type, flags, self.locals, library,
            self.pipeline_class,
        )  # fmt: skip
        return as_part(result)

    def _customize_flags(self, flags: Flags) -> Flags:
        return KernelFlags(flags)


def as_part(result: Any) -> Any:
    """Return the result as other kernels find it, by its environment in place of an entry point."""
    part = result._replace(entry_point=result.environment)
    part.target_context.insert_user_function(part.entry_point, part.fndesc, [part.library])
    return part


def is_part(result: Any) -> bool:
    """Return whether only kernels can call this."""
    return isinstance(result.library, PartLibrary)
