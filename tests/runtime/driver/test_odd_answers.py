"""Flags whose unnamed bits are set, texts with NUL, exceptions of code 0, refusals that a good answer takes back."""

import asyncio
from collections.abc import Callable
from typing import Any

import pytest

from regscribe import checks, lower, source
from regscribe.simulate.device.device import SimulatedDevice
from regscribe_runtime import ExceptionAnswer, NotDecodable, ValueRefused
from regscribe_runtime.link.locks import AsyncTurns
from regscribe_runtime.values.protocol import Protocol
from regscribe_runtime.wire import pdu
from regscribe_runtime.wire.requests import Request, verify

MAP = """
format: 1
map: {id: test/odd, title: Odd, maker: Test, class_prefix: Odd}
manual: {title: Manual, number: "1"}
models: {A: {}}
decimals: {d: {register: point}}
groups:
  - id: all
    name: All
    source: "1"
    each: {access: rw, type: uint16}
    registers:
      - {at: 0, name: Status, flags: {0: heating, 3: alarm}}
      - {at: 1, name: Wide, type: uint32, word_order: little, flags: {0: heating, 31: alarm}}
      - {at: 3, name: Signed, type: int16, flags: {0: heating, 3: alarm}}
      - {at: 4, name: Long, type: uint64, flags: {0: heating, 63: alarm}}
      - {at: 8, name: Parts, fields: {zone: {bits: 0..3}}}
      - {at: 10, name: Label, type: string, length: 4}
      - {at: 20, name: Point, range: 0..3}
      - {at: 21, name: First, decimals: d}
      - {at: 22, name: Second, decimals: d}
"""


@pytest.fixture
def device(build: Callable[[str], Any], direct: Any) -> Any:
    """A driver on a simulated device."""
    built = build(MAP)
    return built.driver("A")(direct(SimulatedDevice(built.map, "A", unit=1)), unit=1)


@pytest.mark.parametrize(
    ("path", "held", "left"),
    [
        ("status", (0x8041,), (0x8048,)),
        ("wide", (0x0041, 0x4000), (0x0040, 0xC000)),
        ("signed", (0x8041,), (0x8048,)),
        ("long", (0x4000, 0, 0, 0x0041), (0xC000, 0, 0, 0x0040)),
    ],
)
def test_bits_without_a_name_survive_a_change(
    path: str, held: tuple[int, ...], left: tuple[int, ...], device: Any
) -> None:
    bound = getattr(device, path)
    bound.write_raw(held)
    flags = bound.register.value_type.make

    written = bound.change(lambda value: (value | flags.ALARM) & ~flags.HEATING)

    assert bound.read_raw() == left
    assert written == bound.read()
    bound.write_raw(held)
    bound.change(lambda _: flags.ALARM)
    assert bound.read_raw() == left


def test_a_new_bit_without_a_name_is_refused(device: Any) -> None:
    device.status.write_raw((0x8041,))

    with pytest.raises(ValueRefused, match="0x2"):
        device.status.change(lambda value: value | 2)
    with pytest.raises(ValueRefused, match="0x40"):
        device.status.write(0x40)
    assert device.status.read_raw() == (0x8041,)


def test_parts_of_a_word_are_changed_beside_bits_without_a_name(device: Any) -> None:
    device.parts.write_raw((0xF0F1,))

    device.parts.change(lambda value: value.replace(zone=7))

    assert device.parts.read_raw() == (0xF0F7,)


def test_bits_survive_in_the_asynchronous_driver(build: Callable[[str], Any], direct: Any) -> None:
    built = build(MAP)

    class Awaited(direct):  # type: ignore[misc] # a class that a fixture gives
        async def call(self, unit: int, request: Request) -> Any:
            return super().call(unit, request)

    link = Awaited(SimulatedDevice(built.map, "A", unit=1))
    link.lock = AsyncTurns()
    device = built.module.AsyncOddA(link, unit=1)

    async def talk() -> tuple[int, ...]:
        await device.status.write_raw((0x8041,))
        await device.status.change(lambda value: value | 8)
        words: tuple[int, ...] = await device.status.read_raw()
        return words

    assert asyncio.run(talk()) == (0x8049,)


@pytest.mark.parametrize(
    ("words", "text"),
    [
        ((0x4142, 0x0043, 0x4445, 0x4647), "AB"),
        ((0x4100, 0xFFFF, 0xFFFF, 0xFFFF), "A"),
        ((0x0041, 0x4142, 0x4142, 0x4142), ""),
        ((0x4120, 0x0041, 0x4142, 0x4142), "A"),
        ((0x4142, 0x4344, 0x4546, 0x4748), "ABCDEFGH"),
    ],
)
def test_a_text_ends_at_the_first_nul(words: tuple[int, ...], text: str, device: Any) -> None:
    device.label.write_raw(words)

    assert device.label.read() == text
    assert device.link.device.peek("label") == text


def test_what_is_no_ascii_before_the_nul_is_no_text(device: Any) -> None:
    device.label.write_raw((0x41C3, 0x0000, 0, 0))
    with pytest.raises(NotDecodable):
        device.label.read()


def test_a_text_with_nul_is_not_written(device: Any) -> None:
    with pytest.raises(ValueRefused, match="NUL"):
        device.label.write("A\0B")


@pytest.mark.parametrize("code", [0, 1, 4, 255])
def test_an_exception_is_reported_with_the_code_that_came(code: int) -> None:
    request = Request(3, 0, 1)

    with pytest.raises(ExceptionAnswer) as caught:
        verify(request, pdu.decode_reply(request, bytes([0x83, code])), unit=1, protocol=Protocol())

    assert caught.value.code == code
    assert f"exception {code:02d}" in str(caught.value)


def test_a_good_answer_ends_the_memory_of_a_refusal(device: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    device.link.device.poke("point", 1)
    device.link.device.poke("first", 1.5)
    answer = device.link.device.handle
    refuse = True

    def handle(asked: bytes) -> bytes | None:
        address, count = int.from_bytes(asked[1:3], "big"), int.from_bytes(asked[3:5], "big")
        hit = asked[0] == 3 and address <= 20 < address + count
        return b"\x83\x02" if hit and refuse else answer(asked)

    monkeypatch.setattr(device.link.device, "handle", handle)
    values = device.read(device.first, device.point).entries
    assert isinstance(values["first"], Exception)
    refuse = False

    assert device.point.read() == 1
    assert device.read(device.first, device.point)["first"] == 1.5


@pytest.mark.parametrize("after", [0, 1])
def test_what_was_read_before_is_asked_for_again_by_the_next_read(
    after: int, device: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    device.link.device.poke("point", 1)
    device.link.device.poke("first", 1.5)
    answer = device.link.device.handle
    refused = [False] * (1 + after) + [True] * 2  # of all together, and alone

    def handle(asked: bytes) -> bytes | None:
        address, count = int.from_bytes(asked[1:3], "big"), int.from_bytes(asked[3:5], "big")
        hit = asked[0] == 3 and address <= 20 < address + count and refused and refused.pop(0)
        return b"\x83\x02" if hit else answer(asked)

    monkeypatch.setattr(device.link.device, "handle", handle)
    for _ in range(1 + after):
        device.read(device.first, device.second)

    assert not refused
    assert device.read(device.first, device.second)["first"] == 1.5


def test_what_was_never_read_is_left_out_until_that_expires(device: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    answer = device.link.device.handle

    def handle(asked: bytes) -> bytes | None:
        address, count = int.from_bytes(asked[1:3], "big"), int.from_bytes(asked[3:5], "big")
        return b"\x83\x02" if address <= 20 < address + count else answer(asked)

    monkeypatch.setattr(device.link.device, "handle", handle)
    device.read(device.first, device.second)
    device.link.log.clear()

    assert isinstance(device.read(device.first, device.second).entries["first"], Exception)
    assert all(one.address > 20 for one in device.link.log)


def test_configure_keeps_bits_without_a_name_that_the_device_has_set(device: Any) -> None:
    device.status.write_raw((0x8041,))
    flags = device.status.register.value_type.make

    report = device.configure({"status": flags(0x8048)})

    assert (report.written, device.status.read_raw()) == (("status",), (0x8048,))
    assert device.configure({"status": flags(0x8048)}).written == ()
    with pytest.raises(ValueRefused, match="0x2 "):
        device.configure({"status": flags(0x804A)})
    device.configure({"status": flags.ALARM})
    assert device.status.read_raw() == (0x0008,)


def test_addresses_that_a_notation_prints_are_warned_of() -> None:
    def rules(at: str, offset: str = "40001") -> list[str]:
        text = MAP.replace("decimals: {d: {register: point}}\n", "").replace(
            "groups:", f"notations: [{{name: n, space: holding, offset: {offset}}}]\ngroups:", 1
        )
        start = text.index("      - {at: 0,")
        text = f"{text[:start]}{at}"
        document, _ = source.parse(text, name="maps/test/odd.yaml")
        assert document is not None
        register_map, found = lower.lower(document)
        assert register_map is not None, found
        return [one.message for one in checks.check(register_map) if one.rule == "RS0636"]

    both = "      - {at: 40001, name: A}\n      - {at: 40005, name: B}\n"
    assert ["40001" in one and "80002" in one for one in rules(both)] == [True]
    assert rules("      - {at: 0, name: A}\n      - {at: 40005, name: B}\n") == []
    assert len(rules(f"      - {{at: 0, name: Z}}\n{both}")) == 1
    assert rules("      - {at: 4057, name: A}\n", "1") == []
    assert rules("      - {at: 4057, name: A}\n", "40001") == []


UNITS = """\
format: 1
map: {id: test/units, title: Units, maker: Nobody, class_prefix: Units}
manual: {title: None}
models: {One: {}}
units: {level: [{when: {kind: 1}, symbol: °C}, {when: {point: 1}, symbol: K}, {symbol: °F}]}
groups:
  - id: main
    name: Main
    source: "1"
    each: {access: rw}
    registers:
      - {at: 0, name: Kind}
      - {at: 1, name: Point, sentinels: {65535: none}}
      - {at: 2, name: Value, unit: level}
"""


def test_a_unit_is_told_where_a_register_in_fault_decides_nothing(talk: Callable[..., Any]) -> None:
    assert talk(UNITS, {0: 1, 1: 0xFFFF}).unit("value") == "°C"
    with pytest.raises(NotDecodable, match="value: its meaning depends on point"):
        talk(UNITS, {0: 0, 1: 0xFFFF}).unit("value")
