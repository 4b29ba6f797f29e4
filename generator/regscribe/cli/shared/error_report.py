"""Errors of live commands as one clear message, an exit code for scripts, and JSON where it was asked for.

Exit codes: 0 done, 1 the device refuses or something differs, 2 the command line or a name in it is wrong,
3 nobody answers (or the link was lost, or the port cannot be opened), 4 a write broke off and what the device holds is
not known, 130 Ctrl-C.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import IO, Any

import click

from regscribe.cli.shared.output import tell
from regscribe.tools.live.errors import TargetError
from regscribe.visible import json_text
from regscribe_runtime import ExceptionAnswer, LinkLost, NoAnswer, PartialWrite, RegscribeError
from regscribe_runtime.errors import GATEWAY, LeftAt, NotApplied, NotConfigured, ReadBackDiffers, WriteUnknown

REFUSED, USAGE, SILENT, UNKNOWN_STATE = 1, 2, 3, 4

UNSETTLED = (PartialWrite, WriteUnknown, ReadBackDiffers, NotApplied, NotConfigured, LeftAt)
"""Errors after which the device does not hold what it held, or nobody knows; some of them are NoAnswer, too."""


class Failure(click.ClickException):
    """An error of a live command; `kind` is the word for it in JSON (`no-answer`)."""

    def __init__(self, message: str, *, kind: str, code: int) -> None:
        super().__init__(message)
        self.kind = kind
        self.exit_code = code  # type: ignore[misc]  # click's usual code is one of the class
        context = click.get_current_context(silent=True)
        self.as_json = bool(context and context.params.get("as_json"))

    def show(self, file: IO[Any] | None = None) -> None:
        """Print the message to standard error; with --json an object to standard output, too."""
        if self.as_json:
            said = {"format": 1, "error": {"kind": self.kind, "message": self.message, "exit_code": self.exit_code}}
            tell(json_text(said) + "\n")
        super().show(file)


@contextmanager
def reported() -> Iterator[None]:
    """Turn errors of targets and of drivers into a `Failure`; others pass."""
    try:
        yield
    except TargetError as error:
        raise Failure(str(error), kind="target", code=USAGE) from None
    except RegscribeError as error:
        raise failure(error) from None


def failure(error: RegscribeError) -> Failure:
    """The failure that an error of a driver is to a command line."""
    return Failure(_in_options(str(error)), kind=kind_of(error), code=code_of(error))


def _in_options(message: str) -> str:
    """What a driver calls an argument is an option here."""
    return message.replace("pass confirm=True", "add --confirm").replace("rounded=True rounds", "--rounded rounds")


def code_of(error: RegscribeError) -> int:
    """The exit code of an error of a driver."""
    if isinstance(error, UNSETTLED):
        return UNKNOWN_STATE
    behind_gateway = isinstance(error, ExceptionAnswer) and error.code in GATEWAY and not error.name
    return SILENT if behind_gateway or isinstance(error, (LinkLost, NoAnswer)) else REFUSED


def kind_of(error: RegscribeError) -> str:
    """The class of an error in words: `no-answer`, `exception-answer`, `value-refused`, `sensor-fault`."""
    name = type(error).__name__
    return "".join(f"-{letter.lower()}" if letter.isupper() else letter for letter in name).lstrip("-")
