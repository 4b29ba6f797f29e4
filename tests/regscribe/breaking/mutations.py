"""Random edits of single scalars of maps, and what the export says differs then."""

import json
import random
import re
from collections.abc import Iterator
from typing import Any

import yaml

from regscribe.export.json import json_text
from regscribe.model import RegisterMap

UNCOMPARED = {"content_hash", "stated", "overrides", "waivers", "extends", "uses"}
"""What the export says of files: which there are, what they state although it is usual, and what they excuse."""

WORDS = [
    ["r", "rw", "w"],
    ["int16", "uint16", "int32", "uint32", "float32"],
    ["ram", "eeprom", "both"],
    ["true", "false"],
]
RANGE = re.compile(r"(-?[\d.]+)\.\.(-?\d+)")


def exported(register_map: RegisterMap) -> Any:
    """What the export says of devices, without the names of conditions."""
    found = json.loads(json_text([register_map]))["maps"][0]
    return _plain({key: value for key, value in found.items() if key != "source"})


def _plain(value: Any) -> Any:
    if isinstance(value, dict):
        dropped = UNCOMPARED | ({"name"} if "tests" in value else set())
        return {key: _plain(each) for key, each in value.items() if key not in dropped}
    return [_plain(each) for each in value] if isinstance(value, list) else value


def scalars(text: str) -> list[tuple[int, int]]:
    """Where the keys and values of a YAML text stand, from and to, without those of several lines."""
    return [(node.start_mark.index, node.end_mark.index) for node in _scalars(yaml.compose(text))]


def _scalars(node: yaml.Node) -> Iterator[yaml.ScalarNode]:
    if isinstance(node, yaml.ScalarNode):
        if node.style not in {">", "|"}:
            yield node
        return
    for each in node.value:
        for part in each if isinstance(each, tuple) else (each,):
            yield from _scalars(part)


def mutant(text: str, place: tuple[int, int], chance: random.Random) -> str:
    """The text with another scalar at a place."""
    start, end = place
    return text[:start] + chance.choice(candidates(text[start:end])) + text[end:]


def candidates(old: str) -> list[str]:
    """Other scalars of the same sort."""
    if re.fullmatch(r"-?\d+", old):
        return [str(int(old) + 1), str(int(old) - 1), str(2 * int(old))]
    if re.fullmatch(r"-?\d+\.\d+", old):
        return [f"{old}1", f"1{old}"]
    alike = [one for words in WORDS if old in words for one in words if one != old]
    if alike:
        return alike
    found = RANGE.fullmatch(old)
    if found:
        return [f"{found[1]}..{int(found[2]) + step}" for step in (-1, 1)]
    return [f"{old[:-1]}x{old[-1]}"] if old[:1] in {'"', "'"} else [f"{old}x", f"{old} more"]
