"""`regscribe export --format collectd` on the command line."""

from collections.abc import Callable
from typing import Any

import pytest

pytestmark = pytest.mark.usefixtures("oven")

POLL = "export acme/oven --format collectd --model M1"


def test_it_prints_a_poll_of_one_model(cli: Callable[..., Any]) -> None:
    result = cli(*POLL.split(), "--at", "10.0.0.7:1502", "--unit", "7", "--every", "2")
    assert result.code == 0
    lines = [line.strip() for line in result.out.splitlines()]
    assert {"<Slave 7>", 'Address "10.0.0.7"', 'Port "1502"', "Interval 2", "Scale 0.1"} <= set(lines)
    assert '<Host "AcmeM1-7">' in lines


def test_a_serial_device_is_told_by_its_path(cli: Callable[..., Any]) -> None:
    assert 'Device "/dev/ttyUSB0"' in cli(*POLL.split(), "--at", "/dev/ttyUSB0", "--name", "oven").out


@pytest.mark.parametrize(
    ("more", "said"),
    [
        ("", "--at"),
        ("--at 10.0.0.7", "HOST:PORT"),
        ("--at 10.0.0.7:0", "HOST:PORT"),
        ("--at 10.0.0.7:65536", "HOST:PORT"),
        ("--at :502", "HOST:PORT"),
        ("--at h:502 --name a/b", "letters"),
        ("--at h:502 --with mode", "PATH=VALUE"),
        ("--at h:502 --with mod=1", "PATH=VALUE"),
        ("--at h:502 --with mode=walk", "STOP, RUN"),
        ("--at h:502 --with setpoint=1e999999999", "a number"),
        ("--at h:502 --given x=1", "givens"),
        ("--at h:502 --unit 0", "--unit"),
        ("--at h:502 --every 0", "--every"),
    ],
)
def test_what_it_cannot_poll_is_told_with_what_to_write(cli: Callable[..., Any], more: str, said: str) -> None:
    result = cli(*POLL.split(), *more.split())
    assert result.code == 2
    assert said in result.err
    assert not result.out


def test_an_unknown_model_is_refused_with_the_nearest(cli: Callable[..., Any]) -> None:
    result = cli("export", "acme/oven", "--format", "collectd", "--model", "M2", "--at", "h:502")
    assert result.code == 2
    assert "did you mean `M1`" in result.err


def test_other_formats_take_none_of_its_options(cli: Callable[..., Any]) -> None:
    result = cli("export", "--format", "csv", "--model", "M1", "--every", "3")
    assert result.code == 2
    assert "--model, --every" in result.err
