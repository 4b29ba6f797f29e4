"""The `regscribe` command: its table of commands, and the exit code and message of every exception.

The codes stand in `exit_codes`.
"""

import gc
import os
import sys
import traceback
from collections.abc import Sequence
from contextlib import suppress
from difflib import get_close_matches
from importlib import import_module
from pathlib import Path
from time import perf_counter
from typing import NoReturn, TextIO

import click
from click.shell_completion import CompletionItem

from regscribe import __version__
from regscribe.cli.shared.exit_codes import CLOSED_PIPE, INTERNAL, INTERRUPTED, OUTPUT, USAGE
from regscribe.cli.shared.global_options import with_global_options
from regscribe.cli.shared.output import detail
from regscribe.visible import safe, safe_lines

COMMANDS = {
    "check": "Report what is wrong in maps.",
    "fmt": "Lay out maps in their canonical form.",
    "generate": "Compile maps to drivers, reference docs, test vectors and tests.",
    "explain": "Explain a rule, with a bad and a good example, or list all rules.",
    "new": "Start a map: a commented skeleton that passes `check`.",
    "import": "Make a map of a table of registers or of another program's configuration.",
    "export": "Print what maps say in the form of another program, and what that form cannot say.",
    "browse": "Make one HTML file that searches registers and calculates raw <-> value.",
    "site": "Make a static site of maps: searchable references, register browser, own pages.",
    "compare": "Hold a map against a second transcription in CSV, or against another map.",
    "breaking": "Say what changed between two versions of maps, and what it breaks.",
    "coverage": "Count what maps cover; list what is inferred and open.",
    "simulate": "Serve models of maps as Modbus devices.",
    "plan": "Show which requests read registers at the least cost, and why.",
    "devices": "List the models that drivers exist for, and those of the maps here.",
    "scan": "Find the units on a line or behind a gateway.",
    "identify": "Ask a device what it is.",
    "read": "Read registers of a device, by name and with units.",
    "write": "Write one register of a device.",
    "dump": "Read everything that a device holds.",
    "watch": "Follow values as they change; chart and log them.",
    "command": "Make a device act, or list what it can be told to do.",
    "backup": "Keep all settings of a device in a file.",
    "restore": "Bring a device to the settings of a backup.",
    "diff": "Show what differs between devices, backups and the manual's defaults.",
    "clone": "Copy the settings of one device to others.",
    "program": "Setpoint programs of a controller: read, draw, check, write and run them.",
    "decode": "Say in names what captured frames mean.",
    "lsp": "Serve an editor: findings while typing, completion, hover, renaming.",
    "man": "Write manual pages for man(1).",
    "completion": "Let a shell complete commands, devices and registers.",
}
"""Name and help of each command, whose module `regscribe.cli.commands.<name>` is imported only to run it."""

MOST_TEXT = 300
"""Most characters of an error's own text that are shown: it may hold a whole map."""


class ClosedPipeError(Exception):
    """The reader of the output went away; click would hide a BrokenPipeError behind an exit code of its own."""


class ClosedOutputError(click.ClickException):
    """There is no standard output."""

    exit_code = OUTPUT


class LazyCommands(click.Group):
    """A group that imports a command only to run it, so that `--version` and `--help` stay quick."""

    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002 - click's signature
        """Name the commands in the order of use."""
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:  # noqa: ARG002 - click's signature
        """Import one command; None if there is none of that name."""
        if cmd_name not in COMMANDS:
            return None
        command: click.Command = import_module(f"regscribe.cli.commands.{cmd_name}").command
        return with_global_options(command)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:  # noqa: ARG002 - click's
        """List the commands from the table, without importing them."""
        with formatter.section("Commands"):
            formatter.write_dl(list(COMMANDS.items()))

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Refuse the character NUL, which no name holds, before the many errors that Python raises for it."""
        if any("\0" in argument for argument in args):
            message = "an argument holds the character NUL"
            raise click.UsageError(message, ctx)
        return super().parse_args(ctx, args)

    def invoke(self, ctx: click.Context) -> object:
        """Run the command; ClosedPipeError if nobody reads its output any more."""
        started = perf_counter()
        try:
            result: object = super().invoke(ctx)
            sys.stdout.flush()
            detail(f"done in {perf_counter() - started:.2f} s")
        except BrokenPipeError:
            raise ClosedPipeError from None
        return result

    def shell_complete(self, ctx: click.Context, incomplete: str) -> list[CompletionItem]:
        """Complete the commands from the table, without importing them."""
        items = [CompletionItem(name, help=about) for name, about in COMMANDS.items() if name.startswith(incomplete)]
        return items or click.Command.shell_complete(self, ctx, incomplete)

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Find the command, or say which one was probably meant."""
        if args and args[0] not in COMMANDS and not args[0].startswith("-"):
            near = get_close_matches(args[0], COMMANDS, n=1)
            hint = f"; did you mean `{near[0]}`?" if near else f"; there are {', '.join(COMMANDS)}"
            message = f"no command `{args[0]}`{hint}"
            raise click.UsageError(message, ctx)
        return super().resolve_command(ctx, args)


@click.group(
    cls=LazyCommands,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
    epilog="Example: regscribe check maps/",
)
def regscribe() -> None:
    """Compile Modbus register maps: one YAML file becomes typed drivers, docs, test vectors and a simulator."""


with_global_options(regscribe, hidden=False)


def main() -> NoReturn:
    """Run the command line and exit with its code."""
    code = run(sys.argv[1:])
    gc.freeze()  # the interpreter would search all that is left for cycles once more; the process ends anyway
    sys.exit(code)


def run(arguments: Sequence[str]) -> int:
    """Run one command line; return its exit code. Raises nothing but SystemExit."""
    for stream in (sys.stdout, sys.stderr):
        # a map may hold any character, and Windows would end lines with \r\n, in files that a command prints, too
        getattr(stream, "reconfigure", lambda **_: None)(errors="backslashreplace", newline="\n")
    try:
        return _carry_out(arguments)
    except (click.Abort, KeyboardInterrupt):
        return INTERRUPTED
    except (BrokenPipeError, ClosedPipeError):
        _forget_output()
        return CLOSED_PIPE
    except OSError as error:
        return _refused_by_the_system(error)
    except Exception as error:  # noqa: BLE001 - the last resort: a user never sees a bare traceback
        return _internal_error(error, debug="--debug" in arguments or bool(os.environ.get("REGSCRIBE_DEBUG")))


def _carry_out(arguments: Sequence[str]) -> int:
    """Run one command line and show its error, which can fail as all output can; return its exit code."""
    try:
        _replace_closed_streams()
        code = regscribe.main(list(arguments), prog_name="regscribe", standalone_mode=False)
    except click.ClickException as error:
        vars(error)["message"] = safe_lines(error.message)  # click calls it final
        error.show()
        code = error.exit_code
    sys.stdout.flush()
    return code if isinstance(code, int) else 0


def _replace_closed_streams() -> None:
    """Open the null device for standard streams that are closed (None in Python); ClosedOutputError without an output.

    In this order each takes its own number, so that no port or file is opened under the number of a stream.
    """
    closed = [name for name in ("stdin", "stdout", "stderr") if getattr(sys, name) is None]
    for name in closed:
        mode = "r" if name == "stdin" else "w"
        setattr(sys, name, Path(os.devnull).open(mode, errors="backslashreplace"))  # noqa: SIM115 - open to the end
    if "stdout" in closed:
        message = "standard output is closed, so nothing was done"
        raise ClosedOutputError(message)


def _forget_output(stream: TextIO | None = None) -> None:
    """Keep the interpreter from flushing a stream (standard output) once more when it ends."""
    with suppress(OSError, ValueError):  # no file, as in a test
        os.dup2(os.open(os.devnull, os.O_WRONLY), (stream or sys.stdout).fileno())


def _refused_by_the_system(error: OSError) -> int:
    """Print where the system refused, and why: a full disk, a name that is too long, a file that may not be read."""
    if error.filename is None:
        _forget_output()
    where = "standard output" if error.filename is None else os.fsdecode(error.filename)
    try:
        click.ClickException(safe(f"{where[:MOST_TEXT]}: {error.strerror or error}")).show()
    except OSError:  # standard error is what is full: nothing can be said, but for the exit code
        _forget_output(sys.stderr)
    return OUTPUT if error.filename is None else USAGE


def _internal_error(error: Exception, *, debug: bool) -> int:
    if debug:
        traceback.print_exception(error)
        return INTERNAL
    last = traceback.extract_tb(error.__traceback__)[-1]
    where = f"{Path(last.filename).name}:{last.lineno}"
    what = safe(f"{type(error).__name__}: {error}"[:MOST_TEXT])
    click.echo(
        f"regscribe {__version__}: internal error: {what} ({where})\n"
        "This is a bug in regscribe, not in your map. Please report it with the command line, the map and the\n"
        "output of the same command with `regscribe --debug ...`.",
        err=True,
    )
    return INTERNAL
