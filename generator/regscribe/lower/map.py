"""A whole map: its models one by one, and what it says about itself."""

import keyword
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction

from regscribe.lower.blocks import blocks_of
from regscribe.lower.conditions import condition, condition_of
from regscribe.lower.enums import enum_at
from regscribe.lower.examples import Product, examples_of
from regscribe.lower.idle_keys import report_idle_defaults
from regscribe.lower.models import model_of, scopes_of, stretch_of
from regscribe.lower.node import Value
from regscribe.lower.protocol import faults_of, notes_of, protocol_of
from regscribe.lower.rules import NO_MODULE, UNKNOWN_MEMBER, UNKNOWN_REGISTER
from regscribe.lower.scales import rule_at, scale_at
from regscribe.lower.scope import Scope
from regscribe.lower.subject import subject_of
from regscribe.lower.texts import ends, known_name
from regscribe.lower.units import own_units, unit_at, unit_notes
from regscribe.lower.variants import Keys, named_models
from regscribe.lower.views import set_at
from regscribe.model import (
    Erratum,
    Given,
    GivenKind,
    Identity,
    IdentityRule,
    Manual,
    Notation,
    RegisterMap,
    Space,
    Waiver,
    WireType,
)


def map_of(root: Value) -> RegisterMap:
    """Lower a whole map; its mistakes are in the context of `root`."""
    line = root.mapping_of("protocol")
    protocol = protocol_of(line)
    scopes = scopes_of(root)
    models = dict(root.items_of("models"))
    products = [
        Product(scope, model_of(models[name], root, scope, bundles, protocol))
        for name, (scope, bundles) in scopes.items()
    ]
    report_idle_defaults(root)
    for product in products:
        _lower_tables(root, replace(product.scope, lenient=True))
    about = root.mapping_of("map")
    return RegisterMap(
        id=_module_id(about),
        title=about.text_of("title"),
        maker=about.text_of("maker"),
        class_prefix=about.text_of("class_prefix"),
        source=root.context.document.name,
        content_hash=root.context.document.content_hash,
        manual=Manual(*map(root.mapping_of("manual").text_of, ("title", "number", "date", "publisher"))),
        models=tuple(product.model for product in products),
        protocol=protocol,
        faults=faults_of(line),
        default_unit=line.whole_of("default_unit") if line.child("default_unit") else None,
        spares_memory=line.truth_of("spares_memory"),
        alike=tuple(tuple(map(Value.whole, codes.elements())) for codes in line.elements_of("alike")),
        accepts=tuple((key, limit.whole()) for key, limit in line.items_of("accepts")),
        protocol_notes=notes_of(line),
        description=root.text_of("description"),
        notations=tuple(map(_notation, root.elements_of("notations"))),
        givens=tuple(_given(node, products) for _, node in root.items_of("givens")),
        blocks=blocks_of(root),
        reserved=tuple(map(stretch_of, root.elements_of("reserved"))),
        identity=tuple(_identity(root, products)),
        errata=tuple(
            Erratum(*map(node.text_of, ("where", "printed", "read", "why"))) for node in root.elements_of("errata")
        ),
        examples=examples_of(root, products),
        waivers=tuple(map(_waiver, root.elements_of("waivers"))),
        notes=root.texts_of("notes"),
        unit_symbols=own_units(root),
        unit_notes=unit_notes(root),
        span=about.mapping_of("id").span,
    )


def _module_id(about: Value) -> str:
    """The id of a map, each part of which becomes a part of a module's name; RS0335 where none can."""
    map_id = about.text_of("id")
    for part in map_id.split("/"):
        if keyword.iskeyword(part):
            message = f"`{part}` is a Python keyword: `import regscribe_devices.{map_id.replace('/', '.')}` cannot be"
            about.mapping_of("id").report(NO_MODULE, message, remedy=f"give another id, for example `{part}-1`")
    return map_id


def _notation(node: Value) -> Notation:
    space, base = node.choice_of("space", Space.HOLDING), node.whole_of("base", 10)
    return Notation(node.text_of("name"), space, node.whole_of("offset"), base)


def _given(node: Value, products: list[Product]) -> Given:
    """A fact from elsewhere that a program must give; RS0301 where it is about an unknown register."""
    register, owners = node.child("register"), products[0].scope.owners if products else {}
    stated = node.child("range")
    low, high = ends(stated) if stated else (None, None)
    return Given(
        id=node.key,
        kind=node.choice_of("type", GivenKind.CODES),
        description=node.text_of("description"),
        reason=node.text_of("reason"),
        register=known_name(register, UNKNOWN_REGISTER, "register", owners) if register else "",
        choices=node.texts_of("choices"),
        low=low,
        high=high,
        default=_default(node),
        span=node.key_span,
    )


def _default(node: Value) -> Fraction | str | None:
    """The default of a given; RS0305 where it is none of the choices."""
    default = node.child("default")
    if default is None:
        return None
    choices = node.texts_of("choices")
    return known_name(default, UNKNOWN_MEMBER, "choice", choices) if choices else default.number()


def _waiver(node: Value) -> Waiver:
    span = (node.child("rule") or node).span
    return Waiver(node.text_of("rule"), node.text_of("at"), node.text_of("reason"), span)


def _identity(root: Value, products: list[Product]) -> Iterator[IdentityRule]:
    """What tells models from others, as it reads on the first of them; nothing where none is named."""
    for node in root.elements_of("identify"):
        models = named_models(node.elements_of("models"), tuple(product.scope.model for product in products))
        found = []
        for scope in (product.scope for product in products if product.scope.model in models):
            when = condition_of(node, scope)
            texts = [(subject_of(text, key, scope), text.text()) for key, text in node.items_of("text")]
            paths = tuple((subject.entry.path, text) for subject, text in texts if subject)
            found.append(IdentityRule(Identity(when, paths), models))
        yield from found[:1]


def _lower_tables(root: Value, scope: Scope) -> None:
    """Lower every named thing of the map for one model and forget it; the mistakes stay in the context.

    What a library or a base declares may be for other maps: there only what is used counts.
    """
    for _, node in _own(root, "conditions"):
        condition(node, scope)
    for name, node in _own(root, "enums"):
        enum_at(node, scope, name, condition)
    for _, node in _own(root, "views"):
        set_at(node, Space.HOLDING, Keys(), scope)
    for _, node in _own(root, "decimals"):
        rule_at(node, scope)
    for _, node in _own(root, "scales"):
        scale_at(node, WireType.INT16, scope)
    for _, node in _own(root, "units"):
        if node.is_list:
            unit_at(node, scope)


def _own(root: Value, table: str) -> list[tuple[str, Value]]:
    return [(name, node) for name, node in root.items_of(table) if node.span.file == root.context.document.name]
