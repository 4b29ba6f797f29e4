"""Views by some functions only: what is read is read where it may be, and a write goes where a write may go."""

from collections.abc import Callable
from typing import Any

import pytest

from regscribe.cli.commands import write
from regscribe.simulate.device.device import SimulatedDevice
from regscribe.tools.live.dry_run import dry
from regscribe.tools.live.errors import TargetError
from regscribe_runtime import NotWritten, ReadBackDiffers
from regscribe_runtime.driver.broadcast import request_for
from regscribe_runtime.driver.identify import Known, identity_of

MAP = """
format: 1
map: {id: test/split, title: Split, maker: Test, class_prefix: Split}
manual: {title: Manual, number: "1"}
models: {A: {}}
protocol: {functions: [3, 6, 16]}
views:
  split:
    base: {type: int16, functions: [3]}
    written: {offset: 100, type: int16, functions: [6, 16]}
  wide:
    base: {type: int32, functions: [16], stride: 2}
    shown: {offset: 400, stride: 2, type: int32, word_order: little, functions: [3], preferred: true}
  coarse:
    base: {type: int16, factor: 0.1, rounding: half_up, functions: [3]}
    fine: {offset: 200, type: int16, functions: [6]}
groups:
  - id: all
    name: All
    source: "1"
    each: {access: rw}
    registers:
      - {at: 5, name: Setpoint, views: split, decimals: 1, persistence: eeprom}
      - {at: 150, name: Total, views: wide}
      - {at: 20, name: Level, views: coarse}
      - {at: 30, name: Many, type: uint16, functions: [3, 16]}
      - {at: 31, name: One, type: uint16, functions: [3, 6]}
      - {at: 40, name: Apart, type: int16, decimals: 1, persistence: eeprom, write_at: 145}
"""


@pytest.fixture
def device(build: Callable[[str], Any], direct: Any) -> Any:
    """A driver on a simulated device, and the requests between them."""
    built = build(MAP)
    simulated = SimulatedDevice(built.map, "A", unit=1)
    return built.driver("A")(direct(simulated), unit=1)


def _sent(device: Any) -> list[tuple[int, int, tuple[int, ...]]]:
    return [(one.function, one.address, one.words) for one in device.link.log]


def test_a_write_goes_to_the_view_that_writes_and_is_read_back_in_the_one_that_reads(device: Any) -> None:
    device.setpoint.write(15.5)

    assert _sent(device) == [(3, 5, ()), (6, 105, (155,)), (3, 5, ())]
    assert device.setpoint.read() == 15.5
    assert _sent(device)[-1] == (3, 5, ())


def test_a_register_with_a_write_address_is_read_back_where_it_is_read(device: Any) -> None:
    device.apart.write(15.5)
    device.apart.write(15.5)
    device.configure({"apart": -1})

    assert _sent(device)[:4] == [(3, 40, ()), (6, 145, (155,)), (3, 40, ()), (3, 40, ())]
    assert _sent(device)[4:] == [(3, 40, ()), (6, 145, (0xFFF6,)), (3, 40, ())]
    assert device.link.device.peek("apart") == -1


def test_what_was_not_sent_reads_back_where_the_register_is_read(device: Any) -> None:
    simulated, link = device.link.device, dry(device)

    device.apart.write(15.5)

    assert [(one.function, one.address) for one in link.written] == [(6, 145)]
    assert (device.apart.read(), simulated.peek("apart")) == (15.5, 0)


def test_an_equal_value_is_not_written_again_although_it_is_read_elsewhere(device: Any) -> None:
    device.setpoint.write(15.5)
    device.link.log.clear()

    device.setpoint.write(15.5)

    assert _sent(device) == [(3, 5, ())]


def test_views_of_other_orders_are_told_apart(device: Any) -> None:
    device.total.write(0x00010002)

    assert _sent(device) == [(16, 300, (1, 2)), (3, 700, ())]
    assert device.total.read_raw() == (2, 1)
    assert device.total.read() == 0x00010002


def test_a_coarser_view_is_compared_as_finely_as_it_can_tell(device: Any) -> None:
    device.level.write(15)

    assert _sent(device) == [(6, 220, (15,)), (3, 20, ())]
    device.link.device.poke("level", 99)
    assert device.level.read() == 100


def test_what_is_held_elsewhere_is_noticed(device: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(type(device.link.device.state), "store", lambda *_: None)

    with pytest.raises(ReadBackDiffers) as caught:
        device.setpoint.write(15.5)

    assert (caught.value.value, caught.value.held) == (15.5, 0.0)


def test_a_lost_answer_is_looked_for_in_the_view_that_reads(build: Callable[[str], Any], direct: Any) -> None:
    built = build(MAP)
    simulated = SimulatedDevice(built.map, "A", unit=1)
    device = built.driver("A")(direct(simulated, fate={1: "lost"}, writes_only=True), unit=1)

    device.setpoint.write(15.5)
    assert device.setpoint.read() == 15.5

    device = built.driver("A")(direct(simulated, fate={1: "missed"}, writes_only=True), unit=1)
    with pytest.raises(NotWritten):
        device.setpoint.write(16)


def test_a_view_is_refused_for_what_its_functions_do_not_do(device: Any) -> None:
    with pytest.raises(ValueError, match=r"the base view of setpoint cannot be written .*; written can"):
        device.setpoint.write(15, view="base")
    with pytest.raises(ValueError, match=r"the written view of setpoint cannot be read .*; base can"):
        device.setpoint.read(view="written")
    with pytest.raises(ValueError, match="cannot be written"):
        device.setpoint.write_raw((1,), view="base")
    assert not device.link.log


def test_the_command_line_tells_which_views_can_be_written(device: Any) -> None:
    with pytest.raises(TargetError, match=r"the base view of setpoint cannot be written .*; written can"):
        write._writable(type(device), "setpoint", "1", "base")


@pytest.mark.parametrize(
    ("name", "function", "address"), [("setpoint", 6, 105), ("total", 16, 300), ("many", 16, 30), ("one", 6, 31)]
)
def test_a_broadcast_goes_where_a_write_goes(
    name: str, function: int, address: int, build: Callable[[str], Any]
) -> None:
    driver = build(MAP.replace("[3, 6, 16]}\nviews", "[3, 6, 16], broadcast: [6, 16]}\nviews")).driver("A")
    state: dict[str, Any] = {}

    request = request_for(
        driver.registers[name], 1, {"all": driver}, view=None, state=state, givens=state, confirm=False
    )

    assert (request.function, request.address) == (function, address)


def test_only_the_function_that_the_view_allows_is_used(device: Any) -> None:
    device.many.write(1, verify=False)
    device.one.write(2, verify=False)

    assert _sent(device) == [(16, 30, (1,)), (6, 31, (2,))]


def test_configure_writes_and_verifies_each_in_its_own_view(device: Any) -> None:
    report = device.configure({"setpoint": 20, "total": 7, "level": 30, "many": 1, "one": 2})

    writes = {(function, address): words for function, address, words in _sent(device) if words}
    assert writes == {(6, 105): (200,), (16, 300): (0, 7), (6, 220): (30,), (16, 30): (1,), (6, 31): (2,)}
    assert set(report.written) == {"setpoint", "total", "level", "many", "one"}
    assert device.configure({"setpoint": 20, "total": 7}).written == ()


def test_a_snapshot_reads_only_what_may_be_read(device: Any) -> None:
    device.link.device.poke("total", 3)

    assert device.read()["total"] == 3
    asked = {(function, address) for function, address, _ in _sent(device)}
    assert asked <= {(3, 5), (3, 20), (3, 30), (3, 40), (3, 700)}


def test_change_reads_in_one_view_and_writes_in_the_other(device: Any) -> None:
    device.link.device.poke("setpoint", 1.5)

    assert device.setpoint.change(lambda value: value + 1) == 2.5
    assert (6, 105, (25,)) in _sent(device)


@pytest.mark.parametrize(
    "registers",
    [
        "- {at: 1, name: A, type: int16, functions: [3]}",
        "- {at: 1, name: A, type: int16, functions: [6]}",
        "- {at: 1, name: A, type: int32, functions: [3, 6]}",
        "- {at: 1, name: A, type: int16, functions: [1, 3, 6]}",
        "- {at: 1, name: A, space: coil, functions: [3, 6]}",
    ],
)
def test_a_register_that_no_function_reads_or_writes_is_refused(registers: str, build: Callable[[str], Any]) -> None:
    head = MAP[: MAP.index("    registers:")].replace("[3, 6, 16]", "[1, 3, 5, 6, 16]")
    with pytest.raises(AssertionError, match=r"RS0406|RS0635"):
        build(f"{head}    registers:\n      {registers}\n")


def test_two_words_are_not_written_one_by_one(build: Callable[[str], Any]) -> None:
    with pytest.raises(AssertionError, match="RS0406"):
        build(
            MAP.replace("[3, 6, 16]}\nviews", "[3, 6]}\nviews").split("    registers:")[0]
            + "    registers:\n      - {at: 1, name: A, type: int32}\n"
        )


SECOND = """
format: 1
map: {id: test/second, title: Second, maker: Test, class_prefix: Second}
manual: {title: Manual, number: "1"}
models: {A: {}}
protocol: {functions: [3, 6, 16]}
views:
  split:
    base: {type: int16, functions: [6, 16]}
    shown: {offset: 100, type: int16, functions: [3]}
identify:
  - {models: [A], when: {code: 7}}
groups:
  - id: all
    name: All
    source: "1"
    each: {access: rw, type: int16}
    registers:
      - {at: 5, name: Plain}
      - {at: 6, name: Both, functions: [3, 16]}
      - {at: 7, name: One, functions: [3, 6], aliases: [60]}
      - {at: 8, name: Hidden, access: w, functions: [6]}
      - {at: 9, name: Code, views: split}
      - {at: 11, name: Next}
      - {at: 12, name: Last, views: split}
"""


@pytest.mark.parametrize(
    ("asked", "answer"),
    [
        ("06 0006 0001", "86 02"),
        ("10 0006 0001 02 0001", "10 0006 0001"),
        ("10 0005 0003 06 0001 0001 0001", "90 02"),
        ("10 0005 0002 04 0001 0001", "10 0005 0002"),
        ("10 003C 0001 02 0001", "90 02"),
        ("06 003C 0001", "06 003C 0001"),
        ("03 0006 0002", "03 04 0000 0000"),
        ("03 0006 0003", "83 02"),
        ("03 0009 0001", "83 02"),
        ("03 000B 0002", "83 02"),
    ],
)
def test_the_simulator_refuses_a_function_wherever_a_request_meets_its_view(
    asked: str, answer: str, build: Callable[[str], Any]
) -> None:
    simulated = SimulatedDevice(build(SECOND).map, "A", unit=1)

    assert simulated.handle(bytes.fromhex(asked)) == bytes.fromhex(answer)


def test_a_device_is_asked_what_it_is_where_that_may_be_read(build: Callable[[str], Any], direct: Any) -> None:
    built = build(SECOND)
    simulated = SimulatedDevice(built.map, "A", unit=1)
    simulated.poke("code", 7)
    device = built.driver("A")(direct(simulated), unit=1)
    known = Known("test/second", "A", built.module.SecondA, built.module.AsyncSecondA)

    assert device.run(identity_of(known)).models == (known,)
    assert _sent(device) == [(3, 109, ())]


def test_a_view_that_the_device_cannot_serve_is_refused_unless_its_functions_say_so(
    build: Callable[[str], Any],
) -> None:
    text = SECOND.replace("[3, 6, 16]}\nviews", "[3, 6]}\nviews")
    views = "views: {two: {base: {type: int16}, wide: {offset: 100, type: int32, stride: 2}}}\n"
    head = text[: text.index("views:")] + views + text[text.index("groups:") : text.index("      - {at: 5")]
    text = f"{head}      - {{at: 5, name: A, views: two}}\n"

    with pytest.raises(AssertionError, match=r"RS0406.*written in space holding"):
        build(text)
    assert build(text.replace("stride: 2", "stride: 2, functions: [3]"))


def test_a_frame_by_a_function_that_its_view_does_not_allow_is_refused(build: Callable[[str], Any]) -> None:
    frame = "examples:\n  - {source: '2', frame: '01 06 00 06 00 01 A8 0B', function: 6, unit: 1, address: 6, count: 1,"

    with pytest.raises(AssertionError, match=r"RS0448.*by functions \[3, 16\], not 06"):
        build(f"{SECOND}{frame} writes: {{both: 1}}}}\n")
