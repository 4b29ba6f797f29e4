"""Reads a program from a device."""

from collections.abc import Iterator, Mapping
from typing import Any

from regscribe.tools.live.reading import read_with
from regscribe.tools.programs.program import FOREVER, Final, Program, Segment, Setting
from regscribe.tools.programs.settings import SettingConverter, needs
from regscribe.tools.programs.slot import ProgramSlot
from regscribe_runtime import Register, Snapshot
from regscribe_runtime.operations.session import Operation, Session, Task
from regscribe_runtime.values.programs import ProgramCounts


def read(place: ProgramSlot) -> Task[Program]:
    """Read a program: its segments in use, or all that may be in use where the manual leaves their number open."""

    def task(session: Session) -> Operation[Program]:
        yield from place.exists(session)
        snapshot = yield from read_with(_registers(place), needs)(session)
        unit = ""
        if place.spec.time_unit:
            path, units = place.spec.time_unit
            unit = dict(units).get(int(snapshot[place.register(path).path]), "")
        return _Reader(place, snapshot, SettingConverter(snapshot.valid, session.givens, unit)).program()

    return task


def _registers(place: ProgramSlot) -> Iterator[Register[Any]]:
    spec, segments = place.spec, place.spec.segments
    unit = spec.time_unit.register if spec.time_unit else ""
    single = [spec.number_of_segments, spec.cycles, unit, spec.holdback, spec.power_failure, spec.end]
    if spec.final:
        single += [spec.final.setpoint, *(path for _, path in spec.final.outputs)]
    yield from (place.register(path) for path in single if path)
    paths = [segments.setpoint, segments.ramp, segments.soak, *(path for _, path in segments.outputs)]
    for number in range(segments.first, segments.first + segments.many):
        yield from (place.register(path, number) for path in paths if path)


class _Reader:
    """Makes a program of the registers that were read."""

    def __init__(self, place: ProgramSlot, snapshot: Snapshot, converter: SettingConverter) -> None:
        self.place, self.snapshot, self.converter = place, snapshot, converter

    def program(self) -> Program:
        spec, final = self.place.spec, None
        count = self._value(spec.number_of_segments)
        if spec.final:
            final = Final(to=self._setting(spec.final.setpoint), outputs=self._outputs(spec.final.outputs))
        return Program(
            name=self.place.name,
            segments=tuple(self._segment(number) for number in self._used(count)),
            final=final,
            number_of_segments=int(count) if spec.counts is ProgramCounts.NOT_STATED and count is not None else None,
            cycles=self._cycles(),
            time_unit=self.converter.time_unit or None,
            holdback=self._setting(spec.holdback) if spec.holdback else None,
            power_failure=self._name(spec.power_failure),
            end=self._name(spec.end),
            map_id=self.place.map_id,
            model=self.place.model,
        )

    def _value(self, path: str, segment: int = 0) -> Any:  # noqa: ANN401 - a value of any register
        register = self.place.register(path, segment) if path else None
        return self.snapshot[register.path] if register else None

    def _setting(self, path: str, segment: int = 0, *, time: bool = False) -> Setting:
        register = self.place.register(path, segment)
        return self.converter.setting(register, self.snapshot[register.path], time=time)

    def _name(self, path: str) -> str | None:
        return str(self._setting(path)) if path else None

    def _outputs(self, outputs: tuple[tuple[str, str], ...], segment: int = 0) -> Mapping[str, str]:
        return {name: str(self._setting(path, segment)) for name, path in outputs}

    def _cycles(self) -> int | str | None:
        spec = self.place.spec
        value = self._value(spec.cycles)
        if value is None:
            return None
        return FOREVER if spec.forever is not None and int(value) == spec.forever else int(value)

    def _used(self, count: Any) -> range:  # noqa: ANN401 - as above
        """Numbers of the segments in use, or of all that may be in use."""
        segments = self.place.spec.segments
        used = segments.many
        if count is not None:
            used = min(int(count) + (self.place.spec.counts is not ProgramCounts.ALL), segments.many)
        elif segments.idle:
            while used and all(int(self._value(path, segments.first + used - 1)) == 0 for path in segments.idle):
                used -= 1
        return range(segments.first, segments.first + used)

    def _segment(self, number: int) -> Segment:
        segments = self.place.spec.segments
        return Segment(
            to=self._setting(segments.setpoint, number),
            ramp=self._setting(segments.ramp, number, time=True),
            soak=self._setting(segments.soak, number, time=True) if segments.soak else None,
            outputs=self._outputs(segments.outputs, number),
        )
