"""The name of a link: `tcp:10.0.0.7:502`, `rtu:/dev/ttyUSB0?baud=9600&parity=E`, read and written without I/O."""

import re
from collections.abc import Container, Mapping
from dataclasses import dataclass, replace
from typing import Any
from urllib.parse import parse_qsl, urlencode

from regscribe.tools.live.errors import TargetError, meant
from regscribe_runtime.link.links import MODBUS_TCP_PORT
from regscribe_runtime.values.serial_line import ADDRESSINGS, DATA_BITS, FRAMINGS, MODBUS, PARITIES, STOP_BITS

SCHEMES = FRAMINGS
BAUDS = range(50, 10_000_001)
LAST_PORT = 0xFFFF
LONGEST_TIMEOUT = 3600.0
KEYS = ("baud", "parity", "data_bits", "stop_bits", "framing", "addressing", "timeout")
"""What may stand behind the `?`, besides the keys of the device (see `target`)."""
_WHOLE: dict[str, tuple[Container[int], str]] = {
    "baud": (BAUDS, f"{BAUDS[0]} to {BAUDS[-1]}"),
    "data_bits": (DATA_BITS, " or ".join(map(str, DATA_BITS))),
    "stop_bits": (STOP_BITS, " or ".join(map(str, STOP_BITS))),
}
_WORDS = {"parity": PARITIES, "addressing": tuple(ADDRESSINGS), "framing": FRAMINGS}
SERIAL_KEYS = ("baud", "data_bits", "parity", "stop_bits")


@dataclass(frozen=True, slots=True, kw_only=True)
class LinkName:
    """Link to a device: `host` and `port` over TCP, else the serial `device` with its line.

    What is None (or "" for `parity`) is left to the driver: the manual's own line, the timeout of its latencies.
    `timeout` is in seconds.
    """

    host: str = ""
    port: int = MODBUS_TCP_PORT
    device: str = ""
    framing: str = "tcp"
    baud: int | None = None
    data_bits: int | None = None
    parity: str = ""
    stop_bits: int | None = None
    addressing: str = MODBUS
    timeout: float | None = None

    @property
    def serial(self) -> bool:
        """Whether it is a serial line."""
        return not self.host

    def settings(self) -> dict[str, Any]:
        """The keyword arguments of a driver's `tcp` or `rtu`, and of the links of the runtime, besides the timeout."""
        if not self.serial:
            return {"port": self.port, "framing": self.framing, "addressing": self.addressing}
        given = {key: value for key in SERIAL_KEYS if (value := getattr(self, key))}
        return {**given, "framing": self.framing, "addressing": self.addressing}

    def __str__(self) -> str:
        usual = {"framing": self.framing if self.serial else "tcp", "addressing": MODBUS}
        given = {key: getattr(self, key) for key in (*SERIAL_KEYS, *usual)}
        told = {key: value for key, value in given.items() if value and value != usual.get(key)}
        query = urlencode(told if self.timeout is None else {**told, "timeout": f"{self.timeout:g}"})
        host = f"[{self.host}]" if ":" in self.host else self.host
        start = f"{self.framing}:{self.device}" if self.serial else f"tcp:{host}:{self.port}"
        return f"{start}?{query}" if query else start


def is_link(text: str) -> bool:
    """Whether a text is meant as the name of a link: it starts with `tcp:` or another word and a colon."""
    return bool(re.match(r"[A-Za-z][A-Za-z0-9+-]*:", text))


def split(text: str) -> tuple[LinkName, dict[str, str]]:
    """The link of a text, and the keys behind its `?` that do not belong to a link; TargetError."""
    scheme, _, rest = text.partition(":")
    if scheme not in SCHEMES:
        message = f"`{text[:100]}`: `{scheme}` is no kind of link{meant(scheme, SCHEMES)}"
        raise TargetError(message)
    place, _, query = rest.partition("?")
    given = _query(text, query)
    if scheme == "tcp":
        link = _tcp(text, place)
    elif place:
        link = LinkName(device=place, framing=scheme)
    else:
        message = f"{text}: name the serial device, for example {scheme}:/dev/ttyUSB0"
        raise TargetError(message)
    own = {key: value for key, value in given.items() if key in KEYS}
    return with_settings(link, own), {key: value for key, value in given.items() if key not in KEYS}


def _query(text: str, query: str) -> dict[str, str]:
    """The keys behind the `?` of a link."""
    pairs = parse_qsl(query, keep_blank_values=True)
    given = dict(pairs)
    if len(given) < len(pairs) or not all(given.values()) or (query and not pairs):
        message = f"{text}: write `?key=value&key=value`, each key once"
        raise TargetError(message)
    return given


def with_settings(link: LinkName, given: Mapping[str, str]) -> LinkName:
    """The link with settings as texts laid over it; TargetError for a value that is none."""
    misplaced = ("framing",) if link.serial else SERIAL_KEYS
    wrong = [key for key in sorted(given) if key in misplaced]
    if wrong:
        why = "TCP has no serial line" if not link.serial else "the framing of a line is its first word, rtu or ascii"
        message = f"{link}: `{wrong[0]}` cannot stand here: {why}"
        raise TargetError(message)
    return replace(link, **{key: _setting(key, value) for key, value in given.items()})


def _tcp(text: str, place: str) -> LinkName:
    if place.count(":") > 1 and "[" not in place and re.fullmatch(r"[0-9A-Fa-f:.%]+", place):
        message = f"{text}: write an IPv6 address in brackets, for example tcp:[{place}]:{MODBUS_TCP_PORT}"
        raise TargetError(message)
    found = re.fullmatch(r"(?:\[([0-9A-Fa-f:.%]+)\]|([^:/\[\]\s]+))(?::([0-9]{1,5}))?", place)
    if not found or not 0 < int(found[3] or MODBUS_TCP_PORT) <= LAST_PORT:
        message = f"{text}: write tcp:HOST or tcp:HOST:PORT with a port from 1 to 65535, for example tcp:10.0.0.7:502"
        raise TargetError(message)
    return LinkName(host=found[1] or found[2], port=int(found[3] or MODBUS_TCP_PORT))


def _setting(key: str, value: str) -> Any:  # noqa: ANN401 - each field has a type of its own
    if key in _WHOLE:
        allowed, said = _WHOLE[key]
        if not re.fullmatch(r"[0-9]{1,9}", value) or int(value) not in allowed:
            message = f"{key}={value}: `{key}` is {said}"
            raise TargetError(message)
        return int(value)
    if key in _WORDS:
        word = value.upper() if key == "parity" else value
        if word not in _WORDS[key]:
            message = f"{key}={word}: `{key}` is {', '.join(_WORDS[key])}"
            raise TargetError(message)
        return word
    return _seconds(value)


def _seconds(value: str) -> float:
    try:
        seconds = float(value)
    except ValueError:
        seconds = 0.0
    if not 0 < seconds <= LONGEST_TIMEOUT:
        message = f"timeout={value}: a timeout is a number of seconds up to {LONGEST_TIMEOUT:g}, for example 1.5"
        raise TargetError(message)
    return seconds
