"""Each phase runs only if none before it found an error; what warnings say is carried to the end."""

from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import pytest

from regscribe import pipeline
from regscribe.compose import Composed
from regscribe.model import Diagnostic, Severity, Span

PHASES = ("source", "schema", "compose", "lower", "checks")
PATH = Path("m.yaml")


def found(phase: str, severity: Severity = Severity.ERROR) -> Diagnostic:
    return Diagnostic(phase, "wrong", Span("m.yaml", 9 - PHASES.index(phase)), severity=severity)


@pytest.fixture
def phases(monkeypatch: pytest.MonkeyPatch) -> dict[str, list[Diagnostic]]:
    """What each phase finds; a phase that runs is noted under `ran`."""
    finds: dict[str, Any] = {phase: [] for phase in PHASES} | {"ran": []}

    def phase(name: str, value: object) -> Any:
        def run(*_: object, **__: object) -> object:
            finds["ran"].append(name)
            return finds[name] if value is None else (value, finds[name])

        return run

    document = SimpleNamespace(name="m.yaml", content_hash="abc")

    def compose(_: object, path: Path, unsaved: object) -> Composed:
        assert (path, unsaved) == (PATH, None)
        finds["ran"].append("compose")
        return Composed(cast("Any", document), tuple(finds["compose"]))

    monkeypatch.setattr("regscribe.source.load", phase("source", document))
    monkeypatch.setattr("regscribe.schema.validate", phase("schema", None))
    monkeypatch.setattr("regscribe.compose.is_library", lambda _: False)
    monkeypatch.setattr("regscribe.compose.compose", compose)
    monkeypatch.setattr("regscribe.lower.lower", phase("lower", "map"))
    monkeypatch.setattr("regscribe.checks.check", phase("checks", None))
    return finds


@pytest.mark.parametrize("last", range(5))
def test_an_error_ends_the_pipeline_after_its_phase(phases: dict[str, list[Any]], last: int) -> None:
    errors = [found(PHASES[last]), found(PHASES[last])]
    phases[PHASES[last]] = errors
    assert pipeline.compile_map(PATH) == pipeline.Compiled(PATH, None, tuple(errors))
    assert phases["ran"] == list(PHASES[: last + 1])


def test_warnings_of_all_phases_come_with_the_map_in_the_order_of_the_file(phases: dict[str, list[Any]]) -> None:
    for phase in PHASES:
        phases[phase] = [found(phase, Severity.WARNING)]
    compiled = pipeline.compile_map(PATH)
    assert str(compiled.map) == "map"
    assert compiled.files == ((PATH, "abc"),)
    assert phases["ran"] == list(PHASES)
    assert [diagnostic.rule for diagnostic in compiled.diagnostics] == list(reversed(PHASES))


LIBRARY = """\
format: 1
library: {id: acme/common, title: Common}
enums: {mode: {0: idle, 1: run}}
"""
MAP = """\
format: 1
map: {id: acme/oven, title: Oven, maker: Acme, class_prefix: Acme}
uses: [acme/common]
manual: {title: Manual, number: "1"}
models: {M1: {}}
groups:
  - {id: all, name: All, registers: [{at: 1, name: Mode, enum: mode, access: r, source: "1"}]}
"""


def test_what_an_editor_has_not_saved_counts_instead_of_the_files(tmp_path: Path) -> None:
    oven, common = tmp_path / "acme/oven.yaml", tmp_path / "acme/common.library.yaml"
    unsaved = {oven: MAP, common: LIBRARY}
    assert pipeline.compile_map(oven, unsaved).diagnostics == ()
    broken = pipeline.compile_map(oven, unsaved | {common: LIBRARY.replace("mode", "state")})
    assert [(each.span.file, each.span.line) for each in broken.diagnostics] == [(str(oven), 7)]
    assert not list(tmp_path.iterdir())
