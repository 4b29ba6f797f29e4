"""What a client is asked to send, and what it reports of the answer: plain data, the same for every client."""

from dataclasses import dataclass
from typing import ClassVar, Protocol, Self

READ_BITS = frozenset({1, 2})
READ_WORDS = frozenset({3, 4})


@dataclass(frozen=True, slots=True)
class Read:
    """A read of `count` bits (functions 1 and 2) or words (3 and 4)."""

    function: int
    address: int
    count: int = 1


@dataclass(frozen=True, slots=True)
class Write:
    """A write of one (5, 6) or several (15, 16) bits or words."""

    function: int
    address: int
    words: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Raw:
    """Any other function with its data."""

    function: int
    data: bytes = b""


Question = Read | Write | Raw


@dataclass(frozen=True, slots=True)
class Values:
    """Bits or words, as the client read them."""

    words: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Written:
    """A confirmed write."""


@dataclass(frozen=True, slots=True)
class Partly:
    """A confirmed write of fewer words than were sent; `count` None where the client does not tell how many."""

    count: int | None


@dataclass(frozen=True, slots=True)
class Payload:
    """The data of an answer to a `Raw` request."""

    data: bytes


@dataclass(frozen=True, slots=True)
class Refused:
    """An exception answer; `code` None where the client only tells that there was one."""

    code: int | None


@dataclass(frozen=True, slots=True)
class Silent:
    """No answer within the patience."""


@dataclass(frozen=True, slots=True)
class Unable:
    """The client cannot send such a request: nothing was tried."""

    why: str


Answer = Values | Written | Partly | Payload | Refused | Silent | Unable


class Client(Protocol):
    """A client by others, connected to one simulated line or port.

    `name` tells the client and the way it talks. `ask` sends one question and waits `patience` seconds for the answer.
    `signed`, `floats` and `text` read holding registers as the client itself understands 16-bit integers in two's
    complement, IEEE numbers in two registers (`swapped`: the least significant word first) and characters (two to a
    word, the first in the high byte); they raise AssertionError where the read fails. `write_float` is the way back.
    """

    name: ClassVar[str]

    def ask(self, unit: int, question: Question, patience: float = 3.0) -> Answer:
        """Send one request; what came of it."""

    def signed(self, unit: int, address: int, count: int) -> tuple[int, ...]:
        """Return `count` integers."""

    def floats(self, unit: int, address: int, count: int, *, swapped: bool) -> tuple[float, ...]:
        """Return `count` IEEE numbers of 32 bits, from 2 x `count` registers."""

    def text(self, unit: int, address: int, words: int) -> str:
        """Return 2 x `words` characters."""

    def write_float(self, unit: int, address: int, number: float, *, swapped: bool) -> Answer:
        """Write one IEEE number of 32 bits."""

    def __enter__(self) -> Self:
        """Connect."""

    def __exit__(self, *_: object) -> None:
        """Disconnect, and end every process of it."""
