"""What an editor asks to be changed: renaming, mends and layout."""

from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcException

from regscribe import source
from regscribe.language_server import protocol_values as values
from regscribe.language_server.fixes import fixes
from regscribe.language_server.navigation import named_at
from regscribe.language_server.rename import PUBLIC, RenameRefusedError, renamed
from regscribe.language_server.server import MapServer
from regscribe.map_format import FormatError, formatted


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


def laid_out(server: MapServer, params: lsp.DocumentFormattingParams) -> list[lsp.TextEdit] | None:
    """The edit to the canonical form; None for a text that is no YAML, or that would say something else."""
    file = server.file(params.text_document.uri)
    document, _ = source.parse(file.text, name=file.path.name) if file else (None, [])
    if file is None or document is None:
        return None
    try:
        text = formatted(document)
    except FormatError:
        return None
    whole = lsp.Range(lsp.Position(0, 0), lsp.Position(len(file.text.split("\n")), 0))
    return [lsp.TextEdit(whole, text)] if text != file.text else []


def _touch(one: lsp.Range, other: lsp.Range) -> bool:
    return _key(one.start) <= _key(other.end) and _key(other.start) <= _key(one.end)


def _key(position: lsp.Position) -> tuple[int, int]:
    return position.line, position.character
