"""A device with a text, which can say anything."""

from pathlib import Path

MAP = """
format: 1
map: {id: acme/oven, title: Oven, maker: Acme, class_prefix: Acme}
manual: {title: Manual, number: "1"}
models: {O1: {}}
groups:
  - id: all
    name: All
    source: "1"
    each: {access: rw}
    registers:
      - {at: 0, name: Label, type: string, length: 12}
      - {at: 20, name: Level, type: int16, range: 0..100}
"""


def put_map(folder: Path) -> None:
    """Write the map to maps/acme/oven.yaml below a folder."""
    path = folder / "maps" / "acme" / "oven.yaml"
    path.parent.mkdir(parents=True)
    path.write_text(MAP, encoding="utf-8")
