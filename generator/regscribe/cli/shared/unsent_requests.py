"""Requests that were not sent, for people and for programs."""

from collections.abc import Sequence
from typing import Any

from regscribe.cli.shared.output import remark, show_table
from regscribe.tools.live.dry_run import DryWrite


def show_requests(written: Sequence[DryWrite]) -> None:
    """List what would have been sent; say so where it is nothing."""
    if not written:
        remark("nothing would be written: the device holds it already")
        return
    show_table(("FUNCTION", "ADDRESS", "WORDS"), [_row(one) for one in written])
    remark("nothing was sent")


def plain_requests(written: Sequence[DryWrite]) -> list[dict[str, Any]]:
    """The same in JSON."""
    return [
        {"function": one.request.function, "address": one.request.address, "words": list(one.request.words)}
        for one in written
    ]


def _row(one: DryWrite) -> tuple[str, str, str]:
    words = " ".join(f"{word:04X}" for word in one.request.words)
    return f"{one.request.function:02d}", str(one.request.address), words
