"""What a shell completes: names of devices, models, registers and commands; a mistake completes nothing."""

from collections.abc import Callable, Iterable
from contextlib import suppress

import click
from click.shell_completion import CompletionItem

Finder = Callable[[click.Context, str], Iterable[tuple[str, str]]]
"""Names with a hint for each, in the context of what is typed already; the text is what the name begins with."""

Completer = Callable[[click.Context, click.Parameter, str], list[CompletionItem]]
"""What click calls to complete a parameter."""


def _completer(find: Finder) -> Completer:
    def complete(context: click.Context, _: click.Parameter, typed: str) -> list[CompletionItem]:
        with suppress(Exception):  # a shell shows what a completion prints: it is better to complete nothing
            return [CompletionItem(name, help=said) for name, said in find(context, typed) if name.startswith(typed)]
        return []

    return complete


@_completer
def complete_target(context: click.Context, typed: str) -> Iterable[tuple[str, str]]:
    """Names of the configuration, and the starts of links."""
    from regscribe.tools.live import config, link_names  # noqa: PLC0415 - a completion must be quick

    if ":" not in typed:
        yield from ((f"{scheme}:", "") for scheme in link_names.SCHEMES)
    for name, entry in config.load(context.params.get("config")).devices.items():
        yield name, entry.note or entry.model


@_completer
def complete_model(context: click.Context, _: str) -> Iterable[tuple[str, str]]:
    """Models of the drivers."""
    from regscribe.tools.live import catalogue  # noqa: PLC0415 - as above

    return [(one.model, catalogue.title(one)) for one in catalogue.models(tuple(context.params.get("packages") or ()))]


@_completer
def complete_register(context: click.Context, _: str) -> Iterable[tuple[str, str]]:
    """Registers, groups and arrays of the target's model, once the target is typed and names its model."""
    from regscribe.tools.live import names  # noqa: PLC0415 - as above

    return names.completions(_driver(context))


@_completer
def complete_command(context: click.Context, _: str) -> Iterable[tuple[str, str]]:
    """Commands of the target's model."""
    from regscribe.tools.live import names  # noqa: PLC0415 - as above

    return [(name, command.danger) for name, command in names.commands_of(_driver(context)).items()]


@_completer
def complete_value(context: click.Context, _: str) -> Iterable[tuple[str, str]]:
    """The members or flags of the register that a write names."""
    from regscribe.tools.live import names, value_text  # noqa: PLC0415 - as above

    return [(one, "") for one in value_text.choices(names.register_named(_driver(context), context.params["name"]))]


def _driver(context: click.Context) -> type:
    from regscribe.tools.live import target  # noqa: PLC0415 - as above

    given = context.params
    found = target.named(given["target_text"], given.get("config"), tuple(given.get("packages") or ()))
    return target.override(found, model=given.get("model") or "").known().driver
