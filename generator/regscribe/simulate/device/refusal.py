"""How a device refuses a request: with an exception code, or by silence."""

from regscribe.model import SILENCE
from regscribe_runtime.wire.pdu import encode_reply
from regscribe_runtime.wire.requests import Reply


class Refusal(Exception):  # noqa: N818 -- the device refuses; nothing went wrong in the program
    """The device does not do what the request asks: `code` is its exception code, or `SILENCE`."""

    def __init__(self, code: int) -> None:
        super().__init__(f"exception code {code}" if code != SILENCE else "no answer")
        self.code = code

    def answer(self, function: int) -> bytes | None:
        """The exception answer to `function`; None where the device keeps silent."""
        return None if self.code == SILENCE else encode_reply(Reply(function, exception=self.code))
