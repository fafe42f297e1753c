"""Pack traces into an archive: ``pack.py ARCHIVE FILE.trace ...``.

Every trace begins with the names of all tokens of GL, which take 25 kB even when packed. In one archive of unpacked
traces they are packed once.
"""

import gzip
import io
import sys
import tarfile
from pathlib import Path

from softshadow.traces.container import unpacked_parts


def pack(archive: Path, traces: list[Path]) -> None:
    """Write an archive with the contents of traces, each as apitrace's gzip files without compression."""
    with tarfile.open(archive, "w:xz", preset=9) as packed:
        for trace in sorted(traces):
            content = b"".join(part for _, part in unpacked_parts(trace))
            stored = gzip.compress(content, compresslevel=0, mtime=0)
            member = tarfile.TarInfo(trace.name)
            member.size = len(stored)
            packed.addfile(member, io.BytesIO(stored))


if __name__ == "__main__":
    pack(Path(sys.argv[1]), [Path(name) for name in sys.argv[2:]])
