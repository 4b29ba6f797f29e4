"""A device that answers as its map says: in process, over TCP, or on a serial line."""

from regscribe.simulate.device.describe import Told, tell
from regscribe.simulate.device.device import SimulatedDevice
from regscribe.simulate.device.value_arguments import HIGH_FAULT, LOW_FAULT, Fault
from regscribe.simulate.errors import SimulatorError
from regscribe.simulate.in_process import Running, in_thread, simulate
from regscribe.simulate.line.connection import Arrival, Chunk, Delivery, Exchange, Patience
from regscribe.simulate.line.line_faults import LineFault, LineFaults
from regscribe.simulate.line.server_context import Foreign
from regscribe.simulate.line.servers import Server
from regscribe.simulate.line.service import Service, Transport, serve, start
from regscribe.simulate.map_cache import find_map
from regscribe.simulate.process.thermal_process import ThermalProcess
from regscribe_runtime.values.serial_line import SerialLine
from regscribe_runtime.wire.framing import Frame

__all__ = [
    "HIGH_FAULT",
    "LOW_FAULT",
    "Arrival",
    "Chunk",
    "Delivery",
    "Exchange",
    "Fault",
    "Foreign",
    "Frame",
    "LineFault",
    "LineFaults",
    "Patience",
    "Running",
    "SerialLine",
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
