"""What the other modules find, as values of the language server protocol."""

from collections.abc import Sequence
from pathlib import Path

from lsprotocol import types as lsp
from pygls.uris import from_fs_path

from regscribe.language_server.completion import Proposal
from regscribe.language_server.fixes import Fix
from regscribe.language_server.navigation import Outlined
from regscribe.language_server.positions import Positions, place_of
from regscribe.language_server.rename import Edit
from regscribe.model import Diagnostic, Severity
from regscribe.visible import tame

SOURCE = "regscribe"
_SEVERITIES = {Severity.ERROR: lsp.DiagnosticSeverity.Error, Severity.WARNING: lsp.DiagnosticSeverity.Warning}
_SYMBOLS = {
    "group": lsp.SymbolKind.Namespace,
    "register": lsp.SymbolKind.Field,
    "array": lsp.SymbolKind.Array,
    "set": lsp.SymbolKind.Struct,
    "enum": lsp.SymbolKind.Enum,
    "model": lsp.SymbolKind.Class,
    "condition": lsp.SymbolKind.Boolean,
    "unit": lsp.SymbolKind.Constant,
    "command": lsp.SymbolKind.Event,
    "program": lsp.SymbolKind.Function,
    "computed": lsp.SymbolKind.Function,
}


def uri_of(path: Path) -> str:
    """The address of a file."""
    return from_fs_path(str(path.absolute())) or path.absolute().as_uri()


def diagnostic(found: Diagnostic, lines: Sequence[str], others: "Lines", positions: Positions) -> lsp.Diagnostic:
    """A finding, in a text with these lines; `others` are the lines of further files by name."""
    related = [
        lsp.DiagnosticRelatedInformation(
            lsp.Location(
                uri_of(others.path(one.span.file)), positions.range(others.of(one.span.file), place_of(one.span))
            ),
            tame(one.message),
        )
        for one in found.related
        if one.span.file
    ]
    said = f"{found.message}\n{found.help}" if found.help else found.message
    return lsp.Diagnostic(
        range=positions.range(lines, place_of(found.span)),
        message=tame(said),
        severity=_SEVERITIES[found.severity],
        code=found.rule,
        source=SOURCE,
        related_information=related or None,
        data={"help": found.help, "replacement": found.replacement},
    )


class Lines:
    """The lines of files, by the names that diagnostics have for them."""

    def __init__(self, known: dict[str, tuple[Path, list[str]]]) -> None:
        self._known = known

    def path(self, name: str) -> Path:
        """The file of a name."""
        return self._known[name][0] if name in self._known else Path.cwd() / name

    def of(self, name: str) -> list[str]:
        """The lines of the file of a name."""
        return self._known[name][1] if name in self._known else [""]


def completion(one: Proposal, lines: Sequence[str], positions: Positions) -> lsp.CompletionItem:
    """A proposal as an edit of the word at the cursor."""
    kind = lsp.CompletionItemKind.Property if one.insert.rstrip().endswith(":") else lsp.CompletionItemKind.Value
    return lsp.CompletionItem(
        label=one.label,
        kind=kind,
        detail=one.detail or None,
        documentation=lsp.MarkupContent(lsp.MarkupKind.Markdown, one.about) if one.about else None,
        sort_text=one.sort,
        filter_text=one.insert.lstrip("- ").strip("'").removesuffix(": "),
        text_edit=lsp.TextEdit(positions.range(lines, one.place), one.insert),
    )


def edits(found: Sequence[Edit], lines: Sequence[str], positions: Positions) -> list[lsp.TextEdit]:
    """Edits of one text."""
    return [lsp.TextEdit(positions.range(lines, place), new) for place, new in found]


def action(fix: Fix, uri: str, lines: Sequence[str], positions: Positions, mended: lsp.Diagnostic) -> lsp.CodeAction:
    """A mend as a quick fix."""
    return lsp.CodeAction(
        title=tame(fix.title),
        kind=lsp.CodeActionKind.QuickFix,
        diagnostics=[mended],
        is_preferred=fix.likely or None,
        edit=lsp.WorkspaceEdit(changes={uri: edits(fix.edits, lines, positions)}),
    )


def symbol(one: Outlined, lines: Sequence[str], positions: Positions) -> lsp.DocumentSymbol:
    """A thing of a file with what is in it."""
    return lsp.DocumentSymbol(
        name=one.name or "?",
        kind=_SYMBOLS.get(one.kind, lsp.SymbolKind.Object),
        range=positions.range(lines, one.place),
        selection_range=positions.range(lines, one.own),
        detail=one.kind,
        children=[symbol(each, lines, positions) for each in one.inside] or None,
    )


def symbol_kind(kind: str) -> lsp.SymbolKind:
    """How the protocol calls a kind."""
    return _SYMBOLS.get(kind, lsp.SymbolKind.Object)
