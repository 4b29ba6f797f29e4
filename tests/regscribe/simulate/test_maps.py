"""The simulated devices of the real maps behave as their manuals say, by the maps' own worked examples and more."""

import struct
from pathlib import Path

import pytest

from regscribe.model import FrameExample, ValueExample
from regscribe.reference import holds
from regscribe.simulate import SimulatedDevice
from regscribe.simulate.map_cache import find_map
from regscribe_runtime.wire.server_framing import RtuFramer

MAPS = Path(__file__).parents[3] / "maps"
GIVENS: dict[str, dict[str, set[int]]] = {"fdc/series-100": {"linear_inputs": {16, 17, 18}}, "athena/series-c": {}}


FAMILIES = {name: find_map(MAPS / f"{name}.yaml") for name in GIVENS}
MODELS = [(name, model.name) for name, family in FAMILIES.items() for model in family.models]
EXAMPLES = [(name, example) for name, family in FAMILIES.items() for example in family.examples]


def simulated(name: str, model: str) -> SimulatedDevice:
    return SimulatedDevice(FAMILIES[name], model, givens=GIVENS[name])


def read(device: SimulatedDevice, address: int, count: int) -> bytes | None:
    return device.handle(struct.pack(">BHH", 3, address, count))


@pytest.mark.parametrize(("name", "model"), MODELS)
def test_every_readable_register_is_answered_at_each_of_its_addresses(name: str, model: str) -> None:
    device = simulated(name, model)
    for register in device.model.registers:
        for view in register.views:
            answer = read(device, view.address(register.at), view.words)
            assert answer is not None, register.path
            words = device.peek_words(register.path, view.name)
            assert answer[2:] == struct.pack(f">{view.words}H", *words), register.path
        for address in register.aliases:
            assert read(device, address, 1) == read(device, register.address, 1), register.path


@pytest.mark.parametrize(("name", "model"), MODELS)
def test_every_default_of_the_manual_is_the_first_value_unless_it_is_delivered_with_another(
    name: str, model: str
) -> None:
    device = simulated(name, model)
    for register in device.model.registers:
        first = register.default if register.delivered is None else register.delivered
        if first is not None and not isinstance(first, str):
            assert device.peek(register.path) == first, register.path


@pytest.mark.parametrize(("name", "model"), MODELS)
def test_the_model_can_be_identified(name: str, model: str) -> None:
    device = simulated(name, model)
    found = [one.models for one in FAMILIES[name].identity if holds(one.identity.when, device.state)]
    assert [model in models for models in found] == [True]


@pytest.mark.parametrize(
    ("name", "example"),
    [(name, each) for name, each in EXAMPLES if isinstance(each, ValueExample)],
    ids=lambda each: getattr(each, "source", each),
)
def test_a_worked_value_shows_its_words(name: str, example: ValueExample) -> None:
    device = simulated(name, example.model)
    for path, value in example.state:
        device.poke(path, value)
    if example.stored is not None:
        device.state.store(example.register, example.stored)
    elif example.value is not None:
        device.poke(example.register, example.value)
    else:
        device.poke(example.register, 0)
        for flag in example.flags or ():
            device.poke(f"{example.register}.{flag}", 1)
    shown = device.peek_words(example.register, example.view)
    assert shown == tuple(word & 0xFFFF for word in example.words)


@pytest.mark.parametrize(
    ("name", "example"),
    [(name, each) for name, each in EXAMPLES if isinstance(each, FrameExample) and not each.answer],
    ids=lambda each: getattr(each, "source", each),
)
def test_a_frame_of_the_manual_does_what_the_manual_says(name: str, example: FrameExample) -> None:
    device = simulated(name, example.model)
    for path, value in example.state:
        device.poke(path, value)
    pdu = example.frame[1:-2] if example.crc else example.frame[1:]
    if example.crc:
        (request,) = RtuFramer().feed(example.frame)
        assert (request.unit, request.pdu) == (example.unit, pdu)
    answer = device.handle(pdu, broadcast=example.unit == 0)
    assert (answer is None) == (example.unit == 0)
    for path, value in example.writes:
        assert device.peek(path) == value, path
    if example.command:
        assert device.commands_run == (example.command,)


def ask(device: SimulatedDevice, request: str) -> str | None:
    answer = device.handle(bytes.fromhex(request))
    return None if answer is None else answer.hex(" ")


@pytest.mark.parametrize(
    ("request_", "answer"),
    [
        ("03 1f41 0002", "83 02"),  # 2.2.6: an odd IEEE address
        ("03 1f40 0003", None),  # 2.2.7: an odd count of IEEE words
        ("03 0000 0019", None),  # 2.2.7: 25 words
        ("03 01f4 0001", "83 02"),  # 2.2.6: no register
        ("04 0000 0001", None),  # 1.2.1.3: an unsupported function
        ("06 1f44 0000", "86 02"),  # 2.3.5: function 06 in the IEEE region
        ("06 0000 0005", "86 03"),  # 2.3.6: read-only
        ("06 0fd1 0017", "86 03"),  # 2.3.6: 23 is no input type
        ("10 0fd1 0001 04 0001 0001", None),  # 2.4.8: a byte count that is not twice the word count
        ("10 1b58 0002 04 0055 005c", "10 1b 58 00 02"),  # 7.2
        ("08 0000 aabb", "08 00 00 aa bb"),  # 2.5.3
        ("08 0001 aabb", None),  # 2.5.5
    ],
)
def test_athena_refuses_and_ignores_as_its_manual_says(request_: str, answer: str | None) -> None:
    assert ask(simulated("athena/series-c", "16C"), request_) == answer


def test_athena_adds_garbage_behind_good_words_and_stops_writing_at_the_first_bad_one() -> None:
    device = simulated("athena/series-c", "16C")
    assert ask(device, "03 0000 0018") == ask(device, "03 0000 0018")
    assert ask(device, "10 0fec 0004 08 0002 0001 0064 ffff") == "10 0f ec 00 03"


@pytest.mark.parametrize(
    ("request_", "answer"),
    [
        ("04 0000 0001", "84 01"),
        ("03 00c8 0001", "83 02"),
        ("03 0000 0051", "83 03"),
        ("06 0040 0000", "86 03"),
        ("06 0034 0001", "86 03"),
        ("06 0042 0001", "86 03"),
        ("03 004d 0003", "03 06 00 00 00 00 00 00"),
    ],
)
def test_fdc_refuses_as_its_manual_says(request_: str, answer: str) -> None:
    assert ask(simulated("fdc/series-100", "C21"), request_) == answer


def test_fdc_opens_calibration_by_a_command_and_outputs_in_manual_control() -> None:
    device = simulated("fdc/series-100", "C21")
    assert ask(device, "06 0048 682d") == "06 00 48 68 2d"
    assert ask(device, "06 0034 0001") == "06 00 34 00 01"
    device.poke("mode.operation", "manual_control_mode")
    assert ask(device, "06 0042 0001") == "06 00 42 00 01"
