"""A device that answers as its map says: in process, over TCP, or on a serial line."""

from regscribe.simulate.connection import Arrival, Delivery, Exchange, Patience, Piece
from regscribe.simulate.device import SimulatedDevice
from regscribe.simulate.errors import SimulatorError
from regscribe.simulate.faults import Faults, LineFault
from regscribe.simulate.framing import Framing, Request
from regscribe.simulate.lines import Line
from regscribe.simulate.maps import find_map
from regscribe.simulate.running import Running, in_thread, simulate
from regscribe.simulate.servers import Server
from regscribe.simulate.service import Service, Transport, serve, start
from regscribe.simulate.station import Foreign
from regscribe.simulate.telling import Told, tell
from regscribe.simulate.thermal import ThermalProcess
from regscribe.simulate.values import HIGH_FAULT, LOW_FAULT, Fault

__all__ = [
    "HIGH_FAULT",
    "LOW_FAULT",
    "Arrival",
    "Delivery",
    "Exchange",
    "Fault",
    "Faults",
    "Foreign",
    "Framing",
    "Line",
    "LineFault",
    "Patience",
    "Piece",
    "Request",
    "Running",
    "Server",
    "Service",
    "SimulatedDevice",
    "SimulatorError",
    "ThermalProcess",
    "Told",
    "Transport",
    "find_map",
    "in_thread",
    "serve",
    "simulate",
    "start",
    "tell",
]
