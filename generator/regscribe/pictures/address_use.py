"""Addresses with the registers that they transmit, by model: every view and every alias of every register.

Those in blocks are left out: where they stand differs from device to device.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from regscribe.emit.common_values import models_by
from regscribe.emit.markdown.transmission import view_formula
from regscribe.model import Access, Model, Register, RegisterMap, Space, View


@dataclass(frozen=True, slots=True)
class AddressUse:
    """A stretch of addresses that transmits one register on `models`; `formula` gives it from the base address n."""

    space: Space
    first: int
    last: int
    view: str
    type: str
    formula: str
    region: tuple[int, int] | None
    path: str
    name: str
    group: str
    access: Access
    alias: bool = False
    models: tuple[str, ...] = ()


def address_uses(register_map: RegisterMap) -> tuple[AddressUse, ...]:
    """Return every use once, with the models that have it, by space and address."""
    models = models_by((model.name, use) for model in register_map.models for use in _uses(model))
    found = [replace(use, models=tuple(dict.fromkeys(names))) for use, names in models.items()]
    return tuple(sorted(found, key=lambda use: (list(Space).index(use.space), use.first, use.last)))


def _uses(model: Model) -> Iterator[AddressUse]:
    for register in (one for one in model.registers if not one.block and not one.page):
        yield from (_use(register, view) for view in register.views if not view.space.part_bits)
        for address in () if register.base.space.part_bits else register.aliases:
            base = _use(register, register.base)
            yield replace(base, first=address, last=address + register.base.words - 1, region=None, alias=True)


def _use(register: Register, view: View) -> AddressUse:
    return AddressUse(
        space=view.space,
        first=view.address(register.at),
        last=view.last(register.at),
        view=view.name,
        type=view.type.value,
        formula=view_formula(view, register.base),
        region=view.region,
        path=register.path,
        name=register.name,
        group=register.group,
        access=register.access,
    )


def groups(register_map: RegisterMap, found: Sequence[AddressUse]) -> dict[str, str]:
    """Return the names of the groups that have registers by id, in the manual's order; `` for none."""
    names = {group.id: group.name for model in register_map.models for group in model.groups}
    present = {use.group for use in found}
    named = {id_: name for id_, name in names.items() if id_ in present}
    rest = dict.fromkeys(use.group for use in found if use.group not in names)
    return named | {id_: id_ or "Other registers" for id_ in rest}
