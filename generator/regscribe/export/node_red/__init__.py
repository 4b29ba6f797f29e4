"""The exporter of a flow for Node-RED with the nodes of node-red-contrib-modbus (docs/export.md).

One node reads each request of the plan, a function node turns its words into the values of all registers in it. On
demand a second function node checks and encodes what is to be written.
"""

from collections.abc import Mapping, Sequence
from functools import partial
from importlib.resources import files

from regscribe.export.device import RESOLVED, Carries, Carry, Device, Point, Request, Target, Wire, exported
from regscribe.export.device.options import DEVICE_OPTIONS
from regscribe.export.device.reads import planned_reads
from regscribe.export.node_red.flow import SPACES, Flow, client, debug, decoder, function, read, span_of, tab
from regscribe.export.node_red.table import Entry, entry_of, is_readable
from regscribe.export.node_red.writes import write_entries
from regscribe.losses import Exported, Grade
from regscribe.model import Kind, RegisterMap
from regscribe.plugins import Option, OptionError
from regscribe.visible import json_text

name = "node-red"
summary = "a flow of Node-RED that reads, decodes and on demand writes one device"
WRITES = Option("writes", "with nodes that check and write what can be written: yes or no.", "no", metavar="yes|no")
options = (*DEVICE_OPTIONS, WRITES)

LONGEST_INTERVAL = (1 << 31) // 1000 - 1
"""Seconds that a timer of Node.js can wait; a longer one fires at once."""

carries: Carries = RESOLVED | {
    **dict.fromkeys(("scale", "offset", "unit", "valid", "saturates"), Carry.WHOLE),
    **dict.fromkeys(("sentinel", "special-value", "special-number", "enum", "flags", "fields"), Carry.WHOLE),
    **dict.fromkeys(("boolean", "string", "padding", "version", "bytes", "date"), Carry.WHOLE),
    **dict.fromkeys(("range", "range-union", "step", "functions", "limits"), Carry.WHOLE),
    "write": Carry.PARTLY,
}


def _fits(wire: Wire) -> bool:
    return wire.space in SPACES


def _refuses(point: Point, _: Request) -> str:
    if point.register.kind is Kind.STRING and not is_readable(point.register.text):
        return f"the flow does not read texts in {point.register.text.encoding}"
    if point.valid is None:
        return "the limits of a valid reading are not known as the device is stated"
    return ""


TARGET = Target(
    name=name, carries=carries, fits=_fits, refuses=_refuses, verified="Node-RED 4.1.15, node-red-contrib-modbus 5.23.3"
)


def export(maps: Sequence[RegisterMap], options: Mapping[str, str]) -> Exported:
    """Return the flow, to be imported by Node-RED's menu. Raises OptionError."""
    if options["writes"] not in {"yes", "no"}:
        message = f"--writes {options['writes']}: write yes or no"
        raise OptionError(message)
    return exported(TARGET, maps, options, partial(_text, writes=options["writes"] == "yes"))


def _text(device: Device, *, writes: bool) -> str:
    if device.request.every > LONGEST_INTERVAL:
        message = f"--every {device.request.every}: Node-RED waits at most {LONGEST_INTERVAL} seconds"
        raise OptionError(message)
    flow = Flow(f"{device.register_map.id} {device.model.name} {device.name}")
    tab(flow, device)
    server = client(flow, device)
    row = _reads(flow, device, server)
    if writes:
        _writes(flow, device, server, row + 1)
    else:
        for point in device.points:
            if point.write is not None:
                device.lose(
                    point.register, "write", Grade.LOST, "read only: ask for the nodes that write by --writes yes"
                )
    return json_text(flow.nodes, indent=1) + "\n"


def _reads(flow: Flow, device: Device, server: str) -> int:
    """Add the nodes that read and decode, and return the last row."""
    planned = planned_reads(device)
    decode = decoder(flow, _code("numbers.js", "decode.js", "on_answer.js"))
    shown = debug(flow, "shown", 1, f"values of {device.name}")
    out = flow.put("values", "link out", 2, 2, name=f"values of {device.name}", mode="link", links=[], wires=[])
    for number, (block, points) in enumerate(planned):
        table = _table([entry_of(point, block.address) for point in points])
        settings = {"name": f"decode {span_of(block)}", "env": [{"name": "registers", "type": "json", "value": table}]}
        to = flow.put(f"decode {number}", f"subflow:{decode}", 1, number + 1, **settings, wires=[[shown, out]])
        read(flow, device, number, block, server=server, to=to)
    return len(planned)


def _writes(flow: Flow, device: Device, server: str, row: int) -> None:
    """Add the nodes that check and write: `topic` of a message is the path of a register, `payload` the value."""
    entries = write_entries(device)
    if not entries:
        return
    plain = {"showStatusActivities": True, "showErrors": True, "emptyMsgOnFail": False, "keepMsgProperties": True}
    shown = debug(flow, "written", row + 1, f"written to {device.name}")
    sent = flow.put("send", "modbus-flex-write", 2, row, name="write", server=server, **plain, wires=[[shown], []])
    head = f"const unit = {device.place.unit}\nconst registers = {_table(entries)}\n"
    code = head + _code("numbers.js", "decode.js", "encode.js", "on_write.js")
    encode = function(flow, "encode", code, called="check and encode", to=[sent], on=flow.place(1, row))
    flow.put("set", "link in", 0, row, name=f"set {device.name}", links=[], wires=[[encode]])


def _table(entries: Sequence[Entry]) -> str:
    """A table as JSON, a line for each register."""
    lines = ",\n".join(f"  {json_text(entry)}" for entry in entries)
    return f"[\n{lines}\n]"


def _code(*parts: str) -> str:
    """The code of a function node, which is the same for every map."""
    return "\n".join(files(__name__).joinpath(part).read_text("utf-8") for part in parts)
