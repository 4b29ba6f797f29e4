"""What a language server for YAML by others makes of `schema/map.schema.json`.

It proposes what fits, and finds no mistakes in sound maps.
"""

import asyncio
import shutil
from collections.abc import AsyncIterator, Iterator
from pathlib import Path

import pytest
import pytest_asyncio
from lsprotocol import types as lsp
from pytest_lsp import ClientServerConfig, LanguageClient, client_capabilities, make_test_lsp_client

from regscribe.schema import schema_json

pytestmark = [pytest.mark.editors, pytest.mark.asyncio(loop_scope="module")]

ROOT = Path(__file__).parents[3]
SERVER = ROOT / ".cache" / "interop" / "yaml-language-server" / "node_modules" / ".bin" / "yaml-language-server"
SCHEMA = ROOT / "schema" / "map.schema.json"
SETTINGS = {"yaml": {"schemas": {SCHEMA.as_uri(): "*.yaml"}, "schemaStore": {"enable": False}}}
MAPS = sorted((ROOT / "maps").rglob("*.yaml"))

HEAD = "format: 1\nmap: {id: a/b, title: T, maker: M, class_prefix: T}\nmodels: {A: {}}\n"
GROUP = HEAD + "groups:\n  - id: g\n    name: G\n    registers:\n"
REGISTER = GROUP + "      - at: 1\n        name: N\n        "


@pytest_asyncio.fixture(scope="module", loop_scope="module")
async def server() -> AsyncIterator[LanguageClient]:
    """An editor, and the server that it started with the schema."""
    if not SERVER.exists() or shutil.which("node") is None:
        pytest.skip("yaml-language-server is not installed: `make test-editors` does that")
    config = ClientServerConfig([str(SERVER), "--stdio"], client_factory=make_test_lsp_client)
    client = await config.start()
    assert isinstance(client, LanguageClient)
    client.feature(lsp.CLIENT_REGISTER_CAPABILITY)(lambda _: None)
    client.set_configuration(SETTINGS)
    await client.initialize_session(lsp.InitializeParams(client_capabilities("visual-studio-code")))
    client.workspace_did_change_configuration(lsp.DidChangeConfigurationParams(SETTINGS))
    while not await findings(client, HEAD.replace("models", "modles")):  # noqa: ASYNC110 - it tells no event when it has read the schema
        await asyncio.sleep(0.1)
    yield client
    await client.shutdown_session()


NAMES: Iterator[str] = map("/nowhere/{}.yaml".format, range(1_000_000))


def opened(server: LanguageClient, text: str, path: Path | None = None) -> str:
    """The URI of a document with a text: a new one, or that of a file."""
    uri = (path or Path(next(NAMES))).as_uri()
    server.text_document_did_open(lsp.DidOpenTextDocumentParams(lsp.TextDocumentItem(uri, "yaml", 1, text)))
    return uri


async def proposed(server: LanguageClient, text: str) -> dict[str, str]:
    """What is proposed at the end of a text: each label, and what it writes."""
    uri = opened(server, text)
    end = lsp.Position(text.count("\n"), len(text) - text.rfind("\n") - 1)
    found = await server.text_document_completion_async(lsp.CompletionParams(lsp.TextDocumentIdentifier(uri), end))
    assert isinstance(found, lsp.CompletionList)
    return {item.label: (item.text_edit.new_text if item.text_edit else item.insert_text) or "" for item in found.items}


async def findings(server: LanguageClient, text: str, path: Path | None = None) -> list[str]:
    uri = opened(server, text, path)
    while uri not in server.diagnostics:
        await asyncio.wait_for(server.wait_for_notification(lsp.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS), 60)
    return [one.message for one in server.diagnostics[uri]]


async def test_a_new_register_proposes_the_keys_of_registers_and_the_other_forms(server: LanguageClient) -> None:
    found = await proposed(server, GROUP + "      - ")
    keys = schema_json()["$defs"]["register"]["properties"]
    assert set(keys) - {"except"} <= set(found)
    assert {"array", "set"} <= set(found)


async def test_a_register_that_was_begun_proposes_the_keys_that_it_lacks(server: LanguageClient) -> None:
    found = await proposed(server, REGISTER)
    assert {"access", "enum", "multiply", "sentinels"} <= set(found)
    assert not {"at", "registers", "repeat", "set"} & set(found)


async def test_an_array_proposes_its_own_keys(server: LanguageClient) -> None:
    found = await proposed(server, GROUP + "      - registers: []\n        ")
    assert {"repeat", "stride", "each"} <= set(found)
    assert "access" not in found


async def test_a_worked_example_proposes_values_frames_and_timings(server: LanguageClient) -> None:
    found = await proposed(server, HEAD + "examples:\n  - ")
    assert {"words", "value", "frame example", "timing example"} <= set(found)


async def test_words_of_the_language_are_proposed(server: LanguageClient) -> None:
    assert set(await proposed(server, REGISTER + "access: ")) == {"r", "rw", "w"}
    assert set(await proposed(server, REGISTER + "static: ")) == {"true", "false"}
    assert {"uint16", "float32"} <= set(await proposed(server, REGISTER + "type: "))


async def test_a_key_that_the_map_chooses_is_proposed_as_such(server: LanguageClient) -> None:
    assert (await proposed(server, HEAD + "enums:\n  mode:\n    "))["code"] == "${1:code}: $2"


PLACES = {
    "top": HEAD,
    "group": HEAD + "groups:\n  - ",
    "register": GROUP + "      - ",
    "key": REGISTER,
    "begun key": REGISTER + "d",
    "view set": HEAD + "views:\n  v:\n    base:\n      ",
    "scale": HEAD + "scales:\n  s:\n    - ",
    "command": HEAD + "commands:\n  c:\n    ",
    "step": HEAD + "commands:\n  c:\n    steps:\n      - ",
    "erratum": HEAD + "errata:\n  - ",
    "program": HEAD + "programs:\n  p:\n    ",
    "override": HEAD + "override:\n  - ",
} | {
    f"{key}:": f"{REGISTER}{key}: "
    for key in schema_json()["$defs"]["register"]["properties"]
    if key not in {"at", "name"}
}


@pytest.mark.parametrize("text", PLACES.values(), ids=PLACES)
async def test_what_is_proposed_is_yaml_and_no_fact_of_an_example(text: str, server: LanguageClient) -> None:
    found = await proposed(server, text)
    assert not [label for label in found if "object Object" in label + found[label]]
    examples = {str(one) for one in _examples(schema_json()) if isinstance(one, str | int | float)}
    words = set(_words(schema_json()))
    assert not {label for label in found if label in examples - words}
    if not text.endswith(": "):
        assert [label for label, written in found.items() if ":" not in written] == []


def _examples(schema: object) -> Iterator[object]:
    """All examples of a schema and of its parts."""
    if isinstance(schema, dict):
        yield from schema.get("x-examples", ())
    for part in schema.values() if isinstance(schema, dict) else schema if isinstance(schema, list) else ():
        yield from _examples(part)


def _words(schema: object) -> Iterator[str]:
    """All keys, titles and listed values of a schema and of its parts."""
    if isinstance(schema, dict):
        yield from schema
        yield from map(str, schema.get("enum", ()) if isinstance(schema.get("enum"), list) else ())
        yield str(schema.get("title", ""))
    for part in schema.values() if isinstance(schema, dict) else schema if isinstance(schema, list) else ():
        yield from _words(part)


@pytest.mark.parametrize("path", MAPS, ids=lambda path: str(path.relative_to(ROOT / "maps")))
async def test_a_shipped_map_has_no_findings(path: Path, server: LanguageClient) -> None:
    text = path.read_text(encoding="utf-8")  # noqa: ASYNC240 - a small file
    assert await findings(server, text, path) == []


async def test_a_mistake_is_found(server: LanguageClient) -> None:
    assert await findings(server, REGISTER + "acess: r\n") != []
