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
        def run(_: object) -> object:
            finds["ran"].append(name)
            return finds[name] if value is None else (value, finds[name])

        return run

    document = SimpleNamespace(name="m.yaml", content_hash="abc")

    def compose(_: object, path: Path) -> Composed:
        assert path == PATH
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
