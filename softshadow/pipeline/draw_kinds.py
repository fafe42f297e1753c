"""Kinds of draws that can wait: what draws under one state have in common is found once, not for each of them.

A kind depends on the state of its draws, on the textures that they read and on the framebuffer that they write to. It
is forgotten when one of these changes: of images, the size or the format. Sampler parameters are part of a `Texture`,
so a program that goes back and forth between two filters finds the kinds of both.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable
from itertools import count
from typing import NamedTuple

from softshadow.framebuffer import Framebuffer, Storage, attached_image
from softshadow.image import Image
from softshadow.pipeline.commands import (
    OF_FRAMEBUFFERS,
    Accumulate,
    AttachTexture,
    BeginQuery,
    BlitFramebuffer,
    Clear,
    Command,
    CopyToTexture,
    CreateTexture,
    DefineImage,
    DeleteTextures,
    Draw,
    DrawDepths,
    GenerateMipmaps,
    SetSampler,
    UpdateImage,
)
from softshadow.pipeline.geometry.program import textures_of
from softshadow.pipeline.plan import MOST_VERTICES, Plan, begin_run, may_wait, plan_draw
from softshadow.state import State, TextureUnit
from softshadow.texture import Texture

try:
    from softshadow.pipeline.fast.batch.admission import WORTH_COMPARING
    from softshadow.pipeline.fast.batch.assembly import width_of
    from softshadow.pipeline.fast.batch.geometry import Setting, setting_of
    from softshadow.pipeline.fast.batch.run import Run, key_of, structure_of
    from softshadow.pipeline.fast.batch.segments import geometry_key
    from softshadow.pipeline.fast.batch.table import BATCH_KERNELS
except ModuleNotFoundError:  # the folder can be deleted: then no draw waits
    pass

KNOWN_KINDS = 1024
KNOWN_VERTICES = 64 * MOST_VERTICES  # about, of the draws that kinds keep
KNOWN_UNITS = 256
CELLS_ONLY = frozenset((Clear, Accumulate, BlitFramebuffer, UpdateImage, CopyToTexture, BeginQuery, DrawDepths))
SHAPE = ("format", "internal_format", "width", "height", "slices")  # of an image
Textures = tuple[Texture | None, ...]
Form = tuple[int, tuple[int, ...], tuple[int, ...]]


class Kind(NamedTuple):
    """A state of draws that wait, with all that depends on it: run and setting for their geometry, plan for the rest.

    Kinds of one `batch` share batches: all that their geometry depends on is equal. `textures` are those that its draws
    may read, by `names`. `counting` keeps the plan of draws whose fragments an occlusion query counts.
    """

    run: Run
    setting: Setting
    plan: Plan
    batch: int
    names: tuple[int, ...]
    textures: Textures
    counting: list[Plan]


class Kinds:
    """The kinds of the latest draws of a context.

    Parameters
    ----------
    storage : Storage        what they draw to
    compiles : bool          whether to compile kernels at the first use
    """

    def __init__(self, storage: Storage, compiles: bool) -> None:
        self._storage, self._compiles = storage, compiles
        # by the identity of what they depend on; the latest by all but tests and blending
        self._known: dict[Hashable, list[Kind]] = {}
        self._latest: dict[Hashable, Kind] = {}
        # the latest, and a draw of it: by its `_form` and what of its state matters; by its form and the state's
        # identity, if the draw is small, as nobody counts the vertices that are kept so
        self._of_states: dict[Hashable, tuple[Kind, Draw]] = {}
        self._of_state: dict[tuple[int, Form], tuple[Kind, Draw]] = {}
        self._batch_numbers: dict[Hashable, int] = {}  # by geometry key
        self._next_number = count()
        self._known_vertices = 0
        self._readable: set[int] = set()  # names of all textures that draws of known kinds may read
        self._names: dict[int, tuple[tuple[TextureUnit, ...], tuple[int, ...]]] = {}  # of textures, by units' identity

    def of(self, command: Draw) -> Kind | None:
        """Return the kind of a draw, or None if it cannot wait."""
        if not may_wait(command) or not (self._compiles or BATCH_KERNELS.are_compiled()):
            return None
        place = id(command.state), _form(command)
        known = self._of_state.get(place)
        if known is not None and known[0].run.continues(command, known[1]):
            return known[0]
        kind = self._of_equal_state(command)
        if kind is not None and len(command.vertices.position) < WORTH_COMPARING:
            if len(self._of_state) >= KNOWN_KINDS:
                self._of_state.clear()
            self._of_state[place] = kind, command
        return kind

    def _of_equal_state(self, command: Draw) -> Kind | None:
        names = self._names_of(command.state)
        textures = tuple([self._storage.textures.get(name) for name in names])
        key = key_of(command), textures
        place = key, structure_of(command.state.lighting), _form(command)
        known = self._of_states.get(place)
        if known is not None and known[0].run.continues_under(command, known[1]):
            return known[0]
        kind = next((each for each in self._known.get(key, ()) if each.run.takes(command)), None)
        is_new = kind is None
        if kind is None:
            target = self._storage.framebuffers[command.state.draw_framebuffer]
            kind = self._with_other_tests(command, textures, target) or self._new(command, names, textures, target)
        if kind is not None:
            if max(len(self._known), len(self._batch_numbers)) >= KNOWN_KINDS or self._known_vertices > KNOWN_VERTICES:
                self.forget()
            if len(self._of_states) >= KNOWN_KINDS:
                self._of_states.clear()
            if is_new:
                self._readable.update(names)
                self._known.setdefault(key, []).append(kind)
            self._of_states[place] = kind, command
            self._known_vertices += len(command.vertices.position)
        return kind

    def _names_of(self, state: State) -> tuple[int, ...]:
        """Return the names of the textures that a draw without a program may read."""
        units, names = self._names.get(id(state.units), (None, ()))
        if units is not state.units:
            if len(self._names) >= KNOWN_UNITS:
                self._names.clear()
            names = tuple(sorted(textures_of(state)))
            self._names[id(state.units)] = state.units, names
        return names

    def _with_other_tests(self, command: Draw, textures: Textures, target: Framebuffer) -> Kind | None:
        """Return the kind of a draw by one that differs in tests and blending only."""
        similar = self._latest.get(_key_without_tests(command, textures))
        run = None if similar is None else similar.run.under(command)
        if similar is None or run is None:
            return None
        kind = similar._replace(run=run)
        if similar.run.has_tests_of(command.state):
            return kind
        return kind._replace(plan=plan_draw(command, target), counting=[])

    def _new(self, command: Draw, names: tuple[int, ...], textures: Textures, target: Framebuffer) -> Kind | None:
        run = begin_run(command, target, self._storage)
        if run is None:
            return None
        setting = setting_of(run, target, self._storage)
        kind = Kind(run, setting, plan_draw(command, target), self._batch_of(run, setting), names, textures, [])
        self._latest[_key_without_tests(command, textures)] = kind
        return kind

    def _batch_of(self, run: Run, setting: Setting) -> int:
        """Return the number of the batch of a run: that of others whose geometry depends on the same."""
        return self._batch_numbers.setdefault(geometry_key(run, setting), next(self._next_number))

    def forget(self) -> None:
        """Forget all kinds; draws that wait keep theirs."""
        self._known.clear()
        self._latest.clear()
        self._of_states.clear()
        self._of_state.clear()
        self._batch_numbers.clear()
        self._readable.clear()
        self._known_vertices = 0

    def note(self, command: Command) -> None:
        """Forget the kinds that depend on what a command changes that will be carried out; cells do not matter."""
        match command:
            case CreateTexture() | SetSampler():  # the storage has another `Texture` then
                self._of_state.clear()
            case DefineImage(texture=texture) | GenerateMipmaps(texture=texture):
                self._forget_readers((texture,))
            case DeleteTextures(textures=textures):
                self._forget_readers(textures)
            case _ if isinstance(command, OF_FRAMEBUFFERS):
                framebuffer = command.framebuffer
                self._forget_some(lambda kind: kind.run.state.draw_framebuffer == framebuffer)
            case _:
                self.forget()

    def _forget_readers(self, names: tuple[int, ...]) -> None:
        """Forget the kinds that may read textures, also with other parameters, and all if one can be drawn to."""
        if any(map(self._storage.is_attached, names)):
            self.forget()
            return
        if not self._readable.isdisjoint(names):
            self._readable.difference_update(names)
            self._forget_some(lambda kind: not set(names).isdisjoint(kind.names))

    def _forget_some(self, depends: Callable[[Kind], bool]) -> None:
        kept = {key: [kind for kind in kinds if not depends(kind)] for key, kinds in self._known.items()}
        self._known = {key: kinds for key, kinds in kept.items() if kinds}
        self._latest = {key: kind for key, kind in self._latest.items() if not depends(kind)}
        self._of_states = {key: known for key, known in self._of_states.items() if not depends(known[0])}
        self._of_state.clear()


def _form(command: Draw) -> Form:
    """Return the mode, and whether colours and normals are arrays: what often differs between draws of one state."""
    vertices = command.vertices
    return command.mode, vertices.color.strides, vertices.normal.strides


def _key_without_tests(command: Draw, textures: Textures) -> tuple[Hashable, ...]:
    """Return by what to look for a kind that may differ in tests and blending only."""
    return key_of(command, with_tests=False), width_of(command.mode), textures


def changes_cells_only(command: Command, storage: Storage) -> bool:
    """Return whether a command that is no draw leaves sizes, formats and parameters as they are."""
    if isinstance(command, DefineImage):
        before = storage.textures[command.texture].images.get((command.face, command.level))
        return before is not None and _same_shape(before, command)
    if isinstance(command, AttachTexture) and command.texture:
        attached = storage.framebuffers[command.framebuffer].attachments.get(command.attachment)
        image = storage.textures[command.texture].images.get((command.face, command.level))
        if attached is None or image is None:
            return False
        return _same_shape(attached.image, attached_image(image, command.attachment))
    return type(command) in CELLS_ONLY


def _same_shape(image: Image, other: Image | DefineImage) -> bool:
    return all(getattr(image, name) == getattr(other, name) for name in SHAPE)
