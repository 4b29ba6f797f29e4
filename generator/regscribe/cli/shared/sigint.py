"""Holds Ctrl-C back while something is written: the request under way is finished first."""

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager

from regscribe.cli.shared.output import remark

INTERRUPTED = 130


class Shield:
    """Whether Ctrl-C came while the block ran."""

    def __init__(self) -> None:
        self.interrupted = False

    @property
    def code(self) -> int:
        """The exit code of a command that went well behind the shield."""
        return INTERRUPTED if self.interrupted else 0


@contextmanager
def shielded() -> Iterator[Shield]:
    """Let Ctrl-C wait for the end of the block; a second one breaks it off."""
    shield = Shield()
    if threading.current_thread() is not threading.main_thread():
        yield shield  # signals come to the main thread alone
        return

    def interrupt(*_: object) -> None:
        if shield.interrupted:
            raise KeyboardInterrupt
        shield.interrupted = True
        remark("finishing what is being written; Ctrl-C again breaks it off, and then nobody knows what is done")

    before = signal.signal(signal.SIGINT, interrupt)
    try:
        yield shield
    finally:
        signal.signal(signal.SIGINT, before)
