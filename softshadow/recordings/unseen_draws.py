"""Draws of the frames before the chosen one: they are carried out only if something later can see them.

Most programs clear the window in every frame. So what they drew in it before is never looked at again, and a replay of
frame 1,000 need not draw the first 999. The chosen frame has the same pixels, bit for bit.
"""

from __future__ import annotations

from softshadow import gl
from softshadow.context import Context
from softshadow.framebuffer import DEFAULT
from softshadow.pipeline import commands
from softshadow.pipeline.commands import Clear, Command, Draw
from softshadow.pipeline.geometry.program import textures_of

MOST_COMMANDS = 20_000
MOST_VERTICES = 1_000_000  # of the commands that are kept
# commands that neither read nor write the window or textures
INDEPENDENT = (
    commands.CreateTexture, commands.CreateFramebuffer, commands.DeleteFramebuffers, commands.DefineRenderbuffer,
    commands.DeleteRenderbuffers, commands.AttachTexture, commands.AttachRenderbuffer,
)  # fmt: skip
BUFFERS = gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT


class UnseenDraws:
    """The draws and clears of a context's window that wait until something looks at the window, or clears it."""

    def __init__(self, context: Context) -> None:
        self.context = context
        self._waiting: list[Command] = []
        self._n_vertices = 0
        self._textures: set[int] = set()  # that they read

    def takes(self, command: Command) -> bool:
        """Return whether a command waits; before one that cannot, those that it could depend on are carried out."""
        window = self.context.objects
        if isinstance(command, Draw | Clear) and command.state.draw_framebuffer == DEFAULT and not window.active_query:
            if isinstance(command, Clear):
                self._clear(command)
            else:
                self._textures |= textures_of(command.state)
                self._n_vertices += len(command.vertices.position)
            self._waiting.append(command)
            if len(self._waiting) > MOST_COMMANDS or self._n_vertices > MOST_VERTICES:
                self.carry_out()
            return True
        self.see(command)
        return False

    def see(self, command: Command) -> None:
        """Carry out what waits if a command, of this context or of one that shares objects, depends on it."""
        if self._waiting and self._depends_on_waiting(command):
            self.carry_out()

    def _depends_on_waiting(self, command: Command) -> bool:
        if isinstance(command, INDEPENDENT):
            return False
        if isinstance(command, commands.SelectBuffers):
            return self._selects_others(command)
        if isinstance(command, commands.CopyToTexture) and command.framebuffer == DEFAULT:
            return True
        if isinstance(command, (*commands.OF_TEXTURES, commands.CopyToTexture)):
            return command.texture in self._textures
        if isinstance(command, Draw | Clear) and command.state.draw_framebuffer != DEFAULT:
            target = self.context.objects.framebuffers[command.state.draw_framebuffer]
            return any(attachment.texture in self._textures for attachment in target.attachments.values())
        return True

    def _selects_others(self, command: commands.SelectBuffers) -> bool:
        """Return whether the draws that wait would write other buffers after a command."""
        if command.framebuffer != DEFAULT or command.draw_buffers is None:
            return False
        present = self.context.objects.window.draw_buffers
        return [buffer == gl.GL_NONE for buffer in command.draw_buffers] != [buffer == gl.GL_NONE for buffer in present]

    def _clear(self, command: Clear) -> None:
        """Drop the commands whose every trace a clear of whole buffers removes, and carry out those before them."""
        window = self.context.objects.window
        cleared = buffers_cleared(command, window.size)
        if not window.colors:  # glDrawBuffer(GL_NONE)
            cleared &= ~gl.GL_COLOR_BUFFER_BIT
        kept = len(self._waiting)
        while kept and not buffers_written(self._waiting[kept - 1]) & ~cleared:
            kept -= 1
        del self._waiting[kept:]
        self.carry_out()

    def drop(self) -> None:
        """Forget what waits: the window is replaced by another one."""
        self._waiting, self._n_vertices, self._textures = [], 0, set()

    def carry_out(self) -> None:
        """Draw everything that waits."""
        waiting = self._waiting
        self.drop()
        if waiting:
            self.context.stream.carry_out_kept(waiting)


def buffers_cleared(command: Clear, size: tuple[int, int]) -> int:
    """Return which of the window's buffers a clear replaces as a whole, as bits."""
    state, scissor = command.state, command.state.scissor
    if scissor.enabled and not (
        scissor.x <= 0
        and scissor.y <= 0
        and scissor.x + scissor.width >= size[0]
        and scissor.y + scissor.height >= size[1]
    ):
        return 0
    cleared = command.mask & BUFFERS
    if not all(state.color.mask):
        cleared &= ~gl.GL_COLOR_BUFFER_BIT
    if not state.depth.write:
        cleared &= ~gl.GL_DEPTH_BUFFER_BIT
    if state.stencil.front.write_mask & 0xFF != 0xFF:
        cleared &= ~gl.GL_STENCIL_BUFFER_BIT
    return cleared


def buffers_written(command: Command) -> int:
    """Return the buffers that a draw or clear of the window may change, as bits."""
    if isinstance(command, Clear):
        return command.mask
    assert isinstance(command, Draw)
    state = command.state
    written = gl.GL_COLOR_BUFFER_BIT if any(state.color.mask) else 0
    if state.depth.enabled and state.depth.write:
        written |= gl.GL_DEPTH_BUFFER_BIT
    return written | (gl.GL_STENCIL_BUFFER_BIT if state.stencil.enabled else 0)
