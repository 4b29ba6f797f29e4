"""A small map as a user would write it, compiled without the checks, and tools to read the page as a renderer does."""

from collections.abc import Callable
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import pytest
from markdown_it import MarkdownIt

from regscribe import compose, lower, source
from regscribe.emit.markdown import render
from regscribe.model import RegisterMap

MAP = """
format: 1
map: {id: acme/big-oven, title: Acme Oven, maker: Acme, class_prefix: Acme}
manual: {title: Oven and Modbus, number: A-7, date: May 2001}
description: An oven; `input_type` decides about scales.
models: {A1: {description: small}, A2: {}, B1: {}}
notations: [{name: absolute, space: holding, offset: 40001}]
protocol:
  source: "1.1"
  functions: [3, 6, 16]
  broadcast: [6]
  default_unit: 1
  limits: {read_words: 24, write_words: 20}
  faults: {function: silence, quantity: silence, later_read: garbage, later_write: stop}
  exceptions: {2: {name: bad address, meaning: no such register}}
  latency: {3: {per_word: 5..100}}
  serial: {modes: [rtu], baud: [9600], formats: [8N1], default: 9600 8N1}
givens:
  linear_inputs: {type: codes, register: input_type, description: the linear codes, reason: not in this manual}
conditions:
  linear: {input_type: {in: linear_inputs}}
units:
  temperature: [{when: {scale_unit: 1}, symbol: °F}, {symbol: °C}]
enums:
  input_type:
    0: J
    1: {label: K, models: [A1]}
    2: {invalid: never fitted}
    3: {label: R, description: rarely used}
    4: S
    5: T
views:
  fraction:
    base: {offset: 0, type: int16, rounding: half_up, region: 0..999}
    ieee: {offset: 8000, stride: 2, type: float32, functions: [3, 16], align: 2, preferred: true}
decimals:
  digits: {register: dp, when: linear}
groups:
  - id: input
    name: Input
    source: "2.1"
    each: {access: rw}
    registers:
      - {at: 4000, name: Input Type, symbol: INPT, enum: input_type, default: 0}
      - {at: 4001, name: Second Type, enum: input_type, except: [B1]}
      - {at: 4002, id: dp, name: Decimal Point, range: 0..3, variants: [{models: [B1], range: 0..1}]}
      - {at: 4003, name: Scale Unit, enum: {1: fahrenheit, 2: celsius}, rescales: temperature, danger: values change}
      - {at: 1, name: Setpoint, views: fraction, decimals: digits, unit: temperature, range: 0..500, default: 77.5}
      - {at: 2, name: Value, views: fraction, unit: temperature, access: r, sentinels: {-32768: low}, range: 0..9}
      - {at: 4004, name: Status, access: r, flags: {0: alarm, 3: {label: door open, models: [A2]}}, aliases: [4100]}
  - id: profile
    name: Profile
    source: "2.2"
    each: {access: rw}
    registers:
      - id: segments
        name: Segment
        repeat: 1..4
        stride: 3
        registers:
          - {at: 4200, name: Ramp Time, range: 1..99, special: {0: 'off'}, default: 0, unit: min}
          - {at: 50, name: Soak Level, views: fraction}
commands:
  load_defaults:
    name: Load Defaults
    source: "3.1"
    danger: all settings are lost
    steps: [{at: 7000, words: [85, 92]}, {wait: 2000}]
    except: [B1]
  take:
    name: Take
    arguments:
      level: {type: uint32, word_order: little, multiply: 2, add: 1, special: {21: none}}
      part: {type: uint8, byte: high}
    steps: [{at: 7010, value: {argument: level}}, {at: 7012, value: {argument: part}}]
identify: [{when: {dp: 0}, models: [A1, A2]}]
reserved: [{at: 77..79}]
examples:
  - {source: "2.1", register: setpoint, with: {input_type: 0}, stored: 20.5, words: [21]}
  - {source: "2.3", frame: 9C 06 0F A9 00 32 C7 66, unit: 156, function: 6, address: 4009, words: [50]}
  - {source: "1.2", timing: {baud: 9600, format: 8N1, function: 3, words: 2}, gap: 4.17, earliest: 14.17, latest: 20.5}
errata:
  - {where: "2.1", printed: $1E2, read: "4082", why: the list agrees}
notes: [All values are decimal.]
"""


class Page(HTMLParser):
    """What a browser sees: tags, links, anchors, cells of each row, text."""

    def __init__(self, html: str) -> None:
        super().__init__()
        self.tags: set[str] = set()
        self.links: list[str] = []
        self.anchors: list[str] = []
        self.tables: list[list[int]] = []
        self.text = ""
        self.attributes: set[str] = set()
        self.feed(html)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.add(tag)
        self.attributes |= {name for name, _ in attrs}
        found = dict(attrs)
        self.links += [found["href"] or ""] if "href" in found else []
        self.anchors += [found["id"] or ""] if "id" in found else []
        if tag == "table":
            self.tables.append([])
        elif tag == "tr":
            self.tables[-1].append(0)
        elif tag in {"td", "th"}:
            self.tables[-1][-1] += 1

    def handle_data(self, data: str) -> None:
        self.text += data


@pytest.fixture(scope="session")
def markdown() -> MarkdownIt:
    return MarkdownIt("commonmark").enable(["table", "strikethrough"])


@pytest.fixture(scope="session")
def parse() -> Callable[[str], Page]:
    return Page


@pytest.fixture(scope="session")
def load() -> Callable[[Path], RegisterMap]:
    """Return a function that reads a map, with the files that it builds on, without checking it."""

    def read(path: Path) -> RegisterMap:
        document, found = source.load(path)
        assert document is not None, found
        composed = compose.compose(document, path)
        assert composed.document is not None, composed.diagnostics
        register_map, lowered = lower.lower(composed.document)
        assert register_map is not None, lowered
        return replace(register_map, extends=composed.extends, uses=composed.uses, overrides=composed.overrides)

    return read


@pytest.fixture(scope="session")
def oven_path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("maps") / "oven.yaml"
    path.write_text(MAP, encoding="utf-8")
    return path


@pytest.fixture(scope="session")
def oven(oven_path: Path, load: Callable[[Path], RegisterMap]) -> RegisterMap:
    return load(oven_path)


@pytest.fixture(scope="session")
def text(oven: RegisterMap) -> str:
    return render(oven)["docs/acme/big-oven.md"]


@pytest.fixture(scope="session")
def section(text: str) -> Callable[[str], str]:
    """Return a function that gives the part of the page from an anchor to the next heading."""

    def find(anchor: str) -> str:
        start = text.index(f'<a id="{anchor}">')
        end = text.find("\n#", start)
        return text[start : end if end > 0 else len(text)]

    return find
