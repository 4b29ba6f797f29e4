"""The server: takes what an editor sends, asks the other modules, and sends back what they say."""

import asyncio
import logging
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcException
from pygls.lsp.server import LanguageServer
from pygls.uris import to_fs_path

from regscribe import __version__
from regscribe.language_server import protocol_values
from regscribe.language_server.files import MapText
from regscribe.language_server.positions import Positions
from regscribe.language_server.session import Session, compile_text
from regscribe.source import display_name

DEBOUNCE = 0.3
"""Seconds without a change after which a file is compiled."""

log = logging.getLogger(__name__)


class MapServer(LanguageServer):
    """A server for maps; `settings` are those that the editor sent under `regscribe`."""

    def __init__(self, debounce: float = DEBOUNCE) -> None:
        super().__init__("regscribe", __version__, text_document_sync_kind=lsp.TextDocumentSyncKind.Full)
        self.session = Session()
        self.settings: dict[str, bool] = {}
        self._debounce = debounce
        self._waiting: dict[Path, asyncio.TimerHandle] = {}
        self._compiler = ThreadPoolExecutor(1, "compile")
        self._uris: dict[Path, str] = {}

    @property
    def positions(self) -> Positions:
        """Translates positions for the client."""
        return Positions(self.workspace.position_encoding)

    def path(self, uri: str) -> Path | None:
        """The file of an address; None for what is no file."""
        found = to_fs_path(uri)
        return Path(found) if found else None

    def uri(self, path: Path) -> str:
        """The address of a file, as the editor spells it."""
        return self._uris.get(path) or protocol_values.uri_of(path)

    def file(self, uri: str) -> MapText | None:
        """An open file that is a map or may become one; None for others."""
        path = self.path(uri)
        found = self.session.files.get(path) if path else None
        return found if found and (found.is_map or not found.text.strip() or "maps" in found.path.parts) else None

    def setting(self, name: str) -> bool:
        """Whether something is wanted; it is unless the editor says no."""
        return bool(self.settings.get(name, True))

    def take_settings(self, sent: object) -> None:
        """Take settings: those under `regscribe`, or the whole."""
        own = sent.get("regscribe", sent) if isinstance(sent, dict) else {}
        self.settings = {str(key): value for key, value in own.items()} if isinstance(own, dict) else {}

    def changed(self, uri: str, text: str) -> None:
        """Take a text and compile, after a while, all that it concerns."""
        path = self.path(uri)
        if path is None:
            return
        self._uris[path] = uri
        self.session.set_text(path, text)
        for one in self.session.touched_by(path):
            self._schedule(one)

    def closed(self, uri: str) -> None:
        """Forget a file, and clear what was said of it."""
        path = self.path(uri)
        if path is None:
            return
        concerned = [one for one in self.session.touched_by(path) if one != path]
        self.session.close(path)
        if waiting := self._waiting.pop(path, None):
            waiting.cancel()
        self.show()
        for one in concerned:
            self._schedule(one)

    def check_all(self) -> None:
        """Compile all open files once more, after a while."""
        for one in self.session.files.unsaved:
            self._schedule(one)

    def _schedule(self, path: Path) -> None:
        if waiting := self._waiting.pop(path, None):
            waiting.cancel()
        loop = asyncio.get_running_loop()
        self._waiting[path] = loop.call_later(self._debounce, lambda: loop.create_task(self._check(path)))

    async def _check(self, path: Path) -> None:
        """Compile a file in a thread and show what was found, unless it has changed meanwhile."""
        self._waiting.pop(path, None)
        file, round_ = self.session.files.get(path), self.session.rounds.get(path)
        if file is None:
            return
        texts = self.session.snapshot()
        try:
            loop = asyncio.get_running_loop()
            compiled = await loop.run_in_executor(self._compiler, compile_text, path, texts, file)
        except Exception:  # a fault of ours must not end the work on the other files
            log.exception("%s could not be compiled", display_name(path))
            return
        if round_ == self.session.rounds.get(path) and path in self.session.files.unsaved:
            self.session.take(path, compiled, texts.get(path, ""))
            self.show()
            self._refresh()

    def _refresh(self) -> None:
        """Ask the editor to fetch lenses and hints anew, if it can."""
        workspace = self.client_capabilities.workspace
        if workspace and workspace.code_lens and workspace.code_lens.refresh_support:
            self.workspace_code_lens_refresh(None)
        if workspace and workspace.inlay_hint and workspace.inlay_hint.refresh_support:
            self.workspace_inlay_hint_refresh(None)

    def show(self) -> None:
        """Send the findings of all files that have some, and none for those that had."""
        others = self.lines()
        for path in self.session.to_show():
            found = self.session.findings_in(path)
            lines = others.of(display_name(path))
            sent = [protocol_values.diagnostic(one, lines, others, self.positions) for one in found]
            self.text_document_publish_diagnostics(lsp.PublishDiagnosticsParams(self.uri(path), sent))
            (self.session.shown.add if sent else self.session.shown.discard)(path)

    def lines(self) -> protocol_values.Lines:
        """The lines of all files that were read."""
        known = self.session.files.read.values()
        return protocol_values.Lines({display_name(one.path): (one.path, one.text.split("\n")) for one in known})

    def end(self) -> None:
        """Stop the compiler."""
        self._compiler.shutdown(wait=False, cancel_futures=True)


def is_worth_telling(record: logging.LogRecord) -> bool:
    """Whether a record belongs into the log: pygls logs refusals, which the editor shows, with a traceback."""
    refused = record.exc_info[1] if record.exc_info else None
    return not (isinstance(refused, JsonRpcException) and refused.code == lsp.LSPErrorCodes.RequestFailed)


def guarded(answer: Callable[..., Any]) -> Callable[..., Any]:
    """A request whose fault is a message in the log and an empty answer, not the end."""

    def answered(*arguments: Any) -> Any:  # noqa: ANN401 - of any request
        try:
            return answer(*arguments)
        except JsonRpcException:  # a refusal, which the editor shows
            raise
        except Exception:  # as above
            log.exception("a request failed")
            return None

    answered.__annotations__ = {}
    answered.__name__ = answer.__name__
    return answered
