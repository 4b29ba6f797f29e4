"""Each client with each way of talking that it has, ready to be let loose on a simulated device."""

from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

from independent.answers import Client
from independent.lines import pty_before, pty_pair
from independent.mbpoll import MbpollRtu, MbpollTcp
from independent.minimal import MinimalAscii, MinimalRtu
from independent.node import NodeAscii, NodeRtu, NodeRtuTcp, NodeTcp
from independent.stage import Stage, service, staged
from regscribe.simulate import Foreign, SimulatedDevice
from regscribe_runtime.link.connect import tcp
from regscribe_runtime.link.links import Link

OVER_TCP: dict[type[Client], str] = {MbpollTcp: "tcp", NodeTcp: "tcp", NodeRtuTcp: "rtu-tcp"}
ON_A_LINE: tuple[type[Client], ...] = (MbpollRtu, MinimalRtu, NodeRtu)
ASCII_ON_A_LINE: tuple[type[Client], ...] = (MinimalAscii, NodeAscii)
CLIENTS: tuple[type[Client], ...] = (*OVER_TCP, *ON_A_LINE, *ASCII_ON_A_LINE)

Talk = tuple[Client, Stage]


@contextmanager
def talking(
    kind: type[Client], device: SimulatedDevice, folder: Path, foreign: Foreign | None = None
) -> Iterator[Talk]:
    """Serve `device` as the client `kind` talks, and on TCP as the last server of the stage; connect the client."""
    make: Callable[..., Client] = kind
    with ExitStack() as stack:
        if kind in OVER_TCP:
            stage = _served(stack, device, service(OVER_TCP[kind], foreign=foreign))
            target = [stage.servers[0].host, stage.servers[0].port]
        elif kind in ON_A_LINE:
            ours, theirs = stack.enter_context(pty_pair(folder))
            stage, target = _served(stack, device, service("serial", path=ours)), [theirs]
        else:
            stage = _served(stack, device, service("ascii-tcp"))
            target = [stack.enter_context(pty_before(stage.servers[0].host, stage.servers[0].port, folder))]
        yield stack.enter_context(make(*target)), stage


def _served(stack: ExitStack, device: SimulatedDevice, way: dict[str, Any]) -> Stage:
    return stack.enter_context(staged(device, way, service("tcp")))


def own_link(stage: Stage) -> Link:
    """Return a link of the own drivers to the device."""
    server = stage.servers[-1]
    return tcp(server.host, port=server.port, timeout=5.0)
