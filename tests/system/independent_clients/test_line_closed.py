"""What the wire tests found once, and needs no client by others to be found again."""

import gc
import os
import tty
from pathlib import Path

from independent.families import FAMILIES
from independent.stage import service, staged


def open_files() -> int:
    gc.collect()
    return len(list(Path("/proc/self/fd").iterdir()))


def test_a_served_line_leaves_nothing_open_when_it_is_stopped() -> None:
    ours, theirs = os.openpty()
    tty.setraw(theirs)
    device = FAMILIES[0].device()
    try:
        before = open_files()
        for _ in range(3):
            with staged(device, service("serial", path=os.ttyname(theirs)), service("tcp")):
                pass
        assert open_files() == before
    finally:
        os.close(ours)
        os.close(theirs)
