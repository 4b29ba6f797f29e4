"""What a format declares that it carries shows in its exports, and what it does not declare is told as lost.

Every format with every fact, by the specimens of `fact_specimens`: the same map with and without the fact.
"""

import re
from collections.abc import Callable
from functools import cache
from importlib import import_module
from pathlib import Path

import pytest

import regscribe.export as export_room
from regscribe import plugins
from regscribe.export.carried import PAGE, declared, with_table
from regscribe.export.device.facts import BY_ID, DEVICE_FACTS, FACTS, Carry
from regscribe.losses import Exported
from regscribe.model import RegisterMap
from regscribe.plugins import OptionError

from .fact_specimens import SPECIMENS, Specimen

ROOT = Path(__file__).parents[3]
AT = "10.0.0.7:502"
CARRIES = {form: one.carries for form, one in declared().items()}
IDS = [fact.id for fact in (*FACTS, *DEVICE_FACTS)]

ONE_BY_ONE = ("collectd", "edgex", "home-assistant", "modbus-exporter", "zabbix")
READERS = ("modbus-exporter", "telegraf", "zabbix")
WORDS = ("boolean", "padding", "version", "date")
HOLDS_BY_ITSELF = {
    **{(form, "limits"): "each register is a request of its own" for form in ONE_BY_ONE},
    **{(form, "functions"): "it reads by the function of the space, and writes nothing" for form in READERS},
    **{("pymodbus-simulator", fact): "words mean what the reader knows" for fact in WORDS},
    ("home-assistant", "functions"): "a switch sends the function that may write it, all else is only read",
}
"""What a format carries without a sign of it in the export, and why."""

each_format = pytest.mark.parametrize("form", CARRIES)
each_fact = pytest.mark.parametrize("fact", IDS)
Small = Callable[..., str]
ModelOf = Callable[[str], RegisterMap]
Export = Callable[..., Exported | None]


@cache
def _compiled(model_of: ModelOf, text: str) -> RegisterMap:
    return model_of(text)


@pytest.fixture
def export(small: Small, model_of: ModelOf) -> Export:
    """What a format makes of a specimen, with its fact or without; None where it can say nothing of it."""

    def made(form: str, specimen: Specimen, *, with_fact: bool) -> Exported | None:
        one = specimen
        lines, top, tail = one.registers, one.top, one.tail
        if not with_fact:
            lines = one.plain
            top = one.top if one.plain_top is None else one.plain_top
            tail = one.tail if one.plain_tail is None else one.plain_tail
        known = {option.name: option.default for option in plugins.exporter(form).options}
        told = {"at": AT, "writes": "yes"} | (dict(one.options) if with_fact else {})
        options = known | {key: text for key, text in told.items() if key in known}
        try:
            return plugins.export(form, [_compiled(model_of, small(*lines, top=top, tail=tail))], options)
        except OptionError:
            return None

    return made


def said(made: Exported | None) -> object:
    """The texts of an export, without what any change of a map changes."""
    if made is None:
        return None
    plain = {path: text for path, text in made.texts.items() if isinstance(text, bytes)}
    texts = {
        path: re.sub(r'"content_hash": "\w+"', "", text) for path, text in made.texts.items() if isinstance(text, str)
    }
    return plain | texts


def told(made: Exported | None, specimen: Specimen, fact: str) -> bool:
    """Whether the loss of a fact is told, or that the whole register is left out."""
    return made is None or any(one.register == specimen.path and one.fact in {fact, "register"} for one in made.losses)


def is_moot(form: str, fact: str) -> bool:
    """Whether a fact means nothing in a format, as the one that it belongs to is lost."""
    of = BY_ID[fact].of if fact in BY_ID else ""
    return bool(of) and (CARRIES[form].get(of, Carry.NO) is Carry.NO or is_moot(form, of))


def test_every_package_and_module_of_a_format_is_declared_as_a_plugin_that_says_what_it_carries() -> None:
    room = Path(str(export_room.__file__)).parent
    modules = (f"regscribe.export.{path.stem}" for path in room.iterdir() if path.suffix == ".py" or path.is_dir())
    formats = {name for name in modules if "__" not in name and callable(getattr(import_module(name), "export", None))}
    assert {plugins.exporter(form).__name__ for form in CARRIES} == formats  # type: ignore[attr-defined]  # modules


def test_the_docs_have_the_table_of_what_is_declared() -> None:
    page = (ROOT / PAGE).read_text(encoding="utf-8")
    assert with_table(page) == page, "run python -m regscribe.export.carried"


def test_every_fact_has_a_specimen() -> None:
    assert SPECIMENS.keys() == set(IDS)


@each_format
def test_a_format_declares_facts_that_there_are(form: str) -> None:
    assert set(CARRIES[form]) <= set(IDS)


@each_fact
@each_format
def test_what_a_format_declares_shows_and_the_rest_is_told(export: Export, form: str, fact: str) -> None:
    carry = CARRIES[form].get(fact, Carry.NO)
    pairs = [(one, export(form, one, with_fact=True), export(form, one, with_fact=False)) for one in SPECIMENS[fact]]
    if carry in {Carry.WHOLE, Carry.PARTLY} and (form, fact) not in HOLDS_BY_ITSELF:
        shows = [one for one, made, plain in pairs if made is not None and said(made) != said(plain)]
        tells = [one for one, made, _ in pairs if told(made, one, fact)]
        assert shows or (carry is Carry.PARTLY and tells), f"{form} declares {fact}, and says the same without it"
    elif carry in {Carry.NO, Carry.FIXED} and not is_moot(form, fact):
        silent = [made and made.texts for one, made, _ in pairs if not told(made, one, fact)]
        assert silent == [], f"{form} does not declare {fact}, and drops it without a word"
