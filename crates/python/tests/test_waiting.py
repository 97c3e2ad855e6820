"""Long work: progress, silence and Ctrl-C."""

from __future__ import annotations

import io
import os
import signal
import threading
import time

import palpate
import pytest
from palpate._palpate import _wait
from palpate.progress import Bar


def test_progress_is_told_as_it_goes() -> None:
    told: list[tuple[float, str]] = []
    _wait(0.3, lambda part, words: told.append((part, words)))
    parts = [part for part, _ in told]
    assert parts == sorted(parts) and told[0] == (0.0, "beginning") and told[-1] == (1.0, "waiting")
    assert {words for _, words in told} == {"beginning", "waiting"}


def test_the_shortest_work_tells_its_beginning_and_its_end() -> None:
    told: list[tuple[float, str]] = []
    _wait(0.0, lambda part, words: told.append((part, words)))
    assert [part for part, _ in (told[0], told[-1])] == [0.0, 1.0]


def test_ctrl_c_is_heard() -> None:
    """Judge: the clock; the interpreter is asked every 50 ms, and a slow machine may take ten times that."""
    threading.Timer(0.2, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        _wait(20.0, False)
    assert time.monotonic() - begin < 1.0


def test_what_a_callable_raises_comes_back() -> None:
    def refuses(part: float, words: str) -> None:
        if words == "waiting":
            raise LookupError(words)

    with pytest.raises(LookupError, match="waiting"):
        _wait(20.0, refuses)


def test_other_threads_go_on_meanwhile() -> None:
    """The interpreter is released: four waits of a second take less than one after another would."""
    begin = time.monotonic()
    threads = [threading.Thread(target=_wait, args=(1.0, False)) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert time.monotonic() - begin < 3.0


def test_nothing_is_printed_where_nobody_looks(capfd: pytest.CaptureFixture[str]) -> None:
    _wait(1.2)
    assert capfd.readouterr() == ("", "")


class Terminal(io.StringIO):
    """A stream that says it is a terminal."""

    def isatty(self) -> bool:
        return True


@pytest.mark.parametrize("has_tqdm", [True, False])
def test_a_terminal_shows_a_bar(has_tqdm: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    if not has_tqdm:
        monkeypatch.setattr(Bar, "_tqdm", lambda self: None)
    stream = Terminal()
    bar = Bar(stream)
    bar(0.5, "half of it")
    assert "50 %" in stream.getvalue() and "half of it" in stream.getvalue()
    bar.close()
    assert stream.getvalue().endswith("\r")


def test_a_file_shows_none() -> None:
    stream = io.StringIO()
    bar = Bar(stream)
    bar(0.5, "half of it")
    bar.close()
    assert stream.getvalue() == ""


def test_errors_are_what_python_expects() -> None:
    assert issubclass(palpate.InputError, palpate.PalpateError)
    assert issubclass(palpate.InputError, ValueError)
