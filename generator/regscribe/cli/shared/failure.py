"""An error that ends a command with an exit code of its own, also in JSON."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import IO, Any

import click

from regscribe.cli.shared.exit_codes import OUTPUT
from regscribe.cli.shared.output import print_json_line


class Failure(click.ClickException):
    """An error that ends a command; `kind` is the word for it in JSON (`no-answer`)."""

    def __init__(self, message: str, *, kind: str, code: int) -> None:
        super().__init__(message)
        self.kind = kind
        self.exit_code = code  # type: ignore[misc]  # click's usual code is one of the class
        context = click.get_current_context(silent=True)
        self.as_json = bool(context and context.params.get("as_json"))

    def show(self, file: IO[Any] | None = None) -> None:
        """Print the message to standard error; with --json an object to standard output, too."""
        try:
            if self.as_json:
                print_json_line(error={"kind": self.kind, "message": self.message, "exit_code": self.exit_code})
        finally:  # a full disk hides no error of a device
            super().show(file)


@contextmanager
def unwritten(*errors: type[Exception]) -> Iterator[None]:
    """Turn errors of files that cannot be written into a `Failure` with the exit code of output."""
    try:
        yield
    except errors as error:
        raise Failure(str(error), kind="file", code=OUTPUT) from None
