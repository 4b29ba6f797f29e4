"""What a tracer is told of: every frame that goes out or comes in, those that were rejected too."""

from collections.abc import Callable
from typing import NamedTuple

SENT, RECEIVED = "sent", "received"


class Trace(NamedTuple):
    """One frame as it stood on the line, with its CRC, LRC or MBAP header.

    `seconds` is the clock's time (seconds since 1970), `direction` is sent or received, `unit` the one that was asked.
    What is no frame (noise, an answer cut short, a repeated one) comes as received too, in the pieces it was found in.
    """

    seconds: float
    direction: str
    unit: int
    frame: bytes


Tracer = Callable[[Trace], None]
"""Called in the thread or task that talks, while it holds the line: it must be quick, and must not talk itself."""
