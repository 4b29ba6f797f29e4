"""`--trace`: every frame on standard error, when it passed, in hexadecimal and in the names of the device's map."""

from datetime import UTC, datetime

from regscribe.cli.shared.output import warn
from regscribe.tools.live.capture import RECEIVED, SENT
from regscribe.tools.live.decode import Decoded, Decoder
from regscribe.tools.live.names import Driver
from regscribe.tools.live.target import Target
from regscribe.visible import safe
from regscribe_runtime.link.links import Trace
from regscribe_runtime.wire.capture import frames

ARROWS = {SENT: "->", RECEIVED: "<-"}


class Tracing:
    """A tracer of the runtime that prints; it knows names as soon as it is told the driver."""

    def __init__(self, target: Target) -> None:
        self._framing = target.link.framing
        self._first = int(target.link.addressing == "jbus")
        self._decoder: Decoder | None = None

    def tell(self, driver: Driver) -> None:
        """Decode in the names of this driver from now on."""
        self._decoder = Decoder(driver, first=self._first)

    def __call__(self, trace: Trace) -> None:
        """Print one frame."""
        moment = datetime.fromtimestamp(trace.seconds, UTC).strftime("%H:%M:%S.%f")[:-3]
        text = self._framing == "ascii"
        raw = trace.frame.decode("ascii", "replace").strip() if text else trace.frame.hex(" ").upper()
        lines = [f"{moment} {ARROWS[trace.direction]} {raw}"]
        if self._decoder is not None:
            for frame in frames(trace.frame, self._framing):
                lines += _said(self._decoder.feed(frame, trace.direction))
        warn("".join(f"{safe(line)}\n" for line in lines))


def _said(one: Decoded) -> list[str]:
    held = [item for item in one.items if item.words]
    asked = "" if held else ", ".join(item.name for item in one.items)
    head = ": ".join(filter(None, (one.what, asked))) + (f"  [{one.complaint}]" if one.complaint else "")
    return [f"    {line}" for line in filter(None, (head, *(item.spelled for item in held)))]
