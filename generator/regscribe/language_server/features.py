"""The requests that the server answers."""

import os
import sys
from contextlib import redirect_stdout
from typing import Any

from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcException

from regscribe.language_server import protocol_values as values
from regscribe.language_server.completion import complete
from regscribe.language_server.files import Spot
from regscribe.language_server.fixes import fixes
from regscribe.language_server.hover import hover
from regscribe.language_server.lenses import other_addresses, read_examples
from regscribe.language_server.navigation import Outlined, named_at, outline, references, targets
from regscribe.language_server.rename import PUBLIC, RenameRefusedError, renamed
from regscribe.language_server.server import MapServer, guarded

NOTHING = "regscribe.nothing"
"""The command of a lens, which only shows a text."""


def opened(server: MapServer, params: lsp.DidOpenTextDocumentParams) -> None:
    """Take a file."""
    server.changed(params.text_document.uri, params.text_document.text)


def changed(server: MapServer, params: lsp.DidChangeTextDocumentParams) -> None:
    """Take the text of a file."""
    server.changed(params.text_document.uri, params.content_changes[-1].text)


def closed(server: MapServer, params: lsp.DidCloseTextDocumentParams) -> None:
    """Forget a file."""
    server.closed(params.text_document.uri)


def saved(server: MapServer, params: lsp.DidSaveTextDocumentParams) -> None:
    """Look once more at what builds on a file."""
    path = server.path(params.text_document.uri)
    if path in server.session.files.unsaved:
        server.changed(params.text_document.uri, server.session.files.unsaved[path])


def configured(server: MapServer, params: lsp.DidChangeConfigurationParams) -> None:
    """Take settings."""
    server.take_settings(params.settings)


def initialized(server: MapServer, params: lsp.InitializeParams) -> None:
    """Take the settings that came with the start."""
    server.take_settings(params.initialization_options)


def completed(server: MapServer, params: lsp.CompletionParams) -> lsp.CompletionList | None:
    """What may be written at a position."""
    file = server.file(params.text_document.uri)
    if file is None:
        return None
    lines = file.text.split("\n")
    found = complete(server.session.files, file, *server.positions.cursor(lines, params.position))
    items = [values.completion(one, lines, server.positions) for one in found]
    return lsp.CompletionList(is_incomplete=False, items=items)


def hovered(server: MapServer, params: lsp.HoverParams) -> lsp.Hover | None:
    """What stands at a position."""
    file = server.file(params.text_document.uri)
    if file is None:
        return None
    lines = file.text.split("\n")
    session = server.session
    found = hover(session.files, file, *server.positions.cursor(lines, params.position), session.map_of(file.path))
    if found is None:
        return None
    place, said = found
    return lsp.Hover(lsp.MarkupContent(lsp.MarkupKind.Markdown, said), server.positions.range(lines, place))


def _location(server: MapServer, spot: Spot) -> lsp.Location:
    file = server.session.files.get(spot.file)
    lines = file.text.split("\n") if file else [""]
    return lsp.Location(server.uri(spot.file), server.positions.range(lines, spot.place))


def defined(server: MapServer, params: lsp.DefinitionParams) -> list[lsp.Location] | None:
    """Where a name is declared."""
    file = server.file(params.text_document.uri)
    if file is None:
        return None
    cursor = server.positions.cursor(file.text.split("\n"), params.position)
    return [_location(server, spot) for spot in targets(server.session.files, file, *cursor)]


def referred(server: MapServer, params: lsp.ReferenceParams) -> list[lsp.Location] | None:
    """Where a thing is named."""
    file = server.file(params.text_document.uri)
    if file is None:
        return None
    session = server.session
    found = named_at(session.files, file, *server.positions.cursor(file.text.split("\n"), params.position))
    if found is None:
        return []
    spots = references(session.files, file, found[1], session.all_maps(file.path))
    own = [found[1].spot] if params.context.include_declaration else []
    return [_location(server, spot) for spot in [*own, *spots]]


def rename_prepared(server: MapServer, params: lsp.PrepareRenameParams) -> lsp.PrepareRenamePlaceholder | None:
    """The name at a position, if it is one that can be changed."""
    file = server.file(params.text_document.uri)
    if file is None:
        return None
    lines = file.text.split("\n")
    found = named_at(server.session.files, file, *server.positions.cursor(lines, params.position))
    if found is None:
        return None
    return lsp.PrepareRenamePlaceholder(server.positions.range(lines, found[0]), found[1].id)


def rename_done(server: MapServer, params: lsp.RenameParams) -> lsp.WorkspaceEdit | None:
    """The edits that give a thing another name; refusals are errors of the request."""
    file = server.file(params.text_document.uri)
    if file is None:
        return None
    session = server.session
    found = named_at(session.files, file, *server.positions.cursor(file.text.split("\n"), params.position))
    if found is None:
        return None
    try:
        changes = renamed(session.files, file, found[1], params.new_name, session.all_maps(file.path))
    except RenameRefusedError as refused:
        raise JsonRpcException(str(refused), lsp.LSPErrorCodes.RequestFailed) from None
    if found[1].kind in PUBLIC:
        said = f"`{found[1].name}` is public: programs that use it in a driver must be changed as well"
        server.window_show_message(lsp.ShowMessageParams(lsp.MessageType.Warning, said))
    sent = {}
    for path, edits in changes.items():
        lines = (session.files.text_of(path) or "").split("\n")
        sent[server.uri(path)] = values.edits(edits, lines, server.positions)
    return lsp.WorkspaceEdit(changes=sent)


def outlined(server: MapServer, params: lsp.DocumentSymbolParams) -> list[lsp.DocumentSymbol] | None:
    """What a file holds."""
    file = server.file(params.text_document.uri)
    if file is None:
        return None
    lines = file.text.split("\n")
    return [values.symbol(one, lines, server.positions) for one in outline(file)]


def found_in_workspace(server: MapServer, params: lsp.WorkspaceSymbolParams) -> list[lsp.WorkspaceSymbol]:
    """What all open maps hold, and those beside them, by a part of the name."""
    session, wanted = server.session, params.query.lower()
    files = {one.path: one for path in session.files.unsaved for one in session.all_maps(path)}
    found = []
    for file in files.values():
        waiting: list[Outlined] = outline(file)
        while waiting:
            one = waiting.pop(0)
            waiting += one.inside
            if one.kind != "table" and wanted in one.name.lower():
                location = _location(server, Spot(file.path, one.own))
                found.append(lsp.WorkspaceSymbol(location, one.name, values.symbol_kind(one.kind), file.id))
    return found


def mended(server: MapServer, params: lsp.CodeActionParams) -> list[lsp.CodeAction] | None:
    """The mends of what was found in a range."""
    file = server.file(params.text_document.uri)
    if file is None:
        return None
    lines, others, positions = file.text.split("\n"), server.lines(), server.positions
    found: list[lsp.CodeAction] = []
    for one in server.session.findings_in(file.path):
        sent = values.diagnostic(one, lines, others, positions)
        if _touch(sent.range, params.range):
            mends = fixes(server.session.files, file, one)
            found += [values.action(fix, params.text_document.uri, lines, positions, sent) for fix in mends]
    return found


def _touch(one: lsp.Range, other: lsp.Range) -> bool:
    return _key(one.start) <= _key(other.end) and _key(other.start) <= _key(one.end)


def _key(position: lsp.Position) -> tuple[int, int]:
    return position.line, position.character


def lensed(server: MapServer, params: lsp.CodeLensParams) -> list[lsp.CodeLens] | None:
    """How the worked examples read."""
    file = server.file(params.text_document.uri)
    compiled = server.session.map_of(file.path, exactly=True) if file else None
    if file is None or compiled is None or not server.setting("codeLens"):
        return None
    lines = file.text.split("\n")
    return [
        lsp.CodeLens(server.positions.range(lines, place), lsp.Command(said, NOTHING))
        for place, said in read_examples(file, compiled)
    ]


def hinted(server: MapServer, params: lsp.InlayHintParams) -> list[lsp.InlayHint] | None:
    """Addresses in other notations."""
    file = server.file(params.text_document.uri)
    compiled = server.session.map_of(file.path, exactly=True) if file else None
    if file is None or compiled is None or not server.setting("inlayHints"):
        return None
    lines, wanted = file.text.split("\n"), range(params.range.start.line, params.range.end.line + 1)
    found = ((place, said) for place, said in other_addresses(file, compiled) if place.line in wanted)
    return [lsp.InlayHint(server.positions.range(lines, place).end, said, padding_left=True) for place, said in found]


def no_action(*_: Any) -> None:  # noqa: ANN401 - whatever the editor sends
    """Do nothing: a lens only shows a text."""


NOTIFICATIONS = {
    lsp.TEXT_DOCUMENT_DID_OPEN: opened,
    lsp.TEXT_DOCUMENT_DID_CHANGE: changed,
    lsp.TEXT_DOCUMENT_DID_CLOSE: closed,
    lsp.TEXT_DOCUMENT_DID_SAVE: saved,
    lsp.WORKSPACE_DID_CHANGE_CONFIGURATION: configured,
    lsp.INITIALIZE: initialized,
}
REQUESTS = {
    lsp.TEXT_DOCUMENT_HOVER: hovered,
    lsp.TEXT_DOCUMENT_DEFINITION: defined,
    lsp.TEXT_DOCUMENT_REFERENCES: referred,
    lsp.TEXT_DOCUMENT_PREPARE_RENAME: rename_prepared,
    lsp.TEXT_DOCUMENT_DOCUMENT_SYMBOL: outlined,
    lsp.WORKSPACE_SYMBOL: found_in_workspace,
    lsp.TEXT_DOCUMENT_CODE_LENS: lensed,
    lsp.TEXT_DOCUMENT_INLAY_HINT: hinted,
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
    add(lsp.TEXT_DOCUMENT_COMPLETION, completed, lsp.CompletionOptions(trigger_characters=list(" {,[-:")))
    add(lsp.TEXT_DOCUMENT_RENAME, rename_done, lsp.RenameOptions(prepare_provider=True))
    add(lsp.TEXT_DOCUMENT_CODE_ACTION, mended, lsp.CodeActionOptions([lsp.CodeActionKind.QuickFix]))
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
