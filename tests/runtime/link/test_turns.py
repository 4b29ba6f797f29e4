"""Turns are fair: first come, first served, and nobody is left out or left waiting."""

import threading
import time

import pytest

from regscribe_runtime.link.locks import FairLock


def waiting(lock: FairLock, many: int) -> None:
    while len(lock._queue) < many:
        time.sleep(0.001)


def test_threads_get_the_lock_in_the_order_in_which_they_ask() -> None:
    lock, order, threads = FairLock(), list[int](), list[threading.Thread]()

    def take(number: int) -> None:
        with lock:
            order.append(number)

    with lock:
        for number in range(6):
            threads.append(threading.Thread(target=take, args=(number,)))
            threads[-1].start()
            waiting(lock, number + 2)
    for thread in threads:
        thread.join()
    assert order == list(range(6))


def test_who_holds_the_lock_may_take_it_again() -> None:
    lock = FairLock()
    with lock, lock:
        assert lock._depth == 2
    assert not lock._queue


def test_a_thread_that_takes_it_again_and_again_does_not_keep_others_out() -> None:
    lock, got = FairLock(), threading.Event()

    def take_once() -> None:
        with lock:
            got.set()

    thread = threading.Thread(target=take_once)
    thread.start()
    for _ in range(10_000):
        with lock:
            pass
        if got.is_set():
            break
    assert got.is_set()
    thread.join()


def test_only_one_thread_at_a_time_is_inside() -> None:
    lock, inside, most = FairLock(), [0], [0]

    def work() -> None:
        for _ in range(300):
            with lock:
                inside[0] += 1
                most[0] = max(most[0], inside[0])
                time.sleep(0)
                inside[0] -= 1

    threads = [threading.Thread(target=work) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert (most[0], len(lock._queue)) == (1, 0)


def test_who_gives_up_waiting_leaves_the_queue_and_holds_up_nobody(monkeypatch: pytest.MonkeyPatch) -> None:
    lock, came = FairLock(), threading.Event()

    class Interrupted:
        """A lock whose second acquire is broken off, as by Ctrl-C."""

        def __init__(self) -> None:
            self.times = 0

        def acquire(self) -> None:
            self.times += 1
            if self.times == 2:
                raise KeyboardInterrupt

        def release(self) -> None:
            pass

    def give_up() -> None:
        with monkeypatch.context() as patched:
            patched.setattr("regscribe_runtime.link.locks.threading.Lock", Interrupted)
            with pytest.raises(KeyboardInterrupt):
                lock.__enter__()
        came.set()

    with lock:
        thread = threading.Thread(target=give_up)
        thread.start()
        assert came.wait(5)
        thread.join()
        assert len(lock._queue) == 1
    with lock:
        pass
