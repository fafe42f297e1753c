"""Films as files: read again by other libraries, the same bytes for the same pictures, and shown in a notebook."""

import base64
import re
from pathlib import Path

import imageio.v3 as imageio
import numpy as np
import pytest
from PIL import Image

import softshadow as ss
from report.browser import chromium
from softshadow.sweeps.films.film import check_output
from softshadow.sweeps.films.writers import durations

FRAMES, RATE = 5, 12


@pytest.fixture(scope="module")
def film() -> ss.Film:
    return ss.animate("map", "boxes", (33, 25), light_path="orbit", frames=FRAMES, rate=RATE, map_size=16)


def frames_of(path: Path) -> tuple[np.ndarray, list[int]]:
    """Return the pictures of a file, and how long each is shown, in ms."""
    pictures, shown = [], []
    with Image.open(path) as image:
        for frame in range(image.n_frames):  # type: ignore[attr-defined]
            image.seek(frame)
            pictures.append(np.asarray(image.convert("RGB")))
            shown.append(round(image.info["duration"]))
    return np.stack(pictures), shown


def test_sides_of_a_film_are_even(film: ss.Film) -> None:
    assert film.size[0] == 34
    assert film.size[1] % 2 == 0


@pytest.fixture(scope="module")
def plain() -> ss.Film:
    """Return a film of at most 256 colours."""
    film = ss.animate(
        "volume-zfail", "boxes", (34, 24), light_path="orbit", frames=FRAMES, rate=RATE, show="stencil", captions=False
    )
    assert len(np.unique(np.reshape(film.pictures, (-1, 3)), axis=0)) <= 256
    return film


@pytest.mark.parametrize("extension", [".webp", ".png", ".gif"])
def test_film_is_read_as_it_was_written(film: ss.Film, plain: ss.Film, extension: str, tmp_path: Path) -> None:
    film = plain if extension == ".gif" else film
    path = film.save(tmp_path / f"film{extension}")
    read = imageio.imread(path, plugin="pillow", index=...)[..., :3]
    assert np.array_equal(read, film.pictures)
    pictures, shown = frames_of(path)
    assert np.array_equal(pictures, film.pictures)
    assert abs(sum(shown) - 1000 * film.seconds) <= 5
    assert b"softshadow" in path.read_bytes()
    with Image.open(path) as image:
        assert image.info.get("loop") == 0  # again and again


@pytest.mark.slow
def test_mp4_is_h264_with_the_frames_in_little_changed_colours(film: ss.Film, tmp_path: Path) -> None:
    av = pytest.importorskip("av")
    path = film.save(tmp_path / "film.mp4")
    with av.open(path) as container:
        stream = container.streams.video[0]
        assert (stream.codec_context.name, stream.codec_context.pix_fmt) == ("h264", "yuv420p")
        assert stream.average_rate == RATE
    read = imageio.imread(path, plugin="pyav").astype(int)
    assert read.shape == (FRAMES, film.size[1], film.size[0], 3)
    # colours have half the resolution, so single pixels at edges differ; another frame would differ by far more
    own = [np.abs(read[frame] - film[frame]).mean() for frame in range(FRAMES)]
    other = [np.abs(read[frame] - film[frame - 1]).mean() for frame in range(FRAMES)]
    assert max(own) < min(other)
    assert max(own) < 6


@pytest.mark.parametrize("extension", [".webp", ".png", ".gif", ".mp4"])
def test_same_pictures_are_the_same_bytes(film: ss.Film, extension: str, tmp_path: Path) -> None:
    if extension == ".mp4":
        pytest.importorskip("av")
    once, again = film.save(tmp_path / f"once{extension}"), film.save(tmp_path / f"again{extension}")
    assert once.read_bytes() == again.read_bytes()


@pytest.mark.slow
def test_bytes_of_an_mp4_do_not_depend_on_what_was_in_memory(tmp_path: Path) -> None:
    pytest.importorskip("av")
    film = ss.animate("map", "torus", (64, 48), light_path="orbit", frames=6)
    rng, kept, seen = np.random.default_rng(7), [], set()
    for _ in range(12):
        for size in rng.integers(1, 400_000, 50):
            kept.append(np.full(size, rng.integers(1, 256), np.uint8))
            if len(kept) > 40 or rng.random() < 0.7:
                kept.pop(int(rng.integers(len(kept))))
        seen.add(film.save(tmp_path / "film.mp4").read_bytes())
    assert len(seen) == 1


def test_gif_of_many_colours_has_one_palette_and_is_close(tmp_path: Path) -> None:
    colored = ss.animate("map", "torus", (64, 48), light_path="orbit", frames=3, captions=False)
    assert len(np.unique(np.reshape(colored.pictures, (-1, 3)), axis=0)) > 256
    pictures, _ = frames_of(colored.save(tmp_path / "film.gif"))
    assert len(np.unique(pictures.reshape(-1, 3), axis=0)) <= 256
    assert np.abs(pictures.astype(int) - np.array(colored.pictures, int)).mean() < 4  # of 255, by median cut


def test_durations_are_whole_units_whose_sum_is_the_length() -> None:
    assert durations(24, 24, 1).count(42) == 16
    assert sum(durations(24, 24, 1)) == sum(durations(24, 24, 10)) == 1000
    assert set(durations(24, 24, 10)) == {40, 50}


def test_poster_is_a_png_of_its_frame(film: ss.Film, tmp_path: Path) -> None:
    path = film.save_poster(tmp_path / "poster.png")
    assert np.array_equal(imageio.imread(path), film[FRAMES // 2])
    with pytest.raises(ValueError, match=r"poster.jpg: expected a poster with the ending .png"):
        film.save_poster(tmp_path / "poster.jpg")


def test_file_that_no_film_can_be_is_refused(film: ss.Film, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"film.avi: expected a film, with an ending of .webp, .png, .gif, .mp4"):
        film.save(tmp_path / "film.avi")
    with pytest.raises(ValueError, match="is a folder; expected a film"):
        check_output(tmp_path)
    (tmp_path / "mine.gif").write_bytes(b"GIF89a of somebody else")
    with pytest.raises(ss.SoftShadowError, match=r"mine.gif"):
        film.save(tmp_path / "mine.gif")
    assert film.save(tmp_path / "mine.gif", force=True).read_bytes().startswith(b"GIF89a")
    assert film.save(tmp_path / "mine.gif") == tmp_path / "mine.gif"  # ours now


def test_mp4_without_its_library_is_an_error_that_names_it(film: ss.Film, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    with pytest.raises(ss.SoftShadowError, match=r"MP4 needs the library av: pip install 'softshadow\[video\]'"):
        film.save("film.mp4")


def test_notebook_shows_the_film_and_elsewhere_its_poster(film: ss.Film, tmp_path: Path) -> None:
    shown = film._repr_mimebundle_()[0]
    data = re.search(r'src="data:image/webp;base64,([^"]*)"', shown["text/html"])
    assert data is not None
    (tmp_path / "film.webp").write_bytes(base64.b64decode(data[1]))
    assert np.array_equal(frames_of(tmp_path / "film.webp")[0], film.pictures)
    (tmp_path / "poster.png").write_bytes(base64.b64decode(shown["image/png"]))
    assert np.array_equal(imageio.imread(tmp_path / "poster.png"), film.poster)
    assert shown["text/plain"] == repr(film)


def test_film_too_large_for_a_notebook_is_shown_as_its_poster(film: ss.Film, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("softshadow.sweeps.films.film.LARGEST_SHOWN", 10)
    shown = film._repr_mimebundle_()[0]
    assert "image/webp" not in shown["text/html"]
    assert 'film.save("film.webp")' in shown["text/html"]


@pytest.mark.slow
@pytest.mark.parametrize("extension", [".webp", ".png", ".gif"])
def test_browser_plays_the_frames(film: ss.Film, extension: str, tmp_path: Path) -> None:
    path = film.save(tmp_path / f"film{extension}")
    empty = tmp_path / "empty.html"
    empty.write_text("<title>film</title>")
    script = """async ([data, type]) => {
        const bytes = Uint8Array.from(atob(data), each => each.charCodeAt(0));
        const decoder = new ImageDecoder({data: bytes, type});
        await decoder.tracks.ready;
        await decoder.completed;
        const track = decoder.tracks.selectedTrack;
        const frames = [];
        for (let index = 0; index < track.frameCount; index++) {
            const {image} = await decoder.decode({frameIndex: index});
            const canvas = new OffscreenCanvas(image.displayWidth, image.displayHeight);
            const context = canvas.getContext("2d");
            context.drawImage(image, 0, 0);
            const pixels = context.getImageData(0, 0, canvas.width, canvas.height).data;
            frames.push([canvas.width, canvas.height, image.duration, Array.from(pixels)]);
        }
        return [track.repetitionCount === Infinity, frames];
    }"""

    data = base64.b64encode(path.read_bytes()).decode()
    with chromium() as browser:
        page = browser.new_page()
        page.goto(empty.as_uri())
        repeated, frames = page.evaluate(script, [data, f"image/{extension[1:]}"])
    assert repeated
    assert len(frames) == FRAMES
    for (width, height, _, pixels), picture in zip(frames, frames_of(path)[0], strict=True):
        assert (width, height) == film.size
        assert np.array_equal(np.reshape(pixels, (height, width, 4))[..., :3], picture)
    assert sum(frame[2] for frame in frames) == pytest.approx(1e6 * film.seconds, abs=5000)  # in units of 10 ms for GIF
