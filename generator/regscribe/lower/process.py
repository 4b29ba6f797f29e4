"""Which registers control the process value, and how: the key `process`."""

from regscribe.lower.conditions import condition
from regscribe.lower.node import Value, elements_of, text_of, whole_of
from regscribe.lower.register_links import subject_at
from regscribe.lower.scope import Scope
from regscribe.model import ALWAYS, Alarm, Condition, OnOff, Output, Pid, Process, Ramp, Trip, TripKind

_MINUTE = 60


def process_of(node: Value | None, scope: Scope) -> Process | None:
    """The process of the model of the scope; None where the map has none."""
    if node is None:
        return None
    ramp = node.child("ramp")
    return Process(
        value=_role(node, "value", scope),
        setpoint=_role(node, "setpoint", scope),
        outputs=tuple(_output(each, scope) for each in _here(node, "outputs", scope)),
        alarms=tuple(_alarm(each, scope) for each in _here(node, "alarms", scope)),
        ramp=_ramp(ramp, scope) if ramp else None,
        off=_maybe(node, "off", scope),
        manual=_maybe(node, "manual", scope),
        highest=_role(node, "highest", scope),
        lowest=_role(node, "lowest", scope),
        fault=_role(node, "fault", scope),
        assumed=tuple((text_of(each, "what"), text_of(each, "why")) for each in elements_of(node, "inferred")),
        section=text_of(node, "source"),
        span=node.key_span,
    )


def _here(node: Value, key: str, scope: Scope) -> list[Value]:
    return [each for each in elements_of(node, key) if scope.has(each)]


def _role(node: Value, key: str, scope: Scope) -> str:
    return subject_at(node.child(key), scope)


def _maybe(node: Value, key: str, scope: Scope) -> Condition | None:
    child = node.child(key)
    return condition(child, scope) if child else None


def _output(node: Value, scope: Scope) -> Output:
    full, pid, on_off = node.child("full"), node.child("pid"), node.child("on_off")
    given = {} if full is None else {"full": full.number()}
    return Output(
        percent=_role(node, "percent", scope),
        cools=_cools(node.child("cools"), scope),
        pid=_pid(pid, scope) if pid else None,
        on_off=_on_off(on_off, scope) if on_off else None,
        manual=_role(node, "manual", scope),
        failsafe=_role(node, "failsafe", scope),
        low=_role(node, "low", scope),
        high=_role(node, "high", scope),
        active=_role(node, "active", scope),
        **given,
    )


def _cools(node: Value | None, scope: Scope) -> Condition | None:
    if node is None or node.value is False:
        return None
    return ALWAYS if node.value is True else condition(node, scope)


def _pid(node: Value, scope: Scope) -> Pid:
    ends = [subject_at(each, scope) for each in elements_of(node, "span")]
    return Pid(
        when=condition(node.child("when"), scope),
        band=_role(node, "band", scope),
        integral=_role(node, "integral", scope),
        derivative=_role(node, "derivative", scope),
        bias=_role(node, "bias", scope),
        ends=(ends[0], ends[1]) if ends else None,
    )


def _on_off(node: Value, scope: Scope) -> OnOff:
    return OnOff(when=condition(node.child("when"), scope), hysteresis=_role(node, "hysteresis", scope))


def _ramp(node: Value, scope: Scope) -> Ramp:
    return Ramp(
        rises=_role(node, "rises", scope),
        falls=_role(node, "falls", scope),
        seconds=whole_of(node, "seconds", _MINUTE),
        shows=_role(node, "shows", scope),
        when=condition(node.child("when"), scope),
    )


def _alarm(node: Value, scope: Scope) -> Alarm:
    return Alarm(
        active=tuple(subject_at(each, scope) for each in elements_of(node, "active")),
        trips=tuple(trip for each in elements_of(node, "trips") for trip in _trips(each, scope)),
        when=condition(node.child("when"), scope),
        latched=_maybe(node, "latched", scope),
        hysteresis=_role(node, "hysteresis", scope),
        delay=_role(node, "delay", scope),
        inhibit=_role(node, "inhibit", scope),
    )


def _trips(node: Value, scope: Scope) -> list[Trip]:
    when = condition(node.child("when"), scope)
    return [Trip(kind, _role(node, kind, scope), when) for kind in TripKind if node.child(kind)]
