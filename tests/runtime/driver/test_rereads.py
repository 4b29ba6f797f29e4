"""Two readings of the same words: one request, one value to hold, and every way to look at it."""

from typing import Any

from regscribe.simulate import SimulatedDevice
from regscribe.testing.simulated_read import wrong_requests

STATES = """
format: 1
map: {id: test/states, title: States, maker: Test, class_prefix: States}
manual: {title: Manual, number: "1"}
models: {A: {}}
protocol: {functions: [3, 6, 16]}
groups:
  - id: main
    name: Main
    source: "1"
    registers:
      - {at: 5, name: State, access: rw, enum: {0: idle, 1: running, 17: faulty}, default: 1}
      - {at: 5, name: State bits, access: r, flags: {0: on, 4: fault}, rereads: state}
      - {at: 6, name: Energy, access: rw, type: uint32, valid: 0..4000000000}
      - {at: 7, name: Low word, access: r, type: int16, rereads: energy}
"""


def test_words_that_are_read_twice_are_asked_for_once(talk: Any) -> None:
    device = talk(STATES, {5: 17, 6: 1, 7: 0xFFFE})

    assert device.read("state_bits") == 17
    assert device.read("low_word") == -2
    assert (3, 5, 3) in device.sent
    assert wrong_requests(device.driver, list(device.driver.registers.values())) == []


def test_a_second_reading_tells_what_was_written_to_the_first(build: Any, direct: Any) -> None:
    built = build(STATES)
    simulated = SimulatedDevice(built.map, "A", unit=1)
    device = built.driver("A")(direct(simulated), unit=1)

    assert simulated.peek("state_bits") == 1
    device.state.write(17)
    device.energy.write(65536 + 0xFFFF)
    assert [device.state_bits.read(), device.low_word.read()] == [17, -1]
    assert simulated.peek("low_word") == -1


def test_a_simulated_device_that_is_told_the_second_reading_holds_it_as_the_first(build: Any) -> None:
    simulated = SimulatedDevice(build(STATES).map, "A", unit=1)

    simulated.poke("energy", 65536)
    simulated.poke("low_word", -2)
    simulated.poke("state_bits.fault", 1)
    assert (simulated.peek("energy"), simulated.peek("state")) == (131070, 17)

    other = SimulatedDevice(simulated.register_map, "A", unit=1)
    other.restore(simulated.snapshot())
    assert [other.peek(path) for path in ("energy", "low_word", "state", "state_bits")] == [131070, -2, 17, 17]
