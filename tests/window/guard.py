"""Catches calls that may take long on the window's thread: waits, the disk, the store."""

from __future__ import annotations

import os
import threading
import time
import traceback
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import pytest
from sqlalchemy import event
from sqlalchemy.engine import Engine

OURS = "/fruitgui/"


class Guard:
    """What was called on the window's thread that must not be.

    Attributes:
        caught: what was called, at which place in the program, and how often.
    """

    def __init__(self) -> None:
        self._window = threading.get_ident()
        self._looking = False
        self.caught: Counter[str] = Counter()

    @contextmanager
    def looking(self) -> Iterator[None]:
        """Look at what is called within."""
        self._looking = True
        try:
            yield
        finally:
            self._looking = False

    def look(self, what: str) -> None:
        """Note a call, if it is on the window's thread and comes from the program."""
        if not self._looking or threading.get_ident() != self._window:
            return
        stack = traceback.extract_stack()
        if any(one.filename == threading.__file__ and one.name == "start" for one in stack):
            return  # a thread that begins is waited for, no longer than it takes to be made
        ours = [one for one in stack if OURS in one.filename.replace(os.sep, "/") and "/tests/" not in one.filename]
        where = " < ".join(f"{one.name} {one.filename.split(OURS)[-1]}:{one.lineno}" for one in ours[:-8:-1])
        if where:
            self.caught[f"{what} in {where}"] += 1


@pytest.fixture
def guard(monkeypatch: pytest.MonkeyPatch) -> Iterator[Guard]:
    """Watch the thread of this test."""
    made = Guard()

    def watched(owner: Any, name: str) -> None:  # noqa: ANN401 - a module or a class
        real: Callable[..., Any] = getattr(owner, name)

        def call(*given: Any, **named: Any) -> Any:  # noqa: ANN401 - whatever it takes and gives
            made.look(name)
            return real(*given, **named)

        monkeypatch.setattr(owner, name, call)

    watched(time, "sleep")
    watched(os, "fsync")
    watched(threading.Thread, "join")
    watched(threading.Condition, "wait")

    def asked(*_: Any) -> None:  # noqa: ANN401 - SQLAlchemy's arguments
        made.look("the store")

    for name in ("before_cursor_execute", "commit"):
        event.listen(Engine, name, asked)
    yield made
    for name in ("before_cursor_execute", "commit"):
        event.remove(Engine, name, asked)
