"""Vector sets: registers of several models with equal vectors share one set, worked out and written once."""

import json
from collections.abc import Iterable
from dataclasses import replace
from typing import Any

from regscribe.emit.common_values import models_by
from regscribe.emit.vectors.content import case_of, surroundings
from regscribe.emit.vectors.situations import Finder, Situation, existence_situations, writable_situations
from regscribe.emit.words import condition_words, term_words
from regscribe.model import (
    PLAIN_READING,
    Condition,
    Enum,
    Model,
    Order,
    OrderCases,
    Register,
    RegisterMap,
    Rounding,
    Span,
    View,
    WordOrder,
    always,
    show,
)
from regscribe_runtime.values.wire_types import PARTED

Json = dict[str, Any]
Sides = tuple[tuple[Situation, bool], ...]
Plan = tuple[tuple[tuple[Situation, ...], ...], Sides, Sides]
NOWHERE = Span("")
PARTS = sorted(map(str, PARTED))


def vector_sets(register_map: RegisterMap) -> list[Json]:
    """Return the vector sets of a map; each names the registers, models and addresses that it is true of."""
    keys: dict[tuple[Register, Plan], str] = {}
    contents: dict[str, Json] = {}
    places: dict[str, list[tuple[str, Json]]] = {}
    finder = Finder(register_map)
    for model in register_map.models:
        for register in model.registers:
            tried = tuple(finder.situations(model, register, view) for view in register.views)
            writable = writable_situations(register_map, model, register)
            bare = (_bare(register), (tried, writable, existence_situations(register_map, model, register)))
            if bare not in keys:
                content = _content(*bare)
                keys[bare] = json.dumps(content)
                contents[keys[bare]] = content
            places.setdefault(keys[bare], []).append((model.name, _place(model, register)))
    return [{"registers": once_for_models(places[key], "path"), **content} for key, content in contents.items()]


def once_for_models(facts: Iterable[tuple[str, Json]], key: str) -> list[Json]:
    """Return each fact once, with `models`, the names of the models that have it, as the second key after `key`."""
    found = models_by((model, json.dumps(fact)) for model, fact in facts)
    return [{key: None, "models": models} | json.loads(fact) for fact, models in found.items()]


def _bare(register: Register) -> Register:
    """Return the register without what makes no difference to its words and values."""
    return replace(
        register,
        at=0,
        id="",
        path="",
        name="",
        symbol="",
        description="",
        section="",
        group="",
        persistence="",
        rescales="",
        unlock="",
        apply="",
        danger="",
        stays="",
        unit_id="",
        array="",
        aliases=(),
        inferred=(),
        governs=None,
        settle=0,
        page=0,
        reading=PLAIN_READING,
        static=False,
        mandatory=None,
        index=(),
        unit=always(""),
        endurance=None,
        views=tuple(view._replace(offset=0, region=None) for view in register.views),
        enum=register.enum and _bare_enum(register.enum),
        fields=tuple(replace(bits, enum=bits.enum and _bare_enum(bits.enum)) for bits in register.fields),
        span=NOWHERE,
    )


def _bare_enum(enum: Enum) -> Enum:
    return replace(enum, id="", description="", span=NOWHERE)


def _place(model: Model, register: Register) -> Json:
    facts = {view.name: view.space.facts(view.address(register.at)) for view in register.views}
    found: Json = {"path": register.path, "addresses": {name: fact["address"] for name, fact in facts.items()}}
    for key in PARTS:
        if numbers := {name: fact[key] for name, fact in facts.items() if key in fact}:
            found[f"{key}s"] = numbers
    if register.page:
        found["page"] = register.page
        if unit := model.pages[register.page - 1].unit:
            found["unit_id"] = unit
    if register.block:
        found["block"] = register.block
    if register.aliases:
        found["aliases"] = [register.base.space.inside(alias) for alias in register.aliases]
    if register.default is not None:
        found["default"] = register.default if isinstance(register.default, str) else show(register.default)
    if register.mandatory is not None:
        found["mandatory"] = register.mandatory
    return found | ({"static": True} if register.static else {})


def _content(register: Register, plan: Plan) -> Json:
    tried, writable, existence = plan
    views = [view_facts(view) for view in register.views]
    found: Json = {"kind": register.kind.value, "access": register.access.value, "views": views, **_names(register)}
    if writable:
        found["writable"] = [{**surroundings(situation), "allowed": allowed} for situation, allowed in writable]
    if existence:
        found["existence"] = [{**surroundings(situation), "exists": exists} for situation, exists in existence]
    found["cases"] = [
        case_of(register, view, situation)
        for view, several in zip(register.views, tried, strict=True)
        for situation in several
    ]
    return found


def view_facts(view: View) -> Json:
    """Return what a view is, without its address."""
    found: Json = {"name": view.name, "space": view.space.value, "type": view.type.value, "words": view.words}
    found["factor"] = show(view.factor)
    if view.times is not None:
        found["times"] = term_words(view.times)
    if view.rounding is not Rounding.NONE:
        found["rounding"] = view.rounding.value
    if view.saturates:
        found["saturates"] = True
    if view.words > 1 or isinstance(view.order, OrderCases):
        found["word_order"] = _order(view.order)
    if view.functions:
        found["functions"] = list(view.functions)
    return found


def _order(order: WordOrder | OrderCases) -> Json | str | list[int]:
    if not isinstance(order, OrderCases):
        return order.value if isinstance(order, Order) else list(order)
    by_code = order.by_code()
    if by_code is None:
        return {"cases": [{"when": condition_words(when), "is": _order(then)} for when, then in order.cases]}
    return {"register": by_code[0], "codes": {show(code): _order(then) for code, then in by_code[1]}}


def _names(register: Register) -> Json:
    found: Json = {}
    if register.enum is not None:
        found["members"] = _members(register.enum)
        found |= {"other": register.enum.other} if register.enum.other else {}
    if register.specials:
        found["specials"] = [
            {"code": show(special.code), "id": special.id, "label": special.label}
            | ({} if special.means is None else {"means": show(special.means)})
            for special in register.specials
        ]
    if register.sentinels:
        found["faults"] = [
            {"stored": one._replace(high=None).spelled, "id": one.id, "label": one.label}
            | ({} if one.high is None else {"high": show(one.high)})
            for one in register.sentinels
        ]
    if register.fields:
        found["fields"] = [
            {"id": bits.id, "label": bits.label, "low": bits.low, "high": bits.high}
            | ({"members": _members(bits.enum)} if bits.enum else {})
            | _condition(bits.when)
            for bits in register.fields
        ]
    return found


def _members(enum: Enum) -> list[Json]:
    return [
        {"code": member.code, "id": member.id, "label": member.label} | _condition(member.when)
        for member in enum.members
    ]


def _condition(when: Condition) -> Json:
    """Return the condition under which something of a value exists; nothing where it always does."""
    return {} if when.always else {"when": condition_words(when)}
