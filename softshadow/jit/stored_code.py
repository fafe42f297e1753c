"""Kernels whose machine code is on disk start without the compiler.

Numba prepares its compiler before it looks at the disk: it imports its implementations of Python's and NumPy's
functions, registers them, and parses the intermediate code of every kernel. For a program whose kernels are all on disk
this took most of the time until its first picture. Here, machine code is handed to LLVM as it is; the compiler starts
when something must be compiled. The files are Numba's own, behind checksums (`softshadow.kernel_cache` names their
folder).
"""

import contextlib
import hashlib
import pickle
import sys
from importlib import import_module
from typing import Any, NamedTuple
from zlib import crc32

import numpy as np
from llvmlite import binding as llvm
from numba.core import compiler, types
from numba.core.caching import CompileResultCacheImpl, FunctionCache, IndexDataCacheFile
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler_lock import global_compiler_lock
from numba.core.environment import Environment, lookup_environment
from numba.core.registry import CPUDispatcher
from numba.core.serialize import dumps
from numba.core.sigutils import normalize_signature
from numba.core.typing.typeof import Purpose, typeof
from numba.np import numpy_support

from softshadow.jit.kernel_place import KernelPlace
from softshadow.jit.parts import PART, KernelCompiler, PartLibrary, as_part, is_part

# what the parts of Numba that are used here raise where another version lacks them or builds them differently
OTHER_VERSION = (AttributeError, KeyError, TypeError, ValueError)
CHECKSUM = 4  # bytes


class StoredResult(NamedTuple):
    """What the disk holds for a kernel and the types of its arguments.

    Attributes
    ----------
    result : tuple               Numba's reduced `CompileResult`, without the environments of its callees
    environments : of callees    module, constants and name of each
    defined, external : names    that machine code defines, and that it needs from elsewhere; empty for a part
    """

    result: tuple[Any, ...]
    environments: tuple[tuple[str, list[Any], str], ...]
    defined: frozenset[str]
    external: frozenset[str]


class StoredLibrary(JITCodeLibrary):
    """Machine code from disk. Its intermediate code is parsed when a kernel that calls it is compiled."""

    _bitcode = b""

    def _get_module_for_linking(self) -> Any:
        if self._shared_module is None:
            self._shared_module = llvm.parse_bitcode(self._bitcode)
        return self._shared_module


class StoredResults(CompileResultCacheImpl):
    """What to store, where, and how to make it callable again."""

    _locator_classes: Any = (KernelPlace, *CompileResultCacheImpl._locator_classes)

    def reduce(self, cres: Any) -> StoredResult:
        """Return the parts of a result that are stored, without the text of types that nobody reads from there."""
        defined, external = (set(), set()) if is_part(cres) else names_of(cres.library._final_module)
        *result, environments = super().reduce(cres._replace(type_annotation=""))
        parts = tuple((each.globals["__name__"], list(each.consts), each.env_name) for each in environments)
        return StoredResult((*result, ()), parts, frozenset(defined), frozenset(external))

    def rebuild(self, target_context: Any, payload: StoredResult) -> Any:
        """Return the result for kernels to call: complete ones are made in Numba's own way."""
        environments = tuple(rebuild_environment(*parts) for parts in payload.environments)
        name, kind, (_, bitcode) = payload.result[0]
        if kind != PART:
            return super().rebuild(target_context, (*payload.result[:-1], environments))
        library = PartLibrary(target_context.codegen(), name)
        library.bitcode, library._finalized = bitcode, True
        return as_part(_result_of(payload, target_context, library, None, environments))

    def rebuild_without_compiler(self, target_context: Any, payload: StoredResult) -> Any:
        """Return the result with its machine code ready to be called, or None if it needs what is not there."""
        codegen = target_context.codegen()
        engine = codegen._engine
        register_runtime()
        if not all(name in engine._defined_symbols or llvm.address_of_symbol(name) for name in payload.external):
            return None
        library_parts, fndesc, environment, _, objectmode, _, _, reload, _ = payload.result
        name, kind, (machine_code, bitcode) = library_parts
        if kind != "object" or reload or objectmode:
            return None
        library = StoredLibrary(codegen, name)
        library._bitcode = bitcode
        library.enable_object_caching()
        library._set_compiled_object(machine_code)
        library._finalize_final_module()
        engine._defined_symbols |= payload.defined
        entry_point = target_context.get_executable(library, fndesc, environment)
        referenced = tuple(rebuild_environment(*parts) for parts in payload.environments)
        for each in referenced:
            codegen.set_env(each.env_name, each)
        return _result_of(payload, target_context, library, entry_point, referenced)


def names_of(module: Any) -> tuple[set[str], set[str]]:
    """Return the names that a module defines, and those that it needs from elsewhere."""
    symbols = [(each.name, each.is_declaration) for each in (*module.functions, *module.global_variables)]
    defined = {name for name, is_declaration in symbols if not is_declaration}
    return defined, {name for name, is_declaration in symbols if is_declaration and not name.startswith("llvm.")}


def _result_of(payload: StoredResult, target_context: Any, library: Any, entry_point: Any, referenced: Any) -> Any:
    _, fndesc, environment, signature, objectmode, lifted, annotation, reload, _ = payload.result
    return compiler.compile_result(
        target_context=target_context, typing_context=target_context.typing_context, library=library,
        environment=environment, entry_point=entry_point, fndesc=fndesc, type_annotation=annotation,
        signature=signature, objectmode=objectmode, lifted=lifted, reload_init=reload, referenced_envs=referenced,
    )  # fmt: skip


def rebuild_environment(module: str, constants: list[Any], name: str) -> Any:
    """Return the environment of a function that a kernel calls.

    A function such as ``np.empty`` is Python code in Numba, and Numba would import its module for the sake of the
    globals. Only interpreted code uses them, which no kernel contains.
    """
    result = lookup_environment(name)
    if result is None:
        result = Environment(vars(sys.modules[module]) if module in sys.modules else {"__name__": module})
        result.consts[:] = constants
        result.env_name = name
        Environment._memo[name] = result
    return result


def register_runtime() -> None:
    """Tell LLVM where the C functions of Numba's runtime are, which machine code calls; once."""
    if not _registered:
        runtime: Any = import_module("numba.core.runtime._nrt_python")
        for name, address in runtime.c_helpers.items():
            llvm.add_symbol(name if name.startswith("_") else f"NRT_{name}", address)
        _registered.append(True)


_registered: list[bool] = []


class KernelFiles(IndexDataCacheFile):
    """Index and data of one kernel on disk, each behind a checksum; what is damaged counts as missing.

    LLVM ends the process where machine code is damaged, and unpickling may raise anything.
    """

    def save(self, key: Any, data: Any) -> None:
        """Store the data of a key, with the key: if the process is killed, the index may name data of another one."""
        super().save(key, (key, data))

    def load(self, key: Any) -> Any:
        """Return the data of a key, or None."""
        stored = super().load(key)
        return stored[1] if stored is not None and stored[0] == key else None

    def _load_index(self) -> dict[Any, str]:
        index: Any = _unsealed(self._index_path)
        is_ours = index is not None and index[:2] == (self._version, self._source_stamp)
        return index[2] if is_ours else {}

    def _save_index(self, overloads: dict[Any, str]) -> None:
        with self._open_for_write(self._index_path) as file:
            file.write(_sealed(self._dump((self._version, self._source_stamp, overloads))))

    def _load_data(self, name: str) -> Any:
        return _unsealed(self._data_path(name))

    def _save_data(self, name: str, data: Any) -> None:
        with self._open_for_write(self._data_path(name)) as file:
            file.write(_sealed(self._dump(data)))


def _sealed(content: bytes) -> bytes:
    return crc32(content).to_bytes(CHECKSUM, "little") + content


def _unsealed(path: str) -> Any:
    """Return the object in a file, None if there is none or the file is damaged."""
    try:
        with open(path, "rb") as file:
            checksum, content = file.read(CHECKSUM), file.read()
    except OSError:
        return None
    return pickle.loads(content) if checksum == crc32(content).to_bytes(CHECKSUM, "little") else None


class KernelCache(FunctionCache):
    """The files of one kernel. What cannot be read is compiled anew, what cannot be written is compiled again later."""

    _impl_class = StoredResults
    for_kernels = False

    def __init__(self, py_func: Any) -> None:
        super().__init__(py_func)
        stamp, base = self._impl.locator.get_source_stamp(), self._impl.filename_base
        self._cache_file = KernelFiles(cache_path=self._cache_path, filename_base=base, source_stamp=stamp)

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """Return the stored result for these types, or None; kernels can call a part or a complete one."""
        result = super().load_overload(sig, target_context)
        if result is None and self.for_kernels:
            self.for_kernels = False
            try:
                result = super().load_overload(sig, target_context)
            finally:
                self.for_kernels = True
        return result

    def _index_key(self, sig: Any, codegen: Any) -> Any:
        """Return what tells results apart; in place of Numba's, which pickles kernels, in each process differently."""
        enclosed = hashlib.sha256(dumps(enclosed_by(self._py_func))).hexdigest()
        key = sig, codegen.magic_tuple(), (hashlib.sha256(self._py_func.__code__.co_code).hexdigest(), enclosed)
        return (*key, PART) if self.for_kernels else key

    def load_without_compiler(self, argument_types: tuple[Any, ...], target_context: Any) -> Any:
        """Return the stored result for these types, or None."""
        payload = self._cache_file.load(self._index_key(argument_types, target_context.codegen()))
        return None if payload is None else self._impl.rebuild_without_compiler(target_context, payload)

    def save_overload(self, sig: Any, data: Any) -> None:
        """Store a result, if that is possible: the disk may be full, or the folder deleted."""
        with contextlib.suppress(OSError):
            super().save_overload(sig, data)


def enclosed_by(function: Any) -> tuple[Any, ...]:
    """Return the values that a function encloses, and in place of kernels their names and what they enclose."""
    values = [cell.cell_contents for cell in function.__closure__ or ()]
    return tuple(
        (each.__module__, each.__qualname__, enclosed_by(each.py_func)) if isinstance(each, KernelDispatcher) else each
        for each in values
    )


NumbaDispatcher: Any = CPUDispatcher  # type checkers do not see the attributes that its C base class has


class KernelDispatcher(NumbaDispatcher):
    """A compiled function that looks for its machine code on disk before it starts the compiler."""

    def __init__(self, py_func: Any, **options: Any) -> None:
        super().__init__(py_func, **options)
        theirs: Any = self._compiler
        with contextlib.suppress(*OTHER_VERSION):
            self._compiler: Any = KernelCompiler(
                py_func, self.targetdescr, theirs.targetoptions, theirs.locals, theirs.pipeline_class
            )
        self._compiler.for_kernels = False  # set by `get_call_template`
        self._former_parts: list[Any] = []  # the environments of which callers use

    def set_wide(self, is_wide: bool) -> None:
        """Set whether machine code may use the longest vectors (`parts.with_wide_vectors`)."""
        self._compiler.is_wide = is_wide

    def enable_caching(self) -> None:
        """Store and find machine code in the folder that Numba's configuration names now."""
        self._cache = KernelCache(self.py_func)

    def typeof_pyval(self, val: Any) -> Any:
        """Return Numba's type of an argument."""
        try:
            result = type_of(val)
        except Exception:  # as an argument of another kind: Numba has its own message
            return super().typeof_pyval(val)
        self._types_active_call.add(result)
        return result

    def get_call_template(self, args: Any, kws: Any) -> Any:
        """Return how another kernel calls this one.

        A whole number written as an argument has the type of all others: Numba would compile this kernel again for it.
        """
        args, kws = [plain_type(each) for each in args], {name: plain_type(each) for name, each in kws.items()}
        before = self._compiler.for_kernels
        self._compiler.for_kernels = self._cache.for_kernels = True
        try:
            return super().get_call_template(args, kws)
        finally:
            self._compiler.for_kernels = self._cache.for_kernels = before

    def compile(self, sig: Any) -> Any:
        """Return the entry point for these types; kernels get a part, if nothing was called from Python yet."""
        with global_compiler_lock:
            if not self._compiler.for_kernels:
                self._forget_part(tuple(normalize_signature(sig)[0]))
            return super().compile(sig)

    def add_overload(self, cres: Any) -> None:
        """Add a result; Python does not see a part."""
        if is_part(cres):
            self.overloads[tuple(cres.signature.args)] = cres
        else:
            super().add_overload(cres)

    def _forget_part(self, argument_types: tuple[Any, ...]) -> None:
        result = self.overloads.get(argument_types)
        if result is not None and is_part(result):
            self._former_parts.append(self.overloads.pop(argument_types))

    def _compile_for_args(self, *args: Any, **kws: Any) -> Any:
        """Return the machine code for these arguments; Numba calls this when they are of new types."""
        with contextlib.suppress(*OTHER_VERSION):
            entry_point = self._entry_point_from_disk(tuple(map(type_of, args)))
            if entry_point is not None:
                return entry_point
        return super()._compile_for_args(*args, **kws)

    def _entry_point_from_disk(self, argument_types: tuple[Any, ...]) -> Any:
        with global_compiler_lock:
            self._forget_part(argument_types)
            result = self.overloads.get(argument_types)
            if result is None and isinstance(self._cache, KernelCache):
                result = self._cache.load_without_compiler(argument_types, self.targetctx)
                if result is not None:
                    self._cache_hits[argument_types] += 1
                    self.targetctx.insert_user_function(result.entry_point, result.fndesc, [result.library])
                    self.add_overload(result)
            return None if result is None else result.entry_point


def plain_type(kind: Any) -> Any:
    """Return the type of all numbers like a constant one."""
    return types.unliteral(kind) if isinstance(kind, types.IntegerLiteral) else kind


def type_of(value: Any) -> Any:
    """Return what `numba.typeof` returns for an argument; for an array it would first import ``numpy.ma``."""
    kind = type(value)
    if kind is np.ndarray:
        layout = numpy_support.map_layout(value)
        return types.Array(
            numpy_support.from_dtype(value.dtype), value.ndim, layout, readonly=not value.flags.writeable
        )
    if isinstance(value, tuple):
        return types.BaseTuple.from_types([type_of(part) for part in value], kind)
    result = typeof(value, Purpose.argument)
    if result is None:
        raise TypeError(f"no type for {value!r}")
    return result
