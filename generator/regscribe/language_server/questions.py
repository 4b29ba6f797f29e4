"""What an editor asks about a file: names, meanings, places."""

from lsprotocol import types as lsp

from regscribe.language_server import protocol_values as values
from regscribe.language_server.completion import complete
from regscribe.language_server.files import Spot
from regscribe.language_server.hover import hover
from regscribe.language_server.navigation import Outlined, named_at, outline, references, targets
from regscribe.language_server.server import MapServer


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
