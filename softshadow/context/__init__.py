"""The current context, with its vertex arrays, and with the vertex buffer and pending attributes that Mesa keeps."""

from softshadow.context.arrays import ArrayLayout, BufferObject, ClientArrays, Mapping
from softshadow.context.context import MATRIX_STACK_DEPTHS, Context, Frame, current, make_current, thread
from softshadow.context.current_values import CurrentVertex
from softshadow.context.display_list import DisplayList
from softshadow.context.matrix_stacks import MatrixStack
from softshadow.context.raster_position import RasterPosition
from softshadow.context.vertex_buffer import Primitive, VertexBuffer

__all__ = [
    "MATRIX_STACK_DEPTHS",
    "ArrayLayout",
    "BufferObject",
    "ClientArrays",
    "Context",
    "CurrentVertex",
    "DisplayList",
    "Frame",
    "Mapping",
    "MatrixStack",
    "Primitive",
    "RasterPosition",
    "VertexBuffer",
    "current",
    "make_current",
    "thread",
]
