"""What is tried again, how often, and after which pause."""

from typing import NamedTuple


class Retry(NamedTuple):
    """How often a read is sent again after NoAnswer, WrongAnswer or LinkLost, each time after `pause` seconds.

    A write is never sent again, whatever stands here: it may have been carried out although its answer was lost.
    """

    reads: int = 2
    pause: float = 0.05


NEVER = Retry(reads=0)
"""Every error shows at once."""
