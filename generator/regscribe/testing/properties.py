"""Properties of a generated driver, for hypothesis: each draws a register, a situation and a value or words.

The same tree gives the same result: the examples are derived from the test, not from a clock.
"""

import math
from collections.abc import Callable, Sequence
from decimal import Context, Decimal
from fractions import Fraction
from typing import Any

try:
    from hypothesis import HealthCheck, given, settings
    from hypothesis import strategies as st
except ModuleNotFoundError as error:
    message = "the generated tests need hypothesis: pip install 'regscribe[test]'"
    raise ModuleNotFoundError(message, name=error.name) from None

from regscribe.testing.compare import written
from regscribe.testing.driver_checks import DriverUnderTest
from regscribe.testing.simulated_read import wrong_requests, wrong_values
from regscribe.testing.vectors import Json, Trial, number
from regscribe_runtime import ValueNotDecodable, ValueRefused
from regscribe_runtime.registers.codec import present_type
from regscribe_runtime.registers.octets import OctetType
from regscribe_runtime.registers.register import Register
from regscribe_runtime.registers.value_types import FlagsType, WordType
from regscribe_runtime.values.wire_types import WireType

each_run = settings(
    max_examples=40,
    deadline=None,
    derandomize=True,
    database=None,
    suppress_health_check=[HealthCheck.too_slow],  # a busy machine is no fault of a driver
)
"""How often each property is tried for each model."""
drawn = given(data=st.data())
"""Hands `data` to a test, from which it draws."""
Data = st.DataObject

NO_VALUES: tuple[object, ...] = (math.nan, math.inf, -math.inf, None, [1], object())
PARTS = 1_000_000
SIGNIFICANT = {"float16": 3, "float32": 6, "float64": 6}
"""Decimal digits that every number of a type keeps (more of them in no vector)."""
NUMERIC = frozenset({"number", "integer", "raw"})


def round_trip(checked: DriverUnderTest, data: st.DataObject) -> None:
    """Assert decode(encode(v)) == v for values of the domain."""
    trial = data.draw(st.sampled_from(checked.written), label="register")
    value = data.draw(values(trial), label="value")
    words = trial.encode(value)
    assert _equal(trial.decode(words), value), f"{trial}: {value!r} became {trial.decode(words)!r} through {words}"  # noqa: S101 (a test library)


def refusal(checked: DriverUnderTest, data: st.DataObject) -> None:
    """Assert that what lies outside the domain is refused before anything is sent."""
    trial = data.draw(st.sampled_from(checked.written), label="register")
    value = data.draw(others(trial), label="no value")
    try:
        words = trial.encode(value)
    except ValueRefused:
        return
    message = f"{trial}: {value!r} was not refused but encoded to {words}"
    raise AssertionError(message)


def total_decoding(checked: DriverUnderTest, data: st.DataObject) -> None:
    """Assert that any words give a value or a ValueNotDecodable, and that a value that can be written comes back."""
    trial = data.draw(st.sampled_from(checked.trials), label="register")
    words = tuple(data.draw(st.lists(_word(trial), min_size=_size(trial), max_size=_size(trial)), label="words"))
    try:
        value = trial.decode(words)
        again = trial.decode(trial.encode(value))
    except (ValueNotDecodable, ValueRefused):
        return
    assert _equal(again, value), f"{trial}: {words} is {value!r}, which was sent and came back as {again!r}"  # noqa: S101 (as above)


def agreement(checked: DriverUnderTest, data: st.DataObject) -> None:
    """Assert that a value written through one view is the same value in every other view that can carry it."""
    trial = data.draw(st.sampled_from(checked.mirrored), label="register")
    value = data.draw(values(trial), label="value")
    for other in _situations(checked, trial):
        try:
            words = other.encode(value)
        except (ValueRefused, ValueNotDecodable):
            continue
        assert _equal(other.decode(words), value), f"{other}: {value!r} became {other.decode(words)!r}"  # noqa: S101 (as above)


def covering_reads(checked: DriverUnderTest, data: st.DataObject) -> None:
    """Assert that reading some registers asks for each exactly once, for no hole, and never for too much."""
    wrong = wrong_requests(checked.driver, data.draw(_several(checked), label="registers"))
    assert not wrong, "\n".join(wrong)  # noqa: S101 (as above)


def batches(checked: DriverUnderTest, data: st.DataObject) -> None:
    """Assert that registers read together have the values that they have alone, whatever the words."""
    chosen = data.draw(_several(checked), label="registers")
    seed, code = data.draw(st.integers(0, 65535), label="words"), data.draw(st.integers(0, 3), label="state")
    wrong = wrong_values(checked.driver, chosen, seed=seed, code=code)
    assert not wrong, "\n".join(wrong)  # noqa: S101 (as above)


def _several(checked: DriverUnderTest) -> st.SearchStrategy[list[Register[Any]]]:
    """Return a strategy of registers to read together: all, neighbours, or any."""
    readable = checked.readable
    ends = st.tuples(st.integers(0, len(readable) - 1), st.integers(1, len(readable)))
    neighbours = ends.map(lambda one: sorted(readable, key=lambda register: register.at)[one[0] : one[0] + one[1]])
    scattered = st.lists(st.sampled_from(readable), unique_by=lambda one: one.path, min_size=1, max_size=40)
    return st.one_of(st.just(readable), neighbours, scattered)


def _situations(checked: DriverUnderTest, trial: Trial) -> Sequence[Trial]:
    """Return the other views of the register where nothing that the trial says is said differently."""
    found = []
    for other in checked.trials:
        if other.register is trial.register and other.view != trial.view:
            state = {**other.state, **trial.state}
            givens = {**other.givens, **trial.givens}
            if all(other.state[name] == state[name] for name in other.state):
                found.append(Trial(other.register, other.entry, other.case, state, givens))
    return found


def _equal(found: object, value: object) -> bool:
    if isinstance(found, float) and isinstance(value, (int, Fraction)):
        return found == float(Fraction(value))
    return found == value


def _view(trial: Trial) -> Json:
    view: Json = next(view for view in trial.entry["views"] if view["name"] == trial.view)
    return view


def _size(trial: Trial) -> int:
    return int(_view(trial)["words"])


def _width(trial: Trial) -> int:
    """How many bits of its words a register uses: a 24-bit number leaves some."""
    wire = WireType(_view(trial)["type"])
    return wire.bits if wire.words == _size(trial) else 16 * _size(trial)


def _word(trial: Trial) -> st.SearchStrategy[int]:
    return st.integers(0, {"bit": 1, "uint8": 255}.get(_view(trial)["type"], 65535))


def values(trial: Trial) -> st.SearchStrategy[Any]:
    """Return a strategy of values that can be written in the situation of a trial."""
    kind, entry = trial.entry["kind"], trial.entry
    if kind == "boolean":
        return st.sampled_from((0, 1))
    if kind == "flags":
        named = [1 << bit for field in entry["fields"] for bit in range(field["low"], field["high"] + 1)]
        bits = [bit for bit in named if not bit & _absent(trial)]
        return (st.sets(st.sampled_from(bits)).map(sum) if bits else st.just(0)).filter(_no_fault(trial))
    if kind == "fields":
        absent = _absent(trial)
        return st.integers(0, (1 << _width(trial)) - 1).map(lambda bits: bits & ~absent).filter(_no_fault(trial))
    if kind == "string":
        return st.text(st.characters(min_codepoint=33, max_codepoint=126), max_size=_room(trial)).filter(_taken(trial))
    if kind == "version" or isinstance(trial.register.value_type, OctetType):
        return st.sampled_from([written(trial, vector["value"]) for vector in trial.case["encode"]])
    return st.sampled_from(trial.case["domain"]).flatmap(lambda stretch: _inside(trial, stretch))


def _room(trial: Trial) -> int:
    """How many characters fit a text: the most of those that vectors write."""
    return max((len(vector["value"]) for vector in trial.case["encode"]), default=0)


def _taken(trial: Trial) -> Callable[[str], bool]:
    """Return what tells texts that can be written from those by which the device reports a fault."""

    def taken(text: str) -> bool:
        faults = trial.register.sentinels
        raw = written_bytes(trial, text) if faults else b""
        return not any(fault.reports(int.from_bytes(raw)) for fault in faults)

    return taken


def written_bytes(trial: Trial, text: str) -> bytes:
    """Return the bytes that a text is written as."""
    value_type = trial.register.value_type
    return value_type.write(text, 2 * _size(trial)) if isinstance(value_type, OctetType) else b""


def _no_fault(trial: Trial) -> Callable[[int], bool]:
    """Return what tells bits that can be written from those by which the device reports a fault."""
    faults = {int(fault["stored"]) % 65536 ** _size(trial) for fault in trial.entry.get("faults", ())}
    return lambda bits: bits not in faults


def _absent(trial: Trial) -> int:
    """Return the bits of flags and parts that do not exist in the situation of a trial."""
    kind = present_type(trial.register, trial.state, trial.givens)
    return kind.absent if isinstance(kind, FlagsType | WordType) else 0


def _inside(trial: Trial, stretch: dict[str, Any]) -> st.SearchStrategy[Any]:
    low, high, step = Fraction(stretch["low"]), Fraction(stretch["high"]), Fraction(stretch.get("step", 0))
    holes = {Fraction(text) for text in stretch.get("except", ())}
    slope, offset = Fraction(stretch.get("slope", 1)), Fraction(stretch.get("offset", 0))
    digits = SIGNIFICANT.get(_view(trial)["type"])

    def carried(there: Fraction) -> Fraction:
        if digits is None:
            return there
        wire = (there - offset) / slope
        few = Context(prec=digits).divide(Decimal(wire.numerator), Decimal(wire.denominator))
        return slope * Fraction(few) + offset

    def value(part: int) -> Fraction:
        there = carried(low + (high - low) * Fraction(part, PARTS))
        return low + (there - low) // step * step if step else there

    def possible(there: Fraction) -> bool:
        return low <= there <= high and there not in holes and carried(there) == there

    part = 10 if digits and not step else 1
    small = st.integers(-99_999, 99_999).map(lambda count: slope * Fraction(count, part) + offset)
    near = small.map(lambda there: low + (there - low) // step * step if step else there)
    anywhere = st.one_of(st.integers(0, PARTS).map(value), near.filter(lambda there: low <= there <= high))
    ends = st.sampled_from((low, high))
    return st.one_of(anywhere, ends).filter(possible).map(lambda there: number(f"{there}"))


def others(trial: Trial) -> st.SearchStrategy[Any]:
    """Return a strategy of values that must be refused in the situation of a trial."""
    kind, entry = trial.entry["kind"], trial.entry
    nonsense: st.SearchStrategy[Any] = st.sampled_from(NO_VALUES)
    if kind == "enum":
        codes = {member["code"] for member in entry["members"]}
        return st.one_of(nonsense, st.integers(-70_000, 70_000).filter(lambda code: code not in codes))
    if kind == "flags":
        named = {bit for field in entry["fields"] for bit in range(field["low"], field["high"] + 1)}
        unnamed = [bit for bit in range(16 * _size(trial) + 1) if bit not in named]
        return st.one_of(nonsense, st.sampled_from(unnamed).map(lambda bit: 1 << bit))
    if kind == "string":
        longest = 2 * _size(trial)
        return st.text("A", min_size=longest + 1, max_size=longest + 9)
    return st.one_of(nonsense, _outside(trial)) if kind in NUMERIC else nonsense


def _outside(trial: Trial) -> st.SearchStrategy[Any]:
    stretches = [(Fraction(one["low"]), Fraction(one["high"])) for one in trial.case["domain"]]
    allowed = {Fraction(one[key]) for one in trial.entry.get("specials", ()) for key in ("code", "means") if key in one}

    def outside(value: Fraction) -> bool:
        return value not in allowed and not any(low <= value <= high for low, high in stretches)

    steps = st.integers(1, 10**6).map(lambda count: Fraction(count, 10))
    beyond = st.sampled_from(stretches).flatmap(
        lambda stretch: st.one_of(steps.map(lambda by: stretch[0] - by), steps.map(lambda by: stretch[1] + by))
    )
    return beyond.filter(outside).map(lambda value: number(f"{value}"))
