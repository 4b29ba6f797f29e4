"""An answer that does not fit its request is never used."""

import pytest

from regscribe_runtime import ExceptionAnswer, PartialWrite, WrongAnswer
from regscribe_runtime.values.protocol import ExceptionCode, Protocol
from regscribe_runtime.wire.requests import Reply, Request, verify

READ = Request(3, 100, 2)
WRITE = Request(6, 100, 1, (7,))
WRITES = Request(16, 100, 3, (1, 2, 3))


def check(request: Request, reply: Reply) -> tuple[int, ...]:
    return verify(
        request, reply, unit=5, protocol=Protocol(exceptions=(ExceptionCode(2, "nowhere", "no such address"),))
    )


def test_the_words_of_a_fitting_answer_are_returned() -> None:
    assert check(READ, Reply(3, (1, 2))) == (1, 2)


@pytest.mark.parametrize(
    ("request_", "reply", "said"),
    [
        (READ, Reply(4, (1, 2)), "function 04"),
        (READ, Reply(3, (1,)), "1 values came where 2"),
        (READ, Reply(3, (1, 2, 3)), "3 values came where 2"),
        (WRITE, Reply(6, (7,), 101), "address 101"),
        (WRITE, Reply(6, (8,), 100), r"sent \[7\], the answer echoes \[8\]"),
        (WRITES, Reply(16, (), 99, 3), "address 99"),
        (WRITES, Reply(16, (), 100, 4), "4 values confirmed where 3"),
    ],
)
def test_an_answer_that_does_not_fit_says_what_is_wrong(request_: Request, reply: Reply, said: str) -> None:
    with pytest.raises(WrongAnswer, match=said):
        check(request_, reply)


def test_fewer_words_than_were_sent_name_the_first_one_not_written() -> None:
    with pytest.raises(PartialWrite, match="2 of 3 words") as caught:
        check(WRITES, Reply(16, (), 100, 2))
    assert caught.value.first_unwritten == 102


@pytest.mark.parametrize(("code", "said"), [(2, "nowhere: no such address"), (9, "exception 09")])
def test_an_exception_answer_has_the_meaning_that_the_manual_gives_it(code: int, said: str) -> None:
    with pytest.raises(ExceptionAnswer, match=said) as caught:
        check(READ, Reply(3, exception=code))
    assert (caught.value.unit, caught.value.function, caught.value.address) == (5, 3, 100)
