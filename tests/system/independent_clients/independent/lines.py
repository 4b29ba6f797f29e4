"""Serial lines made of socat: a pair of pseudo terminals, or a pseudo terminal in front of a TCP port."""

import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

IDLE = "300"
"""Seconds without a byte after which socat ends by itself, should this process be gone."""

PATIENCE = 10.0
"""Seconds that socat has to make its ends."""


@contextmanager
def pty_pair(folder: Path) -> Iterator[tuple[str, str]]:
    """Two ends of one serial line: what is written to one is read from the other."""
    ends = folder / "controller", folder / "master"
    with _socat(*(_pty(end) for end in ends), ends=ends):
        yield str(ends[0]), str(ends[1])


@contextmanager
def pty_before(host: str, port: int, folder: Path) -> Iterator[str]:
    """A serial line whose other end is a TCP port."""
    end = folder / "master"
    with _socat(_pty(end), f"TCP:{host}:{port},nodelay", ends=(end,)):
        yield str(end)


def _pty(end: Path) -> str:
    return f"PTY,rawer,link={end}"


@contextmanager
def _socat(*addresses: str, ends: tuple[Path, ...]) -> Iterator[None]:
    process = subprocess.Popen(["socat", "-T", IDLE, *addresses], stderr=subprocess.PIPE)  # noqa: S603, S607 (fixed, no shell)
    try:
        until = time.monotonic() + PATIENCE
        while not all(end.exists() for end in ends):
            assert process.poll() is None, process.stderr and process.stderr.read()
            assert time.monotonic() < until, f"socat made no {ends} in {PATIENCE} s"
            time.sleep(0.01)  # socat has no event for it
        yield
    finally:
        process.kill()
        process.communicate()
        for end in ends:
            end.unlink(missing_ok=True)
