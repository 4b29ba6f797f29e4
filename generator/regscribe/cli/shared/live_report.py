"""What live commands print alike: errors with an exit code, the heading of JSON, readings, unsent requests."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from datetime import UTC, datetime
from typing import Any

from regscribe.cli.shared.diagnostic_text import report
from regscribe.cli.shared.exit_codes import REFUSED, SILENT, UNKNOWN_STATE, USAGE
from regscribe.cli.shared.failure import Failure
from regscribe.cli.shared.output import hexadecimal, remark, show_table, warn
from regscribe.tools.live import catalogue
from regscribe.tools.live.capture import RECEIVED, SENT
from regscribe.tools.live.decode import Decoded, Decoder
from regscribe.tools.live.errors import TargetError
from regscribe.tools.live.map_drivers import MapError
from regscribe.tools.live.reading import RegisterReading
from regscribe.tools.live.target import Target
from regscribe.tools.live.watch import rfc3339
from regscribe.visible import safe
from regscribe_runtime import BareDevice, ExceptionAnswer, LinkLost, NoAnswer, PartialWrite, RegscribeError
from regscribe_runtime.errors import GATEWAY, LeftAt, NotApplied, NotConfigured, ReadBackDiffers, WriteUnknown
from regscribe_runtime.link.links import Trace
from regscribe_runtime.report import Sent
from regscribe_runtime.values.wire_types import address_facts, spelled_address
from regscribe_runtime.wire.capture import frames
from regscribe_runtime.wire.requests import Request

Unsent = Sequence[Request | Sent]
"""Requests that a dry run did not send."""

ARROWS = {SENT: "->", RECEIVED: "<-"}

OPTIONS = {
    "pass confirm=True": "add --confirm",
    "rounded=True rounds": "--rounded rounds",
    'pass while_running="reset"': "add --while-running reset",
}
"""Advice of drivers about their arguments, and the same about options."""

UNSETTLED = (PartialWrite, WriteUnknown, ReadBackDiffers, NotApplied, NotConfigured, LeftAt)
"""Errors after which the device does not hold what it held, or nobody knows; some of them are NoAnswer, too."""


@contextmanager
def reported() -> Iterator[None]:
    """Turn errors of targets and of drivers into a `Failure`; others pass."""
    try:
        yield
    except MapError as error:
        report(error.diagnostics, failed=False, nothing="")
        message = f"the map {error.path} has errors, so nothing was sent"
        raise Failure(message, kind="map", code=REFUSED) from None
    except TargetError as error:
        raise Failure(str(error), kind="target", code=USAGE) from None
    except RegscribeError as error:
        raise failure(error) from None


def failure(error: RegscribeError) -> Failure:
    """The failure for an error of a driver, whose message names options in place of arguments."""
    message = str(error)
    for argument, option in OPTIONS.items():
        message = message.replace(argument, option)
    return Failure(message, kind=kind_of(error), code=code_of(error))


def code_of(error: RegscribeError) -> int:
    """The exit code of an error of a driver."""
    if isinstance(error, UNSETTLED):
        return UNKNOWN_STATE
    behind_gateway = isinstance(error, ExceptionAnswer) and error.code in GATEWAY and not error.name
    return SILENT if behind_gateway or isinstance(error, (LinkLost, NoAnswer)) else REFUSED


def remark_broken_maps() -> None:
    """Tell which maps here are left out, since they have errors."""
    for error in catalogue.broken_maps():
        remark(f"{error.path} has errors and is left out: `regscribe check {error.path}` tells them")


def refused_if(fault: object) -> int:
    """The exit code of a command that ran: REFUSED if there is anything in `fault`."""
    return REFUSED if fault else 0


def kind_of(error: RegscribeError) -> str:
    """The class of an error in words: `no-answer`, `exception-answer`, `value-refused`, `sensor-fault`."""
    name = type(error).__name__
    return "".join(f"-{letter.lower()}" if letter.isupper() else letter for letter in name).lstrip("-")


def heading(device: BareDevice, target: Target) -> dict[str, Any]:
    """The first members of every JSON object of a live command: the device, and the time (RFC 3339, UTC)."""
    about = {"device": str(target), "unit_id": target.unit, "model": device.model, "map": device.map_id}
    return {**about, "time": rfc3339(datetime.now(UTC))}


def plain(reading: RegisterReading) -> dict[str, Any]:
    """A reading in JSON: value and unit, and why parts are left out; or the error in place of it."""
    if reading.error is not None:
        return {"error": {"kind": kind_of(reading.error), "message": str(reading.error)}}
    absent = {"absent": dict(reading.absent)} if reading.absent else {}
    return {"value": reading.value, "unit": reading.unit, **absent}


def show_requests(unsent: Unsent) -> None:
    """List the requests that a dry run held back; a remark where there are none."""
    if not unsent:
        remark("nothing would be written: the device holds it already")
        return
    rows = [
        (f"{one.function:02d}", spelled_address(one.function, one.address), hexadecimal(one.words)) for one in unsent
    ]
    show_table(("FUNCTION", "ADDRESS", "WORDS"), rows)
    remark("nothing was sent")


def plain_requests(unsent: Unsent | None) -> dict[str, Any]:
    """The member of JSON with the requests that a dry run held back; nothing where it was none."""
    if unsent is None:
        return {}
    plain = [
        {"function": one.function, **address_facts(one.function, one.address), "words": list(one.words)}
        for one in unsent
    ]
    return {"requests": plain}


class FrameTracer:
    """The tracer of `--trace`: prints every frame as it passes, with its meaning once `driver` is known."""

    def __init__(self, target: Target) -> None:
        self._link = target.link
        self._decoder: Decoder | None = None

    def decode_for(self, driver: type[BareDevice]) -> None:
        """Decode in the names of this driver from now on."""
        self._decoder = Decoder(driver, first=int(self._link.addressing == "jbus"))

    def __call__(self, trace: Trace) -> None:
        """Print one frame in hexadecimal (text in ASCII), and below it what it means."""
        moment = datetime.fromtimestamp(trace.seconds, UTC).strftime("%H:%M:%S.%f")[:-3]
        text = self._link.framing == "ascii"
        raw = trace.frame.decode("ascii", "replace").strip() if text else trace.frame.hex(" ").upper()
        lines = [f"{moment} {ARROWS[trace.direction]} {raw}"]
        if self._decoder is not None:
            for frame in frames(trace.frame, self._link.framing):
                lines += _meaning(self._decoder.feed(frame, trace.direction))
        warn("".join(f"{safe(line)}\n" for line in lines))


def _meaning(decoded: Decoded) -> list[str]:
    values = [item.spelled for item in decoded.items if item.words]
    asked = "" if values else ", ".join(item.name for item in decoded.items)
    head = ": ".join(filter(None, (decoded.what, asked)))
    head += f"  [{decoded.complaint}]" if decoded.complaint else ""
    return [f"    {line}" for line in (head, *values) if line]
