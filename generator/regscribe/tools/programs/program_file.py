"""Programs as YAML files: read with line and column of each mistake, written to be read and edited by people."""

from collections.abc import Mapping
from decimal import Decimal
from pathlib import Path
from typing import Any, NamedTuple

from regscribe import files
from regscribe.source import Document
from regscribe.tools.live.errors import TargetError
from regscribe.tools.programs.assignments import Where
from regscribe.tools.programs.program import Amount, Final, Program, Segment, Setting, setting

LANGUAGE = "program"


class ProgramFile(NamedTuple):
    """A program and the file it was read from."""

    program: Program
    document: Document

    def place(self, where: Where) -> str:
        """`anneal.yaml:12:9` for a place in the program."""
        return str(self.document.span(("program", *where)))


def load(path: str | Path) -> ProgramFile:
    """Read a file; TargetError for one that cannot be read, and for its mistakes with their places."""
    try:
        document = files.read(Path(path), language=LANGUAGE, what="program")
    except files.FileError as error:
        raise TargetError(str(error)) from None
    return ProgramFile(_program(document.data["program"]), document)


def _program(data: Mapping[str, Any]) -> Program:
    final = data.get("final")
    return Program(
        name=data.get("name", ""),
        segments=tuple(_segment(one) for one in data["segments"]),
        final=Final(to=_setting(final["to"]), outputs=_outputs(final)) if final else None,
        number_of_segments=data.get("number_of_segments"),
        cycles=data.get("cycles"),
        time_unit=data.get("time_unit"),
        holdback=_maybe(data.get("holdback")),
        power_failure=data.get("power_failure"),
        end=data.get("end"),
        map_id=data.get("map", ""),
        model=str(data.get("model", "")),
    )


def _segment(data: Mapping[str, Any]) -> Segment:
    return Segment(
        to=_setting(data["to"]), ramp=_setting(data["ramp"]), soak=_maybe(data.get("soak")), outputs=_outputs(data)
    )


def _outputs(data: Mapping[str, Any]) -> dict[str, str]:
    return {name: str(state) for name, state in data.get("outputs", {}).items()}


def _maybe(value: Any) -> Setting | None:  # noqa: ANN401 - checked against the schema
    return None if value is None else _setting(value)


def _setting(value: Any) -> Setting:  # noqa: ANN401 - as above
    return setting(value) if isinstance(value, str) else Amount(Decimal(str(value)))


def plain(program: Program) -> dict[str, Any]:
    """A program as plain data, with the keys of a file; what the device does not have is left out."""
    final = program.final
    found = {
        "name": program.name or None,
        "map": program.map_id or None,
        "model": program.model or None,
        "cycles": program.cycles,
        "time_unit": program.time_unit,
        "holdback": _spelled(program.holdback),
        "power_failure": program.power_failure,
        "end": program.end,
        "number_of_segments": program.number_of_segments,
        "segments": [_plain_segment(one) for one in program.segments],
        "final": _given({"to": _spelled(final.to), "outputs": dict(final.outputs) or None}) if final else None,
    }
    return _given(found)


def _plain_segment(one: Segment) -> dict[str, Any]:
    times = {"ramp": _spelled(one.ramp), "soak": _spelled(one.soak)}
    return _given({"to": _spelled(one.to), **times, "outputs": dict(one.outputs) or None})


def _spelled(value: Setting | None) -> str | int | float | None:
    """An amount without a unit is a number."""
    if isinstance(value, Amount) and not value.unit:
        whole = value.number == value.number.to_integral_value()
        return int(value.number) if whole else float(value.number)
    return None if value is None else str(value)


def _given(items: Mapping[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in items.items() if value is not None}


def dump(program: Program, *, remarks: tuple[str, ...] = ()) -> str:
    """A program as a YAML file that `load` reads back; `remarks` become comments at the top."""
    data = {key: _lines(value) for key, value in plain(program).items()}
    return files.dump({"format": 1, "program": data}, remarks=remarks)


def _lines(value: Any) -> Any:  # noqa: ANN401 - of `plain`
    """Plain data with each segment on one line."""
    if isinstance(value, Mapping):
        return files.OneLine(value)
    return [_lines(one) for one in value] if isinstance(value, list) else value
