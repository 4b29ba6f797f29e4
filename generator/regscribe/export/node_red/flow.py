"""Nodes of a flow: their identifiers, places on the sheet and wires, and the settings that the palette asks for."""

from dataclasses import dataclass, field
from hashlib import sha256
from typing import Any

from regscribe.export.device import Device
from regscribe.model import Space
from regscribe_runtime.planning.plan import Block
from regscribe_runtime.values.protocol import Protocol

Node = dict[str, Any]
"""What JSON has."""

SPACES = {
    Space.HOLDING: "HoldingRegister",
    Space.INPUT: "InputRegister",
    Space.COIL: "Coil",
    Space.DISCRETE: "Input",
}
PARITIES = {"N": "none", "E": "even", "O": "odd"}
COLUMN, ROW = 260, 60
"""Steps between nodes on the sheet."""


@dataclass(slots=True)
class Flow:
    """A sheet: `subject` tells its identifiers from those of other flows, so that two can be imported side by side."""

    subject: str
    nodes: list[Node] = field(default_factory=list)

    def id(self, role: str) -> str:
        """The identifier of the node of a role, the same at every export."""
        return sha256(f"{self.subject}\n{role}".encode()).hexdigest()[:16]

    def place(self, column: int, row: int) -> Node:
        """Where a node stands on the sheet."""
        return {"z": self.id("tab"), "x": 160 + column * COLUMN, "y": 60 + row * ROW}

    def put(self, role: str, kind: str, column: int = -1, row: int = 0, **settings: object) -> str:
        """Add a node, on the sheet if it has a column, and return its identifier."""
        found = self.id(role)
        placed = self.place(column, row) if column >= 0 else {}
        self.nodes.append({"id": found, "type": kind, **placed, **settings})
        return found


def tab(flow: Flow, device: Device) -> None:
    """Add the sheet, which says what it was made of."""
    flow.put("tab", "tab", label=device.name, disabled=False, info="\n\n".join(device.heading))


def client(flow: Flow, device: Device) -> str:
    """Add the connection and return its identifier."""
    place, protocol = device.place, device.register_map.protocol
    data, parity, stop = tuple(place.format)
    where: Node = {"clienttype": "tcp", "tcpHost": place.host, "tcpPort": str(place.port), "tcpType": "DEFAULT"}
    if place.device:
        where = {"clienttype": "simpleser", "serialPort": place.device, "serialType": "RTU-BUFFERD"}
        where |= {"serialBaudrate": str(place.baud), "serialDatabits": data, "serialStopbits": stop}
        where |= {"serialParity": PARITIES[parity], "serialConnectionDelay": "100"}
    logs = dict.fromkeys(("stateLogEnabled", "queueLogEnabled"), False)
    settings = {"bufferCommands": True, **logs, "failureLogEnabled": True, **where, **_times(protocol)}
    return flow.put("client", "modbus-client", name=device.name, unit_id=str(place.unit), **settings)


def _times(protocol: Protocol) -> Node:
    """How long to wait between requests, for answers and for a lost connection, in milliseconds."""
    pause = -(-protocol.pause.numerator // protocol.pause.denominator)
    return {
        "commandDelay": str(max(1, pause)),
        "clientTimeout": str(round(1000 * protocol.timeout)),
        "reconnectOnTimeout": True,
        "reconnectTimeout": "2000",
        "parallelUnitIdsAllowed": True,
    }


def read(flow: Flow, device: Device, number: int, block: Block, *, server: str, to: str) -> None:
    """Add the node that reads one request of the plan."""
    flow.put(
        f"read {number}",
        "modbus-read",
        0,
        number + 1,
        name=span_of(block),
        topic=device.name,
        showStatusActivities=True,
        logIOActivities=False,
        showErrors=True,
        unitid=str(device.place.unit),
        dataType=SPACES[block.space],
        adr=str(block.address),
        quantity=str(block.quantity),
        rate=str(device.request.every),
        rateUnit="s",
        delayOnStart=False,
        startDelayTime="",
        server=server,
        useIOFile=False,
        ioFile="",
        useIOForPayload=False,
        emptyMsgOnFail=False,
        wires=[[to], []],
    )


def span_of(block: Block) -> str:
    """Return what a request reads, in words."""
    return f"{block.space} {block.address}..{block.end - 1}"


def function(flow: Flow, role: str, code: str, *, called: str, to: list[str], on: Node) -> str:
    """Add a function node with one output; `on` is the sheet and the place that it stands on."""
    plain: Node = {"outputs": 1, "timeout": 0, "noerr": 0, "initialize": "", "finalize": "", "libs": []}
    return flow.put(role, "function", name=called, func=code, **plain, wires=[to], **on)


def decoder(flow: Flow, code: str) -> str:
    """Add the subflow that decodes by a table of its own in each place where it is used; return its identifier.

    It is the same for every device, so it has the code's own identifier.
    """
    inside = Flow(code)
    found = inside.id("subflow")
    on: Node = {"z": found, "y": 80}
    made = function(inside, "function", code, called="decode", to=[], on=on | {"x": 200})
    status = inside.put("status", "status", name="", scope=[made], wires=[[]], **(on | {"x": 200, "y": 140}))
    table: Node = {"name": "registers", "type": "json", "value": "[]"}
    inside.nodes.append(
        {
            "id": found,
            "type": "subflow",
            "name": "decode registers",
            "info": "Turns the words or bits of one answer into values, by the table in its property `registers`.",
            "category": "",
            "in": [{"x": 60, "y": 80, "wires": [{"id": made}]}],
            "out": [{"x": 360, "y": 80, "wires": [{"id": made, "port": 0}]}],
            "env": [table],
            "meta": {},
            "color": "#DDAA99",
            "status": {"x": 360, "y": 140, "wires": [{"id": status, "port": 0}]},
        }
    )
    flow.nodes += reversed(inside.nodes)
    return found


def debug(flow: Flow, role: str, row: int, called: str) -> str:
    """Add a node that shows whole messages in the sidebar."""
    shown: Node = {"active": True, "tosidebar": True, "console": False, "tostatus": False, "complete": "true"}
    shown |= {"targetType": "full", "statusVal": "", "statusType": "auto"}
    return flow.put(role, "debug", 2, row, name=called, **shown, wires=[])
