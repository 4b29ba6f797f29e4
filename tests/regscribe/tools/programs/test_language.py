"""How maps say what a program is made of: names, models, extension, and what is refused."""

import json
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import pytest

from regscribe import lower, schema, source
from regscribe.export.json import json_text
from regscribe.model import Diagnostic, ProgramCounts, ProgramPart, SetpointProgram, WhileRunning
from regscribe.pipeline import compile_map

from .conftest import KILN, Built, compile_text, shipped

EXTENDING = """\
format: 1
map: {id: test/clone, title: Clone, maker: Test, class_prefix: Clone}
extends: test/kiln
manual: {title: Clone manual, number: C-1}
models: {C1: {from: K1}}
"""


def diagnosed(text: str) -> list[Diagnostic]:
    document, found = source.parse(text, name="maps/test/kiln.yaml")
    assert document is not None, found
    return schema.validate(document) or lower.lower(document)[1]


def program_of(name: str, model: str) -> SetpointProgram:
    (program,) = shipped(name).model(model).programs
    return program


def test_names_mean_the_segment_first_then_the_program_then_anything() -> None:
    (program,) = compile_text(KILN).models[0].programs

    assert program.segments.setpoint == "recipes[{i}].steps[{j}].level"
    assert program.cycles == "recipes[{i}].runs"
    assert program.segment_now == "segment_now"
    assert (program.first, program.programs, program.numbers) == (1, 2, (1, 2))
    assert (program.segments.first, program.segments.many) == (0, 6)


def test_codes_are_given_by_name_and_each_program_has_registers_of_its_own() -> None:
    (program,) = compile_text(KILN).models[0].programs

    assert program.start.writes == (("order_{i}", Fraction(1)),)
    assert program.forever == 0
    assert program.time_unit is not None
    assert program.time_unit.codes == ((0, "s"), (1, "min"))


def test_the_order_of_writing_begins_with_what_is_not_named() -> None:
    (program,) = compile_text(KILN).models[0].programs

    assert program.order[-2:] == (ProgramPart.COUNT, ProgramPart.SEGMENTS)
    assert set(program.order) == set(ProgramPart)
    assert (program.counts, program.while_running) == (ProgramCounts.AFTER_FIRST, WhileRunning.REFUSED)


def test_outputs_that_a_model_lacks_are_left_out_there() -> None:
    assert [name for name, _ in program_of("athena/series-c", "16C").segments.outputs] == ["ramp_event", "soak_event"]
    assert program_of("athena/series-c", "1ZC").segments.outputs == ()


@pytest.mark.parametrize(
    ("old", "new", "rule", "says"),
    [
        ("setpoint: level", "setpoint: lvel", "RS0301", "did you mean `level`"),
        ("array: steps", "array: stpes", "RS0301", "there is no array `stpes`"),
        ("array: recipes", "array: recips", "RS0301", "did you mean `recipes`"),
        ('start: {"order_{i}": go}', 'start: {"odrer_{i}": go}', "RS0301", "there is no register `odrer_{i}`"),
        ('start: {"order_{i}": go}', 'start: {"order_{i}": gone}', "RS0305", "did you mean `go`"),
        ('start: {"order_{i}": go}', "start: begin", "RS0313", "there is no command `begin`"),
        ("forever: endless", "forever: endles", "RS0305", "did you mean `endless`"),
        ("second: s,", "secnd: s,", "RS0305", "did you mean `second`"),
        ("held: [paused]", "held: [pause]", "RS0305", "did you mean `paused`"),
        ("counts: after_first", "counts: first", "RS0204", "counts"),
        ("holdback: band", "holdbak: band", "RS0201", "did you mean `holdback`"),
    ],
)
def test_a_name_that_means_nothing_is_refused(old: str, new: str, rule: str, says: str) -> None:
    assert old in KILN
    found = diagnosed(KILN.replace(old, new))

    assert rule in {one.rule for one in found}, found
    assert says in " ".join(f"{one.message} {one.help}" for one in found)


@pytest.fixture
def extend(tmp_path: Path) -> Callable[[str], tuple[SetpointProgram, ...]]:
    """Compile a map that extends the kiln; its programs."""

    def made(more: str) -> tuple[SetpointProgram, ...]:
        folder = tmp_path / "maps" / "test"
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "kiln.yaml").write_text(KILN, encoding="utf-8")
        (folder / "clone.yaml").write_text(EXTENDING + more, encoding="utf-8")
        compiled = compile_map(folder / "clone.yaml")
        assert compiled.map is not None, compiled.diagnostics
        return compiled.map.models[0].programs

    return made


def test_programs_are_inherited_overridden_and_dropped(extend: Callable[[str], tuple[SetpointProgram, ...]]) -> None:
    assert [one.id for one in extend("")] == ["recipe"]
    (changed,) = extend("override: [{program: recipe, reason: the manual says so, set: {while_running: allowed}}]\n")
    assert changed.while_running is WhileRunning.ALLOWED
    assert extend("drop: {programs: [{id: recipe, reason: the manual does not describe it}]}\n") == ()


def test_the_export_has_them_under_its_schema() -> None:
    (exported,) = json.loads(json_text([compile_text(KILN)]))["maps"]
    (program,) = exported["models"][0]["programs"]

    assert program["segments"]["ramp"] == "recipes[{i}].steps[{j}].ramp_time"
    assert program["status"] == {"register": "state", "running": [1, 2], "ended": [0], "held": [3]}


def test_a_driver_declares_what_its_map_says(kiln_map: Built) -> None:
    (declared,) = kiln_map.driver.setpoint_programs
    (said,) = kiln_map.map.models[0].programs

    assert declared._replace(requires=None) == said._replace(requires=None)
    assert declared.status == ("state", (1, 2), (0,), (3,))
    assert declared.start.writes == (("order_{i}", 1),)
    assert (declared.counts, declared.while_running) == ("after_first", "refused")


def test_a_program_has_only_what_its_manual_has() -> None:
    x5000, m5000 = program_of("athena/platinum-x5000", "X5000"), program_of("athena/platinum-m5000", "M5000")

    assert (x5000.hold.known, x5000.resume.known, x5000.start.known) == (False, False, True)
    assert (m5000.hold.known, m5000.end, m5000.segments.soak) == (True, "", "")
