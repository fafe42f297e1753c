"""Programs of Debian's packages piglit and xscreensaver-gl, recorded with apitrace and compared with Mesa.

``python -m recordings.debian_programs FOLDER [--every N] [--write]`` in the folder ``tests`` records every N-th
program and compares two frames of each. It fails if the list of those that differ, debian_programs.tsv, grows, or holds
programs that do not differ any more; ``--write`` writes it anew. `.ci/debian-programs` installs the packages first.
"""

from __future__ import annotations

import argparse
import os
import re
import shutil
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from softshadow.errors import SoftShadowError
from softshadow.recordings.draw_calls import is_shading
from softshadow.recordings.frames import find_frames
from softshadow.testing.trace_comparison import compare_trace
from softshadow.traces import Trace

PIGLIT = Path("/usr/lib/x86_64-linux-gnu/piglit/bin")
HACKS = Path("/usr/libexec/xscreensaver")
LIST = Path(__file__).parent / "debian_programs.tsv"
TOOLS = ("apitrace", "Xvfb")
SHADERS = re.compile(rb"gl_FragColor|gl_Position|#version|!!ARB|piglit_link_simple_program|piglit_build_simple")
# tests of OpenGL ES, of GL after 2.1, and of limits
LATER = re.compile(
    r"gles|^(egl|glsl|vs-|fs-|gs-|tf-|cl-|vk|amd_|khr_|oes_|ovr_|intel_|gl-3|gl-4)|perf|max-?size|minmax|-oom|streaming"
    r"|^arb_(bindless|blend_func|clear_|clip_control|compute|copy|debug|direct|draw_(ind|inst|elements_base)|es[23]|gpu"
    r"|explicit|fragment_program|framebuffer_no|get_|instanced|internalformat|invalid|indirect|map_buffer_align|program"
    r"|query|robust|sample|seamless|separate|shader|sparse|stencil_tex|sync|tess|timer|transform|uniform|viewport"
    r"|texture_(buffer|view|multisample|storage|stencil8|cube_map_array|gather|query)|vertex_(attrib|program|type))"
    r"|^ext_(gpu|transform|image|direct|external|memory|texture_(array|integer|buffer|snorm|srgb))"
)
LARGEST = {"piglit": 3_000_000, "xscreensaver": 60_000_000}  # bytes of a trace
SECONDS = {"piglit": 8, "xscreensaver": 4}  # a hack draws until it is ended
FRAMES = (0, 3)  # of a hack; a test has one, or few


@dataclass(frozen=True)
class Compared:
    """What became of a program: "equal", "differs", "draws nothing" or "not compared"; which calls were left out."""

    name: str
    outcome: str
    left_out: tuple[str, ...] = ()
    told: str = ""


def missing_tools() -> str:
    """Return what is not installed here, as a reason to skip."""
    missing = [tool for tool in TOOLS if shutil.which(tool) is None]
    missing += [package for package, folder in (("piglit", PIGLIT), ("xscreensaver-gl", HACKS)) if not folder.is_dir()]
    return f"missing: {', '.join(missing)} (.ci/debian-programs installs them)" if missing else ""


def programs() -> list[str]:
    """Return the names of the programs: "piglit/fog-modes", "xscreensaver/gears"."""
    tests = [
        f"piglit/{path.name}"
        for path in sorted(PIGLIT.iterdir())
        if path.is_file() and os.access(path, os.X_OK) and not LATER.search(path.name)
        if not SHADERS.search(path.read_bytes())
    ]
    hacks = [f"xscreensaver/{path.name}" for path in sorted(HACKS.iterdir()) if b"libGLU.so" in path.read_bytes()]
    return tests + hacks


@contextmanager
def display() -> Iterator[dict[str, str]]:
    """Start an X server without a screen; give the environment for programs on it."""
    reading, writing = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(writing), "-screen", "0", "640x480x24", "-nolisten", "tcp"],
        pass_fds=(writing,), stderr=subprocess.DEVNULL,
    )  # fmt: skip
    os.close(writing)
    try:
        number = os.read(reading, 16).decode().strip()
        yield {**os.environ, "DISPLAY": f":{number}", "LIBGL_ALWAYS_SOFTWARE": "1", "PIGLIT_PLATFORM": "glx"}
    finally:
        os.close(reading)
        server.terminate()
        server.wait()


def record(name: str, folder: Path, environment: dict[str, str]) -> Path | None:
    """Record a program; return its trace, or None if it has made none, or too large a one."""
    group, _, program = name.partition("/")
    trace = folder / f"{group}-{program}.trace"
    if group == "piglit":
        command = ["apitrace", "trace", "-o", str(trace), str(PIGLIT / program), "-auto"]
    else:
        hack = [str(HACKS / program), "--window", "--geometry", "160x120", "--delay", "200000"]
        command = ["apitrace", "trace", "--api", "egl", "-o", str(trace), *hack]
    with subprocess.Popen(
        ["timeout", "-s", "TERM", str(SECONDS[group]), *command], env=environment, cwd=folder,
        stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    ) as process:  # fmt: skip
        process.wait()
    return trace if trace.is_file() and trace.stat().st_size <= LARGEST[group] else None


def compare(name: str, trace: Path | None) -> Compared:
    """Compare a program's first frame and, if there are as many, its fourth one."""
    if trace is None:
        return Compared(name, "not compared", told="no trace, or a large one")
    try:
        found = find_frames(Trace(trace), max(FRAMES)).frames
        frames = [frame for frame in FRAMES if frame < len(found)]
        if not any(found[frame].draws for frame in frames):
            return Compared(name, "draws nothing")
        compared = compare_trace(trace, frames)
    except (SoftShadowError, ValueError) as error:
        return Compared(name, "not compared", told=str(error))
    left_out = tuple(dict.fromkeys(each.call for each in compared[-1].left_out if not each.of_program))
    told = "\n".join(map(str, compared))
    return Compared(name, "equal" if all(compared) else "differs", left_out, told)


def is_whole(each: Compared) -> bool:
    """Return whether a program is equal, with every call carried out."""
    return each.outcome == "equal" and not each.left_out


def listed() -> set[str]:
    """Return the names of the programs that are known to differ, or to need a call that is missing."""
    return {line.split("\t")[0] for line in LIST.read_text(encoding="utf-8").splitlines()[1:]}


def write_list(compared: list[Compared]) -> None:
    """Write the programs that differ, or need a call that is missing."""
    rows = [f"{each.name}\t{each.outcome}\t{' '.join(each.left_out) or '-'}" for each in compared
            if each.outcome in ("equal", "differs") and not is_whole(each)]  # fmt: skip
    LIST.write_text("\n".join(["program\toutcome\tleft out", *sorted(rows)]) + "\n", encoding="utf-8")


def changes(compared: list[Compared]) -> list[str]:
    """Return how the programs differ from the list, which may only shrink."""
    known = listed()
    told = []
    for each in compared:
        if is_whole(each) and each.name in known:
            told.append(f"{each.name} is equal now: remove it from {LIST.name}")
        elif each.outcome in ("equal", "differs") and not is_whole(each) and each.name not in known:
            told.append(f"{each.name}: {each.outcome}\n{each.told}")
    return told


def compare_all(names: list[str], folder: Path, seconds: float) -> list[Compared]:
    """Record and compare programs one after the other, for some time at most."""
    compared, end = [], time.monotonic() + seconds
    with display() as environment:
        for name in names:
            if time.monotonic() > end:
                break
            trace = record(name, folder, environment)
            compared.append(compare(name, trace))
            if trace is not None:
                trace.unlink()
    return compared


def summary(compared: list[Compared]) -> str:
    """Return a table: by group, how many programs are equal, with everything and with calls left out."""
    counts: Counter[tuple[str, str]] = Counter()
    for each in compared:
        group = each.name.partition("/")[0]
        what = (
            "nothing left out"
            if not each.left_out
            else "shaders"
            if any(map(is_shading, each.left_out))
            else "left out"
        )
        counts[group, each.outcome if each.outcome not in ("equal", "differs") else f"{each.outcome}, {what}"] += 1
    return "\n".join(f"{group:14}{what:28}{count:5}" for (group, what), count in sorted(counts.items()))


def main() -> int:
    """Record, compare, and tell what has changed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=7200)
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    compared = compare_all(programs()[:: options.every], options.folder, options.seconds)
    print(summary(compared))
    for each in compared:
        if each.outcome == "not compared":
            print(f"{each.name}: {each.told.splitlines()[0]}")
    if options.write:
        write_list(compared)
        return 0
    told = changes(compared)
    print(*told, sep="\n")
    return 1 if told else 0


if __name__ == "__main__":
    sys.exit(main())
