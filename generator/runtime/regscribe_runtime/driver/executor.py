"""The two executors: they send the requests of an operation over a link, and raise the link's errors inside it."""

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
    """Run an operation to its end; errors of the link are raised inside it, so that it may handle them.

    `session` gives requests their response timeouts; without one the link's own apply.
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
                    reply = link.call(asked.unit or (session.unit if session else unit), _timed(asked, session, link))
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
                    reply = await link.call(
                        asked.unit or (session.unit if session else unit), _timed(asked, session, link)
                    )
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
    """End an operation that failed, was cancelled or interrupted; a report of what is half done goes to the error."""
    before = session.broken_off if session else None
    operation.close()
    if session is None:
        return
    if isinstance(error, NoAnswer):
        session.doubt()
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
    if not session.unit:
        asked = asked._replace(answered=True)
    return asked if asked.seconds or link.timeout else session.timed(asked)


def run(task: Task[T], session: Session, link: Link) -> T:
    """Run an operation of a device; others of its unit wait.

    If the link was reopened during an operation that only read, it is run once more: the device may be another one.
    """
    with link.lock.of(session.unit):
        session.begin(link)
        value = carry_out(task(session), link, session.unit, session)
        if session.wrote or session.epoch == link.epoch:
            return value
        session.begin(link)
        return carry_out(task(session), link, session.unit, session)


async def run_async(task: Task[T], session: Session, link: AsyncLink) -> T:
    """As `run`, for asyncio."""
    async with link.lock.of(session.unit):
        session.begin(link)
        value = await carry_out_async(task(session), link, session.unit, session)
        if session.wrote or session.epoch == link.epoch:
            return value
        session.begin(link)
        return await carry_out_async(task(session), link, session.unit, session)
