"""`regscribe lsp`: the language server for editors."""

import importlib.util
import logging
import sys

import click

from regscribe.visible import tame


class TameFormatter(logging.Formatter):
    """Log lines without the invisible characters that a map may hold."""

    def format(self, record: logging.LogRecord) -> str:
        """Format one record."""
        return tame(super().format(record))


@click.command(
    epilog="Example: regscribe lsp\n\n"
    "An editor starts it: docs/editors.md says how. Exit code 0: the editor ended it, 2: wrong usage.",
)
@click.option("--stdio", is_flag=True, help="Talk over standard input and output, as without this option.")
def command(*, stdio: bool) -> int:  # noqa: ARG001 - editors give it, and there is no other way
    """Serve an editor: findings while typing, completion, hover, renaming and quick fixes for maps.

    It speaks the language server protocol over standard input and output, until the editor ends it. What goes wrong is
    told on standard error, which editors show as the log of the server.
    """
    if importlib.util.find_spec("pygls") is None:
        message = "the language server needs pygls: pip install 'regscribe[lsp]'"
        raise click.ClickException(message)
    from regscribe.language_server.features import serve  # noqa: PLC0415 - 200 ms that only an editor needs
    from regscribe.language_server.server import DEBOUNCE, is_worth_telling  # noqa: PLC0415 - as above

    log = logging.StreamHandler(sys.stderr)
    log.setFormatter(TameFormatter("regscribe lsp: %(levelname)s: %(message)s"))
    log.addFilter(is_worth_telling)
    logging.basicConfig(handlers=[log], level=logging.WARNING)
    logging.getLogger("pygls").setLevel(logging.ERROR)  # it warns of each usual end
    serve(DEBOUNCE)
    return 0
