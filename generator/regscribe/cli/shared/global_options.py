"""Options that stand before or after the name of any command: how much is said, and in which colours."""

import click

from regscribe import __version__

COLORS = ("auto", "always", "never")


def _keep(context: click.Context, option: click.Parameter, value: object) -> None:
    """Keep the value of a global option for the whole run. Raises click.UsageError for -q with -v."""
    if value:
        context.meta[f"{__name__}.{option.name}"] = value
    if _chosen("quiet", context) and _chosen("verbose", context):
        message = "--quiet and --verbose contradict each other: choose one"
        raise click.UsageError(message, context)


def _chosen(name: str, context: click.Context | None = None) -> object:
    context = context or click.get_current_context(silent=True)
    return context.meta.get(f"{__name__}.{name}") if context else None


def is_quiet() -> bool:
    """Whether results, findings and errors are all that is said."""
    return bool(_chosen("quiet"))


def is_verbose() -> bool:
    """Whether files, configuration and times are told as well."""
    return bool(_chosen("verbose"))


def color() -> str:
    """The word of --color; `auto` where it is not given."""
    return str(_chosen("color") or COLORS[0])


def _options(*, hidden: bool) -> list[click.Option]:
    """Fresh global options; those that are for all of regscribe are `hidden` in the help of one command."""
    version = click.version_option(__version__, "-V", "--version", message="%(prog)s %(version)s", hidden=hidden)
    made = click.Command("", params=[])
    version(made)
    flag = {"is_flag": True, "is_eager": True, "expose_value": False, "callback": _keep}
    return [
        click.Option(["-q", "--quiet"], help="Say results, findings and errors only.", **flag),  # type: ignore[arg-type]  # of the dict
        click.Option(["-v", "--verbose"], help="Tell on standard error which files are read, and times.", **flag),  # type: ignore[arg-type]  # as above
        click.Option(
            ["--color"],
            type=click.Choice(COLORS),
            is_eager=True,
            expose_value=False,
            callback=_keep,
            help="Colours; wins over NO_COLOR, FORCE_COLOR, the terminal and TERM.",
        ),
        click.Option(
            ["--debug"],
            envvar="REGSCRIBE_DEBUG",
            hidden=hidden,
            help="Show the traceback of an internal error.",
            **flag,  # type: ignore[arg-type]  # as above
        ),
        *(param for param in made.params if isinstance(param, click.Option)),
    ]


def with_global_options(command: click.Command, *, hidden: bool = True) -> click.Command:
    """The command, and those below it, with the global options behind its own; harmless twice."""
    if not any("--quiet" in param.opts for param in command.params):
        command.params += _options(hidden=hidden)
    if isinstance(command, click.Group):
        for below in command.commands.values():
            with_global_options(below)
    return command
