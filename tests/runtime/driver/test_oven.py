"""A generated driver against the simulator, over TCP."""

import asyncio
from collections.abc import Iterator
from typing import Any

import pytest

from regscribe.simulate import simulate
from regscribe_runtime import ExceptionAnswer, LinkLost, NotOpen, PartialWrite, Saturated, SensorFault, ValueRefused

COOLED = {"cooled_codes": {1}}


@pytest.fixture(scope="module")
def running(oven: Any) -> Iterator[Any]:
    with simulate(oven.map, "Big", unit=1, givens=COOLED) as server:
        yield server


@pytest.fixture
def controller(oven: Any, running: Any) -> Iterator[Any]:
    with oven.driver("Big").tcp(running.host, port=running.port, unit=1, cooled_codes={1}) as driver:
        for path, value in (("kind", 1), ("places", 0), ("order", 1), ("degrees", 1), ("setpoint", 77), ("state", 0)):
            running.device.poke(path, value)
        yield driver


def sent(running: Any) -> int:
    return len(running.requests)


def test_a_fraction_is_read_through_the_preferred_view_in_the_word_order_of_the_device(
    controller: Any, running: Any
) -> None:
    running.device.poke("setpoint", 150.5)

    assert controller.setpoint.read() == 150.5
    assert controller.setpoint.read_raw() == (0x8000, 0x4316)

    running.device.poke("order", 0)
    assert controller.setpoint.read_raw() == (0x4316, 0x8000)


def test_each_view_shows_the_same_value_as_finely_as_it_can(controller: Any, running: Any) -> None:
    running.device.poke("setpoint", 120.5)

    assert tuple(controller.setpoint.read(view=view) for view in ("ieee", "x10", "base")) == (120.5, 120.5, 121.0)


def test_what_a_value_depends_on_is_read_once_and_remembered(controller: Any, running: Any) -> None:
    before = sent(running)
    controller.setpoint.read()
    first = sent(running) - before
    controller.setpoint.read()

    assert first > 1
    assert sent(running) - before == first + 1


def test_writing_a_register_that_others_depend_on_forgets_it(controller: Any, oven: Any) -> None:
    kind = oven.module.Kind
    controller.setpoint.write(150)
    controller.kind.write(kind.LINE)
    controller.places.write(1)

    controller.setpoint.write(15.5)

    assert controller.setpoint.read() == 15.5
    assert controller.setpoint.read_raw() == (0, 0x431B)  # 155.0: a line input stores digits


def test_a_link_opened_anew_forgets_what_was_remembered(controller: Any, running: Any) -> None:
    assert controller.setpoint.read() == 77
    running.device.poke("order", 0)  # behind the driver's back
    controller.close()
    controller.open()

    assert controller.setpoint.read() == 77


@pytest.mark.parametrize("attempt", ["read", "write"])
def test_a_driver_that_is_not_open_says_so_and_leaves_no_write_in_doubt(controller: Any, attempt: str) -> None:
    controller.close()
    with pytest.raises(NotOpen, match=r"is not open: use the driver in a `with` statement"):
        controller.setpoint.read() if attempt == "read" else controller.setpoint.write(80)


def test_the_x10_view_at_its_end_is_no_value(controller: Any, running: Any) -> None:
    running.device.poke("high_limit", 5000)

    with pytest.raises(Saturated, match="x10"):
        controller.high_limit.read(view="x10")
    assert controller.high_limit.read() == 5000


@pytest.mark.parametrize(("fault", "words"), [("LOW_ERROR", (0, 0xC700)), ("HIGH_ERROR", (0xFE00, 0x46FF))])
def test_a_sentinel_is_a_fault_in_every_view(controller: Any, running: Any, fault: str, words: tuple[int, ...]) -> None:
    running.device.poke("process_value", fault)

    assert controller.process_value.read_raw() == words
    for view in ("ieee", "base"):
        with pytest.raises(SensorFault) as caught:
            controller.process_value.read(view=view)
        assert caught.value.fault == fault
    with pytest.raises(Saturated, match=fault.lower().replace("_", " ")):
        controller.process_value.read(view="x10")


def test_an_enum_code_that_the_manual_does_not_list_is_read_as_a_value(oven: Any, controller: Any) -> None:
    register = oven.driver("Big").load_type

    found = register.decode((9,))

    assert (found, found.known, found.name) == (9, False, "UNKNOWN_9")
    with pytest.raises(ValueRefused, match="UNKNOWN_9"):
        controller.load_type.write(found)


def test_models_have_their_own_enums_and_registers(oven: Any) -> None:
    big, small = oven.driver("Big"), oven.driver("Small")

    assert hasattr(small, "small_only")
    assert not hasattr(big, "small_only")
    assert big.load_type.encode(oven.module.LoadType.BIG) == (2,)
    with pytest.raises(ValueRefused):
        small.load_type.encode(2)


@pytest.mark.parametrize("value", [-100.1, 1400.5, 1e9])
def test_a_write_outside_limits_that_are_registers_is_refused_before_it_is_sent(
    controller: Any, running: Any, value: float
) -> None:
    running.device.poke("high_limit", 1400)
    controller.setpoint.write(100)

    with pytest.raises(ValueRefused, match="-100 to 1400"):
        controller.setpoint.write(value)
    assert controller.setpoint.read() == 100


def test_a_value_finer_than_a_view_can_carry_is_refused_unless_rounding_is_asked_for(controller: Any) -> None:
    with pytest.raises(ValueRefused, match=r"120\.5 is finer than the base view can carry; nearest are 120 and 121"):
        controller.setpoint.write(120.5, view="base")

    controller.setpoint.write(120.5, view="base", rounded=True)

    assert controller.setpoint.read() == 121


def test_a_line_input_has_the_resolution_of_its_decimals(controller: Any, running: Any) -> None:
    running.device.poke("kind", 2)
    running.device.poke("places", 1)
    running.device.poke("high_limit", 999.9)

    with pytest.raises(ValueRefused, match=r"resolution 0\.1"):
        controller.high_limit.write(99.95)
    with pytest.raises(ValueRefused, match=r"-199\.9 to 999\.9"):
        controller.high_limit.write(1000)


def test_special_values_are_named_and_may_be_written(controller: Any, oven: Any) -> None:
    off = oven.module.HoldbackSpecial.OFF
    controller.holdback.write(off)

    assert controller.holdback.read() is off
    with pytest.raises(ValueRefused):
        controller.holdback.write(0.05)


def test_a_special_code_that_stands_for_a_number_is_that_number(controller: Any) -> None:
    controller.cycle.write(0.2)

    assert controller.cycle.read_raw() == (0,)
    assert controller.cycle.read() == 0.2


def test_a_conditional_scale_uses_the_given(controller: Any, running: Any, oven: Any) -> None:
    running.device.poke("power", 25.0)

    assert controller.power.read_raw() == (12500,)
    assert controller.power.read() == 25.0
    other = oven.driver("Big").power.decode((12500,), state={"kind": 1}, givens={"cooled_codes": {2, 3}})
    assert other == 12500


def test_a_write_under_a_condition_says_which_and_what_is_now(controller: Any) -> None:
    with pytest.raises(ValueRefused, match=r"writable while heating only; state.phase is IDLE"):
        controller.hand_power.write(50)

    controller.state.change(lambda state: state.replace(phase=1))
    controller.hand_power.write(50)

    assert controller.hand_power.read() == 50


def test_changing_a_bit_field_leaves_the_others(controller: Any, running: Any) -> None:
    running.device.poke("state", 0x0100)

    controller.state.change(lambda state: state.replace(alarm=True))

    found = controller.state.read()
    assert (found, found.alarm, found.phase.label) == (0x0101, True, "heating")


def test_a_locked_register_is_unlocked_by_the_write(controller: Any, running: Any) -> None:
    controller.trim.write(5)

    assert controller.trim.read() == 5
    assert "unlock_trim" in str(running.device.commands_run)


def test_an_equal_value_is_not_written_to_the_eeprom_again(controller: Any, running: Any) -> None:
    controller.stored_setpoint.write(42)
    before = sent(running)
    controller.stored_setpoint.write(42)

    functions = [pdu[0] for pdu in running.requests[before:]]
    assert set(functions) == {3}


def test_a_dangerous_command_wants_confirmation(controller: Any, running: Any) -> None:
    before = sent(running)
    with pytest.raises(ValueRefused, match="all settings are lost"):
        controller.commands.forget_everything()
    assert sent(running) == before

    controller.commands.forget_everything(confirm=True)


def test_a_group_is_read_in_few_requests_and_keeps_faults_apart(controller: Any, running: Any) -> None:
    running.device.poke("process_value", "LOW_ERROR")
    controller.setpoint.read()
    before = sent(running)

    snapshot = controller.read(controller.groups.heat)

    assert sent(running) - before == 3  # 12 words against a limit of 10, and what they depend on
    assert snapshot["low_limit"] == -100
    assert list(snapshot.errors) == ["process_value"]
    with pytest.raises(SensorFault):
        snapshot["process_value"]


def test_array_elements_are_numbered_as_in_the_manual(controller: Any, running: Any) -> None:
    controller.steps[3].minutes.write(30)
    controller.steps[4].level.write(99.5)

    assert running.device.peek("steps[3].minutes") == 30
    assert controller.steps[4].read() == {"minutes": 0, "level": 99.5}
    assert [step.minutes.read() for step in controller.steps] == [0, 0, 30, 0]
    with pytest.raises(IndexError, match="1 to 4"):
        controller.steps[0]


def test_an_exception_answer_has_the_meaning_of_the_device(controller: Any) -> None:
    with pytest.raises(ExceptionAnswer, match="the oven does not like the number") as caught:
        controller.places.write_raw((9,))
    assert (caught.value.code, caught.value.address) == (3, 4001)


def test_units_follow_the_configuration(controller: Any, oven: Any) -> None:
    assert controller.setpoint.read_unit() == "°F"
    controller.degrees.write(oven.module.Degrees.CELSIUS)
    assert controller.setpoint.read_unit() == "°C"


def test_a_read_only_register_refuses_assignment_and_has_no_write(controller: Any) -> None:
    assert not hasattr(controller.lamps, "write")
    with pytest.raises(AttributeError, match="is a register"):
        controller.lamps = 1
    with pytest.raises(AttributeError, match=r"use \.write"):
        controller.setpoint = 1


def test_versions_and_flags_have_types_of_their_own(controller: Any, running: Any, oven: Any) -> None:
    running.device.poke("lamps", 0x83)

    assert controller.version.read() == "01.31.00"
    assert controller.lamps.read() == oven.module.Lamps.RED | oven.module.Lamps.GREEN | oven.module.Lamps.BLUE


def test_a_write_that_the_device_cut_short_names_the_first_word_not_written(controller: Any) -> None:
    with pytest.raises(PartialWrite) as caught:
        controller.run(_two_words_at(4011))
    assert (caught.value.written, caught.value.first_unwritten) == (1, 4012)


def _two_words_at(address: int) -> Any:
    from regscribe_runtime.wire.requests import Request  # noqa: PLC0415 (this one test speaks the wire itself)

    def task(session: Any) -> Any:
        return (yield from session.exchange(Request(16, address, 2, (1, 1))))

    return task


def test_a_closed_link_is_a_clear_error(oven: Any) -> None:
    driver = oven.driver("Big").tcp("127.0.0.1", port=9, unit=1, cooled_codes=())
    with pytest.raises(LinkLost, match="not open"):
        driver.setpoint.read()
    with pytest.raises(LinkLost, match="cannot open"):
        driver.open()


def test_a_unit_id_that_the_device_cannot_have_is_refused(oven: Any) -> None:
    with pytest.raises(ValueError, match="1 to 247"):
        oven.driver("Big").tcp("127.0.0.1", unit=248, cooled_codes=())


def test_a_given_has_no_default(oven: Any) -> None:
    with pytest.raises(TypeError, match="cooled_codes"):
        oven.driver("Big").tcp("127.0.0.1", unit=1)


def test_the_asyncio_driver_does_the_same(oven: Any, running: Any) -> None:
    async def talk() -> tuple[Any, ...]:
        driver = oven.module.AsyncOvenBig.tcp(running.host, port=running.port, unit=1, cooled_codes={1})
        async with driver as controller:
            await controller.kind.write(oven.module.Kind.PROBE)
            await controller.setpoint.write(33.3)
            await controller.steps[2].minutes.write(7)
            await controller.commands.unlock_trim()
            snapshot = await controller.read(controller.groups.setup)
            both = await asyncio.gather(controller.setpoint.read(), controller.setpoint.read(view="x10"))
            return (*both, snapshot["trim"], await controller.steps[2].minutes.read(), await controller.loopback(7))

    running.device.poke("trim", 3)
    assert asyncio.run(talk()) == (33.3, 33.3, 3, 7, 7)


@pytest.mark.parametrize("transport", ["tcp", "rtu-tcp", "ascii-tcp", "pty"])
def test_every_transport_carries_the_same_driver(oven: Any, transport: str) -> None:
    with simulate(oven.map, "Small", unit=7, transport=transport, givens=COOLED) as running:
        cls = oven.driver("Small")
        if transport == "pty":
            driver = cls.rtu(running.path, unit=7, cooled_codes={1}, baud=19200)
        else:
            framing = transport.removesuffix("-tcp")
            driver = cls.tcp(running.host, port=running.port, unit=7, cooled_codes={1}, framing=framing)
        with driver as controller:
            controller.small_only.write(12.5)
            assert controller.small_only.read() == 12.5


def test_a_foreign_unit_on_a_serial_line_gives_no_answer_and_names_what_was_asked(oven: Any) -> None:
    from regscribe_runtime import NoAnswer  # noqa: PLC0415 (beside its only use)

    with simulate(oven.map, "Big", unit=1, transport="rtu-tcp", givens=COOLED) as running:
        driver = oven.driver("Big").tcp(
            running.host, port=running.port, unit=2, cooled_codes={1}, framing="rtu", timeout=0.2
        )
        with (
            driver as controller,
            pytest.raises(NoAnswer, match="unit 2 gave no answer to function 03 at address 4001"),
        ):
            controller.places.read()


def test_no_register_can_hide_a_name_of_the_driver() -> None:
    from regscribe.checks.identifiers import RUNTIME_NAMES  # noqa: PLC0415 (beside its only use)
    from regscribe_runtime import AsyncDevice, Device  # noqa: PLC0415 (as above)

    own = {name for cls in (Device, AsyncDevice) for name in dir(cls) if not name.startswith("_")}

    assert own - RUNTIME_NAMES == set()
