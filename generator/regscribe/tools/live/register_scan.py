"""Scans the addresses of a unit: which of them answer, in bounded requests; nothing is ever written.

A block that is refused, or that nobody answers, is halved until the addresses that are to blame are known. What is
known lies in one record, so that a scan that ended early goes on where it was.
"""

import re
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from regscribe.model.address_text import readings
from regscribe.tools.live.errors import TargetError
from regscribe_runtime import Link, LinkLost, NoAnswer, RegscribeError
from regscribe_runtime.values.wire_types import Space
from regscribe_runtime.wire.requests import Request, fits

SPACES = (Space.HOLDING, Space.INPUT, Space.COIL, Space.DISCRETE)
"""The spaces that can be scanned."""

ILLEGAL_FUNCTION, BUSY = 1, 6
GATEWAY = frozenset({10, 11})
"""Exceptions of a gateway behind which nobody answered."""
BUSY_TRIES, BUSY_SECONDS = 5, 0.5
"""How often, and after how long, a unit is asked again that says it is busy."""
TRIES = 2
"""How often one address is asked for that is silent: an answer may be lost on the way."""
SMALL = 4
"""Blocks of so few addresses are asked for one by one: halving them on would take as many requests."""

SILENT, NOISE = "silent", "noise"
"""What is recorded of an address in place of an exception code."""

_SPAN = re.compile(r"([^.\s-]+)(?:(?:\.\.|-)([^.\s-]+))?")

Span = tuple[int, int]
"""First and last address."""


class Asked(NamedTuple):
    """One request of a scan and what came of it: `words` if all went well, else the `refusal`."""

    space: Space
    first: int
    size: int
    words: tuple[int, ...] = ()
    refusal: str = ""


@dataclass(slots=True)
class ScanRecord:
    """What is known: by space, the word (or bit) at each address that answers, and why others do not.

    A refusal is an exception code as text, `silent` or `noise`. `longest` is the longest block to ask for, by space.
    """

    words: dict[Space, dict[int, int]] = field(default_factory=dict)
    refusals: dict[Space, dict[int, str]] = field(default_factory=dict)
    longest: dict[Space, int] = field(default_factory=dict)

    def answered(self, space: Space) -> dict[int, int]:
        """The words by address of a space."""
        return self.words.setdefault(space, {})

    def refused(self, space: Space) -> dict[int, str]:
        """The refusals by address of a space."""
        return self.refusals.setdefault(space, {})

    def unknown(self, space: Space, wanted: Sequence[Span]) -> Iterator[Span]:
        """The spans of which nothing is known yet."""
        known = self.answered(space).keys() | self.refused(space).keys()
        for first, last in wanted:
            yield from runs(address for address in range(first, last + 1) if address not in known)

    def is_left_out(self, space: Space) -> bool:
        """Whether the unit does not have the function that reads a space, so that nothing more is asked there."""
        return not self.answered(space) and str(ILLEGAL_FUNCTION) in self.refused(space).values()

    def heard(self) -> bool:
        """Whether anything was answered at all."""
        codes = (text for refusals in self.refusals.values() for text in refusals.values())
        return any(self.words.values()) or any(text.isdigit() for text in codes)


def spans_of(text: str) -> tuple[Span, ...]:
    """The addresses of a list like `0..99,0x200,4000..4100`, sorted and each once; TargetError."""
    found: set[int] = set()
    for part in text.split(","):
        span = _SPAN.fullmatch(part.strip())
        first, last = (_address(span[1]), _address(span[2] or span[1])) if span else (None, None)
        if first is None or last is None or last < first:
            message = f"`{part.strip()[:40]}` names no addresses: write 0..9999, or 0..99,0x200..0x2FF"
            raise TargetError(message)
        found.update(range(first, last + 1))
    return tuple(runs(sorted(found)))


def _address(text: str) -> int | None:
    """A wire address; None for another text."""
    return next((one.address for one in readings(text) if one.space is None), None)


def of_modicon(space: Space, spans: Sequence[Span]) -> str:
    """The list of wire addresses that spans are if Modicon's numbers were meant; empty where one of them is none."""
    ends = [(_modicon(space, first), _modicon(space, last)) for first, last in spans]
    return ",".join(f"{first}..{last}" for first, last in ends) if all(None not in one for one in ends) else ""


def _modicon(space: Space, address: int) -> int | None:
    return next((one.address for one in readings(str(address)) if one.space == space), None)


def spaces_of(text: str) -> tuple[Space, ...]:
    """The spaces of a list like `holding,input`; TargetError."""
    names = [one.strip() for one in text.split(",")]
    wrong = next((one for one in names if one not in SPACES), None)
    if wrong is not None:
        message = f"`{wrong[:40]}` is no space of addresses: there are {', '.join(SPACES)}"
        raise TargetError(message)
    return tuple(dict.fromkeys(map(Space, names)))


def runs(addresses: "Iterator[int] | Sequence[int]") -> Iterator[Span]:
    """Sorted addresses in spans without gaps."""
    first = last = None
    for address in addresses:
        if first is not None and last is not None and address != last + 1:
            yield first, last
            first = None
        first, last = address if first is None else first, address
    if first is not None and last is not None:
        yield first, last


@dataclass(frozen=True, slots=True, kw_only=True)
class ScanLimits:
    """How a scan asks: addresses a request, seconds between two, and the most requests."""

    block: int = 32
    pause: float = 0.0
    most: int = 10_000


class RegisterScan:
    """One scan of a unit on an open link, into a record."""

    def __init__(
        self,
        link: Link,
        unit: int,
        record: ScanRecord,
        limits: ScanLimits,
        sleep: Callable[[float], None] = time.sleep,
    ) -> None:
        self._link, self._unit, self._record, self._limits, self._sleep = link, unit, record, limits, sleep
        self._silence = NoAnswer(unit=unit, function=0, address=0, seconds=0)
        self._heard = record.heard()
        self.requests = 0

    def run(self, wanted: Mapping[Space, Sequence[Span]]) -> Iterator[Asked]:
        """Ask for all that is not known yet; yields after each request, its outcome recorded.

        It ends when everything is known, or after the most requests. NoAnswer if the unit never answered anything,
        LinkLost if the link is lost.
        """
        for space, spans in wanted.items():
            for start, last in list(self._record.unknown(space, spans)):
                first = start
                while first <= last and not self._is_left_out(space):
                    size = min(self._longest(space), last + 1 - first)
                    yield from self._block(space, first, size)
                    first += size
                    if self._is_spent():
                        return

    def _is_spent(self) -> bool:
        return self.requests >= self._limits.most

    def _longest(self, space: Space) -> int:
        return self._record.longest.get(space, min(self._limits.block, space.most))

    def _is_left_out(self, space: Space) -> bool:
        return self._record.is_left_out(space)

    def _block(self, space: Space, first: int, count: int, *, tries: int = TRIES) -> Iterator[Asked]:
        """Ask for a block, and for its parts where it is not answered, or where its answer is in doubt."""
        asked = self._ask(space, first, count, tries)
        if count == 1:
            self._record_one(asked)
        yield asked
        if count == 1 or self._is_spent():
            return
        if asked.words:
            end = self._ask(space, first + count - 1, 1, TRIES)
            if not end.refusal:
                self._record.answered(space).update(zip(range(first, first + count), asked.words, strict=True))
                return
        yield from self._parts(asked)

    def _parts(self, whole: Asked) -> Iterator[Asked]:
        """Ask for the parts of a block.

        A block may be answered although its end is refused alone: some devices make up the words behind a register.
        But if none of its addresses answers alone, it is one register that is read as a whole.
        """
        space, first, count = whole.space, whole.first, whole.size
        size = 1 if count <= SMALL or whole.refusal == str(ILLEGAL_FUNCTION) else (count + 1) // 2
        tries = 1 if whole.refusal == SILENT else TRIES  # it was silent once already
        for start in range(first, first + count, size):
            yield from self._block(space, start, min(size, first + count - start), tries=tries)
            if self._is_spent() or self._is_left_out(space):
                return
        answered, every = self._record.answered(space), range(first, first + count)
        if whole.refusal and all(address in answered for address in every):
            self._record.longest[space] = size  # not an address was to blame, but the length
        if whole.words and not any(address in answered for address in every):
            answered.update(zip(every, whole.words, strict=True))
            for address in every:
                self._record.refused(space).pop(address, None)

    def _record_one(self, asked: Asked) -> None:
        if asked.refusal:
            self._record.refused(asked.space)[asked.first] = asked.refusal
        else:
            self._record.answered(asked.space)[asked.first] = asked.words[0]

    def _ask(self, space: Space, first: int, count: int, tries: int) -> Asked:
        """Send one request; again if the unit is busy, and of one address as often as `tries` if nobody answers."""
        asked = self._sent(space, first, count)
        for _ in range(BUSY_TRIES):
            if asked.refusal != str(BUSY):
                break
            self._sleep(BUSY_SECONDS)
            asked = self._sent(space, first, count)
        for _ in range(tries - 1 if count == 1 else 0):
            if asked.refusal == SILENT:
                asked = self._sent(space, first, count)
        if asked.refusal != SILENT:
            self._heard = True
        elif count == 1 and not self._heard:
            raise self._silence
        return asked

    def _sent(self, space: Space, first: int, count: int) -> Asked:
        if self.requests and self._limits.pause:
            self._sleep(self._limits.pause)
        self.requests += 1
        request = Request(space.read_function, first, count)
        asked = Asked(space, first, count)
        try:
            reply = self._link.call(self._unit, request)
        except NoAnswer as silence:
            self._silence = silence
            return asked._replace(refusal=SILENT)
        except LinkLost:
            raise
        except RegscribeError:
            return asked._replace(refusal=NOISE)
        if reply.exception is not None:
            return asked._replace(refusal=SILENT if reply.exception in GATEWAY else str(reply.exception))
        return asked._replace(words=reply.words) if fits(request, reply) else asked._replace(refusal=NOISE)
