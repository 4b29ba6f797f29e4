"""The exporter of CSV: one row for each value of each model; docs/export.md is its contract."""

import csv
import io
import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import partial
from typing import NamedTuple

from regscribe.emit.words import (
    bits_words,
    cases_words,
    condition_words,
    conversion_words,
    labels_of,
    limit_words,
    listed,
    map_cases,
    one_line,
    part_words,
    plain_interval,
    term_words,
)
from regscribe.export.device.facts import FACTS, Carries, Carry, device_losses
from regscribe.export.further import beginning, further, valid_words
from regscribe.losses import Exported, Grade, Loss
from regscribe.model import (
    IDENTITY,
    BitField,
    Cases,
    Command,
    Computed,
    Condition,
    Kind,
    Model,
    Page,
    Range,
    Register,
    RegisterMap,
    View,
    always,
    show,
)
from regscribe.plugins import Option
from regscribe.visible import cell

name = "csv"
summary = "every value of every model, arrays expanded, as a table"
options: tuple[Option, ...] = ()
carries: Carries = {
    **dict.fromkeys((fact.id for fact in FACTS), Carry.WHOLE),
    **dict.fromkeys(("commands", "computed"), Carry.WHOLE),
    "givens": Carry.PARTLY,
}
verified = "Python's csv"


class Row(NamedTuple):
    """One row of the table; the fields are the columns, in order, and every one is text."""

    map: str
    model: str
    id: str
    name: str
    symbol: str = ""
    space: str = ""
    address: str = ""
    words: str = ""
    aliases: str = ""
    access: str = ""
    kind: str = ""
    type: str = ""
    unit: str = ""
    minimum: str = ""
    maximum: str = ""
    default: str = ""
    values: str = "{}"
    bits: str = "{}"
    views: str = "{}"
    scale: str = ""
    persistence: str = ""
    group: str = ""
    section: str = ""
    block: str = ""
    page: str = ""
    exists: str = ""
    file: str = ""
    queue: str = ""
    unit_id: str = ""
    more: str = "{}"


COLUMNS = Row._fields


def export(maps: Sequence[RegisterMap], _: Mapping[str, str]) -> Exported:
    """Return the table for standard output."""
    return Exported({"": csv_text(maps)}, losses(maps))


def losses(maps: Iterable[RegisterMap]) -> tuple[Loss, ...]:
    """What a table of registers does not say of a map."""
    found = []
    for one in maps:
        if one.givens:
            named = ", ".join(given.id for given in one.givens)
            found.append(Loss("", "givens", Grade.LOST, f"named in conditions only: {named}"))
        found += [loss for model in one.models for loss in device_losses(one, model, carries)]
    return tuple(found)


def csv_text(maps: Iterable[RegisterMap]) -> str:
    r"""Return the table as RFC 4180 text with `\n` line ends, header first, ordered by map, model, manual."""
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    writer.writerow(COLUMNS)
    writer.writerows(map(cell, row) for row in rows(maps))
    return buffer.getvalue()


def rows(maps: Iterable[RegisterMap]) -> Iterator[Row]:
    """Yield the rows of all maps: the registers of each model (arrays expanded), its commands, what is computed."""
    for register_map in maps:
        for model in register_map.models:
            for register in model.registers:
                yield _register_row(register_map, model, register)
            for command in model.commands:
                yield _command_row(register_map, model, command)
            for computed in model.computed:
                yield _computed_row(register_map, model, computed)


def _register_row(register_map: RegisterMap, model: Model, register: Register) -> Row:
    minimum, maximum = _limits(register.range or register.valid)
    space, page = register.base.space, model.pages[register.page - 1] if register.page else Page()
    place = space.facts(register.address)
    return Row(
        map=register_map.id,
        model=one_line(model.name),
        id=register.path,
        name=one_line(register.name),
        symbol=one_line(register.symbol),
        space=space.value,
        address=str(place["address"]),
        words=str(register.base.words),
        aliases=" ".join(str(space.inside(alias)) for alias in register.aliases),
        access=register.access.value,
        kind=register.kind.value,
        type=register.base.type.value,
        unit=cases_words(map_cases(register.unit, one_line)),
        minimum=minimum,
        maximum=maximum,
        default=_default(register),
        values=_object(_values(register)),
        bits=_object({bits_words(field): _bit_label(field) for field in register.fields}),
        views=_object({one.name: _view(register, one) for one in register.views}),
        scale=_scale(register),
        persistence=one_line(register.persistence),
        group=register.group,
        section=one_line(register.section),
        block=register.block,
        page=", ".join(map("{}={}".format, page.selectors, page.values)),
        exists=_exists(register.when, model),
        file=str(place.get("file", "")),
        queue=str(place.get("queue", "")),
        unit_id=str(page.unit or ""),
        more=_object(further(register, model)),
    )


def _view(register: Register, view: View) -> dict[str, object]:
    facts = view.space.facts(view.address(register.at))
    found: dict[str, object] = {"address": facts["address"], "words": view.words, "type": view.type}
    if view.space is not register.base.space:
        found |= {"space": view.space} | {key: facts[key] for key in ("file", "queue") if key in facts}
    return found


def _default(register: Register) -> str:
    if register.default_cases:
        return cases_words(map_cases(register.default_cases, beginning))
    return "" if register.default is None else beginning(register.default)


def _command_row(register_map: RegisterMap, model: Model, command: Command) -> Row:
    requests = [step for step in command.steps if step.words]
    first = requests[0] if requests else None
    written: dict[str, list[str]] = {}
    for step in requests:
        written.setdefault(step.space.spelled(step.address), []).append(
            (step.argument and f"<{step.argument}>") or " ".join(map(str, step.words))
        )
    return Row(
        map=register_map.id,
        model=one_line(model.name),
        id=command.id,
        name=one_line(command.name),
        space=first.space.value if first else "",
        address=str(first.space.inside(first.address)) if first else "",
        words=str(sum(len(step.words) for step in requests)),
        access="w",
        kind="command",
        values=_object({address: ", ".join(words) for address, words in written.items()}),
        group=command.group,
        section=one_line(command.section),
        block=first.block if first else "",
        exists=_exists(command.when, model),
        more=_object(_steps(command, model)),
    )


def _steps(command: Command, model: Model) -> dict[str, str]:
    """The conditions of the steps that have one, in words."""
    several = ((number, step.when) for number, step in enumerate(command.steps, 1) if not step.when.always)
    words = "; ".join(f"step {number} while {condition_words(when, model)}" for number, when in several)
    return {"steps": one_line(words)} if words else {}


def _exists(when: Condition, model: Model) -> str:
    return "" if when.always else one_line(condition_words(when, model))


def _computed_row(register_map: RegisterMap, model: Model, computed: Computed) -> Row:
    minimum, maximum = _limits(computed.valid)
    more = {"valid": valid_words(computed.valid), "description": one_line(computed.description)}
    return Row(
        map=register_map.id,
        model=one_line(model.name),
        id=computed.id,
        name=one_line(computed.name),
        access="r",
        kind="computed",
        unit=one_line(computed.unit),
        minimum=minimum,
        maximum=maximum,
        scale=one_line(term_words(computed.term)),
        section=one_line(computed.section),
        exists=_exists(computed.when, model),
        more=_object({key: text for key, text in more.items() if text}),
    )


def _object(members: Mapping[str, object]) -> str:
    return json.dumps(members, ensure_ascii=False)


def _values(register: Register) -> dict[str, str]:
    """Codes with a meaning: enum members, special values, and stored numbers that are faults."""
    codes = {str(code): one_line(label) for code, label in labels_of(register.enum).items()}
    codes |= {"0": one_line(register.none)} if register.none else {}
    codes |= {show(special.code): one_line(special.label) for special in register.specials}
    return codes | {sentinel.spelled: one_line(sentinel.label) for sentinel in register.sentinels}


def _bit_label(field: BitField) -> str:
    codes = ", ".join(f"{code} = {one_line(label)}" for code, label in labels_of(field.enum).items())
    codes = codes or one_line(part_words(field))
    return f"{one_line(field.label)}: {codes}" if codes else one_line(field.label)


def _scale(register: Register) -> str:
    if register.kind is Kind.RAW:
        return "not stated"
    if all(case.then == IDENTITY for case in register.scale):
        return ""
    return cases_words(map_cases(register.scale, conversion_words))


def _limits(cases: Cases[Range]) -> tuple[str, str]:
    """Numbers where the range is one interval between numbers, else the limits of each case in words.

    Cases that differ in their decimals only are the one range that the manual's table prints.
    """
    printed = [case.then._replace(decimals=None) for case in cases]
    if len(cases) > 1 and all(one == printed[0] for one in printed):
        cases = always(printed[0])
    plain = plain_interval(cases)
    if plain:
        return show(plain[0]), show(plain[1])
    lowest, highest = (cases_words(map_cases(cases, partial(_ends, side=side))) for side in (0, 1))
    return lowest, highest


def _ends(limits: Range, side: int) -> str:
    return listed([limit_words(interval[side], decimals=limits.decimals) for interval in limits.intervals])
