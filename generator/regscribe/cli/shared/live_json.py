"""What the JSON of live commands has in common: which device was asked and when, readings, errors."""

from datetime import UTC, datetime
from typing import Any

from regscribe.cli.shared.error_report import kind_of
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
