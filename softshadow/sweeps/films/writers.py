"""Films as files: animated WebP, PNG and GIF, and MP4.

The same pictures give the same bytes. WebP and PNG keep every pixel; a GIF has one palette for the whole film, exact
if it has at most 256 colours; MP4 is H.264 with half the resolution in colour, for players and slides.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from softshadow.errors import SoftShadowError
from softshadow.inspection.files import MARK, write_whole

if TYPE_CHECKING:
    from PIL.Image import Image

PALETTE_SIZE = 256
MOST_PIXELS_SAMPLED = 1 << 23  # that the palette of a GIF is chosen from
CRF = "18"  # quality of H.264, 0 best to 51: 18 looks like the original
LARGEST_RATE = 50  # frames per second; browsers slow a GIF of more down, since its unit is 10 ms
WEBP_METHOD = 4  # 0 fast to 6 small


def write_film(path: Path, pictures: Sequence[np.ndarray], rate: int, force: bool = False) -> Path:
    """Write pictures (H, W, 3) uint8, `rate` of them per second, in the format that the extension names.

    Raises
    ------
    ValueError                   another extension
    SoftShadowError              MP4 without its library; the file cannot be written, or is not ours
    """
    check_film(path)
    return write_whole(path, lambda temporary: WRITERS[path.suffix.lower()](temporary, pictures, rate), force)


def check_film(path: Path) -> None:
    """Raise an error if a film cannot be written to such a file; called before a long drawing."""
    extension = path.suffix.lower()
    if extension not in WRITERS:
        raise ValueError(f"{path}: expected a film, with an ending of {', '.join(WRITERS)}")
    if extension == ".mp4":
        _require_av(path)


def durations(n_frames: int, rate: int, unit: int) -> list[int]:
    """Return how long each frame is shown, in ms: multiples of `unit` ms whose sum differs from the exact one by less.

    Examples
    --------
    >>> durations(5, 24, 10)
    [40, 40, 40, 50, 40]
    """
    ends = [round(Fraction(1000 * frame, rate * unit)) * unit for frame in range(n_frames + 1)]
    return [end - start for start, end in pairwise(ends)]


def _write_webp(path: Path, pictures: Sequence[np.ndarray], rate: int) -> None:
    import imageio.v3 as imageio

    shown = durations(len(pictures), rate, 1)
    mark = f'<x:xmpmeta xmlns:x="adobe:ns:meta/" x:xmptk="{MARK}"/>'.encode()
    imageio.imwrite(
        path, list(pictures), plugin="pillow", extension=".webp", lossless=True, method=WEBP_METHOD, duration=shown,
        loop=0, xmp=mark,
    )  # fmt: skip


def _write_apng(path: Path, pictures: Sequence[np.ndarray], rate: int) -> None:
    import imageio.v3 as imageio
    from PIL.PngImagePlugin import PngInfo

    comment = PngInfo()
    comment.add_text("Comment", MARK)
    shown = durations(len(pictures), rate, 1)
    imageio.imwrite(
        path, list(pictures), plugin="pillow", extension=".png", duration=shown, loop=0, pnginfo=comment
    )  # fmt: skip


def _write_gif(path: Path, pictures: Sequence[np.ndarray], rate: int) -> None:
    """Write a GIF with Pillow, since imageio chooses a palette for every frame."""
    from PIL import Image

    palette = common_palette(pictures)
    frames = [Image.fromarray(picture).quantize(palette=palette, dither=Image.Dither.NONE) for picture in pictures]
    shown = durations(len(frames), rate, 10)
    frames[0].save(
        path, "GIF", save_all=True, append_images=frames[1:], duration=shown, loop=0, comment=MARK, optimize=False
    )


def common_palette(pictures: Sequence[np.ndarray]) -> Image:
    """Return an image whose palette fits all pictures: their own colours if they are at most 256."""
    from PIL import Image

    colors = np.unique(np.concatenate([_packed_colors(picture) for picture in pictures]))
    channels = np.stack([colors >> 16, colors >> 8 & 255, colors & 255], axis=1).astype(np.uint8)
    if len(colors) <= PALETTE_SIZE:
        palette = Image.new("P", (1, 1))
        palette.putpalette(np.pad(channels, ((0, PALETTE_SIZE - len(colors)), (0, 0)), "edge").tobytes())
        return palette
    # all pixels of evenly chosen frames: frequent colours get more of the palette
    chosen = pictures[:: -(-len(pictures) * pictures[0][..., 0].size // MOST_PIXELS_SAMPLED)]
    return Image.fromarray(np.concatenate(chosen)).quantize(PALETTE_SIZE, Image.Quantize.MEDIANCUT)


def _packed_colors(picture: np.ndarray) -> np.ndarray:
    red, green, blue = np.moveaxis(picture.astype(np.uint32), 2, 0)
    return np.unique(red << 16 | green << 8 | blue)


def _write_mp4(path: Path, pictures: Sequence[np.ndarray], rate: int) -> None:
    """Write H.264 in yuv420p, the format that every player knows.

    The bytes are repeatable with one thread, and without x264's macroblock tree, which reads memory that it did not
    write: bytes then depended on what the process had done before.
    """
    import imageio.v3 as imageio

    with imageio.imopen(path, "w", plugin="pyav") as file:
        file.container_metadata["comment"] = MARK
        file.init_video_stream("libx264", fps=rate, pixel_format="yuv420p")
        stream: Any = file._video_stream
        codec = stream.codec_context
        codec.thread_count = 1
        codec.options = {"crf": CRF, "preset": "medium", "mbtree": "0"}
        for picture in pictures:
            height, width = picture.shape[:2]
            even = np.pad(picture, ((0, height % 2), (0, width % 2), (0, 0)), "edge")
            file.write_frame(even)


def _require_av(path: Path) -> None:
    from importlib.util import find_spec

    if find_spec("av") is None:
        raise SoftShadowError(f"{path}: MP4 needs the library av: pip install 'softshadow[video]'")


WRITERS: dict[str, Callable[[Path, Sequence[np.ndarray], int], None]] = {
    ".webp": _write_webp,
    ".png": _write_apng,
    ".gif": _write_gif,
    ".mp4": _write_mp4,
}
