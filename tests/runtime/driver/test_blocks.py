"""Blocks through the whole house: a driver finds them on its simulated device, tools know where they are."""

import asyncio
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import pytest

from regscribe.export.collectd import export as collectd
from regscribe.model import Access
from regscribe.planned_model import PlannedModel
from regscribe.plugins import OptionError
from regscribe.simulate.device.device import SimulatedDevice
from regscribe.simulate.errors import SimulatorError
from regscribe.testing.simulated_read import wrong_requests
from regscribe.tools.live.decode import Decoder
from regscribe.tools.settings.take import backup
from regscribe_runtime import NotPresent, ValueRefused
from regscribe_runtime.driver.broadcast import request_for
from regscribe_runtime.driver.executor import carry_out
from regscribe_runtime.driver.identify import Known, identity_of
from regscribe_runtime.wire import pdu
from regscribe_runtime.wire.capture import CapturedFrame

MAP = """
format: 1
map: {id: test/sun, title: Sun, maker: Test, class_prefix: Sun}
manual: {title: Manual, number: "1"}
models: {A: {}}
protocol: {functions: [3, 6, 16]}
chains: {sunspec: {at: [40000, 0], marker: [0x5375, 0x6E53]}}
givens: {offset: {type: number, description: where the table begins, reason: it is set at installation}}
blocks:
  table: {base: {given: offset}}
  common: {chain: sunspec, id: 1}
  inverter: {chain: sunspec, id: [101, 103]}
  spare: {chain: sunspec, id: 101, index: 2}
decimals: {power: [{register: power_decimals}]}
groups:
  - id: common
    name: Common
    source: "1"
    block: common
    each: {access: r}
    registers:
      - {at: 0, id: model_id, name: Id}
      - {at: 2, name: Maker, type: string, length: 4}
  - id: inverter
    name: Inverter
    source: "2"
    block: inverter
    each: {access: rw}
    registers:
      - {at: 2, name: Power, decimals: power, default: 5}
      - {at: 4, name: Power Decimals, range: 0..3, default: 1}
      - {at: 8, name: Limit, range: 0..100}
  - id: spare
    name: Spare
    source: "3"
    block: spare
    each: {access: rw}
    registers: [{at: 3, name: Spare Limit}]
  - id: table
    name: Table
    source: "4"
    block: table
    each: {access: rw}
    registers:
      - {at: 0, name: Level}
      - {at: 4, name: Volume, type: uint32}
commands:
  stop: {name: Stop, steps: [{register: limit, value: 0}, {block: spare, at: 3, words: [7]}]}
"""


TABLE: dict[str, Any] = {"offset": 300}


@pytest.fixture(scope="module")
def sun(build: Callable[[str], Any]) -> Any:
    return build(MAP)


def test_the_driver_finds_the_blocks_of_a_simulated_device_wherever_its_chain_begins(sun: Any, direct: Any) -> None:
    for base in (40000, 0):
        simulated = SimulatedDevice(sun.map, "A", unit=1, givens=TABLE, bases={"sunspec": base})
        device = sun.driver("A")(direct(simulated), unit=1, **TABLE)
        simulated.poke("maker", "Acme")
        simulated.poke("power", 12.5)

        found = device.read()
        assert dict(found) == {
            "model_id": 1,
            "maker": "Acme",
            "power": 12.5,
            "power_decimals": 1,
            "limit": 0,
            "spare_limit": 0,
            "level": 0,
            "volume": 0,
        }
        assert [one.id for one in device.chain_headers()["sunspec"]] == [1, 101, 101]
        device.limit.write(40)
        device.power.write(7.5)
        device.spare_limit.write(9)
        assert [int(simulated.peek(path)) for path in ("limit", "power_decimals", "spare_limit")] == [40, 1, 9]
        device.commands.stop()
        assert [int(simulated.peek(path)) for path in ("limit", "spare_limit")] == [0, 7]


def test_headers_of_a_simulated_chain_cannot_be_written(sun: Any) -> None:
    simulated = SimulatedDevice(sun.map, "A", unit=1, givens=TABLE)

    assert simulated.handle(bytes.fromhex("06 9C 41 00 07")) == bytes.fromhex("86 02")
    assert simulated.handle(bytes.fromhex("03 9C 40 00 04")) == bytes.fromhex("03 08 53 75 6E 53 00 01 00 04")


def test_a_backup_has_the_settings_in_blocks(sun: Any, direct: Any) -> None:
    device = sun.driver("A")(direct(SimulatedDevice(sun.map, "A", unit=1, givens=TABLE)), unit=1, **TABLE)

    saved = device.run(backup(type(device))).groups
    assert saved["inverter"]["power"].value == 5
    assert saved["spare"]["spare_limit"].value == 0


def test_a_plan_has_the_requests_of_the_driver(sun: Any, direct: Any) -> None:
    link = direct(SimulatedDevice(sun.map, "A", unit=1, givens=TABLE))
    device = sun.driver("A")(link, unit=1, **TABLE)
    device.read()
    link.log.clear()
    device.read()

    planned = PlannedModel.of(sun.map, "A", {}).registers
    assert planned["power"].at == 40002 + 6 + 2
    assert [(one.address, one.quantity) for one in link.log] == [(300, 1), (304, 2), (40002, 19)]
    assert PlannedModel.of(sun.map, "A", {"sunspec": 0, "spare": 900, "table": 7}).registers["spare_limit"].at == 903


def test_decode_learns_from_a_log_where_the_blocks_are(sun: Any, direct: Any) -> None:
    simulated = SimulatedDevice(sun.map, "A", unit=1, givens=TABLE, bases={"sunspec": 0})
    link = direct(simulated)
    device = sun.driver("A")(link, unit=1, **TABLE)
    device.limit.read()
    device.commands.stop()

    decoder, said = Decoder(type(device)), []
    for request in link.log:
        sent = pdu.encode_request(request)
        for direction, frame in (("sent", sent), ("received", simulated.handle(sent) or b"")):
            decoded = decoder.feed(CapturedFrame("tcp", 1, frame, frame), direction)
            said.append((decoded.what, [item.name for item in decoded.items]))
    assert ("read holding 16", ["limit"]) in said
    assert ("write holding 16 (command stop)", ["limit"]) in said
    known = Decoder(type(device), bases={"spare": 500})
    frame = bytes.fromhex("03 01 F7 00 01")
    assert [item.name for item in known.feed(CapturedFrame("tcp", 1, frame, frame), "sent").items] == ["spare_limit"]


def test_collectd_polls_the_blocks_whose_base_is_stated(sun: Any) -> None:
    options = dict.fromkeys(("name", "unit", "with", "given", "base"), "") | {"every": "10"}
    options |= {"model": "A", "at": "10.0.0.1:502"}

    with pytest.raises(OptionError, match=r"registers stand in blocks \(common, inverter, spare, table\)"):
        collectd([sun.map], options)
    text = collectd([sun.map], options | {"base": "spare=500"}).texts[""]
    assert "RegisterBase 503" in text
    assert "limit" in text
    assert "power" not in text
    with pytest.raises(OptionError, match="--base spar=500: write NAME=ADDRESS"):
        collectd([sun.map], options | {"base": "spar=500"})


def test_a_declaration_has_the_distance_and_its_block(sun: Any) -> None:
    register = sun.driver("A").limit

    assert (register.at, register.block, register.access) == (8, "inverter", Access.READ_WRITE)


def test_a_given_tells_the_base_of_a_table(sun: Any, direct: Any) -> None:
    simulated = SimulatedDevice(sun.map, "A", unit=1, givens={"offset": 700})
    link = direct(simulated)
    device = sun.driver("A")(link, unit=1, offset=700)
    device.volume.write(70000)

    assert int(simulated.peek("volume")) == 70000
    assert [(one.address, one.quantity) for one in link.log] == [(704, 2)] * 2
    with pytest.raises(ValueError, match="offset=70000: the base of block table is a whole number from 0 to 65535"):
        sun.driver("A")(link, unit=1, offset=70000)
    beyond = sun.driver("A")(link, unit=1, offset=65531)
    with pytest.raises(NotPresent, match="volume: it exists only while its addresses end by 65535"):
        beyond.volume.read()


STRINGS = """
format: 1
map: {id: test/strings, title: Strings, maker: Test, class_prefix: Strings}
manual: {title: Manual, number: "1"}
models: {A: {}}
protocol: {functions: [3]}
chains: {sunspec: {at: 0}}
blocks: {strings: {chain: sunspec, id: 160}}
groups:
  - id: strings
    name: Strings
    source: "1"
    block: strings
    each: {access: r}
    registers:
      - {at: 2, name: Scale}
      - id: modules
        name: Module
        repeat: {from: 1, to: {block: end}, most: 9}
        stride: 3
        registers:
          - {at: 3, name: Number}
          - {at: 4, name: Volts, type: uint32}
"""


def test_an_array_has_as_many_elements_as_the_block_has_room_for(build: Any, words: Any, direct: Any) -> None:
    built, held = build(STRINGS), [160, 1 + 2 * 3 + 2, 5, 1, 0, 100, 2, 0, 200, 3, 0, 0xFFFF, 0]
    link = direct(words(dict(enumerate(held))))
    device = built.driver("A")(link, unit=1)

    assert len(device.modules) == 2
    assert [module.volts.read() for module in device.modules] == [100, 200]
    assert set(device.read().valid) == {
        "scale",
        *(f"modules[{n}].{one}" for n in (1, 2) for one in ("number", "volts")),
    }
    assert max(one.address + one.quantity for one in link.log) == 13
    with pytest.raises(NotPresent, match=r"modules\[3\].number: .* has 10 words or more; .* at 0 is 9"):
        device.modules[3].number.read()
    with pytest.raises(IndexError):
        _ = device.modules[10]
    assert len(built.driver("A").modules.element.registers) == 2


def test_a_simulated_device_has_room_for_what_stands_unnamed_at_the_end_of_the_last_element(
    build: Any, direct: Any
) -> None:
    built = build(STRINGS.replace("stride: 3", "stride: 4"))
    driver = built.driver("A")
    device = driver(direct(SimulatedDevice(built.map, "A", unit=1)), unit=1)

    assert len(device.modules) == 9
    assert "modules[9].volts" in device.read().valid
    assert wrong_requests(device, list(device.registers.values())) == []


def test_asyncio_awaits_the_count_of_elements(talk: Any) -> None:
    for held, expected in (([160, 7, *[0] * 7, 0xFFFF, 0], 2), ([7, 0, 0xFFFF, 0], 0)):
        device = talk(STRINGS, dict(enumerate(held))).other
        with pytest.raises(TypeError, match=r"await .count\(\)"):
            len(device.modules)
        assert asyncio.run(device.modules.count()) == expected


def test_a_model_is_identified_by_a_register_in_a_chain(build: Any, words: Any, direct: Any) -> None:
    built = build(STRINGS.replace("chains:", "identify: [{models: [A], when: {scale: 5}}]\nchains:"))
    known = Known("test/strings", "A", built.driver("A"), built.module.AsyncStringsA)

    def identified(held: list[int]) -> Any:
        return carry_out(identity_of(known)(SimpleNamespace(unit=1)), direct(words(dict(enumerate(held)))), 1)  # type: ignore[arg-type] # all that it asks of a session

    assert identified([7, 1, 0, 160, 1, 5, 0xFFFF, 0]).models == (known,)
    assert identified([160, 1, 6, 0xFFFF, 0]).models == ()
    lacking = identified([7, 1, 0, 0xFFFF, 0])
    assert lacking.models == ()
    assert "block strings (id 160) is in the chain" in str(lacking.evidence[0].error)


def test_a_block_is_not_written_to_all_units_at_once(sun: Any) -> None:
    driver = sun.driver("A")

    with pytest.raises(ValueRefused, match="where block inverter stands differs by unit"):
        request_for(driver.limit, 5, {"one": driver}, givens={})


CURVES = """
format: 1
map: {id: test/curves, title: Curves, maker: Test, class_prefix: Curves}
manual: {title: Manual, number: "1"}
models: {A: {}}
protocol: {functions: [3, 6, 16]}
chains: {sunspec: {at: 0}}
blocks: {volt_var: {chain: sunspec, id: 705}}
groups:
  - id: volt_var
    name: Volt-Var
    source: "1"
    block: volt_var
    each: {access: rw}
    registers:
      - {at: 2, name: Points, access: r}
      - id: curves
        name: Curve
        repeat: {from: 1, to: {block: end}, most: 3}
        stride: 17
        registers:
          - {at: 3, name: Active}
          - id: trip
            name: Trip
            repeat: {from: 1, to: points, most: 4, packed: true}
            stride: 2
            registers: [{at: 4, name: Volts}, {at: 5, name: Var}]
          - {at: 12, name: Between, type: uint32}
          - id: stop
            name: Stop
            repeat: {from: 1, to: points, most: 4, packed: true}
            stride: 1
            registers: [{at: 14, name: Hertz}]
          - {at: 18, name: Tail}
          - {at: 19, name: Last}
"""


def curve(number: int, points: int) -> list[int]:
    """The words of a curve: each value tells what it is."""
    trip = [word for point in range(1, points + 1) for word in (number * 100 + point, number * 100 + point + 50)]
    return [number, *trip, 0, number * 100, *(number * 1000 + point for point in range(1, points + 1)), number + 70, 0]


@pytest.mark.parametrize("points", [0, 1, 3, 4])
@pytest.mark.parametrize("number", [1, 3])
def test_what_stands_behind_packed_arrays_moves_up(talk: Any, points: int, number: int) -> None:
    held = [points, *(word for one in range(1, number + 1) for word in curve(one, points))]
    device = talk(CURVES, dict(enumerate([705, len(held), *held, 0xFFFF, 0])))

    found = device.driver.read().valid
    for one in range(1, number + 1):
        path = f"curves[{one}]"
        assert [found[f"{path}.{name}"] for name in ("active", "between", "tail")] == [one, one * 100, one + 70]
        for point in range(1, points + 1):
            assert found[f"{path}.trip[{point}].var"] == one * 100 + point + 50
            assert found[f"{path}.stop[{point}].hertz"] == one * 1000 + point
    assert len(found) == 1 + number * (4 + 3 * points)
    assert (len(device.driver.curves), len(device.driver.curves[1].trip)) == (number, points)
    device.driver.curves[number].tail.write(5)
    assert device.words.holds[len(held)] == 5
    assert asyncio.run(device.other.curves[number].stop.count()) == points


def test_an_element_beyond_the_count_is_not_present(talk: Any) -> None:
    held = [1, *curve(1, 1)]
    device = talk(CURVES, dict(enumerate([705, len(held), *held, 0xFFFF, 0]))).driver

    with pytest.raises(NotPresent, match=r"trip\[2\].volts: it exists only while points is at least 2; points is 1"):
        device.curves[1].trip[2].volts.read()
    with pytest.raises(NotPresent, match=r"curves\[2\].tail: .* block volt_var has 16 words or more"):
        device.curves[2].tail.read()


def test_a_simulated_device_has_the_most_elements(build: Any, direct: Any) -> None:
    built = build(CURVES)
    simulated = SimulatedDevice(built.map, "A", unit=1)
    device = built.driver("A")(direct(simulated), unit=1)
    simulated.poke("curves[3].stop[4].hertz", 50)

    assert device.points.read() == 4
    assert device.curves[3].stop[4].hertz.read() == 50
    with pytest.raises(SimulatorError, match="'points' counts elements"):
        simulated.poke("points", 2)


def test_decode_learns_the_count_from_a_log(build: Any, words: Any, direct: Any) -> None:
    built, held = build(CURVES), [1, *curve(1, 1)]
    device = words(dict(enumerate([705, len(held), *held, 0xFFFF, 0])))
    link = direct(device)
    built.driver("A")(link, unit=1).curves[1].tail.read()
    decoder, names = Decoder(built.driver("A")), []
    for request in link.log:
        sent = pdu.encode_request(request)
        for direction, frame in (("sent", sent), ("received", device.handle(sent))):
            names += [item.name for item in decoder.feed(CapturedFrame("tcp", 1, frame, frame), direction).items]

    assert names == ["points", "points", "curves[1].tail", "curves[1].tail"]


def test_a_count_that_changes_moves_what_stands_behind(talk: Any) -> None:
    def holds(points: int) -> dict[int, int]:
        held = [points, *curve(1, points)]
        return dict(enumerate([705, 20, *held, *[0] * (20 - len(held)), 0xFFFF, 0]))

    device = talk(CURVES, holds(3))
    assert device.driver.read()["curves[1].tail"] == 71
    device.words.holds = holds(1)  # somebody has set it up anew
    assert device.driver.read()["curves[1].tail"] == 71
    assert device.driver.curves[1].tail.read() == 71
    device.words.holds = holds(2)
    device.driver.curves[1].tail.write(9)
    assert device.words.holds == holds(2) | {2 + len(curve(1, 2)) - 1: 9}
    device.words.holds = holds(3)
    device.driver.configure({"curves[1].tail": 8})
    assert device.words.holds == holds(3) | {2 + len(curve(1, 3)) - 1: 8}
    device.driver.read()
    device.words.holds = holds(2)
    device.driver.configure({"curves[1].tail": 8, "curves[1].last": 7})  # both stand behind what one counter counts
    assert device.words.holds == holds(2) | {2 + len(curve(1, 2)) - 1: 8, 2 + len(curve(1, 2)): 7}
