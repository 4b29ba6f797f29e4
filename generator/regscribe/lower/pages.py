"""Pages: registers that a device shows at the same addresses, one page at a time, as other registers select it."""

from regscribe.lower.commands import CommandScope, step_of_value
from regscribe.lower.node import Value
from regscribe.model import Page

UNIT = ""
"""In place of a register: another unit id."""
Selection = tuple[tuple[str, str], ...]
"""The registers that select a page, and the value of each, as the map spells them."""


def page_number(group: Value, root: Value) -> int:
    """The number of the page that a group stands on, from 1 on in the order of the map; 0 where it is on none."""
    return list(_pages(root)).index(_selection(group)) + 1 if _is_on_page(group) else 0


def _pages(root: Value) -> dict[Selection, Value]:
    """The pages of a map, each with the first group that is on it."""
    found: dict[Selection, Value] = {}
    for group in root.elements_of("groups"):
        if _is_on_page(group):
            found.setdefault(_selection(group), group)
    return found


def _is_on_page(group: Value) -> bool:
    return bool(group.child("page") or group.child("unit_id"))


def _selection(group: Value) -> Selection:
    unit = group.child("unit_id")
    selected = tuple((key, each.text()) for key, each in group.items_of("page"))
    return ((UNIT, unit.text()), *selected) if unit else selected


def pages_of(root: Value, device: CommandScope) -> tuple[Page, ...]:
    """What selects each page on a model; nothing for a page that the model has no register of."""
    used: dict[int, bool] = {}
    for register in device.registers.values():
        for view in register.views:
            number = view.space.page(view.address(register.at))
            used[number] = used.get(number, False) or view.is_read_behind_write
    pages = enumerate(_pages(root).values(), start=1)
    return tuple(_page(group, device, used[number]) if number in used else Page() for number, group in pages)


def _page(group: Value, device: CommandScope, at_once: bool) -> Page:  # noqa: FBT001 (a field of the page)
    steps = [step_of_value(each, key, device) for key, each in group.items_of("page")]
    named = zip(steps, group.items_of("page"), strict=True)
    values = tuple(" ".join(map(str, step.words)) if each.is_text else each.text() for (step, _), (_, each) in named)
    paths = tuple(path for _, path in steps)
    return Page(tuple(step for step, _ in steps), paths, values, group.whole_of("unit_id"), at_once)
