"""What each device of a model has tells what a unit is; what a device may lack is absent and no failure."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from regscribe.emit.vectors import document, dumps
from regscribe.simulate import SimulatorError
from regscribe.simulate.device.device import SimulatedDevice
from regscribe.testing import DriverUnderTest, load
from regscribe.testing.simulated_read import wrong_without
from regscribe_runtime import Absent, ExceptionAnswer, identify
from regscribe_runtime.operations.missing_registers import MissingRegisters

MAP = """
format: 1
map: {id: test/mandatory, title: Mandatory, maker: Test, class_prefix: M}
manual: {title: Manual, number: "1"}
models: {Old: {}, New: {}}
decimals: {digits: {register: places}, rated: {register: rating_places}}
groups:
  - id: all
    name: All
    source: "1"
    each: {access: rw}
    registers:
      - {at: 0, name: Code, access: r, default: 7, mandatory: true}
      - {at: 1, name: Second, mandatory: true}
      - {at: 2, name: Third, mandatory: true}
      - {at: 3, name: Fourth, mandatory: true}
      - {at: 4, name: Fifth, mandatory: true}
      - {at: 10, name: Alarm, mandatory: false, default: 3}
      - {at: 11, name: Level}
      - {at: 20, name: Trend, models: [New], mandatory: true}
      - {at: 30, name: Places, range: 0..3, static: true}
      - {at: 31, name: Flow, decimals: digits}
      - {at: 40, name: Rating Places, range: 0..3}
      - {at: 41, name: Rating, decimals: rated, static: true}
identify:
  - {when: {code: 7}, models: [Old, New]}
"""


@pytest.fixture
def on(build: Callable[[str], Any], direct: Any) -> Callable[..., Any]:
    """A driver of a model on a simulated device of it, without some registers."""
    built = build(MAP)

    def made(model: str, *without: str) -> Any:
        link = direct(SimulatedDevice(built.map, model, unit=1, without=without))
        driver = built.driver(model)(link, unit=1)
        driver.link.module = built.module
        return driver

    return made


def _sent(driver: Any) -> list[tuple[int, int]]:
    found = [(one.address, one.quantity) for one in driver.link.log]
    driver.link.log.clear()
    return found


def test_a_unit_that_refuses_what_each_device_of_a_model_has_is_not_of_it(on: Callable[..., Any]) -> None:
    old = on("Old")
    found = identify(old.link, unit=1, packages=(old.link.module,))

    assert [one.model for one in found.models] == ["Old"]
    assert [(known.model, one.register, one.address) for known, one in found.lacking] == [("New", "trend", 20)]
    assert (20, 1) in _sent(old)


def test_what_few_models_have_is_asked_for_first_and_no_more_than_four_registers(on: Callable[..., Any]) -> None:
    new = on("New")
    found = identify(new.link, unit=1, packages=(new.link.module,))

    assert [one.model for one in found.models] == ["New", "Old"]
    assert found.lacking == ()
    assert _sent(new) == [(0, 1), (20, 1), (1, 1), (2, 1), (3, 1), (4, 1)]  # four of each model, the code besides


def test_what_a_device_may_lack_rules_nothing_out(on: Callable[..., Any]) -> None:
    old = on("Old", "alarm")
    found = identify(old.link, unit=1, packages=(old.link.module,))

    assert [one.model for one in found.models] == ["Old"]
    assert all(address != 10 for address, _ in _sent(old))


def test_a_device_without_an_optional_register_gives_the_others(on: Callable[..., Any]) -> None:
    driver = on("Old", "alarm")
    snapshot = driver.read()

    assert {name: type(error) for name, error in snapshot.errors.items()} == {"alarm": Absent}
    assert snapshot["level"] == 0
    with pytest.raises(ExceptionAnswer, match="exception 02"):
        driver.alarm.read()
    assert on("Old").alarm.read() == 3


def test_only_what_a_device_may_lack_can_be_left_out(on: Callable[..., Any]) -> None:
    with pytest.raises(SimulatorError, match=r"never without 'level'.* are alarm"):
        on("Old", "level")


def test_a_static_dependency_is_asked_for_once_per_connection(on: Callable[..., Any]) -> None:
    driver = on("Old")
    driver.link.device.poke("places", 2)
    driver.link.device.poke("flow", 1)

    assert driver.read(driver.flow)["flow"] == 1
    assert _sent(driver) == [(30, 1), (31, 1)]
    assert driver.read(driver.flow)["flow"] == 1
    assert _sent(driver) == [(31, 1)]


def test_a_static_value_whose_meaning_may_change_is_asked_for_again(on: Callable[..., Any]) -> None:
    driver = on("Old")
    assert driver.read(driver.rating)["rating"] == 0
    assert driver.read(driver.rating)["rating"] == 0
    assert _sent(driver)[-1] == (40, 2)


def test_what_was_written_is_asked_for_again_though_it_is_static(on: Callable[..., Any]) -> None:
    driver = on("Old")
    driver.read(driver.flow)
    driver.places.write(1)
    driver.link.log.clear()
    driver.read(driver.flow)
    assert _sent(driver) == [(30, 1), (31, 1)]


def test_a_driver_knows_both_facts(on: Callable[..., Any]) -> None:
    registers = type(on("Old")).registers
    assert [registers[name].mandatory for name in ("code", "alarm", "level")] == [True, False, None]
    assert [name for name, one in registers.items() if one.static] == ["places", "rating"]


OPTIONAL = """
format: 1
map: {id: test/optional, title: Optional, maker: Test, class_prefix: Opt}
manual: {title: Manual, number: "1"}
models: {A: {}}
groups:
  - id: all
    name: All
    source: "1"
    each: {access: r}
    registers:
      - {at: 0, name: Before}
      - {at: 1, name: Alarm, mandatory: false}
      - {at: 2, name: After, static: true}
"""


def test_a_device_is_tried_without_what_it_may_lack(build: Callable[[str], Any], tmp_path: Path) -> None:
    built = build(OPTIONAL)
    path = tmp_path / "vectors.json"
    path.write_text(dumps(document(built.map)), encoding="utf-8")
    checked = DriverUnderTest(built.driver("A"), load(path))

    checked.check_registers()
    assert [place.get("mandatory") for place, _ in checked.places] == [None, False, None]
    checked.driver.registers["alarm"].mandatory = None
    checked.driver.registers["after"].static = False
    with pytest.raises(AssertionError, match=r"alarm: mandatory None, expected False\n.*after: static False"):
        checked.check_registers()


def test_a_read_that_fails_for_what_a_device_may_lack_is_noticed(
    build: Callable[[str], Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    driver = build(OPTIONAL).driver("A")
    assert wrong_without(driver, ["alarm"]) == []
    monkeypatch.setattr(MissingRegisters, "error", lambda *_: None)  # nobody remembers what was refused
    with pytest.raises(ValueError, match="alarm cannot be read"):
        wrong_without(driver, ["alarm"])
