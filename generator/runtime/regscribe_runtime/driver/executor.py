"""The two executors: they carry the requests of an operation over a link, and tell it of errors there."""

import asyncio
import time
from typing import TypeVar, cast

from regscribe_runtime.errors import NoAnswer, RegscribeError
from regscribe_runtime.link.links import AsyncLink, Link
from regscribe_runtime.operations.session import Operation, Pause, Session, Task
from regscribe_runtime.values.serial_line import LineChange
from regscribe_runtime.wire.requests import Request

T = TypeVar("T")


def carry_out(operation: Operation[T], link: Link, unit: int, session: Session | None = None) -> T:
    """Run an operation to its end; errors of the link are raised inside it first, so that it may act on them.

    `session` gives its requests their response timeouts; without one they are left to the link.
    """
    try:
        asked = next(operation)
        while True:
            try:
                reply = None
                if isinstance(asked, Pause):
                    time.sleep(asked.seconds)
                elif isinstance(asked, LineChange):
                    _retune(asked, session, link)
                else:
                    reply = link.call(session.unit if session else unit, _timed(asked, session, link))
            except RegscribeError as error:
                asked = operation.throw(error)
            else:
                asked = operation.send(reply)
    except StopIteration as done:
        return cast("T", done.value)
    except BaseException as error:
        _break_off(operation, error, session, link)
        raise


async def carry_out_async(operation: Operation[T], link: AsyncLink, unit: int, session: Session | None = None) -> T:
    """As `carry_out`, for asyncio."""
    try:
        asked = next(operation)
        while True:
            try:
                reply = None
                if isinstance(asked, Pause):
                    await asyncio.sleep(asked.seconds)
                elif isinstance(asked, LineChange):
                    _retune(asked, session, link)
                else:
                    reply = await link.call(session.unit if session else unit, _timed(asked, session, link))
            except RegscribeError as error:
                asked = operation.throw(error)
            else:
                asked = operation.send(reply)
    except StopIteration as done:
        return cast("T", done.value)
    except BaseException as error:
        _break_off(operation, error, session, link)
        raise


def _break_off(operation: Operation[T], error: BaseException, session: Session | None, link: Link | AsyncLink) -> None:
    """End an operation that failed, is cancelled or interrupted; what it leaves half done is noted at the error."""
    if session is None:
        operation.close()
        return
    before = session.broken_off
    operation.close()
    if session.home is not None:
        _retune(session.home, session, link)
    if session.broken_off is not None and session.broken_off is not before:
        error.add_note(f"configure was broken off in the middle: {session.broken_off.told}")


def _retune(change: LineChange, session: Session | None, link: Link | AsyncLink) -> None:
    link.retune(change)
    if session is not None:
        session.retuned(change, line=link.line, addressing=link.addressing)


def _timed(asked: Request, session: Session | None, link: Link | AsyncLink) -> Request:
    if session is None:
        return asked
    if not asked.reads:
        session.wrote = True
    return asked if asked.seconds or link.timeout else session.timed(asked)


def run(task: Task[T], session: Session, link: Link) -> T:
    """Carry out the operation of a device, alone among those of its unit.

    If the link was opened anew under an operation that only read, the device may be another one: it is run once more.
    """
    with link.lock.of(session.unit):
        value = _once(task, session, link)
        return value if session.wrote or session.epoch == link.epoch else _once(task, session, link)


def _once(task: Task[T], session: Session, link: Link) -> T:
    session.begin(link)
    try:
        return carry_out(task(session), link, session.unit, session)
    except NoAnswer:
        session.doubt()
        raise


async def run_async(task: Task[T], session: Session, link: AsyncLink) -> T:
    """As `run`, for asyncio."""
    async with link.lock.of(session.unit):
        value = await _once_async(task, session, link)
        return value if session.wrote or session.epoch == link.epoch else await _once_async(task, session, link)


async def _once_async(task: Task[T], session: Session, link: AsyncLink) -> T:
    session.begin(link)
    try:
        return await carry_out_async(task(session), link, session.unit, session)
    except NoAnswer:
        session.doubt()
        raise
