"""What an editor tells of its files and settings."""

from lsprotocol import types as lsp

from regscribe.language_server.server import MapServer


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
