"""Which registers control the process value, and how: the key `process`."""

from fractions import Fraction

from regscribe.lower.conditions import condition, condition_of
from regscribe.lower.node import Value
from regscribe.lower.scope import Scope
from regscribe.lower.subject import subject_at
from regscribe.model import ALWAYS, Alarm, Condition, OnOff, Output, Pid, Process, Ramp, Trip, TripKind

_MINUTE = 60
_PER_CENT = Fraction(100)


def process_of(node: Value | None, scope: Scope) -> Process | None:
    """The process of the model of the scope; None where the map has none."""
    if node is None:
        return None
    ramp = node.child("ramp")
    return Process(
        **_roles(node, scope, "value", "setpoint", "highest", "lowest", "fault"),
        outputs=tuple(_output(each, scope) for each in node.elements_of("outputs") if scope.has(each)),
        alarms=tuple(_alarm(each, scope) for each in node.elements_of("alarms") if scope.has(each)),
        ramp=_ramp(ramp, scope) if ramp else None,
        off=_maybe(node, "off", scope),
        manual=_maybe(node, "manual", scope),
        assumed=tuple((each.text_of("what"), each.text_of("why")) for each in node.elements_of("inferred")),
        section=node.text_of("source"),
        span=node.key_span,
    )


def _roles(node: Value, scope: Scope, *keys: str) -> dict[str, str]:
    """The registers or bits that keys name."""
    return {key: subject_at(node.child(key), scope) for key in keys}


def _maybe(node: Value, key: str, scope: Scope) -> Condition | None:
    child = node.child(key)
    return condition(child, scope) if child else None


def _output(node: Value, scope: Scope) -> Output:
    pid, on_off = node.child("pid"), node.child("on_off")
    return Output(
        **_roles(node, scope, "percent", "manual", "failsafe", "low", "high", "active"),
        full=node.fraction_of("full", _PER_CENT),
        cools=_cools(node.child("cools"), scope),
        pid=_pid(pid, scope) if pid else None,
        on_off=OnOff(when=condition_of(on_off, scope), **_roles(on_off, scope, "hysteresis")) if on_off else None,
    )


def _cools(node: Value | None, scope: Scope) -> Condition | None:
    if node is None or node.value is False:
        return None
    return ALWAYS if node.value is True else condition(node, scope)


def _pid(node: Value, scope: Scope) -> Pid:
    ends = [subject_at(each, scope) for each in node.elements_of("span")]
    return Pid(
        **_roles(node, scope, "band", "integral", "derivative", "bias"),
        when=condition_of(node, scope),
        ends=(ends[0], ends[1]) if ends else None,
    )


def _ramp(node: Value, scope: Scope) -> Ramp:
    return Ramp(
        **_roles(node, scope, "rises", "falls", "shows"),
        seconds=node.whole_of("seconds", _MINUTE),
        when=condition_of(node, scope),
    )


def _alarm(node: Value, scope: Scope) -> Alarm:
    trips = [(each, condition_of(each, scope)) for each in node.elements_of("trips")]
    return Alarm(
        **_roles(node, scope, "hysteresis", "delay", "inhibit"),
        active=tuple(subject_at(each, scope) for each in node.elements_of("active")),
        trips=tuple(
            Trip(kind, subject_at(each.child(kind), scope), when)
            for each, when in trips
            for kind in TripKind
            if each.child(kind)
        ),
        when=condition_of(node, scope),
        latched=_maybe(node, "latched", scope),
    )
