"""The lines of Python that the page offers do with the generated driver what the page says."""

from fractions import Fraction
from importlib import import_module
from types import ModuleType
from typing import Any

import pytest

from regscribe.model import RegisterMap
from regscribe.register_browser import document
from regscribe.register_browser.page import asset, codec

from ...conformance.browser_codec import evaluate  # noqa: TID252 (test folders are no packages)
from ...conformance.suite import build, whole_map  # noqa: TID252 (as above)
from ..conftest import shipped_map  # noqa: TID252 (as above)

WORDS = [
    {"at": 1, "name": "Lamps", "type": "uint16", "access": "rw", "flags": {0: "red", 1: "blue", 3: "green"}},
    {
        "at": 2,
        "name": "State",
        "type": "uint16",
        "access": "rw",
        "fields": {"stage": {"bits": "0..3"}, "heat": {"bits": "8..15", "type": "signed"}},
    },
]

SCRIPTS = codec().removesuffix("\n})()\n") + "\n".join(map(asset, ("ui/python_lines.js", "ui/copy_lines.js")))
OFFER = "\nglobalThis.regscribe = { ...globalThis.regscribe, pythonWrite, isPreferred, stated, ratio }\n})()\n"
ASK = """(codec, data) => {
  const [map] = codec.open(data)
  const found = []
  for (const { name: model } of map.models) for (const entry of map.registers) {
    if (!codec.modelsOf(map, entry).includes(model) || entry.elements) continue
    const register = codec.registerOf(map, entry, model)
    const known = codec.surroundings({}, {}, map, model)
    const view = register.views.find((one) => codec.isPreferred(register, one))
    if (register.access === 'r' || !view || register.path.includes('[')) continue
    const members = register.enum?.members ?? register.enum?.cases?.flatMap((one) => one.then.members) ?? []
    const codes = members.map((one) => codec.show(codec.stated(one.code)))
    const specials = register.specials.map((one) => one.label)
    for (const text of new Set(['0', '1', '2', '3', '10', ...codes, ...specials])) {
      const { words } = codec.encode(register, view, text, known)
      const reading = words && codec.decode(register, view, words, known)
      if (reading?.meaning !== 'value' || typeof reading.value === 'string') continue
      const line = codec.pythonWrite(register, view, words, reading, known)
      found.push([model, register.kind, Boolean(reading.special), line, codec.show(reading.value)])
    }
  }
  return found
}"""


class Written:
    """A register of a driver's class: writing tells which number of its type a value is."""

    def __init__(self, register: Any) -> None:
        self.type = register.value_type

    def write(self, value: Any, **_options: object) -> Fraction:
        if self.type.special and isinstance(value, self.type.special):
            return Fraction(str(value.value))
        return Fraction(self.type.number("register", value))


class Controller:
    """A driver of which only the types count."""

    def __init__(self, driver: type) -> None:
        self.driver = driver

    def __getattr__(self, name: str) -> Written:
        return Written(getattr(self.driver, name))


def kinds_written(register_map: RegisterMap, module: ModuleType) -> set[str]:
    """Write each line with the driver; return of which kinds they are."""
    drivers = {one.name: one.class_name for one in register_map.models}
    kinds = set()
    for model, kind, is_special, line, value in evaluate(ASK, document([register_map]), SCRIPTS + OFFER):
        assert ".write(" in line, line
        driver = getattr(module, drivers[model])
        written = eval(line, vars(module) | {"controller": Controller(driver)})  # noqa: S307 (our own line)
        assert written == Fraction(value), line
        kinds.add("special" if is_special else kind)
    return kinds


@pytest.mark.parametrize(
    ("name", "kinds"),
    [
        ("athena/series-c", {"enum", "number", "integer", "special"}),
        ("athena/platinum-x5000", {"enum", "boolean", "raw"}),  # whose enums are those of a library
    ],
)
def test_a_line_to_copy_writes_with_a_shipped_driver_what_the_page_says(name: str, kinds: set[str]) -> None:
    module = import_module(f"regscribe_devices.{name.replace('/', '.').replace('-', '_')}")
    assert kinds_written(shipped_map(name), module) >= kinds


def test_flags_and_words_of_bit_fields_are_written_by_their_names() -> None:
    built = build(whole_map({"registers": WORDS}))
    assert kinds_written(built.map, built.module) == {"flags", "fields"}
