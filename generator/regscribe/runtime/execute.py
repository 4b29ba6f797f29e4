"""The two executors: they carry the requests of an operation over a link, and tell it of errors there."""

import asyncio
import time
from typing import TypeVar, cast

from regscribe.runtime.errors import RegscribeError
from regscribe.runtime.link import AsyncLink, Link
from regscribe.runtime.session import Operation, Pause

T = TypeVar("T")


def carry_out(operation: Operation[T], link: Link, unit: int) -> T:
    """Run an operation to its end; errors of the link are raised inside it first, so that it may act on them."""
    try:
        asked = next(operation)
        while True:
            try:
                reply = None
                if isinstance(asked, Pause):
                    time.sleep(asked.seconds)
                else:
                    reply = link.call(unit, asked)
            except RegscribeError as error:
                asked = operation.throw(error)
            else:
                asked = operation.send(reply)
    except StopIteration as done:
        return cast("T", done.value)


async def carry_out_async(operation: Operation[T], link: AsyncLink, unit: int) -> T:
    """As `carry_out`, for asyncio."""
    try:
        asked = next(operation)
        while True:
            try:
                reply = None
                if isinstance(asked, Pause):
                    await asyncio.sleep(asked.seconds)
                else:
                    reply = await link.call(unit, asked)
            except RegscribeError as error:
                asked = operation.throw(error)
            else:
                asked = operation.send(reply)
    except StopIteration as done:
        return cast("T", done.value)
