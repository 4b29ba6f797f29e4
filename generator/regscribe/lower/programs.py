"""Setpoint programs: the names of registers become paths in which the numbers of program and segment are left open."""

import re
from dataclasses import dataclass
from fractions import Fraction

from regscribe.lower.commands import Device
from regscribe.lower.conditions import condition
from regscribe.lower.names import unknown
from regscribe.lower.node import Node, elements_of, items_of, text_of
from regscribe.lower.presence import present
from regscribe.lower.rules import UNKNOWN_COMMAND, UNKNOWN_REGISTER
from regscribe.lower.scope import Scope
from regscribe.lower.subject import Subject, code_of_text
from regscribe.model import (
    Inferred,
    ProgramAction,
    ProgramCounts,
    ProgramFinal,
    ProgramPart,
    ProgramSegments,
    ProgramStatus,
    ProgramTimeUnit,
    SetpointProgram,
    WhileRunning,
    Writable,
    numbered,
)

_ELEMENT = re.compile(r"\[(\d+)\]")


def programs_of(root: Node, device: Device) -> tuple[SetpointProgram, ...]:
    """The setpoint programs that a model has."""
    scope = device.scope
    return tuple(
        _program(name, node, scope)
        for name, node in items_of(root, "programs")
        if scope.model in present(node, scope.models, scope.models)
    )


def _program(name: str, node: Node, scope: Scope) -> SetpointProgram:
    array = node.child("array")
    numbers = _numbers(array, array.text(), scope) if array else []
    place = _Place(scope, tuple(numbers) or (0,), f"{array.text()}[{{i}}]." if array and numbers else "")
    count, cycles, forever = node.child("count"), node.child("cycles"), node.child("forever")
    limits, requires = node.child("setpoint_limits"), node.child("requires")
    running = node.child("while_running")
    return SetpointProgram(
        id=name,
        name=text_of(node, "name", name),
        segments=_segments(node.child("segments") or node, place),
        first=numbers[0] if numbers else 0,
        programs=len(numbers),
        description=text_of(node, "description"),
        section=text_of(node, "source"),
        final=_final(node.child("final"), place),
        count=place.path(count, "register"),
        counts=count.child("counts").choice(ProgramCounts, ProgramCounts.ALL)  # type: ignore[union-attr]
        if count and count.child("counts")
        else ProgramCounts.ALL,
        cycles=place.path(node, "cycles"),
        forever=place.code(forever, place.path(node, "cycles")) if forever and cycles else None,
        time_unit=_time_unit(node.child("time_unit"), place),
        holdback=place.path(node, "holdback"),
        power_failure=place.path(node, "power_failure"),
        end=place.path(node, "end"),
        setpoint_limits=(place.path(limits, "from"), place.path(limits, "to")) if limits else None,
        enable=place.values(node.child("enable")),
        requires=Writable(condition(requires.child("when"), scope), text_of(requires, "reason")) if requires else None,
        status=_status(node.child("status"), place),
        segment_now=place.path(node, "segment_now"),
        program_now=place.path(node, "program_now"),
        setpoint_now=place.path(node, "setpoint_now"),
        start=_action(node.child("start"), place),
        hold=_action(node.child("hold"), place),
        resume=_action(node.child("resume"), place),
        reset=_action(node.child("reset"), place),
        while_running=running.choice(WhileRunning, WhileRunning.NOT_STATED) if running else WhileRunning.NOT_STATED,
        order=_order(node),
        inferred=tuple(Inferred(text_of(one, "what"), text_of(one, "why")) for one in elements_of(node, "inferred")),
        span=node.key_span,
    )


def _order(node: Node) -> tuple[ProgramPart, ...]:
    told = tuple(one.choice(ProgramPart, ProgramPart.SEGMENTS) for one in elements_of(node, "write_order"))
    return (*(part for part in ProgramPart if part not in told), *told)


def _numbers(node: Node, name: str, scope: Scope) -> list[int]:
    """The indices of an array's elements; RS0301 and none if there is no such array."""
    found = [path[len(name) :] for path in scope.entries if path.startswith(f"{name}[")]
    numbers = sorted({int(match[1]) for rest in found if (match := _ELEMENT.match(rest))})
    if not numbers:
        known = dict.fromkeys(_ELEMENT.split(path)[0] for path in scope.homes if "[" in path)
        unknown(node, UNKNOWN_REGISTER, "array", node.text(), known)
    return numbers


@dataclass(frozen=True, slots=True)
class _Place:
    """Where the names of a program's registers are looked up: in each element `prefix`, then everywhere.

    `inside` is the path of a segment, `first` the number of the first one; it comes before the element.
    """

    scope: Scope
    numbers: tuple[int, ...]
    prefix: str
    inside: str = ""
    first: int = 0

    def path(self, node: Node | None, key: str) -> str:
        """The path of the register that a key names; empty if the key is absent, or after RS0301 or RS0302."""
        name = node.child(key) if node else None
        return self.found(name, name.text()) if name else ""

    def found(self, node: Node, name: str, *, at_key: bool = False) -> str:
        """The path of the register of this name; RS0301 or RS0302 at `node` and an empty one if there is none."""
        candidates = [f"{prefix}{name}" for prefix in dict.fromkeys((self.inside, self.prefix, ""))]
        for path in candidates:
            if all(one in self.scope.entries for one in self._concrete(path)):
                return path
        elsewhere = [one for path in candidates for one in self._concrete(path) if one in self.scope.homes]
        if elsewhere:
            lacking = next((one for one in elsewhere if one not in self.scope.entries), elsewhere[0])
            self.scope.missing(node, lacking, at_key=at_key)
        else:
            unknown(node, UNKNOWN_REGISTER, "register", name, self._known(), at_key=at_key)
        return ""

    def absent(self, name: str) -> bool:
        """Whether other models have the register in the segment, and this one does not."""
        path = numbered(f"{self.inside}{name}", self.numbers[0], self.first)
        return path in self.scope.homes and path not in self.scope.entries

    def _concrete(self, path: str) -> list[str]:
        return [numbered(path, number, self.first) for number in self.numbers]

    def _known(self) -> list[str]:
        own = [numbered(prefix, self.numbers[0], self.first) for prefix in (self.inside, self.prefix) if prefix]
        return [path.removeprefix(part) for part in own for path in self.scope.homes if path.startswith(part)] + [
            path for path in self.scope.homes if "[" not in path
        ]

    def code(self, node: Node, path: str) -> int:
        """The code of a member or special value of the register at `path`."""
        entry = self.scope.entries.get(numbered(path, self.numbers[0], self.first))
        return int(code_of_text(node, Subject(path, entry), self.scope)) if entry else 0

    def values(self, node: Node | None) -> tuple[tuple[str, Fraction], ...]:
        """Paths and codes of a mapping from registers to their values."""
        found = []
        for key, value in node.items() if node else ():
            path = self.found(value, key, at_key=True)
            if path:
                found.append((path, value.number() if value.is_number else Fraction(self.code(value, path))))
        return tuple(found)

    def outputs(self, node: Node | None) -> tuple[tuple[str, str], ...]:
        """Names and paths of outputs, without those that only other models have."""
        named = [(name, one) for name, one in items_of(node, "outputs") if not self.absent(one.text())]
        return tuple((name, self.found(one, one.text())) for name, one in named)


def _segments(node: Node, around: _Place) -> ProgramSegments:
    array = node.child("array") or node
    name = array.text() if array.is_text else ""
    first = [f"{numbered(prefix, around.numbers[0])}{name}" for prefix in dict.fromkeys((around.prefix, ""))]
    inner = bool(around.prefix) and any(path.startswith(f"{first[0]}[") for path in around.scope.entries)
    numbers = _numbers(array, first[0] if inner else name, around.scope) or [0]
    prefix = around.prefix if inner else ""
    place = _Place(around.scope, around.numbers, around.prefix, f"{prefix}{name}[{{j}}].", numbers[0])
    return ProgramSegments(
        first=numbers[0],
        count=len(numbers),
        setpoint=place.path(node, "setpoint"),
        ramp=place.path(node, "ramp"),
        soak=place.path(node, "soak"),
        outputs=place.outputs(node),
        idle=tuple(place.found(one, one.text()) for one in elements_of(node, "idle")),
    )


def _final(node: Node | None, place: _Place) -> ProgramFinal | None:
    return ProgramFinal(setpoint=place.path(node, "setpoint"), outputs=place.outputs(node)) if node else None


def _time_unit(node: Node | None, place: _Place) -> ProgramTimeUnit | None:
    if node is None:
        return None
    path = place.path(node, "register")
    units = items_of(node, "codes")
    codes = [(place.code(Node(one.context, one.path, member), path), one.text()) for member, one in units]
    return ProgramTimeUnit(register=path, codes=tuple(codes))


def _status(node: Node | None, place: _Place) -> ProgramStatus | None:
    if node is None:
        return None
    path = place.path(node, "register")
    states = {key: tuple(place.code(one, path) for one in elements_of(node, key)) for key in _STATES}
    return ProgramStatus(register=path, **states)


_STATES = ("running", "held", "ended")


def _action(node: Node | None, place: _Place) -> ProgramAction:
    if node is None or not node.is_text:
        return ProgramAction(writes=place.values(node))
    place.scope.named(node, "commands", rule=UNKNOWN_COMMAND, what="command")
    return ProgramAction(command=node.text())
