"""Requests that were not sent, for people and for programs."""

from collections.abc import Sequence
from typing import Any

from regscribe.cli.shared.output import hexadecimal, remark, show_table
from regscribe.tools.live.dry_run import DryWrite


def show_requests(written: Sequence[DryWrite]) -> None:
    """List what would have been sent; say so where it is nothing."""
    if not written:
        remark("nothing would be written: the device holds it already")
        return
    requests = [one.request for one in written]
    rows = [(f"{one.function:02d}", str(one.address), hexadecimal(one.words)) for one in requests]
    show_table(("FUNCTION", "ADDRESS", "WORDS"), rows)
    remark("nothing was sent")


def plain_requests(written: Sequence[DryWrite]) -> list[dict[str, Any]]:
    """The same in JSON."""
    return [
        {"function": one.request.function, "address": one.request.address, "words": list(one.request.words)}
        for one in written
    ]
