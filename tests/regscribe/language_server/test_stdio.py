"""The server as an editor starts it: a real client over standard input and output."""

import asyncio
import json
import subprocess
import sys
from collections.abc import AsyncIterator
from pathlib import Path

import pytest
import pytest_asyncio
from lsprotocol import types as lsp
from pytest_lsp import ClientServerConfig, LanguageClient, client_capabilities, make_test_lsp_client

from .texts import HEAD

COMMAND = [sys.executable, "-m", "regscribe", "lsp", "--stdio"]
EXAMPLES = "examples:\n  - {register: setpoint, words: [1505], value: 150.5, with: {fahrenheit: 1}}\n"


@pytest_asyncio.fixture
async def client() -> AsyncIterator[LanguageClient]:
    """An editor like Visual Studio Code, and the server that it started."""
    found = await ClientServerConfig(COMMAND, client_factory=make_test_lsp_client).start()
    assert isinstance(found, LanguageClient)
    found.feature(lsp.WORKSPACE_CODE_LENS_REFRESH)(lambda _: None)
    found.feature(lsp.WORKSPACE_INLAY_HINT_REFRESH)(lambda _: None)
    found.feature(lsp.CLIENT_REGISTER_CAPABILITY)(lambda _: None)
    await found.initialize_session(lsp.InitializeParams(client_capabilities("visual-studio-code")))
    yield found
    await found.shutdown_session()


class Editor:
    """A text that is open in the client."""

    def __init__(self, client: LanguageClient, path: Path) -> None:
        self.client, self.path, self.version = client, path, 0
        self.uri = path.as_uri()
        self.document = lsp.TextDocumentIdentifier(self.uri)

    async def write(self, text: str) -> list[lsp.Diagnostic]:
        """Open or change the text, and wait for what is found in it."""
        self.version += 1
        if self.version == 1:
            item = lsp.TextDocumentItem(self.uri, "yaml", 1, text)
            self.client.text_document_did_open(lsp.DidOpenTextDocumentParams(item))
        else:
            version = lsp.VersionedTextDocumentIdentifier(self.version, self.uri)
            change = lsp.TextDocumentContentChangeWholeDocument(text)
            self.client.text_document_did_change(lsp.DidChangeTextDocumentParams(version, [change]))
        return await self.found()

    async def found(self) -> list[lsp.Diagnostic]:
        """Wait for the findings of this text."""
        while True:
            await asyncio.wait_for(self.client.wait_for_notification(lsp.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS), 20)
            if self.uri in self.client.diagnostics:
                return list(self.client.diagnostics[self.uri])


@pytest.fixture
def editor(client: LanguageClient, tmp_path: Path) -> Editor:
    return Editor(client, tmp_path / "maps" / "acme" / "one.yaml")


def place(text: str, part: str, more: int = 0) -> lsp.Position:
    before = text[: text.index(part) + more]
    return lsp.Position(before.count("\n"), len(before) - before.rfind("\n") - 1)


@pytest.mark.asyncio
async def test_findings_come_while_typing_and_go_when_the_file_is_closed(editor: Editor) -> None:
    assert await editor.write(HEAD) == []
    (found,) = await editor.write(HEAD.replace("decimals: 1", "decimal: 1"))
    assert (found.code, found.source, found.severity) == ("RS0201", "regscribe", lsp.DiagnosticSeverity.Error)
    editor.client.text_document_did_close(lsp.DidCloseTextDocumentParams(editor.document))
    assert await editor.found() == []


@pytest.mark.asyncio
async def test_findings_count_in_utf_16(editor: Editor) -> None:
    text = HEAD + "      - {at: 20, name: 🌡🌡, id: a, unit: °G}\n"
    (found,) = await editor.write(text)
    line = text.count("\n") - 1
    start = len("      - {at: 20, name: 🌡🌡, id: a, unit: ".encode("utf-16-le")) // 2
    assert found.range == lsp.Range(lsp.Position(line, start), lsp.Position(line, start + 2))


@pytest.mark.asyncio
async def test_keys_are_completed_in_a_register_that_is_not_closed(editor: Editor) -> None:
    text = HEAD + "      - {at: 15, name: Lo, "
    await editor.write(text)
    end = lsp.Position(text.count("\n"), len("      - {at: 15, name: Lo, "))
    found = await editor.client.text_document_completion_async(lsp.CompletionParams(editor.document, end))
    assert isinstance(found, lsp.CompletionList)
    labels = {one.label for one in found.items}
    assert {"unit", "enum", "access"} <= labels
    assert not {"at", "name"} & labels


@pytest.mark.asyncio
async def test_a_register_tells_its_addresses_when_pointed_at(editor: Editor) -> None:
    await editor.write(HEAD)
    found = await editor.client.text_document_hover_async(lsp.HoverParams(editor.document, place(HEAD, "Setpoint", 2)))
    assert found is not None
    assert isinstance(found.contents, lsp.MarkupContent)
    assert "| 12 | 0xC | 40013 |" in found.contents.value


@pytest.mark.asyncio
async def test_a_register_is_renamed_with_all_that_names_it(editor: Editor) -> None:
    await editor.write(HEAD)
    params = lsp.RenameParams(editor.document, place(HEAD, "fahrenheit: 1", 3), "degrees_f")
    edit = await editor.client.text_document_rename_async(params)
    assert edit is not None
    assert edit.changes is not None
    assert sorted(one.new_text for one in edit.changes[editor.uri]) == ["degrees_f", "id: degrees_f, "]
    assert "public" in editor.client.messages[-1].message


@pytest.mark.asyncio
async def test_a_rename_that_would_clash_is_refused_with_the_reason(editor: Editor) -> None:
    await editor.write(HEAD)
    params = lsp.RenameParams(editor.document, place(HEAD, "fahrenheit: 1", 3), "mode")
    with pytest.raises(Exception, match=r"there is a register `mode` already: one\.yaml:21"):
        await editor.client.text_document_rename_async(params)


@pytest.mark.asyncio
async def test_the_name_that_was_meant_is_a_quick_fix(editor: Editor) -> None:
    (found,) = await editor.write(HEAD.replace("decimals: 1", "decimal: 1"))
    params = lsp.CodeActionParams(editor.document, found.range, lsp.CodeActionContext([found]))
    actions = await editor.client.text_document_code_action_async(params)
    assert actions
    assert isinstance(actions[0], lsp.CodeAction)
    assert (actions[0].title, actions[0].is_preferred) == ("Write `decimals`", True)
    assert actions[0].edit
    assert actions[0].edit.changes
    assert list(actions[0].edit.changes[editor.uri]) == [lsp.TextEdit(found.range, "decimals")]


@pytest.mark.asyncio
async def test_worked_examples_are_read_aloud_above_them(editor: Editor) -> None:
    await editor.write(HEAD + EXAMPLES)
    found = await editor.client.text_document_code_lens_async(lsp.CodeLensParams(editor.document)) or ()
    assert [one.command.title for one in found if one.command] == ["05 E1 = 150.5 °F"]


@pytest.mark.asyncio
async def test_definition_references_symbols_and_hints_answer(editor: Editor) -> None:
    await editor.write(HEAD)
    client, at_use = editor.client, place(HEAD, "fahrenheit: 1", 3)
    declared = await client.text_document_definition_async(lsp.DefinitionParams(editor.document, at_use))
    assert isinstance(declared, list | tuple)
    assert [one.range.start for one in declared if isinstance(one, lsp.Location)] == [place(HEAD, "Fahrenheit")]
    context = lsp.ReferenceContext(include_declaration=True)
    used = await client.text_document_references_async(lsp.ReferenceParams(context, editor.document, at_use))
    assert len(used or ()) == 2
    symbols = await client.text_document_document_symbol_async(lsp.DocumentSymbolParams(editor.document)) or ()
    control = next(one for one in symbols if one.name == "control")
    assert isinstance(control, lsp.DocumentSymbol)
    assert [one.name for one in control.children or ()] == ["mode", "fahrenheit", "setpoint"]
    found = await client.workspace_symbol_async(lsp.WorkspaceSymbolParams("setp"))
    assert [one.name for one in found or ()] == ["setpoint"]
    whole = lsp.Range(lsp.Position(0, 0), lsp.Position(99, 0))
    hints = await client.text_document_inlay_hint_async(lsp.InlayHintParams(editor.document, whole)) or ()
    assert [one.label for one in hints] == ["0xA (40011)", "0xB (40012)", "0xC (40013)"]


@pytest.mark.asyncio
async def test_lenses_and_hints_can_be_switched_off(editor: Editor) -> None:
    settings = {"regscribe": {"codeLens": False, "inlayHints": False}}
    editor.client.workspace_did_change_configuration(lsp.DidChangeConfigurationParams(settings))
    await editor.write(HEAD + EXAMPLES)
    assert not await editor.client.text_document_code_lens_async(lsp.CodeLensParams(editor.document))
    whole = lsp.Range(lsp.Position(0, 0), lsp.Position(99, 0))
    assert not await editor.client.text_document_inlay_hint_async(lsp.InlayHintParams(editor.document, whole))


@pytest.mark.asyncio
async def test_a_library_that_is_being_changed_is_judged_with_the_maps_that_use_it(
    client: LanguageClient, tmp_path: Path
) -> None:
    folder = tmp_path / "maps" / "acme"
    library, own = Editor(client, folder / "common.library.yaml"), Editor(client, folder / "one.yaml")
    text = "format: 1\nlibrary: {id: acme/common, title: Common}\nenums:\n  shared: {0: a}\n"
    assert await library.write(text) == []
    used = HEAD.replace("conditions:", "uses: [acme/common]\nconditions:", 1).replace("enum: mode", "enum: shared")
    first = await own.write(used.replace("{mode: manual}", "{mode: 1}"))
    assert [one.code for one in first] == []
    library.version = 1
    await library.write(text.replace("shared", "other"))
    while not client.diagnostics[own.uri]:
        await own.found()
    assert "there is no enum `shared`" in client.diagnostics[own.uri][0].message


@pytest.mark.asyncio
async def test_what_another_program_does_to_a_library_is_seen_in_the_maps_that_use_it(
    client: LanguageClient, tmp_path: Path
) -> None:
    folder = tmp_path / "maps" / "acme"
    folder.mkdir(parents=True)
    library, own = folder / "common.library.yaml", Editor(client, folder / "one.yaml")

    async def told(kind: lsp.FileChangeType) -> list[lsp.Diagnostic]:
        event = lsp.FileEvent(library.as_uri(), kind)
        client.workspace_did_change_watched_files(lsp.DidChangeWatchedFilesParams([event]))
        return await own.found()

    (missing,) = await own.write(HEAD.replace("conditions:", "uses: [acme/common]\nconditions:", 1))
    assert missing.code == "RS0501"
    library.write_text(
        "format: 1\nlibrary: {id: acme/common, title: Common}\nenums:\n  shared: {0: a}\n", encoding="utf-8"
    )
    assert "RS0501" not in [one.code for one in await told(lsp.FileChangeType.Created)]
    library.unlink()
    assert [one.code for one in await told(lsp.FileChangeType.Deleted)] == ["RS0501"]


@pytest.mark.asyncio
async def test_a_new_version_without_a_change_is_no_fault(editor: Editor, capfd: pytest.CaptureFixture[str]) -> None:
    await editor.write(HEAD)
    version = lsp.VersionedTextDocumentIdentifier(2, editor.uri)
    editor.client.text_document_did_change(lsp.DidChangeTextDocumentParams(version, []))
    asked = lsp.DocumentSymbolParams(editor.document)
    assert await editor.client.text_document_document_symbol_async(asked)
    assert "IndexError" not in capfd.readouterr().err


@pytest.mark.asyncio
async def test_files_that_are_no_maps_get_no_findings(client: LanguageClient, tmp_path: Path) -> None:
    other = Editor(client, tmp_path / "compose.yaml")
    assert await other.write("services: {web: {image: nginx}}\n") == []
    rules = Editor(client, tmp_path / "maps" / "acme" / "one.import.yaml")
    assert await rules.write("map: {at: Address}\ncolumns: 3\n") == []
    one = Editor(client, tmp_path / "maps" / "acme" / "one.yaml")
    assert await one.write(HEAD) == []


def test_nothing_but_the_protocol_is_on_standard_output(tmp_path: Path) -> None:
    def message(**content: object) -> bytes:
        body = json.dumps({"jsonrpc": "2.0", **content}).encode()
        return b"Content-Length: %d\r\n\r\n%s" % (len(body), body)

    watching = {"workspace": {"didChangeWatchedFiles": {"dynamicRegistration": True}}}
    start = {"processId": None, "rootUri": None, "capabilities": watching}
    sent = message(id=1, method="initialize", params=start) + message(method="initialized", params={})
    sent += message(id=2, method="textDocument/nothing", params={}) + message(id=3, method="shutdown")
    sent += message(method="exit")
    done = subprocess.run(COMMAND, input=sent, capture_output=True, timeout=60, check=False, cwd=tmp_path)  # noqa: S603 - our own
    rest = done.stdout
    while rest:
        head, _, rest = rest.partition(b"\r\n\r\n")
        length = int(dict(line.split(b": ") for line in head.split(b"\r\n"))[b"Content-Length"])
        assert json.loads(rest[:length])["jsonrpc"] == "2.0"
        rest = rest[length:]
    assert b'"**/*.yaml"' in done.stdout, "it asks to be told of files that other programs change"
    assert done.returncode == 0


@pytest.mark.asyncio
async def test_a_map_is_laid_out_and_a_broken_one_left_alone(editor: Editor) -> None:
    await editor.write("# of Acme\nmap:   {id: acme/one,title: One}\n")
    asked = lsp.DocumentFormattingParams(editor.document, lsp.FormattingOptions(2, insert_spaces=True))
    (edit,) = await editor.client.text_document_formatting_async(asked) or []
    assert edit.new_text == "# of Acme\nmap: {id: acme/one, title: One}\n"
    assert edit.range == lsp.Range(lsp.Position(0, 0), lsp.Position(3, 0))

    await editor.write("map:   {id: acme/one\n")
    assert await editor.client.text_document_formatting_async(asked) is None
