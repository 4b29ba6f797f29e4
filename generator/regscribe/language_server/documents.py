"""What an editor tells of its files and settings."""

from lsprotocol import types as lsp

from regscribe.language_server.server import MapServer


def opened(server: MapServer, params: lsp.DidOpenTextDocumentParams) -> None:
    """Take a file."""
    server.changed(params.text_document.uri, params.text_document.text)


def changed(server: MapServer, params: lsp.DidChangeTextDocumentParams) -> None:
    """Take the text of a file; an editor may tell of a new version without a change."""
    for change in params.content_changes[-1:]:
        server.changed(params.text_document.uri, change.text)


def closed(server: MapServer, params: lsp.DidCloseTextDocumentParams) -> None:
    """Forget a file."""
    server.closed(params.text_document.uri)


def saved(server: MapServer, params: lsp.DidSaveTextDocumentParams) -> None:
    """Look once more at what builds on a file."""
    path = server.path(params.text_document.uri)
    if path in server.session.files.unsaved:
        server.changed(params.text_document.uri, server.session.files.unsaved[path])


def changed_on_disk(server: MapServer, params: lsp.DidChangeWatchedFilesParams) -> None:
    """Look once more at all open files: what they build on may have come, changed or gone."""
    if {server.path(one.uri) for one in params.changes} - server.session.files.unsaved.keys():
        server.check_all()


def watching(server: MapServer, _params: lsp.InitializedParams) -> None:
    """Ask the editor to tell of changes that other programs make, if it can."""
    workspace = server.client_capabilities.workspace
    if workspace and workspace.did_change_watched_files and workspace.did_change_watched_files.dynamic_registration:
        options = lsp.DidChangeWatchedFilesRegistrationOptions([lsp.FileSystemWatcher("**/*.yaml")])
        wanted = lsp.Registration("regscribe.maps", lsp.WORKSPACE_DID_CHANGE_WATCHED_FILES, options)
        server.client_register_capability(lsp.RegistrationParams([wanted]))


def configured(server: MapServer, params: lsp.DidChangeConfigurationParams) -> None:
    """Take settings."""
    server.take_settings(params.settings)


def initialized(server: MapServer, params: lsp.InitializeParams) -> None:
    """Take the settings that came with the start."""
    server.take_settings(params.initialization_options)
