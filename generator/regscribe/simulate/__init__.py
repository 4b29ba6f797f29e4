"""A device that answers as its map says: in process, over TCP, or on a serial line."""

from regscribe.simulate.connection import Delivery, Exchange, Patience
from regscribe.simulate.device import SimulatedDevice
from regscribe.simulate.errors import SimulatorError
from regscribe.simulate.framing import Request
from regscribe.simulate.lines import Line
from regscribe.simulate.servers import Server
from regscribe.simulate.service import Running, Service, Transport, serve, simulate, start
from regscribe.simulate.station import Foreign

__all__ = [
    "Delivery",
    "Exchange",
    "Foreign",
    "Line",
    "Patience",
    "Request",
    "Running",
    "Server",
    "Service",
    "SimulatedDevice",
    "SimulatorError",
    "Transport",
    "serve",
    "simulate",
    "start",
]
