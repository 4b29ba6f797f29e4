"""node-wot's own codec makes of the words of all cases by hand (tests/conformance/cases) the values by hand."""

import json
import subprocess
from fractions import Fraction
from typing import Any

import pytest

from regscribe.export.device.places import places_of
from regscribe.export.wot_td import TARGET
from regscribe.export.wot_td.forms import forms_of, reads_whole, why_read_only
from regscribe.export.wot_td.schema import schema_of
from regscribe.model import WireType

from ...conformance.exported import (  # noqa: TID252 (tests are no package)
    Asked,
    code_of,
    compiled_cases,
    label_of,
    reads,
    writes,
)
from .install import consumer

pytestmark = pytest.mark.interop("node-wot")

Json = Any

SCRIPT = """
const { ContentSerdes } = require('@node-wot/core')
const serdes = ContentSerdes.get()
async function main () {
  const made = []
  for (const { type, schema, bytes, value } of JSON.parse(require('fs').readFileSync(0))) {
    try {
      if (bytes) made.push({ value: serdes.contentToValue({ type, body: Buffer.from(bytes) }, schema) })
      else made.push({ bytes: [...(await serdes.valueToContent(value, schema, type).toBuffer())] })
    } catch (error) { made.push({ error: error.message }) }
  }
  console.log(JSON.stringify(made))
}
main()
"""
NEAR = {
    WireType.FLOAT16: Fraction(1, 10**3),
    WireType.FLOAT32: Fraction(1, 10**6),
    WireType.FLOAT64: Fraction(1, 10**15),
}
"""How near a float is to its shortest decimal."""
LEAST = {
    WireType.FLOAT16: Fraction(1, 10**8),
    WireType.FLOAT32: Fraction(1, 10**37),
    WireType.FLOAT64: Fraction(1, 10**300),
}
"""What numbers that have too few digits to be compared are below."""


def node_wot(jobs: list[Json]) -> list[Json]:
    """What the codec makes of bytes, or of values."""
    done = subprocess.run(  # noqa: S603 (a fixed program)
        ["node", "-e", SCRIPT],  # noqa: S607 (as it is installed)
        cwd=consumer("node-wot").folder,
        input=json.dumps(jobs),
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
        timeout=120,
        check=True,
    )
    found: list[Json] = json.loads(done.stdout.splitlines()[-1])
    return found


def octets(one: Asked) -> list[int]:
    """The bytes of the words of a row as they come from the device."""
    if one.point.wire.space.is_bits:
        return one.words
    return [byte for word in one.words for byte in divmod(word, 256)]


def test_the_codec_reads_what_the_cases_say() -> None:
    rows = [one for case, built in compiled_cases() for one in reads(TARGET, case, built)]
    said = [schema_of(one.device, one.point, writable=False) for one in rows]
    jobs = [
        {
            "type": forms_of(one.device, one.point, writable=False)[0]["contentType"],
            "schema": schema,
            "bytes": octets(one),
        }
        for one, schema in zip(rows, said, strict=True)
        if one.register.access.readable
    ]
    rows = [one for one in rows if one.register.access.readable]
    made = node_wot(jobs)
    wrong = [
        f"{one.case}: {one.row}: {found} by {job}"
        for one, found, job in zip(rows, made, jobs, strict=True)
        if not _agrees(one, found, job["schema"])
    ]
    assert wrong == []
    assert len(rows) > 800


def _agrees(one: Asked, found: Json, schema: Json) -> bool:
    row, value = one.row, found.get("value")
    if not reads_whole(one.point) or "no_value" in row or "fault" in row:
        return "error" in found or reads_whole(one.point)  # raw numbers, which x-faults and the report tell
    if "flags" in row and isinstance(value, dict):
        return {name for name, is_set in value.items() if is_set} == set(row["flags"]) & value.keys()
    if "fields" in row and isinstance(value, dict):
        return all(_is_part(value[name], part, schema["properties"][name]) for name, part in row["fields"].items())
    if {"flags", "fields"} & row.keys():
        return bool(
            value == sum(octets(one)[place] << 8 * at for at, place in enumerate(reversed(places_of(one.point))))
        )
    if "unknown" in row:
        return Fraction(value) * one.point.slope + one.point.offset == row["unknown"]
    return _is_value(one, value)


def _is_part(value: Json, said: Any, schema: Json) -> bool:
    if isinstance(said, str):
        return True
    scale = schema.get("x-scale", {"multiply": "1", "add": "0", "signed": False})
    signed = scale["signed"] and value >= 1 << schema["ex:bitLength"] - 1
    number = value - (1 << schema["ex:bitLength"]) if signed else value
    return Fraction(number) * Fraction(scale["multiply"]) + Fraction(scale["add"]) == Fraction(said)


def _is_value(one: Asked, value: Json) -> bool:
    """Whether a raw number with its scale, or a text without its filling, is the value of a row."""
    row = one.row
    said = row.get("value")
    if isinstance(value, str):
        rest = value.removeprefix(said)
        return value.startswith(said) and (not rest or not rest[0].isalnum())
    if isinstance(said, str):
        return True  # a version, told to be the number that packs it
    number = Fraction(value) * one.point.slope + one.point.offset
    if "member" in row:
        return number == code_of(one)
    special = [each for each in one.point.special_numbers if _near(one, Fraction(value), Fraction(each.wire))]
    if "special" in row:
        return label_of(one) in {each.label for each in special}
    return bool(special) or _near(one, number, Fraction(said))


def _near(one: Asked, number: Fraction, said: Fraction) -> bool:
    kind = one.point.wire.type
    return number == said or (kind in NEAR and abs(number - said) <= max(abs(said) * NEAR[kind], LEAST[kind]))


def test_the_codec_writes_what_the_cases_say() -> None:
    rows = [
        one
        for case, built in compiled_cases()
        for one in writes(TARGET, case, built)
        if "words" in one.row and not why_read_only(one.device, one.point) and isinstance(_raw(one), int | float)
    ]
    jobs = [
        {
            "type": forms_of(one.device, one.point, writable=True)[-1]["contentType"],
            "schema": schema_of(one.device, one.point, writable=True),
            "value": _raw(one),
        }
        for one in rows
    ]
    wrong = [
        f"{one.case}: {one.row}: {found} by {job}"
        for one, found, job in zip(rows, node_wot(jobs), jobs, strict=True)
        if _sent(one, found) != one.words
    ]
    assert wrong == []
    assert len(rows) > 300


def _raw(one: Asked) -> Json:
    """The raw number of the value of a row; a truth value of a coil."""
    if "special" in one.row:
        special = next(each.wire for each in one.point.special_numbers if each.label == label_of(one))
        return float(special) if one.point.wire.type.is_float else int(special)
    value = code_of(one) if "member" in one.row else one.row["value"]
    if isinstance(value, bool | str):
        return value if one.point.wire.space.is_bits or isinstance(value, str) else int(value)
    number = next((each.wire for each in one.point.special_numbers if each.value == Fraction(value)), None)
    raw = (Fraction(value) - one.point.offset) / one.point.slope if number is None else Fraction(number)
    return raw.numerator if raw.denominator == 1 and not one.point.wire.type.is_float else float(raw)


def _sent(one: Asked, found: Json) -> list[int]:
    """The words that the binding makes of the bytes: it swaps those of a single register, and of no others."""
    raw = found.get("bytes", [])
    if one.point.wire.space.is_bits:
        return [int(any(raw))]
    words = [256 * high + low for high, low in zip(raw[::2], raw[1::2], strict=True)]
    swapped = (
        len(words) == 1
        and "byteSeq=BIG_ENDIAN_BYTE_SWAP" in forms_of(one.device, one.point, writable=True)[-1]["contentType"]
    )
    return [(word >> 8) | (word & 0xFF) << 8 for word in words] if swapped else words
