"""What commands say fits the screen, and counts one as one."""

import io
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from rich.console import Console

from regscribe.cli.commands import scan
from regscribe.cli.shared.chart import chart
from regscribe.cli.shared.exit_codes import SILENT
from regscribe.cli.shared.request_log import RequestLog, drawn
from regscribe.pipeline import compile_map
from regscribe.simulate import Exchange, simulate
from regscribe_devices.athena.series_c import Athena16C


@pytest.mark.parametrize("height", [10, 12, 24, 60])
def test_a_full_screen_of_requests_ends_with_the_newest(height: int) -> None:
    exchanges: list[Exchange] = []

    async def kept(exchange: Exchange) -> bytes:
        exchanges.append(exchange)
        return exchange.frame

    with simulate("athena/series-c", "16C", unit=1, delivery=kept) as running:
        with Athena16C.tcp("127.0.0.1", port=running.port, unit=1) as controller:
            for _ in range(29):
                controller.input_filter.read()
            controller.setpoint_ram.read(view="x10")
        log = RequestLog([running.device])
        for exchange in exchanges:
            log.note(exchange)
        out = io.StringIO()
        Console(file=out, width=70, height=height).print(drawn(log, height))
    lines = out.getvalue().rstrip("\n").split("\n")
    shown = [line for line in lines if "read" in line]
    assert len(lines) < height
    assert "setpoint_ram" in shown[-1]
    assert len(shown) == min(height - 6, 18)


@pytest.mark.parametrize("width", [40, 80, 133])
def test_a_chart_is_as_wide_as_the_terminal_and_no_wider(width: int) -> None:
    text = chart("value", [0, 1, 2], [0, 5, 3], unit="K", width=width)
    widest = max(len(line.rstrip()) for line in text.splitlines())
    assert width - 10 <= widest <= width


def test_a_scan_says_what_the_exception_means(oven: Path, cli: Callable[..., Any]) -> None:
    register_map = compile_map(oven).map
    assert register_map is not None
    with simulate(register_map, "M1", unit=3) as running:
        link = f"tcp:127.0.0.1:{running.port}?timeout=0.2"
        result = cli("scan", link, "--units", "3", "--address", "9", "--no-names")
    assert "exception 02" in result.out
    assert f"exception 02: {scan.MEANINGS[2]}; it is there all the same" in result.err


def test_a_scan_takes_the_address_in_every_notation(cli: Callable[..., Any]) -> None:
    closed = "tcp:127.0.0.1:1?timeout=0.2"
    assert cli("scan", closed, "--units", "3", "--address", "0x9").code == SILENT
    assert "write holding:40010 or holding:9" in cli("scan", closed, "--address", "40010").err
    for other in ("input:9", "-1", "70000", "nine"):
        assert f"--address {other}: write that of a holding register" in cli("scan", closed, f"--address={other}").err
