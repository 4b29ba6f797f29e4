"""Decode a block, against struct and against pymodbus."""

import struct
from collections.abc import Iterator
from fractions import Fraction

from measure import Row, at_most, milliseconds, paired

from regscribe_runtime import Conversion, ReadOnly, WireType, always, integer, number, word
from regscribe_runtime.operations.prepared_read import make_ready
from regscribe_runtime.operations.session import Session
from regscribe_runtime.values.protocol import Protocol

COUNT = 1000
READS = 100


def decoding() -> Iterator[Row]:
    """1,000 words: half whole numbers, half with one decimal."""
    plain = word(WireType.INT16)
    tenths = always(Conversion(Fraction("0.1")))
    registers = [
        ReadOnly(at, plain, number, scale=tenths) if at % 2 else ReadOnly(at, plain, integer) for at in range(COUNT)
    ]
    for register in registers:
        register.path = f"parameter_{register.at}"
    known = {register.path: register for register in registers}
    session = Session(unit=1, protocol=Protocol(read_words=COUNT), registers=known, commands={}, givens={})
    (block,) = make_ready(session, registers, fresh=True, unknown={}).blocks
    words = tuple(range(COUNT))

    def bare() -> list[float]:
        numbers = struct.unpack(f">{COUNT}h", struct.pack(f">{COUNT}H", *words))
        return [value / 10 if at % 2 else value for at, value in enumerate(numbers)]

    assert list(block.decode(words).values()) == bare()
    ours, theirs = paired(lambda: block.decode(words), bare, runs=50)
    yield at_most(
        "decode 1,000 registers (struct.unpack and scaling)",
        milliseconds(ours),
        milliseconds(theirs),
        ours / theirs,
        1.3,
    )
