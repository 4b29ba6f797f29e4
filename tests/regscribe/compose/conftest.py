"""A base, a library and maps that build on them, in a folder of maps of their own."""

from collections.abc import Callable
from pathlib import Path
from textwrap import dedent

import pytest

from regscribe.model import Diagnostic, Register, RegisterMap
from regscribe.pipeline import Compiled, compile_map

BASE = """\
format: 1
map: {id: acme/series-c, title: Series C, maker: Acme, class_prefix: Acme}
manual: {title: Series C Manual, number: SC-1}
description: the first family
models:
  16C: {description: small}
  18C: {description: large, class: LargeOne}
  1ZC: {}
protocol:
  source: "2.1"
  functions: [3, 6, 16]
  limits: {read_words: 24, write_words: 24}
  faults: {read_only: 3, condition: 3}
  latency: {3: {per_word: 5..100}, 6: {fixed: 25..180}}
enums:
  action: {1: "off", 2: normal, 3: {label: latched, models: [16C, 18C]}, 4: {label: event, models: [1ZC], invalid: no}}
groups:
  - id: control
    name: Control
    source: 4.7.2
    each: {access: rw, type: int16}
    registers:
      - {at: 0, name: Setpoint, range: 0..400, default: 77}
      - {at: 1, name: Alarm Action, enum: action, default: 1}
      - {at: 2, name: Rate, except: [1ZC], variants: [{models: [16C], default: 5}, {models: [18C], default: 6}]}
      - {at: 3, name: Watchdog, models: [1ZC]}
      - {at: 4, name: Card, except: [16C, 18C]}
      - id: segments
        name: Segment
        repeat: 1..3
        stride: 2
        source: 4.9
        registers:
          - {at: 10, name: Ramp Time}
          - {at: 11, name: Soak Event, flags: {0: first, 1: {label: second, models: [1ZC]}}}
  - id: zone
    name: Zone
    source: "4.10"
    each: {access: rw, type: int16}
    registers: [{at: 40, name: Zone Number, models: [1ZC]}]
commands:
  clear: {name: Clear, source: "7.4", steps: [{at: 90, words: [1]}]}
  zero: {name: Zero, source: "7.5", models: [1ZC], steps: [{at: 92, words: [1]}]}
identify:
  - {when: {alarm_action: 1}, models: [16C, 18C]}
  - {when: {alarm_action: 4}, models: [1ZC]}
write_order: [zone, control]
examples:
  - {source: 3.1, register: setpoint, value: 77, words: [77]}
  - {source: 3.2, register: watchdog, value: 1, words: [1]}
  - {source: 3.3, model: 18C, register: "segments[2].ramp_time", value: 3, words: [3]}
errata:
  - {where: 4.7, printed: "78", read: "77", why: the table}
  - {where: 9.1, printed: a, read: b, why: c}
notes: [the first note]
"""

LIBRARY = """\
format: 1
library: {id: acme/common, title: Common}
protocol: {functions: [3, 4, 6, 16], alike: [[3, 4]], limits: {write_words: 8}, faults: {value: 3, read_only: 2}}
notations: [{name: JBUS, space: holding, offset: 1}]
enums:
  launch:
    columns: [launch, op3_status]
    0: {cells: [output, "ON"]}
    1: {cells: [input, "OFF"]}
conditions:
  only_elsewhere: {register_of_another_map: 3}
sets:
  control:
    - {at: 0, name: Setpoint, symbol: S.P., printed: 5.P., access: rw, range: 0..400}
    - {at: 1, name: Timer Action, access: rw, enum: launch, aliases: [300], source: "1.1"}
    - id: segments
      name: Segment
      repeat: 1..2
      stride: 4
      registers:
        - {set: segment, shift: 20}
  segment:
    - {at: 0, name: "Ramp {i} Time", symbol: "rt{i}", access: rw}
    - {at: 1, name: Soak, symbol: so, access: rw}
commands:
  apply: {name: Apply, source: "5.1", steps: [{at: 120, words: [21930]}]}
  save: {name: Save, source: "5.2", steps: [{at: 121, words: [1]}]}
errata: [{where: 1.1, printed: a, read: b, why: c}]
notes: [of the library]
"""

Maps = Callable[..., Path]
Found = Callable[[Path], RegisterMap]


@pytest.fixture
def maps(tmp_path: Path) -> Maps:
    """Write files by their path in the folder of maps (without `.yaml`); the base and the library are there already."""
    folder = tmp_path / "maps" / "acme"
    folder.mkdir(parents=True)
    (folder / "series-c.yaml").write_text(BASE)
    (folder / "common.library.yaml").write_text(LIBRARY)

    def write(name: str, text: str) -> Path:
        path = tmp_path / "maps" / f"{name}.yaml"
        path.parent.mkdir(exist_ok=True)
        path.write_text(dedent(text))
        return path

    return write


@pytest.fixture
def extension(maps: Maps) -> Callable[..., Path]:
    """Write a map that extends the base: `body` behind its head; models X1 and X2 are the 16C and the 18C."""

    def write(body: str = "", models: str = "{X1: {from: 16C}, X2: {from: 18C}}") -> Path:
        head = "format: 1\nmap: {id: omega/x, title: X, maker: Omega, class_prefix: Omega}\nextends: acme/series-c\n"
        return maps("omega/x", f"{head}models: {models}\n{dedent(body)}")

    return write


@pytest.fixture
def user(maps: Maps) -> Callable[..., Path]:
    """Write a map that uses the library: lines of registers in one group, and what stands before the groups."""

    def write(*registers: str, top: str = "", name: str = "acme/user") -> Path:
        head = f"format: 1\nmap: {{id: {name}, title: User, maker: Acme, class_prefix: User}}\n"
        lines = "".join(f"      - {register}\n" for register in registers)
        return maps(
            name,
            f"{head}manual: {{title: M, number: N-1}}\nmodels: {{A: {{}}, B: {{}}}}\n"
            f"uses: [acme/common]\n{dedent(top)}\n"
            f'groups:\n  - id: main\n    name: Main\n    source: "4.1"\n    registers:\n{lines}',
        )

    return write


@pytest.fixture
def found() -> Found:
    """Compile a map that has no mistake."""

    def run(path: Path) -> RegisterMap:
        compiled = compile_map(path)
        assert compiled.diagnostics == ()
        assert compiled.map is not None
        return compiled.map

    return run


@pytest.fixture
def mistakes() -> Callable[[Path], tuple[Diagnostic, ...]]:
    """Compile a map that has mistakes."""

    def run(path: Path) -> tuple[Diagnostic, ...]:
        compiled: Compiled = compile_map(path)
        assert compiled.map is None
        return compiled.diagnostics

    return run


@pytest.fixture
def register() -> Callable[[RegisterMap, str, str], Register]:
    """Find a register of a model by its path."""
    return lambda found, model, path: found.model(model).register(path)
