"""Which addresses of which space hold what, on which models: every view and every alias of every register."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from regscribe.emit.common_values import models_by
from regscribe.emit.markdown.transmission import view_formula
from regscribe.model import Access, Model, Register, RegisterMap, Space, View

Stretch = tuple[Space, int, int]
"""Space, first and last address."""


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


def places(register_map: RegisterMap) -> tuple[AddressUse, ...]:
    """Return every place once, with the models that have it, by space and address."""
    models = models_by((model.name, place) for model in register_map.models for place in _places(model))
    found = [replace(place, models=tuple(dict.fromkeys(names))) for place, names in models.items()]
    return tuple(sorted(found, key=lambda place: (list(Space).index(place.space), place.first, place.last)))


def _places(model: Model) -> Iterator[AddressUse]:
    for register in model.registers:
        yield from (_place(register, view) for view in register.views)
        for address in register.aliases:
            base = _place(register, register.base)
            yield replace(base, first=address, last=address + register.base.words - 1, region=None, alias=True)


def _place(register: Register, view: View) -> AddressUse:
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


def unused(register_map: RegisterMap) -> tuple[Stretch, ...]:
    """Return the stretches that any model has as unused."""
    return tuple(dict.fromkeys(stretch for model in register_map.models for stretch in model.unused))


def groups(register_map: RegisterMap, found: Sequence[AddressUse]) -> dict[str, str]:
    """Return the names of the groups that have registers by id, in the manual's order; `` for none."""
    names = {group.id: group.name for model in register_map.models for group in model.groups}
    present = {place.group for place in found}
    named = {id_: name for id_, name in names.items() if id_ in present}
    rest = dict.fromkeys(place.group for place in found if place.group not in names)
    return named | {id_: id_ or "Other registers" for id_ in rest}
