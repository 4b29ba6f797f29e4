"""One model's driver on the bench: its registers beside their vectors, and checks that say what differs."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from regscribe.runtime import NotDecodable, Saturated, SensorFault, ValueNotDecodable, ValueRefused
from regscribe.runtime.register import Register
from regscribe.testing.vectors import Json, Vectors, number

MOST_SHOWN = 12
"""Differences listed in a failure; more would hide the pattern."""
CODED = frozenset({"enum", "flags", "fields", "boolean"})
FUNCTION_WRITE_ONE = 6


@dataclass(frozen=True, slots=True, repr=False)
class Trial:
    """One register in one view and situation: `case` has its vectors, `entry` what the register is."""

    register: Register[Any]
    entry: Json
    case: Json
    state: Mapping[str, Any]
    givens: Mapping[str, Any]

    @property
    def view(self) -> str:
        """The name of the view."""
        return str(self.case["view"])

    def decode(self, words: Sequence[int]) -> Any:  # noqa: ANN401 (whatever the register holds)
        """Decode with the driver under the state of this trial."""
        return self.register.decode(words, view=self.view, state=self.state, givens=self.givens)

    def encode(self, value: object, *, rounded: bool = False) -> tuple[int, ...]:
        """Encode with the driver under the state of this trial."""
        return self.register.encode(value, view=self.view, state=self.state, givens=self.givens, rounded=rounded)

    def __repr__(self) -> str:
        given = {name: codes for name, codes in self.givens.items() if name in self.case.get("givens", {})}
        return f"{self.register.path} ({self.view}) with {dict(self.state) | given}"


class Bench:
    """The driver class of one model and the vectors of its map."""

    def __init__(self, driver: Any, vectors: Vectors) -> None:  # noqa: ANN401 (a generated class)
        self.driver, self.vectors, self.model = driver, vectors, str(driver.model)
        self.places = tuple(vectors.registers(self.model))
        self.trials = tuple(self._trials())

    def __repr__(self) -> str:
        return f"<Bench {self.model}>"

    def _register(self, path: str) -> Register[Any] | None:
        found: Register[Any] | None = self.driver.registers.get(path)
        return found

    def _trials(self) -> Iterator[Trial]:
        """Yield trials of each register that the driver has; equal declarations in one set are tried once."""
        for entry in self.vectors.sets:
            tried: list[tuple[object, ...]] = []
            paths = (place["path"] for place in entry["registers"] if self.model in place["models"])
            for register in filter(None, map(self._register, paths)):
                declared = _declaration(register)
                if declared not in tried:
                    tried.append(declared)
                    yield from (Trial(register, entry, case, *known(case)) for case in entry["cases"])

    def check_registers(self) -> None:
        """Assert that the driver has the registers of the model, no others, at their addresses in every view."""
        differences = [*self._places(), *self._names()]
        assert not differences, report(differences)  # noqa: S101 (this is a test library)

    def _names(self) -> Iterator[str]:
        expected, found = {place["path"] for place, _ in self.places}, set(self.driver.registers)
        yield from (f"{path}: the driver of {self.model} lacks it" for path in sorted(expected - found))
        yield from (f"{path}: {self.model} has no such register" for path in sorted(found - expected))

    def _places(self) -> Iterator[str]:
        for place, entry in self.places:
            register = self._register(place["path"])
            if register is None:
                continue
            addresses = {view.name: view.address(register.at) for view in register.views}
            yield from differs(place["path"], "addresses", addresses, place["addresses"])
            yield from differs(place["path"], "aliases", list(register.aliases), place.get("aliases", []))
            yield from differs(place["path"], "access", register.access, entry["access"])
            spaces = {
                view["name"]: (view["space"], view["words"], view.get("functions", [])) for view in entry["views"]
            }
            found = {view.name: (view.space, view.words, list(view.functions)) for view in register.views}
            yield from differs(place["path"], "views", found, spaces)

    def check_decoding(self) -> None:
        """Assert that the words of every vector decode to its value, its fault or its outcome."""
        differences = [
            text for trial in self.trials for vector in trial.case.get("decode", ()) for text in _decoded(trial, vector)
        ]
        assert not differences, report(differences)  # noqa: S101 (as above)

    def check_encoding(self) -> None:
        """Assert that the value of every vector encodes to its words."""
        differences = [
            text for trial in self.trials for vector in trial.case.get("encode", ()) for text in _encoded(trial, vector)
        ]
        assert not differences, report(differences)  # noqa: S101 (as above)

    def check_refusals(self) -> None:
        """Assert that every value that has no words is refused."""
        differences = [
            text for trial in self.trials for vector in trial.case.get("refuse", ()) for text in _refused(trial, vector)
        ]
        assert not differences, report(differences)  # noqa: S101 (as above)

    def check_conditions_of_writing(self) -> None:
        """Assert that a register that can be written at times can be written then and at no other time."""
        differences: list[str] = []
        for place, entry in self.places:
            register = self._register(place["path"])
            for vector in entry.get("writable", ()) if register else ():
                state, givens = known(vector)
                when = register.writable[0] if register and register.writable else ()
                allowed = all(test.holds(state, givens) for test in when)
                differences += differs(f"{place['path']} with {state}", "allowed", allowed, vector["allowed"])
        assert not differences, report(differences)  # noqa: S101 (as above)

    def check_examples(self) -> None:
        """Assert that the driver reproduces the manual's worked examples."""
        differences = [text for example in self.vectors.examples_of(self.model) for text in self._example(example)]
        assert not differences, report(differences)  # noqa: S101 (as above)

    def _example(self, example: Json) -> Iterator[str]:
        state, givens = known(example)
        if "register" in example:
            register = self.driver.registers[example["register"]]
            trial = Trial(register, {"kind": register.kind.name}, {"view": example["view"]}, state, givens)
            if set(example) & {"value", "fault", "outcome"}:
                yield from _decoded(trial, example)
            if example.get("encodes"):
                yield from _encoded(trial, example)
        elif example.get("encodes") and not example["answer"]:
            yield from self._frame(example, state, givens)

    def _frame(self, example: Json, state: Mapping[str, Any], givens: Mapping[str, Any]) -> Iterator[str]:
        sent = bytes.fromhex(example["frame"])[: -2 if example["crc"] else None]
        data = sent[4:] if example["function"] == FUNCTION_WRITE_ONE else sent[7:]
        start = int.from_bytes(sent[2:4], "big")
        state = {**state, **{path: number(text) for path, text in example["writes"].items()}}
        for path, text in example["writes"].items():
            register = self.driver.registers[path]
            view = register.view(example.get("view") or register.view_names[0])
            words = register.encode(number(text), view=view.name, state=state, givens=givens)
            place = 2 * (view.address(register.at) - start)
            there = data[place : place + 2 * len(words)] if place >= 0 else b""
            expected = b"".join(word.to_bytes(2, "big") for word in words)
            yield from differs(f"frame of {example['source']}", f"{path} = {text}", there.hex(" "), expected.hex(" "))


def _declaration(register: Register[Any]) -> tuple[object, ...]:
    """Return all that the codec looks at; two registers with equal declarations cannot differ in it."""
    scaling = (register.scale, register.range, register.sentinels)
    return (register.views, id(register.kind), register.access, *scaling)


def known(case: Json) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return the state and the givens of a case as a driver takes them."""
    givens = case.get("givens", {})
    stated = {**case.get("assumed", {}), **case.get("state", {})}
    return (
        {path: number(text) for path, text in stated.items()},
        {
            name: codes if isinstance(codes, bool) else {number(text) for text in codes}
            for name, codes in givens.items()
        },
    )


def differs(where: str, what: str, found: object, expected: object) -> Iterator[str]:
    """Yield a line if the two are not equal."""
    if found != expected:
        yield f"{where}: {what} {found!r}, expected {expected!r}"


def report(differences: Iterable[str]) -> str:
    """Return differences as the message of a failure: how many, and the first of them."""
    listed = list(differences)
    rest = f"\n  ... and {len(listed) - MOST_SHOWN} more" if len(listed) > MOST_SHOWN else ""
    return f"{len(listed)} differences:\n  " + "\n  ".join(listed[:MOST_SHOWN]) + rest


def same(found: object, text: str) -> bool:
    """Tell whether a decoded value is what a vector spells; a float must be the nearest one."""
    if isinstance(found, str):
        return found == text
    if isinstance(found, float):
        exactly = Fraction(text)
        return found == exactly.numerator / exactly.denominator
    return isinstance(found, (int, Fraction)) and found == Fraction(text)


def _decoded(trial: Trial, vector: Json) -> Iterator[str]:
    where = f"{trial}: words {vector['words']}"
    expected = vector.get("value") or vector.get("fault") or vector.get("outcome")
    try:
        found = trial.decode(vector["words"])
    except SensorFault as fault:
        yield from differs(where, "fault", fault.fault, vector.get("fault", expected))
    except Saturated:
        yield from differs(where, "outcome", "saturated", vector.get("outcome", expected))
    except NotDecodable as error:
        yield from differs(where, "outcome", "not_decodable", vector.get("outcome", f"{expected} ({error})"))
    else:
        if "value" not in vector or not same(found, vector["value"]):
            yield f"{where}: value {found!r}, expected {expected!r}"
        else:
            yield from _named(where, trial, found, vector)


def _named(where: str, trial: Trial, found: Any, vector: Json) -> Iterator[str]:  # noqa: ANN401 (any value)
    for key in ("member", "special"):
        if key in vector:
            labels = trial.entry.get(f"{key}s", ())
            label = next((one["label"] for one in labels if one["id"] == vector[key]), None)
            yield from differs(where, key, getattr(found, "name", None), vector[key])
            yield from differs(where, "label", getattr(found, "label", None), label) if label is not None else ()
    if "unknown" in vector:
        yield from differs(where, "known", getattr(found, "known", None), not vector["unknown"])
    if "flags" in vector:
        names = {str(member.name).lower() for member in type(found) if member in found} if found else set()
        yield from differs(where, "flags", names, {name.lower() for name in vector["flags"]})
    for name, part in vector.get("fields", {}).items():
        yield from differs(where, name, getattr(found, name, None), int(part))


def written(trial: Trial, text: str) -> Any:  # noqa: ANN401 (a text or a number)
    """Return the value of a vector as a program hands it over."""
    return text if trial.entry["kind"] in {"string", "version"} else number(text)


def _encoded(trial: Trial, vector: Json) -> Iterator[str]:
    where = f"{trial}: value {vector['value']}"
    try:
        words = trial.encode(written(trial, vector["value"]), rounded=vector.get("rounded", False))
    except (ValueRefused, ValueNotDecodable) as error:
        yield f"{where}: refused ({error}), expected words {vector['words']}"
    else:
        yield from differs(where, "words", list(words), vector["words"])


def _refused(trial: Trial, vector: Json) -> Iterator[str]:
    try:
        words = trial.encode(written(trial, vector["value"]))
    except ValueRefused:
        return
    except ValueNotDecodable as error:
        if vector["reason"] != "condition":
            yield f"{trial}: value {vector['value']}: {error}, expected a refusal ({vector['reason']})"
    else:
        yield f"{trial}: value {vector['value']}: words {list(words)}, expected a refusal ({vector['reason']})"
