"""Decode a block; read one register through a driver; against struct and against the bare pymodbus client."""

import struct
from collections.abc import Iterator

from measure import Row, at_least, at_most, milliseconds, paired
from pymodbus.client import ModbusTcpClient
from synthetic import yaml_map

from regscribe import lower, source
from regscribe.runtime import INT16, Conversion, Device, ReadOnly, integer, number, word
from regscribe.runtime.ready import make_ready
from regscribe.runtime.session import Protocol, Session
from regscribe.simulate import simulate

COUNT = 1000
READS = 100


def decoding() -> Iterator[Row]:
    """1,000 words: half whole numbers, half with one decimal."""
    tenths = (((), Conversion(multiply="0.1")),)
    registers = [
        ReadOnly(at, word(INT16), number, scale=tenths) if at % 2 else ReadOnly(at, word(INT16), integer)
        for at in range(COUNT)
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

    def pymodbus() -> list[object]:
        convert, kind = ModbusTcpClient.convert_from_registers, ModbusTcpClient.DATATYPE.INT16
        return [convert([value], kind) for value in words]

    assert list(block.decode(words).values()) == bare()
    ours, theirs = paired(lambda: block.decode(words), bare, runs=50)
    yield at_most(
        "decode 1,000 registers (struct.unpack and scaling)", milliseconds(ours), milliseconds(theirs), ours / theirs, 2
    )
    ours, theirs = paired(lambda: block.decode(words), pymodbus, runs=20)
    yield at_least(
        "decode 1,000 registers (pymodbus convert_from_registers)",
        milliseconds(ours),
        milliseconds(theirs),
        theirs / ours,
        20,
    )


class Bench(Device):
    """Two registers of the synthetic device."""

    value = ReadOnly(2, word(INT16), integer)


def reading() -> Iterator[Row]:
    """One register over loopback TCP from the same simulated device, through the driver and through pymodbus."""
    document, _ = source.parse(yaml_map(10), name="bench")
    assert document is not None
    register_map, _ = lower.lower(document)
    assert register_map is not None
    with (
        simulate(register_map, "Unit", unit=1) as running,
        Bench.tcp(running.host, port=running.port, unit=1) as driver,
    ):
        client = ModbusTcpClient(running.host, port=running.port, retries=0)
        client.connect()

        def ours() -> None:
            for _ in range(READS):
                driver.value.read()

        def theirs() -> None:
            for _ in range(READS):
                client.read_holding_registers(2, count=1, device_id=1)

        mine, bare = paired(ours, theirs, runs=60)
        client.close()
    what = "read one register over TCP (bare pymodbus client)"
    yield at_most(what, milliseconds(mine / READS), milliseconds(bare / READS), mine / bare, 1.15)
