"""Reading a group costs what reading its registers costs: work that grows as the group does, and is done once."""

import sys
from collections.abc import Callable
from types import FrameType
from typing import Any

from regscribe_runtime.operations.prepared_read import dependencies
from regscribe_runtime.planning.read_order import lay_out
from regscribe_runtime.planning.read_places import read_places

HEAD = """\
format: 1
map: {id: test/wide, title: Wide, maker: Nobody, class_prefix: Wide}
manual: {title: None}
models: {One: {}}
groups:
"""
REGISTER = "      - {{at: {at}, name: R{at}, access: {access}, type: int16}}\n"


def wide(count: int) -> str:
    """A map with so many registers in a group, and a group of an array with one that can only be written."""
    rows = "".join(REGISTER.format(at=at, access="rw") for at in range(count))
    return f"""{HEAD}
  - id: rest
    name: Rest
    registers:
      - {{at: 9000, name: Order, access: w, type: int16}}
      - id: steps
        name: Step
        repeat: 1..2
        stride: 1
        registers: [{{at: 9001, name: Level, access: rw, type: int16}}]
      - {{at: 9010, name: Steps more, access: r, type: int16}}
  - id: main
    name: Main
    registers:
{rows}"""


def work(act: Callable[[], object]) -> int:
    """How many operations of the interpreter some Python code takes."""
    count = 0

    def step(frame: FrameType, event: str, _: object) -> Any:
        nonlocal count
        frame.f_trace_opcodes = True
        count += event == "opcode"
        return step

    before = sys.gettrace()
    sys.settrace(step)
    try:
        act()
    finally:
        sys.settrace(before)
    return count


def poll(talk: Callable[[str, dict[int, int]], Any], count: int) -> tuple[int, int]:
    """The work of a second read of a group of so many registers, and of the same registers by name."""
    driver = talk(wide(count), {}).driver
    kind = type(driver)
    group, names = kind.groups.main, [getattr(kind, f"r{at}") for at in range(count)]
    for what in ((group,), names):
        driver.read(*what)
    return work(lambda: driver.read(group)), work(lambda: driver.read(*names))


def test_a_group_is_read_at_the_cost_of_its_registers(talk: Callable[[str, dict[int, int]], Any]) -> None:
    (small, small_by_name), (large, large_by_name) = poll(talk, 50), poll(talk, 400)

    assert small < 1.2 * small_by_name
    assert large < 1.2 * large_by_name
    assert large < 1.2 * 8 * small, "eight times as many registers take more than eight times as much"


def test_a_group_has_its_readable_registers_and_the_elements_of_its_arrays(
    talk: Callable[[str, dict[int, int]], Any],
) -> None:
    device = talk(wide(3), {9001: 7, 9002: 8, 9010: 9})

    assert dict(device.driver.read(type(device.driver).groups.rest)) == {
        "steps[1].level": 7,
        "steps[2].level": 8,
        "steps_more": 9,
    }


FAR = """{HEAD}
  - id: main
    name: Main
    registers:
      - id: rows
        name: Row
        repeat: 1..{count}
        stride: 10
        registers:
          - {{at: 0, name: Value, access: rw, type: int16, decimals: one}}
          - {{at: 20000, name: Places, access: rw, type: int16, range: 0..3}}
"""


def test_to_lay_out_many_requests_takes_as_much_for_each_as_for_few(
    talk: Callable[[str, dict[int, int]], Any],
) -> None:
    def laid(count: int) -> int:
        text = FAR.format(HEAD=HEAD, count=count).replace("groups:", "decimals: {one: {register: places}}\ngroups:")
        driver = talk(text, {}).driver
        driver.session.memory.update(dict.fromkeys((f"rows[{row}].places" for row in range(1, count + 1)), 0))
        _ = driver.session.terms()
        spent = work(lambda: lay_out(*wants(driver)))
        assert len(lay_out(*wants(driver)).blocks) == 2 * count
        return spent

    assert laid(160) < 1.5 * 8 * laid(20)


def wants(driver: Any) -> tuple[Any, Any, Any]:
    """All registers of a driver with the place to read them at, what each depends on, and what a plan must keep to."""
    every = list(driver.registers.values())
    needs = dependencies(driver.registers, every)
    return {one.path: read_places(one)[0] for one in every}, needs, driver.session.terms()
