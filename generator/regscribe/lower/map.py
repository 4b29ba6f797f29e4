"""A whole map: its models one by one, and what stands around them."""

from dataclasses import replace

from regscribe.lower.commands import CommandScope, commands_of
from regscribe.lower.conditions import condition
from regscribe.lower.enums import enum_at
from regscribe.lower.examples import Product, examples_of
from regscribe.lower.idle_keys import report_untaken
from regscribe.lower.map_header import (
    errata_of,
    givens_of,
    manual_of,
    notations_of,
    reserved_of,
    unused_of,
    waivers_of,
)
from regscribe.lower.members import Bundle, bundles_of, groups_of, members_of
from regscribe.lower.names import letters_and_digits, module_id
from regscribe.lower.node import Value, elements_of, items_of, text_of, texts_of
from regscribe.lower.process import process_of
from regscribe.lower.programs import programs_of
from regscribe.lower.protocol import device_facts, protocol_of
from regscribe.lower.scales import rule_at, scale_at
from regscribe.lower.scope import Scope
from regscribe.lower.subject import subject_of
from regscribe.lower.units import cases_at, own_symbols
from regscribe.lower.variants import Models, named_models
from regscribe.lower.views import Home, set_at
from regscribe.model import Identity, IdentityRule, Model, Protocol, RegisterMap, Space, WireType


def map_of(root: Value) -> RegisterMap:
    """Lower a whole map; its mistakes are in the context of `root`."""
    protocol = protocol_of(root.child("protocol"))
    scopes, bundles = _scopes(root)
    products = [_product(root, scope, bundles[scope.model], protocol) for scope in scopes]
    report_untaken(root)
    for scope in scopes:
        _look_at_tables(root, replace(scope, lenient=True))
    about = root.child("map") or root
    return RegisterMap(
        id=module_id(about),
        title=text_of(about, "title"),
        maker=text_of(about, "maker"),
        class_prefix=text_of(about, "class_prefix"),
        source=root.context.document.name,
        content_hash=root.context.document.content_hash,
        manual=manual_of(root.child("manual")),
        models=tuple(model for model, _ in products),
        protocol=protocol,
        **device_facts(root.child("protocol")),
        description=text_of(root, "description"),
        notations=notations_of(root),
        givens=givens_of(root, scopes[0].homes if scopes else {}),
        reserved=reserved_of(root),
        identity=tuple(rule for node in elements_of(root, "identify") for rule in _identity(node, scopes)),
        errata=errata_of(root),
        examples=examples_of(root, [product for _, product in products]),
        waivers=waivers_of(root),
        notes=texts_of(root, "notes"),
        unit_symbols=own_symbols(root),
        span=(about.child("id") or about).span,
    )


def _scopes(root: Value) -> tuple[list[Scope], dict[str, list[Bundle]]]:
    """The names of each model, all of them before any register gets a meaning: registers refer to each other."""
    models = tuple(name for name, _ in items_of(root, "models"))
    bundles = {model: bundles_of(root, model, models) for model in models}
    homes: dict[str, Models] = {}
    entries = {}
    for model in models:
        entries[model] = {entry.path: entry for bundle in bundles[model] for entry in bundle.entries}
        for path in entries[model]:
            homes[path] = (*homes.get(path, ()), model)
    return [Scope(root, model, models, entries[model], homes) for model in models], bundles


def _product(root: Value, scope: Scope, bundles: list[Bundle], protocol: Protocol) -> tuple[Model, Product]:
    items = tuple(item for bundle in bundles for item in bundle.items)
    members, registers = members_of(items, scope)
    by_path = {register.path: register for register in registers}
    device = CommandScope(scope, by_path, protocol)
    commands = commands_of(root, device)
    node = next(node for name, node in items_of(root, "models") if name == scope.model)
    programs = programs_of(root, device)
    model = Model(
        name=scope.model,
        class_name=_class_name(root, node, scope.model),
        description=text_of(node, "description"),
        members=members,
        registers=registers,
        groups=groups_of(bundles, root),
        commands=commands,
        programs=tuple(program for program, _ in programs),
        program_notes=tuple(notes for _, notes in programs),
        process=process_of(root.child("process"), scope),
        unused=unused_of(root, scope),
        span=node.key_span,
    )
    return model, Product(scope, by_path, tuple(command.id for command in commands))


def _class_name(root: Value, node: Value, model: str) -> str:
    prefix = text_of(root.child("map") or root, "class_prefix")
    return text_of(node, "class") or f"{prefix}{letters_and_digits(model)}"


def _identity(node: Value, scopes: list[Scope]) -> list[IdentityRule]:
    every = tuple(scope.model for scope in scopes)
    models = named_models(elements_of(node, "models"), every)
    mine = [scope for scope in scopes if scope.model in models]
    conditions = [condition(node.child("when"), scope) for scope in mine]
    texts = [_identity_texts(node.child("text"), scope) for scope in mine]
    return [IdentityRule(Identity(conditions[0], texts[0]), models)] if conditions else []


def _identity_texts(node: Value | None, scope: Scope) -> tuple[tuple[str, str], ...]:
    found = [(subject_of(text, key, scope), text.text()) for key, text in (node.items() if node else ())]
    return tuple((subject.entry.path, text) for subject, text in found if subject)


def _look_at_tables(root: Value, scope: Scope) -> None:
    """Lower every named thing of the map for one model and forget it; the mistakes stay in the context.

    What a library or a base declares may be for other maps: there only what is used counts.
    """
    for _, node in _own(root, "conditions"):
        condition(node, scope)
    for name, node in _own(root, "enums"):
        enum_at(node, scope, name)
    for _, node in _own(root, "views"):
        set_at(node, Home(Space.HOLDING, length=1), scope)
    for _, node in _own(root, "decimals"):
        rule_at(node, scope)
    for _, node in _own(root, "scales"):
        scale_at(node, WireType.INT16, scope)
    for _, node in _own(root, "units"):
        if node.is_list:
            cases_at(node, scope)


def _own(root: Value, table: str) -> list[tuple[str, Value]]:
    return [(name, node) for name, node in items_of(root, table) if node.span.file == root.context.document.name]
