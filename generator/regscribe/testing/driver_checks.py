"""Checks of one model's generated driver against the vectors of its map; each says what differs."""

from collections.abc import Callable, Iterator, Mapping
from functools import cached_property
from typing import Any

from regscribe.testing.compare import decoded, differs, encoded, expect_none, refused, same, spelled
from regscribe.testing.computed import computed, computed_of
from regscribe.testing.simulated_read import wrong_without
from regscribe.testing.vectors import Json, Trial, Vectors, known, number
from regscribe_runtime.driver.parts import AnyCommand
from regscribe_runtime.registers.register import Register
from regscribe_runtime.values.conditions import ALWAYS
from regscribe_runtime.values.facts import CommandStep
from regscribe_runtime.values.wire_types import PARTED

WRITE_COIL, WRITE_COILS = 5, 15
WRITE_ONE = (5, 6)
ON = 0xFF00
"""Word that function 05 sends for a coil that is on."""
WITH_DOMAIN = frozenset({"number", "integer", "raw", "enum"})
"""Kinds whose vectors have a domain of values to write, if there are any."""


class DriverUnderTest:
    """The driver class of one model and the vectors of its map."""

    def __init__(self, driver: Any, vectors: Vectors) -> None:  # noqa: ANN401 (a generated class)
        self.driver, self.vectors, self.model = driver, vectors, str(driver.model)
        self.places = tuple(vectors.registers(self.model))
        self.trials = tuple(self._trials())

    @cached_property
    def readable(self) -> list[Register[Any]]:
        """The registers that can be read."""
        return [register for register in self.driver.registers.values() if register.access != "w"]

    @cached_property
    def written(self) -> list[Trial]:
        """The trials in which there is something to write."""
        return [
            trial
            for trial in self.trials
            if trial.entry["access"] != "r"
            and trial.case.get("domain" if trial.entry["kind"] in WITH_DOMAIN else "encode")
        ]

    @cached_property
    def mirrored(self) -> list[Trial]:
        """The trials of `written` whose registers have several views."""
        return [trial for trial in self.written if len(trial.register.view_names) > 1]

    def __repr__(self) -> str:
        return f"<DriverUnderTest {self.model}>"

    def _register(self, path: str) -> Register[Any] | None:
        found: Register[Any] | None = self.driver.registers.get(path)
        return found

    def _trials(self) -> Iterator[Trial]:
        """Yield trials of each register of the driver, once for those of a set that are equal for the codec."""
        for entry in self.vectors.sets:
            tried: list[tuple[object, ...]] = []
            paths = (place["path"] for place in entry["registers"] if self.model in place["models"])
            for register in filter(None, map(self._register, paths)):
                scaling = (register.scale, register.special_scale, register.range, register.valid)
                named = (register.sentinels, register.partial)
                declared = (register.views, id(register.value_type), register.access, *scaling, *named)
                if declared not in tried:
                    tried.append(declared)
                    yield from (Trial(register, entry, case, *known(case)) for case in entry["cases"])

    def check_registers(self) -> None:
        """Assert that the driver has the registers of the model, no others, at their addresses in every view."""
        expected, found = {place["path"] for place, _ in self.places}, set(self.driver.registers)
        differences = list(self._places())
        differences += [f"{path}: the driver of {self.model} lacks it" for path in sorted(expected - found)]
        differences += [f"{path}: {self.model} has no such register" for path in sorted(found - expected)]
        differences += self._optional()
        expect_none(differences)

    def _optional(self) -> Iterator[str]:
        """What is wrong with a read of a device that lacks all that it may lack."""
        optional = [place["path"] for place, _ in self.places if place.get("mandatory") is False]
        yield from wrong_without(self.driver, optional) if optional else ()

    def _places(self) -> Iterator[str]:
        for place, entry in self.places:
            register = self._register(place["path"])
            if register is None:
                continue
            facts = {view.name: view.space.facts(view.address(register.at)) for view in register.views}
            yield from differs(place["path"], "addresses", facts, _facts(place))
            pages = {one["page"] for one in facts.values() if "page" in one}
            units = {unit for page in pages if (unit := self.driver._pages[page - 1].unit)}  # noqa: SLF001 (a fact for the judges)
            yield from differs(place["path"], "unit ids", units, {place["unit_id"]} if "unit_id" in place else set())
            yield from differs(place["path"], "block", register.block, place.get("block", ""))
            yield from differs(place["path"], "mandatory", register.mandatory, place.get("mandatory"))
            yield from differs(place["path"], "static", register.static, place.get("static", False))
            yield from differs(
                place["path"],
                "aliases",
                [register.views[0].space.inside(alias) for alias in register.aliases],
                place.get("aliases", []),
            )
            default = "" if register.default is None else spelled(register, register.default)
            if default != place.get("default", "") and not same(default, place.get("default", "0")):
                yield from differs(place["path"], "default", default, place.get("default"))
            yield from differs(place["path"], "access", register.access, entry["access"])
            spaces = {
                view["name"]: (view["space"], view["words"], view.get("functions", [])) for view in entry["views"]
            }
            found = {view.name: (view.space, view.words, list(view.functions)) for view in register.views}
            yield from differs(place["path"], "views", found, spaces)

    def check_device(self) -> None:
        """Assert that the driver knows the limits of the device, and that its commands send what they should."""
        expected = {
            name: tuple(fact) if isinstance(fact, list) else fact for name, fact in self.vectors.protocol.items()
        }
        found = {name: getattr(self.driver.protocol, name, expected[name]) for name in expected}
        expect_none([*differs(self.model, "protocol", found, expected), *self._commands()])

    def _commands(self) -> Iterator[str]:
        section: Any = getattr(self.driver, "commands", None)
        found = {
            name: (bool(one.danger), [_step(step) for step in one.steps])
            for name, one in (section.commands() if section else {}).items()
        }
        expected = {
            one["id"]: (one["danger"], [_without_existence(step) for step in one["steps"]])
            for one in self.vectors.commands
            if self.model in one["models"]
        }
        yield from differs(self.model, "commands", found, expected)
        for one in self.vectors.commands if section and found.keys() == expected.keys() else ():
            if self.model in one["models"]:
                yield from _conditions(section.commands()[one["id"]], one)

    def check_decoding(self) -> None:
        """Assert that the words of every vector decode to its value, its fault or its outcome."""
        self._check("decode", decoded)

    def check_encoding(self) -> None:
        """Assert that the value of every vector encodes to its words."""
        self._check("encode", encoded)

    def check_refusals(self) -> None:
        """Assert that every value that has no words is refused."""
        self._check("refuse", refused)

    def _check(self, key: str, judge: Callable[[Trial, Json], Iterator[str]]) -> None:
        expect_none(
            text for trial in self.trials for vector in trial.case.get(key, ()) for text in judge(trial, vector)
        )

    def check_conditions_of_writing(self) -> None:
        """Assert that what can be written, or exists, at times can be written or exists then and at no other time."""
        differences: list[str] = []
        for place, entry in self.places:
            register = self._register(place["path"])
            for vector in entry.get("writable", ()) if register else ():
                state, givens = known(vector)
                when = register.writable.when if register and register.writable else ALWAYS
                allowed = when.holds(state, givens)
                differences += differs(f"{place['path']} with {state}", "allowed", allowed, vector["allowed"])
            for vector in entry.get("existence", ()) if register else ():
                state, givens = known(vector)
                exists = register.when.holds(state, givens) if register else None
                differences += differs(f"{place['path']} with {state}", "exists", exists, vector["exists"])
        expect_none(differences)

    def check_computed(self) -> None:
        """Assert that the driver has the computed values of the model, and that each is what follows from words."""
        found, several = computed_of(self.driver), [one for one in self.vectors.computed if self.model in one["models"]]
        differences = [*differs(self.model, "computed values", sorted(found), sorted(one["id"] for one in several))]
        pairs = ((found[one["id"]], case) for one in several if one["id"] in found for case in one["cases"])
        expect_none([*differences, *(text for pair in pairs for text in computed(self.driver, *pair))])

    def check_examples(self) -> None:
        """Assert that the driver reproduces the manual's worked examples."""
        expect_none(text for example in self.vectors.examples_of(self.model) for text in self._example(example))

    def _example(self, example: Json) -> Iterator[str]:
        state, givens = known(example)
        if "register" in example:
            register = self.driver.registers[example["register"]]
            trial = Trial(register, {"kind": register.kind}, {"view": example["view"]}, state, givens)
            if set(example) & {"value", "fault", "outcome"}:
                yield from decoded(trial, example)
            if example.get("encodes"):
                yield from encoded(trial, example)
        elif example.get("encodes") and not example["answer"]:
            yield from self._frame(example, state, givens)

    def _frame(self, example: Json, state: Mapping[str, Any], givens: Mapping[str, Any]) -> Iterator[str]:
        sent = bytes.fromhex(example["frame"])[: -2 if example["crc"] else None]
        data = _carried(example["function"], sent)
        start = int.from_bytes(sent[2:4], "big")
        state = {**state, **{path: number(text) for path, text in example["writes"].items()}}
        for path, text in example["writes"].items():
            register = self.driver.registers[path]
            view, address = _placed(register, example.get("view"), start, len(data))
            words = register.encode(number(text), view=view.name, state=state, givens=givens)
            place = address - view.space.within(start)
            there = data[place : place + len(words)] if place >= 0 else ()
            frame = f"frame of {example['source']}" if example["source"] else "frame"
            yield from differs(frame, f"{path} = {text}", _hex(there), _hex(words))


CHECKS = (
    DriverUnderTest.check_registers,
    DriverUnderTest.check_device,
    DriverUnderTest.check_decoding,
    DriverUnderTest.check_encoding,
    DriverUnderTest.check_refusals,
    DriverUnderTest.check_conditions_of_writing,
    DriverUnderTest.check_computed,
    DriverUnderTest.check_examples,
)
"""The checks of generated tests that draw no values."""


def _placed(register: Register[Any], name: str | None, start: int, count: int) -> tuple[Any, int]:
    """The view (of this name) or alias that a frame of `count` words holds whole, and its address; else the first."""
    base = register.views[0]
    places = [(view, view.address(register.at)) for view in register.views if name in {None, view.name}]
    places += [(base, alias) for alias in register.aliases if name in {None, base.name}]
    held = (
        (view, address) for view, address in places if 0 <= address - view.space.within(start) <= count - view.words
    )
    return next(held, places[0])


def _carried(function: int, sent: bytes) -> tuple[int, ...]:
    """The words that a request writes, or the bits: function 05 sends FF00 for 1."""
    data = sent[4:] if function in WRITE_ONE else sent[7:]
    if function == WRITE_COILS:
        count = int.from_bytes(sent[4:6], "big")
        return tuple(data[place // 8] >> place % 8 & 1 for place in range(count))
    words = tuple(int.from_bytes(data[place : place + 2], "big") for place in range(0, len(data), 2))
    return tuple(int(word == ON) for word in words) if function == WRITE_COIL else words


def _conditions(command: AnyCommand, vectors: Json) -> Iterator[str]:
    """Yield a line for each situation in which a command, or one of its steps, is done against its vector."""
    steps = zip(command.steps, vectors["steps"], strict=False)
    told = [(f"step {number}", step.when, one) for number, (step, one) in enumerate(steps, start=1)]
    for what, when, one in (("", command.when, vectors), *told):
        where = f"command {command.id} {what}".rstrip()
        yield from differs(where, "has a condition", not when.always, "existence" in one)
        for vector in one.get("existence", ()):
            state, givens = known(vector)
            yield from differs(f"{where} with {state}", "exists", when.holds(state, givens), vector["exists"])


def _without_existence(step: Json) -> Json:
    return {key: value for key, value in step.items() if key != "existence"}


def _hex(words: tuple[int, ...]) -> str:
    return " ".join(f"{word:04X}" for word in words)


def _facts(place: Json) -> dict[str, dict[str, int]]:
    """The address of each view, with the file, the queue or the page that it is in."""
    page = {"page": place["page"]} if "page" in place else {}
    found = {name: {"address": address} | page for name, address in place["addresses"].items()}
    for space in PARTED:
        for name, part in place.get(f"{space}s", {}).items():
            found[name][str(space)] = part
    return found


def _step(step: CommandStep) -> Json:
    """Return a step of a command as vectors have it."""
    if not step.words:
        return {"wait": step.wait}
    more = {key: text for key in ("block", "argument") if (text := getattr(step, key))}
    return {"function": step.function, **step.space.facts(step.address), "words": list(step.words), **more}
