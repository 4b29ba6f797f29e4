"""A server that stops leaves nothing open, whatever its clients are doing."""

import gc
import socket
import warnings

from regscribe.simulate import simulate


def test_clients_that_come_while_it_stops_are_closed_too() -> None:
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always", ResourceWarning)
        for _ in range(30):
            clients = [socket.socket() for _ in range(8)]
            with simulate("athena/series-c", "16C") as running:
                for client in clients:
                    client.settimeout(0)
                    client.connect_ex((running.host, running.port))
            for client in clients:
                client.close()
        gc.collect()
    assert [str(one.message) for one in said] == []
