"""A simulated device that is served in several ways at once: by one of them to a client, by TCP to the own driver."""

import asyncio
import threading
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from typing import Any

from regscribe.simulate import Server, Service, SimulatedDevice, Transport, start


@dataclass(frozen=True, slots=True)
class Stage:
    """The device and where it is reached; `requests` are the PDUs of all requests that it was told of, in order."""

    device: SimulatedDevice
    servers: tuple[Server, ...]
    requests: list[bytes]

    def writes(self) -> list[bytes]:
        """Return the requests that write."""
        return [pdu for pdu in self.requests if pdu[0] in {5, 6, 15, 16}]


@contextmanager
def staged(device: SimulatedDevice, *services: dict[str, Any]) -> Iterator[Stage]:
    """Serve `device` as each of `services` says (keywords of `Service`), from a thread, while the block runs."""
    requests: list[bytes] = []
    ways = [Service(**service, recorder=lambda request: requests.append(request.pdu)) for service in services]
    loop = asyncio.new_event_loop()
    thread = threading.Thread(target=loop.run_forever, daemon=True)
    thread.start()
    with ExitStack() as undo:
        undo.callback(_end, loop, thread)
        yield Stage(device, tuple(_started(loop, device, way, undo) for way in ways), requests)


def _started(loop: asyncio.AbstractEventLoop, device: SimulatedDevice, service: Service, undo: ExitStack) -> Server:
    server = asyncio.run_coroutine_threadsafe(start((device,), service), loop).result()
    undo.callback(lambda: asyncio.run_coroutine_threadsafe(server.stop(), loop).result())
    return server


def _end(loop: asyncio.AbstractEventLoop, thread: threading.Thread) -> None:
    loop.call_soon_threadsafe(loop.stop)
    thread.join()
    loop.close()


def service(transport: str, **settings: Any) -> dict[str, Any]:
    """Return the keywords of a `Service` on `transport`."""
    return {"transport": Transport(transport), **settings}


def several(pdus: Sequence[bytes]) -> str:
    """Requests for a message."""
    return ", ".join(pdu.hex(" ") for pdu in pdus)
