"""The requests that the server answers."""

import os
import sys
from contextlib import redirect_stdout
from typing import Any

from lsprotocol import types as lsp

from regscribe.language_server import additions, changes, documents, questions
from regscribe.language_server.additions import NOTHING
from regscribe.language_server.server import MapServer, guarded


def no_action(*_: Any) -> None:  # noqa: ANN401 - whatever the editor sends
    """Do nothing: a lens only shows a text."""


NOTIFICATIONS = {
    lsp.TEXT_DOCUMENT_DID_OPEN: documents.opened,
    lsp.TEXT_DOCUMENT_DID_CHANGE: documents.changed,
    lsp.TEXT_DOCUMENT_DID_CLOSE: documents.closed,
    lsp.TEXT_DOCUMENT_DID_SAVE: documents.saved,
    lsp.WORKSPACE_DID_CHANGE_WATCHED_FILES: documents.changed_on_disk,
    lsp.WORKSPACE_DID_CHANGE_CONFIGURATION: documents.configured,
    lsp.INITIALIZED: documents.watching,
    lsp.INITIALIZE: documents.initialized,
}
REQUESTS = {
    lsp.TEXT_DOCUMENT_HOVER: questions.hovered,
    lsp.TEXT_DOCUMENT_DEFINITION: questions.defined,
    lsp.TEXT_DOCUMENT_REFERENCES: questions.referred,
    lsp.TEXT_DOCUMENT_PREPARE_RENAME: changes.rename_prepared,
    lsp.TEXT_DOCUMENT_FORMATTING: changes.laid_out,
    lsp.TEXT_DOCUMENT_DOCUMENT_SYMBOL: questions.outlined,
    lsp.WORKSPACE_SYMBOL: questions.found_in_workspace,
    lsp.TEXT_DOCUMENT_CODE_LENS: additions.lensed,
    lsp.TEXT_DOCUMENT_INLAY_HINT: additions.hinted,
}


def create(debounce: float) -> MapServer:
    """A server with all its features."""
    server = MapServer(debounce)

    def add(name: str, answer: Any, options: object = None) -> None:  # noqa: ANN401 - of any request
        async def answered(params: Any) -> Any:  # noqa: ANN401 - as above
            return guarded(answer)(server, params)

        def told(params: Any) -> None:  # noqa: ANN401 - as above
            guarded(answer)(server, params)

        server.feature(name, options)(told if name in NOTIFICATIONS else answered)

    for name, answer in {**NOTIFICATIONS, **REQUESTS}.items():
        add(name, answer)
    add(lsp.TEXT_DOCUMENT_COMPLETION, questions.completed, lsp.CompletionOptions(trigger_characters=list(" {,[")))
    add(lsp.TEXT_DOCUMENT_RENAME, changes.rename_done, lsp.RenameOptions(prepare_provider=True))
    add(lsp.TEXT_DOCUMENT_CODE_ACTION, changes.mended, lsp.CodeActionOptions([lsp.CodeActionKind.QuickFix]))
    server.command(NOTHING)(no_action)
    return server


def serve(debounce: float) -> None:
    """Serve one editor over standard input and output, until it ends."""
    server = create(debounce)
    with os.fdopen(os.dup(sys.stdout.fileno()), "wb") as protocol, redirect_stdout(sys.stderr):
        try:
            server.start_io(stdout=protocol)
        finally:
            server.end()
