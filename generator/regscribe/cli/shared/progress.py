"""A bar for long work, on a terminal only; what stands on standard output stays clean."""

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from regscribe.visible import tame

Advance = Callable[[str], None]
"""One step is done; the text says which."""


@contextmanager
def progress(total: int, label: str) -> Iterator[Advance]:
    """A bar of `total` steps on standard error while the block runs; nothing where that is no terminal."""
    if not sys.stderr.isatty():
        yield lambda _: None
        return
    from rich.console import Console  # noqa: PLC0415 - 60 ms that only a terminal needs
    from rich.progress import Progress  # noqa: PLC0415 - as above

    with Progress(console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task(label, total=total)
        yield lambda text: bar.update(task, advance=1, description=tame(text))
