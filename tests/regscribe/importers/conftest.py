"""Configurations of other programs as maps: what was taken, and what its registers make of words."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from regscribe import plugins
from regscribe.draft import Draft, Outcome
from regscribe.draft.settle import settle
from regscribe.model import Register, RegisterMap, Severity
from regscribe.pipeline import compile_map
from regscribe.reference import Meaning, decode

HEAD = {"format": 1, "map": {"id": "test/device", "title": "Device", "maker": "Test", "class_prefix": "Device"}}


@dataclass(frozen=True)
class Imported:
    """A draft after what `check` refuses was taken out, its text, and the map that it is."""

    draft: Draft
    text: str
    map: RegisterMap

    @property
    def outcomes(self) -> dict[str, str]:
        """What became of each row, by name."""
        return {entry.name: entry.outcome.value for entry in self.draft.each}

    def codes(self, name: str) -> list[str]:
        """The codes of the remarks on a row."""
        return [remark.code for entry in self.draft.each if entry.name == name for remark in entry.remarks]

    def line(self, name: str) -> int:
        """The line of a row."""
        return next(entry.place.line for entry in self.draft.each if entry.name == name)

    @property
    def left_out(self) -> dict[str, str]:
        """The reason of each row that is left out."""
        left = [entry for entry in self.draft.each if entry.outcome is Outcome.LEFT_OUT]
        return {entry.name: "; ".join(remark.message for remark in entry.remarks) for entry in left}

    def register(self, path: str) -> Register:
        """A register by its path."""
        found = self.map.models[0].register(path)
        assert found is not None, [one.path for one in self.map.models[0].registers]
        return found

    def value(self, path: str, *words: int) -> Any:
        """What the reference makes of the words of a register: a number or text, or what is meant instead."""
        register = self.register(path)
        reading = decode(register, register.base, words)
        return reading.value if reading.meaning is Meaning.VALUE else str(reading.meaning)

    def members(self, path: str) -> dict[int, str]:
        """The codes of an enum with their labels."""
        enum = self.register(path).enum
        return {member.code: member.label for member in enum.members} if enum else {}

    def bits(self, path: str) -> dict[str, tuple[int, int]]:
        """The parts of a word."""
        return {one.label: (one.low, one.high) for one in self.register(path).fields}


Import = Callable[..., Imported]


@pytest.fixture
def imported(tmp_path: Path) -> Import:
    """Import a text in a format, with options; all that is left must pass `check`."""

    def check(text: str) -> Any:
        path = tmp_path / "map.yaml"
        path.write_text(text, encoding="utf-8")
        return compile_map(path).diagnostics

    def run(form: str, text: str | bytes, **options: str) -> Imported:
        data = text.encode() if isinstance(text, str) else text
        given: Mapping[str, str] = {one.name: one.default for one in plugins.importer(form).options} | options
        draft = plugins.read(form, data, "source", given)
        assert not draft.failed, draft.findings
        draft, written, found = settle(draft, HEAD, check)
        assert [one for one in found if one.severity is Severity.ERROR] == [], written.text
        compiled = compile_map(tmp_path / "map.yaml").map
        assert compiled is not None
        return Imported(draft, written.text, compiled)

    return run


@pytest.fixture
def refusal() -> Callable[..., str]:
    """The one message of a source that nothing can be made of."""

    def run(form: str, text: str | bytes, **options: str) -> str:
        data = text.encode() if isinstance(text, str) else text
        given = {one.name: one.default for one in plugins.importer(form).options} | options
        draft = plugins.read(form, data, "source", given)
        (found,) = draft.findings
        assert draft.failed
        assert draft.entries == ()
        return f"{found.span.line}: {found.message}"

    return run
