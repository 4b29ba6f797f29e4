"""What a shell completes: names of devices, models, registers and commands; a mistake completes nothing."""

from collections.abc import Callable, Iterable
from contextlib import suppress

import click
from click.shell_completion import CompletionItem


def complete_target(context: click.Context, _: click.Parameter, typed: str) -> list[CompletionItem]:
    """Names of the configuration, and the starts of links."""
    return _completed(lambda: _targets(context, typed), typed)


def complete_model(context: click.Context, _: click.Parameter, typed: str) -> list[CompletionItem]:
    """Models of the drivers."""
    return _completed(lambda: _models(context), typed)


def complete_register(context: click.Context, _: click.Parameter, typed: str) -> list[CompletionItem]:
    """Registers, groups and arrays of the target's model, once the target is typed and names its model."""
    return _completed(lambda: _registers(context), typed)


def complete_command(context: click.Context, _: click.Parameter, typed: str) -> list[CompletionItem]:
    """Commands of the target's model."""
    return _completed(lambda: _commands(context), typed)


def complete_value(context: click.Context, _: click.Parameter, typed: str) -> list[CompletionItem]:
    """The members or flags of the register that a write names."""
    return _completed(lambda: _values(context), typed)


def _completed(find: Callable[[], Iterable[tuple[str, str]]], typed: str) -> list[CompletionItem]:
    with suppress(Exception):  # a shell shows what a completion prints: it is better to complete nothing
        return [CompletionItem(name, help=said) for name, said in find() if name.startswith(typed)]
    return []


def _targets(context: click.Context, typed: str) -> Iterable[tuple[str, str]]:
    from regscribe.tools.live import config, link_names  # noqa: PLC0415 - a completion must be quick

    if ":" not in typed:
        yield from ((f"{scheme}:", "") for scheme in link_names.SCHEMES)
    for name, entry in config.load(context.params.get("config")).devices.items():
        yield name, entry.note or entry.model


def _models(context: click.Context) -> Iterable[tuple[str, str]]:
    from regscribe.tools.live import catalogue  # noqa: PLC0415 - as above

    return [(one.model, catalogue.title(one)) for one in catalogue.models(tuple(context.params.get("packages") or ()))]


def _registers(context: click.Context) -> Iterable[tuple[str, str]]:
    from regscribe.tools.live import names  # noqa: PLC0415 - as above

    return names.completions(_driver(context))


def _commands(context: click.Context) -> Iterable[tuple[str, str]]:
    from regscribe.tools.live import names  # noqa: PLC0415 - as above

    return [(name, command.danger) for name, command in names.commands_of(_driver(context)).items()]


def _values(context: click.Context) -> Iterable[tuple[str, str]]:
    from regscribe.tools.live import names, value_text  # noqa: PLC0415 - as above

    return [(one, "") for one in value_text.choices(names.register_named(_driver(context), context.params["name"]))]


def _driver(context: click.Context) -> type:
    from regscribe.tools.live import config, target  # noqa: PLC0415 - as above

    given = context.params
    parsed = target.parse(given["target_text"], config.load(given.get("config")))
    found = target.with_packages(parsed, tuple(given.get("packages") or ()))
    return target.override(found, model=given.get("model") or "").known().driver
