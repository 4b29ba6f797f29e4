"""Blocks are found on each device: a chain is walked once, what it lacks is named, and nothing else is read for it."""

from typing import Any

import pytest

from regscribe_runtime import (
    BrokenChain,
    Chain,
    Command,
    CommandStep,
    NotPresent,
    Protocol,
    ReadOnly,
    ReadWrite,
    RegisterBlock,
    ValueRefused,
    WireType,
    integer,
    word,
)
from regscribe_runtime.errors import ExceptionAnswer
from regscribe_runtime.operations import tasks
from regscribe_runtime.operations.session import Session
from regscribe_runtime.wire.requests import Reply, Request

CHAIN = Chain("sunspec", at=(40000, 0, 50000), marker=(0x5375, 0x6E53))
BLOCKS = (
    RegisterBlock("inverter", chain=CHAIN, ids=(101, 103)),
    RegisterBlock("second", chain=CHAIN, ids=(160,), number=2),
    RegisterBlock("fixed", given="base"),
)
WORD = word(WireType.UINT16)
START = 40000


class Sun:
    power = ReadOnly(2, WORD, integer, block="inverter")
    limit = ReadWrite(5, WORD, integer, block="inverter")
    string = ReadOnly(3, WORD, integer, block="second")
    plain = ReadOnly(7, WORD, integer)
    fixed = ReadOnly(1, WORD, integer, block="fixed")


REGISTERS = {one.id: one for one in (Sun.power, Sun.limit, Sun.string, Sun.plain, Sun.fixed)}


class Unit:
    """A device of words by address, which refuses all others; `asked` are the addresses and counts of its reads."""

    def __init__(self, words: dict[int, int]) -> None:
        self.words = {7: 70, 301: 30} | words
        self.asked: list[tuple[int, int]] = []
        self.session = Session(
            unit=1, protocol=Protocol(absent=2), registers=REGISTERS, commands={}, givens={"base": 300}, blocks=BLOCKS
        )

    def run(self, task: Any) -> Any:
        operation = task(self.session)
        try:
            asked = next(operation)
            while True:
                asked = operation.send(self.answer(asked) if isinstance(asked, Request) else None)
        except StopIteration as done:
            return done.value

    def answer(self, request: Request) -> Reply:
        addresses = range(request.address, request.address + request.quantity)
        if not request.reads:
            self.words |= dict(zip(addresses, request.words, strict=True))
            return Reply(request.function, request.words, request.address, request.quantity)
        self.asked.append((request.address, request.quantity))
        if not set(addresses) <= self.words.keys():
            return Reply(request.function, exception=2)
        return Reply(request.function, tuple(map(self.words.__getitem__, addresses)))


def chain(*blocks: tuple[int, list[int]], start: int = START, end: bool = True) -> dict[int, int]:
    words = [*CHAIN.marker]
    for identity, held in blocks:
        words += [identity, len(held), *held]
    words += [0xFFFF, 0] if end else []
    return dict(enumerate(words, start))


def test_a_block_is_read_where_the_chain_has_it_and_the_chain_is_walked_once() -> None:
    unit = Unit(chain((1, [0] * 3), (103, [7, 0, 0, 9])))

    assert unit.run(tasks.read(Sun.power, None)) == 7
    assert unit.asked == [(40000, 2), (40002, 2), (40007, 2), (40013, 2), (40009, 1)]
    unit.asked.clear()
    assert unit.run(tasks.read(Sun.power, None)) == 7
    assert unit.run(tasks.read(Sun.limit, None)) == 9
    assert unit.asked == [(40009, 1), (40012, 1)]


def test_a_new_connection_walks_it_again() -> None:
    unit = Unit(chain((103, [7])))
    unit.run(tasks.read(Sun.power, None))
    for address in chain((103, [7])):
        del unit.words[address]
    unit.words |= chain((9, [0] * 10), (101, [8]), start=0)
    unit.session.at_epoch(1)

    assert unit.run(tasks.read(Sun.power, None)) == 8


def test_registers_outside_do_not_wait_for_a_chain() -> None:
    unit = Unit({})

    assert unit.run(tasks.read(Sun.plain, None)) == 70
    assert unit.run(tasks.read(Sun.fixed, None)) == 30
    assert unit.asked == [(7, 1), (301, 1)]


def test_what_the_chain_lacks_is_not_present_with_the_ids_that_it_has() -> None:
    unit = Unit(chain((1, [0]), (160, [0, 1])))

    with pytest.raises(NotPresent, match=r"power: .* block inverter \(id 101 or 103\) is in the chain; .* is 1, 160$"):
        unit.run(tasks.read(Sun.power, None))
    with pytest.raises(NotPresent, match=r"block second \(id 160, number 2\) is in the chain"):
        unit.run(tasks.read(Sun.string, None))
    with pytest.raises(NotPresent):
        unit.run(tasks.write(Sun.limit, 1))
    with pytest.raises(ValueRefused, match="limit: it exists only while block inverter"):
        unit.run(tasks.configure({"limit": 1}))
    command = Command(CommandStep(6, 5, (1,), block="inverter"))
    with pytest.raises(NotPresent):
        unit.run(tasks.run(command, confirm=False))


def test_nothing_beyond_the_length_of_a_block_is_read() -> None:
    unit = Unit(chain((103, [7, 0, 0]), (160, [9])))

    found = unit.run(tasks.read_many([Sun.power, Sun.limit]))
    assert found["power"] == 7
    with pytest.raises(NotPresent, match=r"limit: .* block inverter has 4 words or more; .* at 40002 is 3"):
        _ = found["limit"]
    assert max(address + count for address, count in unit.asked) == 40012  # the end mark


def test_a_snapshot_has_what_is_there_in_one_request_for_each_block() -> None:
    unit = Unit(chain((103, [7, 0, 0, 9]), (160, [1, 2]), (160, [3, 4])))
    unit.run(tasks.read_many(list(REGISTERS.values())))
    unit.asked.clear()

    found = unit.run(tasks.read_many(list(REGISTERS.values())))
    assert dict(found) == {"power": 7, "limit": 9, "string": 4, "plain": 70, "fixed": 30}
    assert (40004, 4) in unit.asked


def test_writes_and_commands_go_to_the_block() -> None:
    unit = Unit(chain((103, [7, 0, 0, 9])))

    unit.run(tasks.write(Sun.limit, 5))
    assert unit.words[40007] == 5
    unit.run(tasks.configure({"limit": 6}))
    assert unit.words[40007] == 6
    unit.run(tasks.run(Command(CommandStep(6, 5, (3,), block="inverter")), confirm=False))
    assert unit.words[40007] == 3


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        ({}, r"marker 5375 6E53 does not stand at 40000 \(exception 02\), 0 \(exception 02\), 50000"),
        ({0: 1, 1: 2}, r"does not stand at .* 0 \(0001 0002\)"),
        (chain((1, [0] * 4), end=False), r"behind 1 blocks \(ids 1\) there is no header at 40008"),
        (chain(end=False) | {40002: 9, 40003: 0xFFFF}, r"next header would stand at 105539, beyond all addresses"),
        (dict.fromkeys(range(40002, 65536), 0) | chain(end=False), "more than 256 headers"),
    ],
)
def test_a_broken_chain_says_what_is_wrong_and_spoils_nothing_else(words: dict[int, int], reason: str) -> None:
    unit = Unit(words)

    with pytest.raises(BrokenChain, match=f"chain sunspec: .*{reason}"):
        unit.run(tasks.read(Sun.power, None))
    found = unit.run(tasks.read_many([Sun.power, Sun.plain]))
    assert found["plain"] == 70
    with pytest.raises(BrokenChain):
        _ = found["power"]


def test_a_gateway_without_an_answer_says_nothing_about_the_chain() -> None:
    unit = Unit({})
    unit.answer = lambda request: Reply(request.function, exception=11)  # type: ignore[method-assign] # a gateway

    with pytest.raises(ExceptionAnswer):
        unit.run(tasks.read(Sun.power, None))


def test_the_device_tells_all_its_blocks() -> None:
    unit = Unit(chain((1, [0]), (64001, [])))

    found = unit.run(tasks.headers())
    assert [(one.id, one.base, one.length) for one in found["sunspec"]] == [(1, 40002, 1), (64001, 40005, 0)]
