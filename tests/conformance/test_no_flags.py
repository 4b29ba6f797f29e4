"""What a manual calls a word of flags in which none is set: everyone who shows texts says it, and takes it."""

import csv
import io
import json
from typing import Any

from regscribe.emit import markdown
from regscribe.export.csv import csv_text
from regscribe.export.json import json_text
from regscribe.simulate.device.device import SimulatedDevice
from regscribe.tools.live.reading import readings
from regscribe.tools.live.value_text import as_text, parse, show

from .matrix_watch import Wire
from .suite import build, diagnose, errors_of, whole_map

PARTS: dict[str, Any] = {
    "registers": [{"at": 0, "name": "Alarms", "type": "uint16", "flags": {0: "hot", 3: "cold", "none": "All well, go"}}]
}


def test_texts_show_the_label_and_take_it() -> None:
    built = build(whole_map(PARTS))
    register, flags = built.module.CaseA.registers["alarms"], built.module.Alarms
    assert as_text(register, flags(0)) == "All well, go"
    assert as_text(register, flags.COLD) == "COLD"
    assert show(register, flags(0)) == []
    assert [parse(register, one) for one in ("all well, go", "none", "", "hot, cold")] == [0, 0, 0, 9]


def test_a_device_reads_and_simulates_it() -> None:
    built = build(whole_map(PARTS))
    device = SimulatedDevice(built.map, "A", unit=1)
    device.poke("alarms", 9)
    device.poke("alarms", "all well, go")
    assert device.peek_words("alarms") == (0,)
    driver = built.module.CaseA(Wire(device.handle), unit=1)
    (reading,) = driver.run(readings([driver.registers["alarms"]]))
    assert (reading.value, reading.text) == ([], "All well, go")


def test_docs_and_exports_say_it() -> None:
    register_map = build(whole_map(PARTS)).map
    (page,) = (text for path, text in markdown.render(register_map).items() if path.endswith("case.md"))
    assert "| none | All well, go |" in page
    (register,) = json.loads(json_text([register_map]))["maps"][0]["models"][0]["registers"]
    assert register["none"] == "All well, go"
    (row,) = csv.DictReader(io.StringIO(csv_text([register_map])))
    assert json.loads(row["values"]) == {"0": "All well, go"}


def test_a_label_of_none_alone_is_no_word_of_flags() -> None:
    _, found = diagnose(whole_map({"registers": [{"at": 0, "name": "V", "type": "uint16", "flags": {"none": "well"}}]}))
    assert errors_of(found)
