"""Requests and answers as plain data, and the comparison of an answer with its request.

pymodbus matches unit and transaction only; a wrong function or length would pass as a good answer, so every answer is
compared with its request here (Modbus Application Protocol V1.1b3, section 6).
"""

from typing import NamedTuple

from regscribe_runtime.errors import ExceptionAnswer, PartialWrite, WrongAnswer
from regscribe_runtime.values.protocol import Protocol
from regscribe_runtime.values.wire_types import ENRON_BIT, WRITE_AND_READ, Space, spelled_address

READ_COILS, READ_DISCRETE_INPUTS, READ_HOLDING, READ_INPUT = 1, 2, 3, 4
WRITE_COIL, WRITE_REGISTER, READ_STATUS, LOOPBACK, WRITE_COILS, WRITE_REGISTERS = 5, 6, 7, 8, 15, 16
READ_FILE, WRITE_FILE, READ_QUEUE = Space.FILE.read_function, Space.FILE.write_functions[0], Space.QUEUE.read_function
MASK_REGISTER, IDENTIFY = 22, Space.IDENTIFICATION.read_function
READ_SPACES = {space.read_function: space for space in Space if space is not Space.ENRON}
READS = frozenset(READ_SPACES)
WRITES = frozenset(function for space in Space for function in space.write_functions)
SPACES = READ_SPACES | {
    function: space for space in Space for function in space.write_functions if space is not Space.ENRON
}
"""By function: the space that it reads or writes, but for Enron's registers (see `Request.space`)."""
WORD_READS, BIT_READS = (READ_HOLDING, READ_INPUT), (READ_COILS, READ_DISCRETE_INPUTS)
BLOCK_WRITES = (WRITE_COILS, WRITE_REGISTERS)
"""Writes of several values: a byte count announces them, and the answer has only their number."""
UNADDRESSED = frozenset({READ_STATUS, LOOPBACK, READ_FILE, WRITE_FILE, IDENTIFY})

BITS_IN_BYTE, BYTES_IN_WORD = 8, 2
HEAD_SIZE, BLOCK_HEAD_SIZE, BOTH_HEAD_SIZE = 4, 5, 9
"""Bytes of an address with a quantity or a value, of both with a byte count, and of all that for a read and a write."""
IDENTITY_HEAD_SIZE = 9
"""Bytes of an answer about one object before its text."""
FILE_HEAD_SIZE, QUEUE_HEAD_SIZE = 8, 4
"""Bytes of a byte count with one group of records (type, file, record, length), and of the two counts of a queue."""


class Request(NamedTuple):
    """One request: `quantity` addresses from `address`; `words` are what a write sends (bits as 0 and 1).

    `seconds` is its response timeout, set on the way to the link; 0 leaves it to the link. `answered`: unit 0 is no
    broadcast but a device that answers. `page` is the number of the page that it means
    (0: none), `selects` whether it writes what selects one. `unit` is the unit id, where it is not that of the device.
    Function 23 writes its words from the address `into` on, and then reads.
    """

    function: int
    address: int
    quantity: int = 1
    words: tuple[int, ...] = ()
    seconds: float = 0.0
    answered: bool = False
    page: int = 0
    selects: bool = False
    unit: int = 0
    into: int = 0

    @property
    def space(self) -> Space | None:
        """The space that it reads or writes; None where its function names none."""
        return Space.ENRON if self.address >= ENRON_BIT else SPACES.get(self.function)

    @property
    def fetches(self) -> bool:
        """Whether its answer has what registers hold."""
        return self.function in READS or self.function == WRITE_AND_READ

    @property
    def reads(self) -> bool:
        """Whether it only reads, so that it may be sent again."""
        return self.function in READS

    def portions(self, most: int) -> list["Request"]:
        """The requests of up to `most` addresses each that carry the same, from the first address on."""
        starts = range(0, self.quantity, most)
        return [
            self._replace(
                address=self.address + start,
                quantity=min(most, self.quantity - start),
                words=self.words[start : start + most],
            )
            for start in starts
        ]

    def shifted(self, steps: int) -> "Request":
        """The request with its address moved, if its function has one: JBUS counts from 1 where Modbus does from 0."""
        if not steps or self.function in UNADDRESSED:
            return self
        space = self.space
        part_bits = space.part_bits if space is Space.QUEUE or space is Space.ENRON else 0
        into = self.into + steps if self.function == WRITE_AND_READ else 0
        return self._replace(address=self.address + (steps << part_bits), into=into)


class Reply(NamedTuple):
    """One answer: `words` as read or echoed, or an `exception` code (None: it is none)."""

    function: int
    words: tuple[int, ...] = ()
    address: int = 0
    quantity: int = 0
    exception: int | None = None


def bytes_of_bits(count: int) -> int:
    """The bytes that hold so many bits."""
    return -(-count // BITS_IN_BYTE)


def sizes(request: Request) -> tuple[int, int]:
    """Bytes of a request and of its longest good answer, function code included."""
    function, count = request.function, request.quantity
    values = bytes_of_bits(count) if function in (*BIT_READS, WRITE_COILS) else BYTES_IN_WORD * count
    if function in BLOCK_WRITES:
        return 1 + BLOCK_HEAD_SIZE + values, 1 + HEAD_SIZE
    of_file = 1 + FILE_HEAD_SIZE
    special = {
        READ_STATUS: (1, 2),
        READ_FILE: (of_file, 4 + values),
        WRITE_FILE: (of_file + values, of_file + values),
        IDENTIFY: (HEAD_SIZE, IDENTITY_HEAD_SIZE + values),
        READ_QUEUE: (3, 1 + QUEUE_HEAD_SIZE + BYTES_IN_WORD * (Space.QUEUE.most - 1)),
        WRITE_AND_READ: (1 + BOTH_HEAD_SIZE + BYTES_IN_WORD * len(request.words), 2 + values),
    }
    if function in special:
        return special[function]
    more = function == MASK_REGISTER or (function == WRITE_REGISTER and request.space is Space.ENRON)
    whole = 1 + HEAD_SIZE + (BYTES_IN_WORD if more else 0)
    return whole, 2 + values if request.reads else whole


def fits(request: Request, reply: Reply) -> bool:
    """Whether an answer may be the one to a request, as far as its function, length and address tell."""
    if reply.function != request.function:
        return False
    if reply.exception is not None:
        return True
    return len(reply.words) == request.quantity if request.fetches else reply.address == request.address


def verify(request: Request, reply: Reply, *, unit: int, protocol: Protocol) -> tuple[int, ...]:
    """The words of a reply that fits; ExceptionAnswer, PartialWrite or WrongAnswer otherwise."""
    if reply.exception is not None:
        found = protocol.exception(reply.exception)
        function, address, code = request.function, request.address, reply.exception
        raise ExceptionAnswer(
            unit=unit, function=function, address=address, code=code, name=found.name, meaning=found.meaning
        )
    if reply.function == request.function and request.fetches and len(reply.words) == request.quantity:
        return reply.words
    where = spelled_address(request.function, request.address)
    asked = f"unit {unit}, function {request.function:02d}, address {where}"
    if reply.function != request.function:
        message = f"{asked}: the answer is to function {reply.function:02d}"
        raise WrongAnswer(message)
    if request.fetches:
        message = f"{asked}: {len(reply.words)} values came where {request.quantity} were asked for"
        if request.space is Space.ENRON:
            message += ": in space enron each register is two words (four bytes); is this a holding register?"
        raise WrongAnswer(message)
    _verify_echo(request, reply, unit=unit, asked=asked)
    return reply.words


def _verify_echo(request: Request, reply: Reply, *, unit: int, asked: str) -> None:
    if reply.address != request.address:
        message = f"{asked}: the answer names address {spelled_address(reply.function, reply.address)}"
        raise WrongAnswer(message)
    if request.function in BLOCK_WRITES:
        if reply.quantity < len(request.words):
            raise PartialWrite(unit=unit, address=request.address, sent=len(request.words), written=reply.quantity)
        if reply.quantity > len(request.words):
            message = f"{asked}: {reply.quantity} values confirmed where {len(request.words)} were sent"
            raise WrongAnswer(message)
    elif reply.words != request.words:
        message = f"{asked}: sent {list(request.words)}, the answer echoes {list(reply.words)}"
        raise WrongAnswer(message)
