"""A small map, whose lines the tests change."""

CURSOR = "│"
HEAD = """\
format: 1
map: {id: acme/one, title: One, maker: Acme, class_prefix: Acme}
manual: {title: One, number: A-1}
models: {A1: {}, B2: {}}
notations:
  - {name: absolute, space: holding, offset: 40001}
conditions:
  manual_mode: {mode: manual}
units:
  temperature:
    - {when: {fahrenheit: 1}, symbol: °F}
    - {symbol: °C}
enums:
  mode: {0: automatic, 1: manual}
groups:
  - id: control
    name: Control
    source: "3"
    each: {access: rw, type: int16}
    registers:
      - {at: 10, name: Mode, enum: mode, default: 0}
      - {at: 11, name: Fahrenheit, kind: boolean, type: uint16, default: 1}
      - {at: 12, name: Setpoint, unit: temperature, decimals: 1, range: -10..250.5, default: 77}
"""
"""A map that compiles; lines of further registers may follow."""
