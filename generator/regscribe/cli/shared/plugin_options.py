"""Commands whose options come from plug-ins: `export` has those of all exporters, `import` those of all importers."""

from collections.abc import Mapping, Sequence
from typing import Any

import click

from regscribe import plugins
from regscribe.cli.shared.output import raised_as
from regscribe.plugins import Exporter, Importer, Option, OptionError, PluginError
from regscribe.visible import safe

OWN = "option_"
"""Begins the name of the parameter that holds an option of a plug-in: `--with` would be a keyword of Python."""

Plugin = Exporter | Importer


class PluginCommand(click.Command):
    """A command with a choice of all plug-ins of `group`, and with their options."""

    group = plugins.EXPORTERS
    format_required = True

    def get_params(self, ctx: click.Context) -> list[click.Parameter]:
        """Return the parameters, with those of the plug-ins, which are loaded once a run."""
        found: list[click.Parameter] = ctx.meta.setdefault(f"{__name__}.{self.name}", []) or self._parameters()
        ctx.meta[f"{__name__}.{self.name}"] = found
        return [*found, *super().get_params(ctx)]

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Parse the arguments; the error for an unknown option names broken plug-ins, which may have it."""
        try:
            return super().parse_args(ctx, args)
        except click.NoSuchOption as error:
            names = plugins.names(self.group)
            broken = [fault for name in names if isinstance(fault := self._loaded(name), PluginError)]
            raise click.UsageError("\n".join([error.format_message(), *map(str, broken)]), ctx) from None

    def _parameters(self) -> list[click.Parameter]:
        with raised_as(click.ClickException, PluginError):
            names = plugins.names(self.group)
        if not names:
            message = (
                f"no {plugins.KINDS[self.group]} is installed, not even those of regscribe: install regscribe anew"
            )
            raise click.ClickException(message)
        working = {name: one for name in names if not isinstance(one := self._loaded(name), PluginError)}
        about = "; ".join(f"{safe(name)}: {safe(one.summary)}" for name, one in working.items())
        type_ = click.Choice([*map(safe, names)])
        choice = click.Option(["--format", "form"], type=type_, required=self.format_required, help=f"{about}.")
        options = [option.name for one in working.values() for option in one.options]
        return [choice, *(_parameter(option, working) for option in dict.fromkeys(options))]

    def _loaded(self, name: str) -> Plugin | PluginError:
        """The plug-in of that name, or the error of one that is broken, which is not raised before it is asked for."""
        try:
            return plugins.exporter(name) if self.group == plugins.EXPORTERS else plugins.importer(name)
        except PluginError as error:
            return error


def _parameter(name: str, having: Mapping[str, Plugin]) -> click.Option:
    """The option of that name; where several plug-ins have it, each is told with what it means by it."""
    own = [(who, option) for who, one in having.items() for option in one.options if option.name == name]
    meanings: dict[str, list[str]] = {}
    for who, option in own:
        default = f"  [default: {option.default}]" if option.default else ""
        meanings.setdefault(safe(f"{option.help}{default}"), []).append(safe(who))
    everybody = len(meanings) == 1 and len(own) > MOST_NAMED
    texts = [text if everybody else f"{', '.join(who)}: {text}" for text, who in meanings.items()]
    return click.Option(
        [f"--{name}", f"{OWN}{name.replace('-', '_')}"],
        multiple=True,
        metavar=safe(own[0][1].metavar),
        help="  ".join(texts),
    )


MOST_NAMED = 3
"""An option that more plug-ins share, with one meaning, is told without their names."""


def own_options(
    plugin: Plugin, parameters: Mapping[str, Any], kept: Mapping[str, Sequence[str]] | None = None
) -> dict[str, str]:
    """Return the value of each option of a plug-in; a file has `kept` some. Raises OptionError for those of others."""
    given = {name.removeprefix(OWN).replace("_", "-"): texts for name, texts in parameters.items() if texts}
    given = {**(kept or {}), **given}
    own = {option.name: option for option in plugin.options}
    if foreign := [f"--{name}" for name in given if name not in own]:
        message = f"{', '.join(foreign)}: the format {plugin.name} takes no such option"
        raise OptionError(message)
    return {name: _value(option, given.get(name, ())) for name, option in own.items()}


def _value(option: Option, texts: Sequence[str]) -> str:
    return ("\n".join(texts) if option.several else texts[-1]) if texts else option.default
