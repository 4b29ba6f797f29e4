"""Faults of a line: requests and answers that are lost, late, doubled, cut, garbled, foreign, stale, or hang up."""

from collections import Counter, deque
from collections.abc import Callable, Iterable, Sequence
from enum import StrEnum
from random import Random
from threading import Lock

from regscribe.simulate.line.service import Chunk, Exchange
from regscribe_runtime.wire.framing import MBAP_HEAD, TCP, Frame, build, checked_framing
from regscribe_runtime.wire.pdu import encode_reply
from regscribe_runtime.wire.requests import (
    BIT_READS,
    BLOCK_WRITES,
    LOOPBACK,
    WORD_READS,
    WRITE_COIL,
    WRITE_REGISTER,
    Reply,
)

STORM = 3
"""Requests in a row that are refused."""
STORM_CODES = (1, 2, 3, 4, 5, 6, 8, 10, 11)
FUNCTIONS = (1, 2, 3, 4, 5, 6, 15, 16)
MOST_NOISE = 24
KEPT = 8
"""Answers that are kept, to come once more when another one is asked for."""

SPLIT_SECONDS, CHATTER_SECONDS = 0.002, 0.001


class LineFault(StrEnum):
    """A fault of a request or its answer.

    `REQUEST_LOST` and `REFUSED` keep the request from the device; after all others it was carried out. `FORGED` flips
    a bit of what the protocol compares (byte count, echo) and repairs the check; `FALSIFIED` one of what nothing can
    compare: values, exception codes, counts of words written. No client can detect `FALSIFIED`, nor a `STALE` answer
    that looks like the right one (see `LineFaults.forgeries`).
    """

    REQUEST_LOST = "request lost"
    REFUSED = "refused again and again"
    LOST = "answer lost"
    LATE = "answer after the timeout"
    TWICE = "answer twice"
    CUT = "answer cut short"
    EXTENDED = "answer with bytes behind it"
    SPLIT = "answer in two parts"
    FLIPPED = "bit flipped"
    FORGED = "bit flipped and check repaired"
    FOREIGN_UNIT = "wrong unit"
    FOREIGN_FUNCTION = "wrong function"
    FOREIGN_TRANSACTION = "wrong transaction id"
    STALE = "answer of an earlier request"
    NOISE = "garbage before the answer"
    CHATTER = "garbage after the answer"
    HANGUP = "disconnected"
    FALSIFIED = "value falsified"


UNDETECTABLE = frozenset({LineFault.FALSIFIED})
FORGERIES = frozenset({LineFault.FORGED, LineFault.FALSIFIED})
USUAL = tuple(fault for fault in LineFault if fault not in UNDETECTABLE)


class LineFaults:
    """Faults of one service in a share `rate` of its exchanges, by a seed or by `plan`; safe to read from any thread.

    Its `arrival` and `delivery` are those of a `Service`; `framing` is tcp, rtu or ascii, as the service has it.
    `late` is in seconds: longer than the client's timeout, shorter than its patience with late answers. `kinds` may
    hold `HANGUP` only where a line can hang up (TCP). `injected` counts the faults, `exchanges` all exchanges; in
    `forgeries` are the faults that no client could have detected.
    """

    def __init__(
        self,
        framing: str,
        *,
        rate: float = 0.2,
        late: float = 1.5,
        seed: int = 0,
        kinds: Iterable[LineFault] = USUAL,
    ) -> None:
        self.rate, self.late = rate, late
        self.kinds = tuple(kinds)
        self.injected: Counter[LineFault] = Counter()
        self.exchanges = 0
        self.forgeries: list[Exchange] = []
        self._framing = checked_framing(framing)
        self._random = Random(seed)  # noqa: S311 - repeatable, and no secret
        self._planned: deque[tuple[LineFault | None, int | None]] = deque()
        self._chosen: dict[int, tuple[LineFault | None, int | None]] = {}
        self._earlier: deque[Exchange] = deque(maxlen=KEPT)
        self._storm = 0
        self._lock = Lock()

    def plan(self, *faults: LineFault | None, at: int | None = None) -> None:
        """Give the next exchanges these faults (None: none), before chance decides again.

        `at` is the byte at which an answer is cut or the line hangs up, or the bit that is flipped.
        """
        with self._lock:
            self._planned += [(fault, at) for fault in faults]

    def calm(self) -> None:
        """Inject no more faults."""
        with self._lock:
            self._planned.clear()
            self.rate, self._storm = 0.0, 0

    def arrival(self, request: Frame, act: Callable[[], bytes | None]) -> bytes | None:
        """Choose a fault for an exchange, and keep its request from the device if that is the fault."""
        with self._lock:
            self.exchanges += 1
            fault: LineFault | None = None
            at: int | None = None
            if self._planned:
                fault, at = self._planned.popleft()
            elif self._random.random() < self.rate:
                fault = self._random.choice(self.kinds)
            if (fault is LineFault.REFUSED or self._storm) and request.unit:
                self._storm = self._storm - 1 if self._storm else STORM - 1
                self.injected[LineFault.REFUSED] += 1
                return encode_reply(Reply(request.pdu[0], exception=at or self._random.choice(STORM_CODES)))
            if fault is LineFault.REQUEST_LOST:
                self.injected[fault] += 1
                return None
            if request.unit:
                self._chosen[id(request)] = (fault, at)
        return act()

    async def delivery(self, exchange: Exchange) -> Sequence[Chunk]:
        """The chunks of an answer after its fault."""
        fault, at = self._chosen.pop(id(exchange.request), (None, None))
        if not exchange.frame:
            return ()
        spoilt = None if fault is None else self._spoil(fault, exchange, at)
        if fault is not None and spoilt is not None:
            with self._lock:
                self.injected[fault] += 1
        self._earlier.append(exchange)
        return (Chunk(exchange.frame),) if spoilt is None else spoilt

    def _spoil(self, fault: LineFault, exchange: Exchange, at: int | None) -> Sequence[Chunk] | None:
        """The chunks to send instead of the frame; None where this fault does not fit this answer."""
        if fault in CUTS:
            frame = exchange.frame
            return CUTS[fault](self, frame, self._random.randrange(len(frame)) if at is None else at)
        if fault is LineFault.STALE:
            return self._stale(exchange)
        if fault is not LineFault.FLIPPED:
            return self._rewritten(fault, exchange, at)
        flipped = bytearray(exchange.frame)
        checked = len(flipped)
        if self._framing == TCP:  # TCP has a check of its own: only what this protocol compares flips here
            checked = MBAP_HEAD.size + len(_compared(exchange.answer or b""))
        bit = self._random.randrange(8 * checked) if at is None else at % (8 * checked)
        flipped[bit // 8] ^= 1 << bit % 8
        return (Chunk(bytes(flipped)),)

    def noise(self) -> bytes:
        """Random bytes, `MOST_NOISE` at most."""
        return self._random.randbytes(self._random.randint(1, MOST_NOISE))

    def _stale(self, exchange: Exchange) -> Sequence[Chunk] | None:
        """An earlier answer in place of this one, or before it."""
        others = [each for each in self._earlier if self._identity(each) != self._identity(exchange)]
        if not others:
            return None
        old = self._random.choice(others).frame
        return (Chunk(old + exchange.frame if self._random.random() < 1 / 2 else old),)

    def _identity(self, exchange: Exchange) -> tuple[int, ...]:
        """What distinguishes an answer from others: the transaction id, else unit and function."""
        request = exchange.request
        return (request.transaction,) if self._framing == TCP else (request.unit, request.pdu[0])

    def _rewritten(self, fault: LineFault, exchange: Exchange, at: int | None) -> Sequence[Chunk] | None:
        """The answer in a frame of its own, to another request or with another byte."""
        to, answer, chance = exchange.request, bytearray(exchange.answer or b""), self._random
        if fault is LineFault.FOREIGN_UNIT:
            to = to._replace(unit=_other(range(1, 248), to.unit, chance))
        elif fault is LineFault.FOREIGN_TRANSACTION and self._framing == TCP:
            to = to._replace(transaction=(to.transaction + chance.randrange(1, 1 << 16)) % (1 << 16))
        elif fault is LineFault.FOREIGN_FUNCTION:
            answer[0] = _other(FUNCTIONS, to.pdu[0], chance)
        elif fault in FORGERIES and (places := _places(answer, compared=fault is LineFault.FORGED)):
            place = chance.choice(places) if at is None else places[at % len(places)]
            answer[place] ^= 1 << chance.randrange(8)
        else:
            return None
        if fault in UNDETECTABLE:
            self.forgeries.append(exchange)
        return (Chunk(build(self._framing, to.unit, bytes(answer), to.transaction)),)


CUTS: dict[LineFault, Callable[[LineFaults, bytes, int], Sequence[Chunk]]] = {
    LineFault.LOST: lambda *_: (),
    LineFault.LATE: lambda faults, frame, _: (Chunk(frame, faults.late),),
    LineFault.TWICE: lambda _, frame, __: (Chunk(frame * 2),),
    LineFault.CUT: lambda _, frame, at: (Chunk(frame[:at]),),
    LineFault.EXTENDED: lambda faults, frame, _: (Chunk(frame + faults.noise()),),
    LineFault.SPLIT: lambda _, frame, at: (Chunk(frame[:at]), Chunk(frame[at:], SPLIT_SECONDS)),
    LineFault.NOISE: lambda faults, frame, _: (Chunk(faults.noise() + frame),),
    LineFault.CHATTER: lambda faults, frame, _: (Chunk(frame), Chunk(faults.noise(), CHATTER_SECONDS)),
    LineFault.HANGUP: lambda _, frame, at: (Chunk(frame[:at], hangup=True),),
}
"""Faults that need nothing but the frame: the chunks to send, by the frame and a place in it."""


def _other(candidates: Sequence[int], than: int, chance: Random) -> int:
    return chance.choice([each for each in candidates if each != than])


def _compared(answer: bytes | bytearray) -> range:
    """The bytes of an answer that a client can compare with its request, the function code first."""
    function, whole = answer[0], range(len(answer))
    if function in WORD_READS or function in BIT_READS:
        return whole[:2]
    if function in {WRITE_COIL, WRITE_REGISTER, LOOPBACK}:
        return whole
    return whole[:3] if function in BLOCK_WRITES else whole[:0]  # 07 with the bit of an exception is one


def _places(answer: bytearray, *, compared: bool) -> Sequence[int]:
    """The bytes behind the function code that a client can compare with its request, or those that it cannot."""
    return [place for place in range(1, len(answer)) if (place in _compared(answer)) is compared]
