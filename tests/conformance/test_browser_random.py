"""Random maps: the calculator of the register browser says what the reference says of words and of values."""

import random
from collections.abc import Iterator, Sequence
from contextlib import suppress
from fractions import Fraction
from typing import Any, NamedTuple

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from regscribe.model import Register, RegisterMap, View, show
from regscribe.model.located import layout_of, located
from regscribe.reference import Meaning, RefusedError, Surroundings, UnknownValueError, decode, encode

from . import judges, probes
from .browser_codec import run, same_value
from .strategies import FUZZ, STEADY, maps
from .suite import Built, Json, diagnose, errors_of, whole_map
from .wire import Memory

FEW, MANY = 60, 500
"""Maps that one run of Node.js answers for."""
PROBES = 12
"""Words and values that are tried of a view."""
LIKELY = 0.8
"""How often a register holds what one is likely to hold; else anything."""


class Tried(NamedTuple):
    """A view of a register under what a device holds, with words and values to try."""

    register: Register
    view: View
    known: Surroundings
    job: Json
    words: Sequence[tuple[int, ...]]
    values: Sequence[Fraction | str]


def _compiled(parts: Json) -> RegisterMap | None:
    register_map, found = diagnose(whole_map(parts))
    return None if register_map is None or errors_of(found) else register_map


def _tried(register_map: RegisterMap, chance: random.Random) -> Iterator[Tried]:
    layout = layout_of(register_map, register_map.models[0], {})
    model = located(register_map.models[0], layout)
    memory = Memory()
    for one in model.registers:
        memory.put(one.base.space.value, one.address, list(_likely(one, chance)))
    held = {one.path: _held(memory, one) for one in model.registers}
    known = judges.Present(Built(register_map, None, {}), memory)  # of registers outside of blocks
    for one in model.registers:
        for view in one.views:
            words = _some(probes.words(one, view, chance), chance)
            values = _some(probes.values(one), chance)
            case = {
                "view": view.name,
                "held": held,
                "decode": words,
                "encode": [[_text(each), False] for each in values],
            }
            job = {"map": register_map.id, "places": [["A", one.path]], "cases": [case]}
            yield Tried(one, view, known.known, job, words, values)


def _some(several: Sequence[Any], chance: random.Random) -> list[Any]:
    return chance.sample(list(several), min(len(several), PROBES))


def _likely(register: Register, chance: random.Random) -> tuple[int, ...]:
    likely = probes.plausible(register.base) if chance.random() < LIKELY else ()
    return chance.choice(likely or probes.words(register, register.base, chance))


def _held(memory: Memory, register: Register) -> list[int]:
    view = register.preferred
    return memory.get(view.space.value, view.address(register.at), view.words)


def _text(value: Fraction | str) -> str:
    return value if isinstance(value, str) else show(value)


def _wrong(tried: Tried, said: Json) -> Iterator[str]:
    (made,) = said["cases"]
    where = f"{tried.register.path}, {tried.view.name}"
    for words, found in zip(tried.words, made["decode"], strict=True):
        expected = _read(tried, tuple(words))
        if expected != (found["meaning"], found.get("fault", "")) and expected is not None:
            yield f"{where}: {words}: {found}, not {expected}"
        value = _value(tried, tuple(words))
        if value is not None and not same_value(found["value"], _text(value)):
            yield f"{where}: {words}: {found}, not {value}"
    for value, found in zip(tried.values, made["encode"], strict=True):
        expected_words = _written(tried, value)
        if expected_words != found.get("words", found.get("refused")):
            yield f"{where}: {value}: {found}, not {expected_words}"


def _read(tried: Tried, words: tuple[int, ...]) -> tuple[str, str]:
    try:
        reading = decode(tried.register, tried.view, words, tried.known)
    except UnknownValueError:
        return "unknown", ""
    return reading.meaning.value, reading.fault


def _value(tried: Tried, words: tuple[int, ...]) -> Fraction | str | None:
    with suppress(UnknownValueError):
        reading = decode(tried.register, tried.view, words, tried.known)
        return reading.value if reading.meaning in {Meaning.VALUE, Meaning.UNKNOWN_MEMBER} else None
    return None


def _written(tried: Tried, value: Fraction | str) -> object:
    if not tried.register.access.writable:
        return "read_only"
    try:
        return list(encode(tried.register, tried.view, value, tried.known))
    except RefusedError as error:
        return error.reason.value
    except UnknownValueError:
        return "unknown"


def disagreements(several: Sequence[tuple[RegisterMap, int]]) -> list[str]:
    """What the page says otherwise than the reference."""
    tried = [(one, list(_tried(one, random.Random(seed)))) for one, seed in several]  # noqa: S311 (found again by its seed)
    said = run([([one], [each.job for each in views]) for one, views in tried])
    pairs = (
        (each, *one)
        for (_, views), found in zip(tried, said, strict=True)
        for each, one in zip(views, found, strict=True)
    )
    return [text for each, made in pairs for text in _wrong(each, made)]


def drawn(count: int, *, same: bool) -> list[tuple[RegisterMap, int]]:
    """Random maps that no rule refuses, each with a seed; with `same`, the same every time."""
    found: list[tuple[RegisterMap, int]] = []

    @settings(STEADY, max_examples=count, derandomize=same)
    @given(parts=maps(), seed=st.integers(0, 2**32))
    def draw(parts: Json, seed: int) -> None:
        compiled = _compiled(parts)
        found.extend([(compiled, seed)] if compiled else [])

    draw()
    return found


def test_the_page_agrees_on_random_maps() -> None:
    several = drawn(FEW, same=True)
    assert len(several) > FEW // 2
    assert disagreements(several) == []


@pytest.mark.slow
def test_the_page_agrees_on_many_random_maps() -> None:
    for _ in range(0, FUZZ, MANY):
        assert disagreements(drawn(MANY, same=False)) == []
