import io

import pytest

from regscribe.cli.shared.output import show


class Terminal(io.StringIO):
    """A stream that says it is a terminal."""

    def isatty(self) -> bool:
        return True


@pytest.fixture(autouse=True)
def _colourful(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("NO_COLOR", raising=False)
    monkeypatch.setenv("TERM", "xterm-256color")


def shown(stream: io.StringIO) -> str:
    show([("error", "bold red"), (": [red] is no markup\n", "")], stream=stream)
    return stream.getvalue()


def test_a_terminal_gets_colour_and_markup_of_a_map_is_text() -> None:
    assert "\x1b[1;31merror\x1b[0m: [red] is no markup\n" in shown(Terminal())


def test_a_pipe_gets_plain_text() -> None:
    assert shown(io.StringIO()) == "error: [red] is no markup\n"


@pytest.mark.parametrize(("name", "value"), [("NO_COLOR", "1"), ("TERM", "dumb")])
def test_a_terminal_whose_user_wants_no_colour_gets_plain_text(
    monkeypatch: pytest.MonkeyPatch, name: str, value: str
) -> None:
    monkeypatch.setenv(name, value)
    assert shown(Terminal()) == "error: [red] is no markup\n"
