"""Create, fill, attach and delete texture, framebuffer and renderbuffer objects."""

from __future__ import annotations

from dataclasses import replace

from softshadow.framebuffer import DEFAULT, NOTHING, Attachment, Framebuffer, Storage, attached_image
from softshadow.image import BLOCK_SIDE, Image
from softshadow.pipeline.commands import (
    AttachRenderbuffer,
    AttachTexture,
    CreateFramebuffer,
    CreateTexture,
    DefineImage,
    DefineRenderbuffer,
    DeleteFramebuffers,
    DeleteRenderbuffers,
    DeleteTextures,
    SelectBuffers,
    SetSampler,
    UpdateImage,
)
from softshadow.texture import Texture, initial_sampler


def create_texture(command: CreateTexture, storage: Storage) -> None:
    """Create a texture object without images."""
    storage.textures[command.texture] = Texture(command.texture, command.target, initial_sampler(command.target))


def define_image(command: DefineImage, storage: Storage) -> None:
    """Give a level of a texture a new image, also in the framebuffers that it is attached to."""
    layout = command.format, command.width, command.height, command.internal_format, command.slices
    image = Image.new(*layout, command.cells)
    if command.stencil is not None and image.stencil is not None:
        image.stencil.view[:] = command.stencil
    image.blocks = None if command.blocks is None else command.blocks.copy()
    storage.textures[command.texture].images[command.face, command.level] = image
    storage.reattach(command.texture, command.face, command.level, image)


def update_image(command: UpdateImage, storage: Storage) -> None:
    """Write a rectangle of a level of a texture, or a box of a 3-D texture."""
    image = storage.textures[command.texture].images[command.face, command.level]
    for target, cells in ((image, command.cells), (image.stencil, command.stencil)):
        if target is not None and cells is not None:
            slices = cells.reshape(command.slices, len(cells) // command.slices, *cells.shape[1:])
            height, width = slices.shape[1:3]
            for z, cells_of_slice in enumerate(slices, command.z):
                y = z * image.height + command.y
                target.view[y : y + height, command.x : command.x + width] = cells_of_slice
    if command.blocks is not None and image.blocks is not None:
        rows, columns = command.blocks.shape[:2]
        x, y = command.x // BLOCK_SIDE, command.y // BLOCK_SIDE
        image.blocks[y : y + rows, x : x + columns] = command.blocks


def set_sampler(command: SetSampler, storage: Storage) -> None:
    """Set the sampler state of a texture object: draws that wait keep the `Texture` with the state of before."""
    storage.textures[command.texture] = storage.textures[command.texture].with_sampler(command.sampler)


def delete_textures(command: DeleteTextures, storage: Storage) -> None:
    """Delete texture objects; names without one are ignored."""
    for name in command.textures:
        storage.textures.pop(name, None)


def create_framebuffer(command: CreateFramebuffer, storage: Storage) -> None:
    """Create a framebuffer object without attachments."""
    storage.framebuffers[command.framebuffer] = Framebuffer(command.framebuffer)


def delete_framebuffers(command: DeleteFramebuffers, storage: Storage) -> None:
    """Delete framebuffer objects; the window stays, and names without one are ignored."""
    for name in command.framebuffers:
        if name != DEFAULT:
            storage.framebuffers.pop(name, None)


def define_renderbuffer(command: DefineRenderbuffer, storage: Storage) -> None:
    """Give a renderbuffer a new image of zeros, also in the framebuffers that it is attached to."""
    image = Image.new(command.format or NOTHING, command.width, command.height, command.internal_format)
    storage.renderbuffers[command.renderbuffer] = image
    for target in storage.framebuffers.values():
        for point, attachment in target.attachments.items():
            if attachment.renderbuffer == command.renderbuffer:
                target.attachments[point] = replace(attachment, image=attached_image(image, point))


def delete_renderbuffers(command: DeleteRenderbuffers, storage: Storage) -> None:
    """Delete renderbuffers; names without one are ignored."""
    for name in command.renderbuffers:
        storage.renderbuffers.pop(name, None)


def attach_texture(command: AttachTexture, storage: Storage) -> None:
    """Attach a level of a texture to a framebuffer; texture 0 detaches."""
    attachments = storage.framebuffers[command.framebuffer].attachments
    if command.texture == 0:
        attachments.pop(command.attachment, None)
        return
    images = storage.textures[command.texture].images
    image = images.get((command.face, command.level)) or Image.new(NOTHING, 0, 0)
    attached = attached_image(image, command.attachment)
    attachments[command.attachment] = Attachment(attached, command.texture, command.face, command.level)


def attach_renderbuffer(command: AttachRenderbuffer, storage: Storage) -> None:
    """Attach a renderbuffer to a framebuffer; renderbuffer 0 detaches."""
    attachments = storage.framebuffers[command.framebuffer].attachments
    if command.renderbuffer == 0:
        attachments.pop(command.attachment, None)
        return
    attached = attached_image(storage.renderbuffers[command.renderbuffer], command.attachment)
    attachments[command.attachment] = Attachment(attached, renderbuffer=command.renderbuffer)


def select_buffers(command: SelectBuffers, storage: Storage) -> None:
    """Set the draw buffers and the read buffer of a framebuffer."""
    target = storage.framebuffers[command.framebuffer]
    if command.draw_buffers is not None:
        target.draw_buffers = command.draw_buffers
    if command.read_buffer is not None:
        target.read_buffer = command.read_buffer
