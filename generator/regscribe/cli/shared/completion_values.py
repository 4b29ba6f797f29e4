"""What a shell completes: names of devices, models, registers, commands and rules; a mistake completes nothing."""

from collections.abc import Callable, Iterable
from contextlib import suppress

import click
from click.shell_completion import CompletionItem

from regscribe.map_files import LOCAL, ids_in, shipped
from regscribe.tools.live import catalogue, config, link_names, names, target, value_text

Finder = Callable[[click.Context, str], Iterable[tuple[str, str]]]
"""Yields names with a hint for each, from the parameters before the one to complete and its first letters."""

Completer = Callable[[click.Context, click.Parameter, str], list[CompletionItem]]
"""What click calls to complete a parameter."""


def _completer(find: Finder) -> Completer:
    def complete(context: click.Context, _: click.Parameter, typed: str) -> list[CompletionItem]:
        with suppress(Exception):  # a shell shows what a completion prints: it is better to complete nothing
            return [CompletionItem(name, help=hint) for name, hint in find(context, typed) if name.startswith(typed)]
        return []

    return complete


@_completer
def complete_target(context: click.Context, typed: str) -> Iterable[tuple[str, str]]:
    """Names of the configuration, and the starts of links."""
    if ":" not in typed:
        yield from ((f"{scheme}:", "") for scheme in link_names.SCHEMES)
    for name, entry in config.load(context.params.get("config")).devices.items():
        yield name, entry.note or entry.model


@_completer
def complete_model(context: click.Context, _: str) -> Iterable[tuple[str, str]]:
    """Models of the drivers."""
    return [(one.model, catalogue.title(one)) for one in catalogue.models(tuple(context.params.get("packages") or ()))]


def complete_map(_context: click.Context, _parameter: click.Parameter, typed: str) -> list[CompletionItem]:
    """Ids of maps, here and shipped; files where no id begins so."""
    with suppress(Exception):  # as above
        if found := [one for one in sorted(set(ids_in((LOCAL, shipped())))) if one.startswith(typed)]:
            return [CompletionItem(one) for one in found]
    return [CompletionItem(typed, type="file")]


@_completer
def complete_rule(_context: click.Context, _: str) -> Iterable[tuple[str, str]]:
    """Ids of rules."""
    from regscribe.checks import catalogue as rules  # noqa: PLC0415 - the compiler, which no live command waits for

    return [(rule.id, rule.title) for rule in rules.all_rules()]


@_completer
def complete_register(context: click.Context, _: str) -> Iterable[tuple[str, str]]:
    """Registers, groups and arrays of the target's model, once the target is typed and names its model."""
    return names.completions(_driver(context))


@_completer
def complete_command(context: click.Context, _: str) -> Iterable[tuple[str, str]]:
    """Commands of the target's model."""
    return [(name, command.danger) for name, command in names.commands_of(_driver(context)).items()]


@_completer
def complete_value(context: click.Context, _: str) -> Iterable[tuple[str, str]]:
    """The members or flags of the register that a write names."""
    return [(one, "") for one in value_text.choices(names.register_named(_driver(context), context.params["name"]))]


def _driver(context: click.Context) -> type:
    options = context.params
    named = target.named(options["target_text"], options.get("config"), tuple(options.get("packages") or ()))
    return target.override(named, model=options.get("model") or "").known().driver
