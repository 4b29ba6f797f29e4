"""Random sound maps: driver and reference agree on every reading and on every write."""

import os
import random
from collections.abc import Iterator
from contextlib import suppress
from fractions import Fraction
from typing import Any

import pytest

from regscribe.model import RegisterMap, View
from regscribe.model.reference import Meaning, RefusedError, Surroundings, decode, encode, holds
from regscribe.runtime import SensorFault, ValueNotDecodable, ValueRefused

from . import judges, matrix, matrix_maps, matrix_watch
from .suite import Built, Json
from .wire import Memory

MOST_KEYS = 4
PAIRS = frozenset(
    [
        "word_order",
        "byte_order",
        "scale",
        "decimals",
        "multiply",
        "add",
        "range",
        "range_decimals",
        "special",
        "default",
        "unit",
        "enum",
        "sentinels",
        "writable",
        "persistence",
        "functions",
        "type",
        "kind",
    ]
)
"""Keys that have to do with what words mean."""
FUZZ = int(os.environ.get("FUZZ_MAPS", "4000"))


def random_map(chance: random.Random) -> tuple[matrix.Seed, Json]:
    """A register at a place with some keys, whatever they are together."""
    seed = chance.choice(matrix_maps.seeds())
    keys: Json = {}
    for key in chance.sample(sorted(PAIRS), chance.randint(1, MOST_KEYS)):
        value, beside = chance.choice(matrix.TRIALS[key])
        keys |= beside | {key: value}
    return seed, keys


def sound_maps(seeds: range) -> Iterator[tuple[int, matrix.Seed, Json, RegisterMap]]:
    """Those of the random maps that no rule refuses."""
    for number in seeds:
        seed, keys = random_map(random.Random(number))  # noqa: S311 (the same maps every time)
        register_map, _ = matrix.compiled(matrix_maps.whole(seed, {}, keys))
        found = [one for one in register_map.models[0].registers if one.path == seed.path] if register_map else []
        if register_map is not None and found:
            yield number, seed, keys, register_map


def plain(value: Any) -> object:
    """A value of a driver as a number or a text."""
    if isinstance(value, str):
        return value
    return float(value) if not isinstance(value, bool) else float(int(value))


def by_driver(subject: matrix_watch.Subject, view: str) -> object:
    """What the driver reads: a value, a fault, or that there is none."""
    try:
        return plain(subject.bound.read(view=view))
    except SensorFault as error:
        return ("fault", error.fault)
    except ValueNotDecodable:
        return "no value"


def by_reference(built: Built, memory: Memory, path: str, view: View) -> object:
    """What the reference makes of the same words."""
    register = built.map.models[0].register(path)
    words = tuple(memory.get(view.space.value, view.address, view.words))
    reading = decode(register, view, words, Surroundings(values=judges.Present(built, memory)))
    if reading.meaning is Meaning.FAULT:
        return ("fault", reading.fault)
    if reading.meaning in {Meaning.VALUE, Meaning.UNKNOWN_MEMBER} and reading.value is not None:
        return plain(reading.value)
    return "no value"


def sent_by_reference(built: Built, memory: Memory, path: str, view: View, value: Any) -> object:
    """The words that the reference makes of a value, or that it refuses it."""
    register = built.map.models[0].register(path)
    number = (
        value if isinstance(value, str) else Fraction(str(value)) if isinstance(value, float) else Fraction(int(value))
    )
    known = Surroundings(values=judges.Present(built, memory))
    if register.writable is not None and not holds(register.writable.when, known):
        return "refused"
    try:
        return list(encode(register, view, number, known))
    except RefusedError:
        return "refused"


def differences(seed: matrix.Seed, register_map: RegisterMap) -> Iterator[str]:
    """Where driver and reference disagree."""
    module = matrix_watch.driver_of(register_map)
    subject = matrix_watch.Subject(module, seed.path)
    built = Built(register_map, module)
    register = register_map.models[0].register(seed.path)
    for state in matrix_watch.STATES:
        for view in register.views:
            declared = subject.declared.view(view.name)
            for words in matrix_watch.WORDS[view.words]:
                subject.hold(declared, words, state)
                if register.access.readable:
                    told = by_driver(subject, view.name), by_reference(built, subject.memory, seed.path, view)
                    if told[0] != told[1]:
                        yield f"{view.name} {words} with {state}: driver {told[0]!r}, reference {told[1]!r}"
            if register.access.writable:
                yield from _written(subject, built, view, state)


def _written(subject: matrix_watch.Subject, built: Built, view: View, state: dict[int, int]) -> Iterator[str]:
    numbers = (
        matrix_watch.TEXTS if subject.declared.kind.name in {"string", "version", "text"} else matrix_watch.NUMBERS
    )
    for value in numbers:
        made = value
        with suppress(Exception):
            made = same if (same := subject.declared.kind.make(value)) == value else value
        subject.hold(subject.declared.view(view.name), (0,) * view.words, state)
        expected = sent_by_reference(built, subject.memory, subject.path, view, value)
        try:
            subject.bound.write(made, view=view.name, verify=False)
        except ValueRefused:
            found: object = "refused"
        else:
            found = subject.memory.get(view.space.value, view.address, view.words)
        if found != expected:
            yield f"{view.name} {value!r} with {state}: driver {found!r}, reference {expected!r}"


def disagreements(seeds: range) -> tuple[int, list[str]]:
    """How many maps were sound, and where they disagree."""
    count, found = 0, []
    for number, seed, keys, register_map in sound_maps(seeds):
        count += 1
        found += [f"map {number}, {'/'.join(seed)} {keys}: {one}" for one in differences(seed, register_map)]
    return count, found


def test_driver_and_reference_agree_on_random_maps() -> None:
    count, found = disagreements(range(1200))
    assert found == []
    assert count > 100


@pytest.mark.slow
def test_driver_and_reference_agree_on_many_random_maps() -> None:
    _, found = disagreements(range(100_000, 100_000 + 10 * FUZZ))
    assert found == []
