"""Long work on a terminal: a progress bar, and Ctrl-C that waits for the request under way."""

import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from regscribe.cli.shared.exit_codes import INTERRUPTED
from regscribe.cli.shared.global_options import is_quiet
from regscribe.cli.shared.output import alert, console
from regscribe.visible import tame

Advance = Callable[[str], None]
"""Called after each step with a text that says which."""


@contextmanager
def progress(total: int, label: str) -> Iterator[Advance]:
    """A bar of `total` steps on standard error while the block runs; nothing with --quiet or without a terminal."""
    if is_quiet() or not sys.stderr.isatty():
        yield lambda _: None
        return
    from rich.progress import Progress  # noqa: PLC0415 - 60 ms that only a terminal needs

    with Progress(console=console(sys.stderr), transient=True) as bar:
        task = bar.add_task(label, total=total)
        yield lambda text: bar.update(task, advance=1, description=tame(text))


class Shield:
    """Whether Ctrl-C came while the block ran."""

    def __init__(self) -> None:
        self.interrupted = False

    @property
    def code(self) -> int:
        """The exit code of a command that succeeded behind the shield."""
        return INTERRUPTED if self.interrupted else 0


@contextmanager
def shielded() -> Iterator[Shield]:
    """Hold Ctrl-C back until the end of the block; a second one breaks it off."""
    shield = Shield()
    if threading.current_thread() is not threading.main_thread():
        yield shield  # signals come to the main thread alone
        return

    def interrupt(*_: object) -> None:
        if shield.interrupted:
            raise KeyboardInterrupt
        shield.interrupted = True
        alert("finishing what is being written; Ctrl-C again breaks it off, and then nobody knows what is done")

    before = signal.signal(signal.SIGINT, interrupt)
    try:
        yield shield
    finally:
        signal.signal(signal.SIGINT, before)
