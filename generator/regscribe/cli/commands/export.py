"""`regscribe export`: what maps say in the form of an exporter, a plug-in with options of its own."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import click

from regscribe import plugins
from regscribe.cli.shared.compiled_maps import compiled_maps
from regscribe.cli.shared.map_arguments import find_maps
from regscribe.cli.shared.output import raised_as, tell
from regscribe.emit.write import WriteError, write
from regscribe.plugins import EXPORTERS, Exporter, Option, OptionError, PluginError
from regscribe.visible import safe

OWN = "option_"
"""Begins the name of the parameter that holds an option of an exporter: `--with` would be a keyword of Python."""


class ExportCommand(click.Command):
    """The command with a choice of all exporters, and with their options."""

    def get_params(self, ctx: click.Context) -> list[click.Parameter]:
        """Return the parameters, with those of the exporters, which are loaded once a run."""
        found: list[click.Parameter] = ctx.meta.setdefault(__name__, []) or _parameters()
        ctx.meta[__name__] = found
        return [*found, *super().get_params(ctx)]

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Parse the arguments; the error for an unknown option names broken exporters, which may have it."""
        try:
            return super().parse_args(ctx, args)
        except click.NoSuchOption as error:
            broken = [fault for name in plugins.names(EXPORTERS) if isinstance(fault := _loaded(name), PluginError)]
            raise click.UsageError("\n".join([error.format_message(), *map(str, broken)]), ctx) from None


def _parameters() -> list[click.Parameter]:
    with raised_as(click.ClickException, PluginError):
        names = plugins.names(EXPORTERS)
    if not names:
        message = "no exporter is installed, not even those of regscribe: install regscribe anew"
        raise click.ClickException(message)
    working = {name: one for name in names if not isinstance(one := _loaded(name), PluginError)}
    about = "; ".join(f"{safe(name)}: {safe(one.summary)}" for name, one in working.items())
    choice = click.Option(["--format", "form"], type=click.Choice([*map(safe, names)]), required=True, help=f"{about}.")
    options = [option.name for one in working.values() for option in one.options]
    return [choice, *(_parameter(option, working) for option in dict.fromkeys(options))]


def _loaded(name: str) -> Exporter | PluginError:
    """The exporter of that name, or the error of one that is broken, which is not raised before it is asked for."""
    try:
        return plugins.exporter(name)
    except PluginError as error:
        return error


def _parameter(name: str, exporters: Mapping[str, Exporter]) -> click.Option:
    having = [(who, option) for who, one in exporters.items() for option in one.options if option.name == name]
    help_texts = []
    for exporter, option in having:
        default = f"  [default: {option.default}]" if option.default else ""
        help_texts.append(safe(f"{exporter}: {option.help}{default}"))
    return click.Option(
        [f"--{name}", f"{OWN}{name.replace('-', '_')}"],
        multiple=True,
        metavar=safe(having[0][1].metavar),
        help="  ".join(help_texts),
    )


@click.command(
    cls=ExportCommand,
    epilog="Example: regscribe export fdc/series-100 --format csv > series-100.csv\n\n"
    "regscribe export athena/series-c --format collectd --model 16C --at 10.0.0.7:502 > modbus.conf\n\n"
    "Exit code 0: done, 1: errors in a map or a broken exporter (nothing is printed to standard output), "
    "2: wrong usage.",
)
@click.argument("maps", nargs=-1, metavar="[MAP]...")
@click.option("--out", type=click.Path(path_type=Path), metavar="DIR", help="Where files go that an exporter makes.")
def command(*, maps: tuple[str, ...], form: str, out: Path | None, **own_options: tuple[str, ...]) -> None:
    """Print what maps say in the form of an exporter: every value as CSV, the whole model as JSON, and others.

    MAP is a map file, a folder that is searched for *.yaml, or the id of a map (fdc/series-100). Without MAP: maps/.
    The format collectd takes one MAP and a --model. Plug-ins bring further formats (docs/plugins.md).
    """
    with raised_as(click.ClickException, PluginError), raised_as(click.UsageError, OptionError):
        options = _options(plugins.exporter(form), own_options)
        register_maps = compiled_maps(find_maps(maps), nothing="nothing was exported")
        _put(form, plugins.export(form, register_maps, options), out)


def _options(exporter: Exporter, parameters: Mapping[str, Sequence[str]]) -> dict[str, str]:
    """Return the value of each option of an exporter; those of others are refused."""
    given = {name.removeprefix(OWN).replace("_", "-"): texts for name, texts in parameters.items() if texts}
    own = {option.name: option for option in exporter.options}
    if foreign := [f"--{name}" for name in given if name not in own]:
        message = f"{', '.join(foreign)}: the format {exporter.name} takes no such option"
        raise OptionError(message)
    return {name: _value(option, given.get(name, ())) for name, option in own.items()}


def _value(option: Option, texts: Sequence[str]) -> str:
    return ("\n".join(texts) if option.several else texts[-1]) if texts else option.default


def _put(form: str, texts: Mapping[str, str], out: Path | None) -> None:
    """Print the text for standard output, and write the files below `out`."""
    files = {path: text for path, text in texts.items() if path}
    if files and out is None:
        message = f"the format {form} makes files: say with --out in which folder"
        raise OptionError(message)
    try:
        if files and out is not None:
            write(files, out)
    except WriteError as error:
        message = f"the exporter {form}: {error}"
        raise PluginError(message) from None
    tell(texts.get("", ""))
