import string
from contextlib import suppress

import pytest
from hypothesis import given
from hypothesis import strategies as st

from regscribe.tools.live import link_names
from regscribe.tools.live.errors import TargetError
from regscribe.tools.live.link_names import LinkName
from regscribe_runtime.values.serial_line import ADDRESSINGS, FRAMINGS

hosts = st.one_of(st.text(string.ascii_lowercase + string.digits + ".-", min_size=1), st.just("::1"))
seconds = st.none() | st.integers(1, 60).map(float)
addressings = st.sampled_from(list(ADDRESSINGS))
tcp = st.builds(
    LinkName,
    host=hosts,
    port=st.integers(1, 65535),
    framing=st.sampled_from(FRAMINGS),
    addressing=addressings,
    timeout=seconds,
)
serial = st.builds(
    LinkName,
    device=st.text(string.ascii_letters + string.digits + "/:._-", min_size=1),
    framing=st.sampled_from(["rtu", "ascii"]),
    baud=st.none() | st.integers(50, 10_000_000),
    data_bits=st.sampled_from([None, 7, 8]),
    parity=st.sampled_from(["", "N", "E", "O"]),
    stop_bits=st.sampled_from([None, 1, 2]),
    addressing=addressings,
    timeout=seconds,
)


@given(tcp | serial)
def test_the_text_of_a_link_names_the_same_link(link: LinkName) -> None:
    assert link_names.split(str(link)) == (link, {})


@given(st.sampled_from(["", "tcp:", "rtu:", "ascii:", "tcp:h?", "rtu:/dev/x?"]), st.text())
def test_any_text_is_a_link_or_refused(start: str, text: str) -> None:
    with suppress(TargetError):
        link_names.split(start + text)


def test_a_line_has_its_settings_behind_a_question_mark() -> None:
    link, _ = link_names.split("rtu:/dev/ttyUSB0?baud=19200&parity=e&stop_bits=2&timeout=0.5")
    assert link.settings() == {"baud": 19200, "parity": "E", "stop_bits": 2, "framing": "rtu", "addressing": "modbus"}
    assert (link.device, link.timeout) == ("/dev/ttyUSB0", 0.5)


def test_tcp_carries_the_frames_of_a_line_where_its_name_says_so() -> None:
    link, _ = link_names.split("tcp:[::1]:1502?framing=rtu&addressing=jbus")
    assert (link.host, link.port, link.settings()["framing"], link.addressing) == ("::1", 1502, "rtu", "jbus")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("tpc:10.0.0.7", "did you mean `tcp`?"),
        ("tcp:", "write tcp:HOST"),
        ("tcp:::1", "in brackets, for example tcp:[::1]:502"),
        ("tcp:host:0", "port from 1 to 65535"),
        ("tcp:host:99999", "port from 1 to 65535"),
        ("rtu:", "name the serial device"),
        ("rtu:/dev/x?baud=fast", "`baud` is 50 to"),
        ("rtu:/dev/x?parity=X", "`parity` is N, E, O"),
        ("rtu:/dev/x?data_bits=9", "7 or 8"),
        ("rtu:/dev/x?framing=tcp", "the framing of a line is its first word"),
        ("tcp:host?baud=9600", "TCP has no serial line"),
        ("tcp:host?timeout=0", "a number of seconds"),
        ("tcp:host?timeout=nan", "a number of seconds"),
        ("tcp:host?timeout=1&timeout=2", "each key once"),
        ("tcp:host?timeout", "key=value"),
    ],
)
def test_a_link_that_is_none_says_what_to_write(text: str, said: str) -> None:
    with pytest.raises(TargetError) as caught:
        link_names.split(text)
    assert said in str(caught.value)
