"""Any malformed map gives clear messages, never a traceback: thousands of broken maps through every phase.

Every variant comes from a seed; what fails names it and shows its files. What became of the variants of a job is
printed, and shown by `pytest -rP`.
"""

import ast
import csv
import io
import json
import os
import re
import signal
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from importlib import import_module
from pathlib import Path
from time import process_time
from typing import Any, NamedTuple
from xml.etree import ElementTree as ET

import pytest

from regscribe import checks, compose, lower, pipeline, schema, source
from regscribe.checks.catalogue import Example
from regscribe.emit import EMITTERS
from regscribe.export.csv import csv_text
from regscribe.export.json import json_text
from regscribe.model import RegisterMap
from regscribe.pipeline import Compiled, compile_map, has_errors

HANG_SECONDS = 60.0
"""CPU time of one variant: very many times what any of the unbroken maps needs."""
CANARY = "REGSCRIBE_FUZZ"
SLOW = {"vectors"}
PARSERS: dict[str, Callable[[str], object]] = {
    ".py": ast.parse,
    ".json": json.loads,
    ".svg": ET.fromstring,
    ".md": str.strip,
}


class Job(NamedTuple):
    """Variants of a kind of map, broken in one way; `least` must reach lowering, the checks and the emitters."""

    kind: str
    way: str
    seeds: range
    least: tuple[int, int, int]
    deep: int
    """Of so many maps that compile, one goes through the slow emitters and has its driver imported."""


JOBS = (
    *(Job("rules", "tree", range(start, start + 650), (180, 140, 70), 6) for start in (0, 650, 1300)),
    Job("families", "tree", range(500), (70, 60, 50), 6),
    Job("families", "text", range(350), (10, 9, 9), 6),
    Job("rules", "text", range(800), (50, 40, 20), 6),
    Job("oven", "tree", range(100), (40, 28, 16), 30),
    Job("oven", "text", range(100), (8, 6, 4), 30),
    Job("fdc", "tree", range(60), (20, 17, 11), 20),
    Job("fdc", "text", range(40), (5, 5, 4), 20),
    Job("athena", "tree", range(40), (13, 12, 9), 20),
    Job("athena", "text", range(30), (5, 4, 4), 20),
)


@dataclass
class Tally:
    """How many variants reached each phase, and the longest that one took, in seconds of CPU time."""

    reached: Counter[str] = field(default_factory=Counter)
    slowest: dict[str, float] = field(default_factory=dict)

    def timed(self, phase: str, work: Callable[..., Any]) -> Callable[..., Any]:
        """Let `work` be counted."""

        def count(*arguments: Any, **options: Any) -> Any:
            self.reached[phase] += 1
            start = process_time()
            result = work(*arguments, **options)
            self.slowest[phase] = max(self.slowest.get(phase, 0), process_time() - start)
            return result

        return count


@pytest.fixture
def tally(monkeypatch: pytest.MonkeyPatch) -> Tally:
    """The phases of the pipeline, counted from now on."""
    found = Tally()
    phases = ((source, "load"), (schema, "validate"), (compose, "compose"), (lower, "lower"), (checks, "check"))
    for room, work in phases:
        monkeypatch.setattr(room, work, found.timed(work, getattr(room, work)))
    return found


@contextmanager
def told(files: Example, what: str) -> Iterator[None]:
    """Stop what hangs, and add to any failure the variant that it is about."""

    def stop(*_: object) -> None:
        raise TimeoutError

    signal.signal(signal.SIGVTALRM, stop)
    signal.setitimer(signal.ITIMER_VIRTUAL, HANG_SECONDS)
    try:
        yield
    except Exception as error:
        shown = "\n".join(f"--- {name}\n{text[:20_000]}" for name, text in files)
        error.add_note(f"{what}\n{shown}")
        raise
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)


def compiled(files: Example, folder: Path) -> Compiled:
    for name, text in files:
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(text.encode("utf-8", "surrogatepass"))
    return compile_map(folder / files[0][0])


def assert_told_where(files: Example, result: Compiled, folder: Path) -> None:
    """What is wrong is said, at places inside the files."""
    lines = {source.display_name(folder / name): re.split("\r\n|[\r\n]", text) for name, text in files}
    assert result.map is not None or has_errors(result.diagnostics) or "library:" in files[0][1].replace('"', "")
    for found in result.diagnostics:
        assert found.message.strip()
        assert "Traceback" not in found.message
        for span in (found.span, *(related.span for related in found.related)):
            there = lines[span.file]
            assert 1 <= span.line <= span.end_line <= len(there), found
            assert 1 <= span.column <= len(there[span.line - 1]) + 1, found
            assert (span.line, span.column) <= (span.end_line, span.end_column), found


def assert_emitted(register_map: RegisterMap, tally: Tally, *, deep: bool) -> None:
    """What is rendered can be parsed; a driver of hostile text executes nothing of it."""
    for name in (name for name in EMITTERS if deep or name not in SLOW):
        emitter = import_module(EMITTERS[name])
        for path, text in tally.timed(name, emitter.render)(register_map).items():
            assert PARSERS[Path(path).suffix](text) is not None
            if name == "python":
                names = {node.id for node in ast.walk(ast.parse(text)) if isinstance(node, ast.Name)}
                assert "__import__" not in names
                if deep and "from regscribe_devices" not in text:  # the driver of another map is not there
                    tally.timed("import", exec)(text, {"__name__": "driver"})
    if deep:
        assert json.loads(tally.timed("json", json_text)([register_map]))
        rows = csv.reader(io.StringIO(tally.timed("csv", csv_text)([register_map])))
        assert len({len(row) for row in rows}) == 1


@pytest.mark.parametrize("job", JOBS, ids=lambda job: f"{job.kind}-{job.way}-{job.seeds.start}")
def test_no_broken_map_makes_a_phase_raise_or_hang(
    job: Job, broken: Callable[[str, str, int], Example], tally: Tally, tmp_path: Path
) -> None:
    for seed in job.seeds:
        files = broken(job.kind, job.way, seed)
        with told(files, f"variant {seed} of {job.kind} as {job.way}"):
            result = compiled(files, tmp_path)
            assert_told_where(files, result, tmp_path)
            if result.map is not None:
                assert_emitted(result.map, tally, deep=tally.reached["python"] % job.deep == 0)
    print(dict(tally.reached), {phase: f"{seconds:.2f} s" for phase, seconds in tally.slowest.items()})  # noqa: T201
    reached = tuple(tally.reached[phase] for phase in ("lower", "check", "python"))
    assert all(number >= least for number, least in zip(reached, job.least, strict=True)), reached
    assert tally.reached["import"]
    assert CANARY not in os.environ


@pytest.mark.parametrize("kind", ["oven", "fdc", "athena", "rules", "families"])
def test_the_maps_that_are_broken_are_sound_before(
    kind: str, sound: Callable[[str], list[Example]], tmp_path: Path
) -> None:
    good = [
        not has_errors(compiled(files, tmp_path / str(number)).diagnostics) for number, files in enumerate(sound(kind))
    ]
    assert sum(good) >= len(good) * (0.4 if kind in {"rules", "families"} else 1)


def test_there_are_thousands_of_variants() -> None:
    assert sum(len(job.seeds) for job in JOBS) >= 3000
    assert pipeline.compile_map is compile_map
