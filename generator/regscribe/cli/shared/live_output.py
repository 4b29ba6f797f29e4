"""What live commands print alike: the heading of their JSON, readings, and requests that were not sent."""

from collections.abc import Sequence
from datetime import UTC, datetime
from typing import Any

from regscribe.cli.shared.error_report import kind_of
from regscribe.cli.shared.output import hexadecimal, remark, show_table
from regscribe.tools.live.dry_run import DryWrite
from regscribe.tools.live.reading import RegisterReading
from regscribe.tools.live.target import Target
from regscribe.tools.live.watch import rfc3339
from regscribe_runtime import BareDevice


def heading(device: BareDevice, target: Target) -> dict[str, Any]:
    """What every JSON object of a live command begins with: the device, and the time (RFC 3339, UTC)."""
    about = {"device": str(target), "unit_id": target.unit, "model": device.model, "map": device.map_id}
    return {**about, "time": rfc3339(datetime.now(UTC))}


def plain(one: RegisterReading) -> dict[str, Any]:
    """A reading in JSON: value and unit, or the error in place of it."""
    if one.error is not None:
        return {"error": {"kind": kind_of(one.error), "message": str(one.error)}}
    return {"value": one.value, "unit": one.unit}


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
