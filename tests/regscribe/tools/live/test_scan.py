import socket
import threading
from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from regscribe.simulate import Running
from regscribe.tools.live import link_names, scan
from regscribe.tools.live.errors import TargetError


def found(link: str, units: str, **more: Any) -> list[scan.Probe]:
    probes = scan.scan(scan.settings(link_names.split(link)[0], (), ()), scan.units(units), **more)
    return [probe for probe in probes if probe.answer]


@given(st.sets(st.integers(1, 247), min_size=1))
def test_units_are_a_list_of_numbers_and_spans(wanted: set[int]) -> None:
    assert set(scan.units(",".join(map(str, wanted)))) == wanted


def test_a_span_has_both_its_ends() -> None:
    assert scan.units("1-3,7, 2") == (1, 2, 3, 7)


@pytest.mark.parametrize("text", ["", "0", "248", "5-3", "1-", "a", "1,,2", "9" * 50])
def test_units_that_are_none_are_refused(text: str) -> None:
    with pytest.raises(TargetError, match="names no units"):
        scan.units(text)


def test_a_line_is_tried_with_every_speed_and_format() -> None:
    tried = scan.settings(link_names.split("rtu:/dev/x?timeout=0.2")[0], (9600, 19200), ("8N1", "8e1"))
    assert [(one.baud, one.parity, one.timeout) for one in tried] == [
        (9600, "N", 0.2),
        (9600, "E", 0.2),
        (19200, "N", 0.2),
        (19200, "E", 0.2),
    ]


def test_what_the_name_of_a_line_says_is_not_varied() -> None:
    (only,) = scan.settings(link_names.split("rtu:/dev/x?baud=4800&parity=O")[0], (), ())
    assert (only.baud, only.parity, only.data_bits) == (4800, "O", 8)


@pytest.mark.parametrize(("link", "bauds", "formats"), [("tcp:h", (9600,), ()), ("rtu:/dev/x", (), ("9X3",))])
def test_settings_that_a_link_cannot_have_are_refused(link: str, bauds: Any, formats: Any) -> None:
    with pytest.raises(TargetError):
        scan.settings(link_names.split(link)[0], bauds, formats)


def test_a_scan_is_bounded() -> None:
    tried = scan.settings(link_names.split("rtu:/dev/x?timeout=0.2")[0], (9600, 19200), ("8N1",))
    assert scan.longest(tried, range(1, 11)) == pytest.approx(10 * (2 * 0.2 + 165 / 9600 + 165 / 19200))


def test_a_unit_that_answers_is_found_and_asked_for_its_model(running: Running) -> None:
    (one,) = found(f"tcp:{running.host}:{running.port}", "1-4")
    assert (one.unit, one.answer, one.models) == (1, "a value", ("16C", "CN8200"))


def test_an_exception_is_an_answer_too(serve: Callable[..., Any]) -> None:
    with serve("fdc/series-100", "C21", givens={"linear_inputs": frozenset({1})}) as running:
        (one,) = found(f"tcp:{running.host}:{running.port}", "1", address=60_000)
    assert (one.answer[:9], one.models) == ("exception", ("C21",))


def test_a_unit_on_a_line_is_found_among_silent_ones(serve: Callable[..., Any]) -> None:
    with serve(transport="pty", unit=3) as running:
        link = f"rtu:{running.path}?baud=9600&timeout=0.05"
        assert [one.unit for one in found(link, "1-4", names=False)] == [3]


def test_other_speeds_are_not_tried_once_units_answered(serve: Callable[..., Any]) -> None:
    with serve(transport="pty", unit=2) as running:
        tried = scan.settings(link_names.split(f"rtu:{running.path}?timeout=0.05")[0], (9600, 19200), ("8N1",))
        once = [probe.link.baud for probe in scan.scan(tried, (2,), names=False)]
        every = [probe.link.baud for probe in scan.scan(tried, (2,), names=False, every=True)]
    assert (once, every) == ([9600], [9600, 19200])


def test_who_does_not_speak_modbus_is_no_unit(serve: Callable[..., Any]) -> None:
    with serve(transport="ascii-tcp") as running:
        link, _ = link_names.split(f"tcp:{running.host}:{running.port}?framing=rtu&timeout=0.1")
        assert [probe.answer for probe in scan.scan((link,), (1, 2))] == ["", ""]


def test_a_server_of_another_kind_is_asked_once() -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:
        answering = threading.Thread(target=_greet, args=(server,), daemon=True)
        answering.start()
        link, _ = link_names.split(f"tcp:127.0.0.1:{server.getsockname()[1]}?timeout=1")
        (probe,) = scan.scan((link,), (1, 2, 3))
        answering.join()
    assert (probe.answer, "is no header of Modbus TCP" in probe.noise) == ("", True)


def _greet(server: socket.socket) -> None:
    connection, _ = server.accept()
    with connection:
        connection.recv(100)
        connection.sendall(b"HTTP/1.1 400 Bad Request\r\n\r\n")
        connection.recv(100)
