"""What an editor shows between the lines of a map that compiles: readings and addresses."""

from lsprotocol import types as lsp

from regscribe.language_server.lenses import other_addresses, read_examples
from regscribe.language_server.server import MapServer

NOTHING = "regscribe.nothing"
"""The command of a lens, which only shows a text."""


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
