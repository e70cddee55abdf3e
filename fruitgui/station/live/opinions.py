"""What fruit in view seem to be so far, at a bounded cost."""

from __future__ import annotations

from collections.abc import Iterable
from concurrent.futures import Future
from typing import Any

from fruitgui.errors import FruitguiError
from fruitgui.station.judging import Judgement
from fruitgui.station.live.bench import Bench
from fruitgui.station.live.helper import Weigh
from fruitgui.station.live.state import Opinion
from fruitgui.tracking.tracker import LiveTrack, Tracker

LEAST_VIEWS = 4
"""Whole views from which on a first opinion means something."""

AGAIN = 2.5
"""An opinion is formed anew when there are so many times as many views."""

EVERY_S = 0.1
COST_SHARE = 0.25
"""Opinions are formed at most this often, and take at most this share of the helper's time."""


class Opinions:
    """Has one track at a time measured by a helper that has nothing else to do.

    Without a helper there are no opinions: they would cost the line frames.
    """

    def __init__(self, bench: Bench) -> None:
        self._bench = bench
        self._formed: dict[int, Opinion] = {}
        self._asked: tuple[int, int, float, Future[Any]] | None = None
        self._next_s = 0.0

    def of(self, track: int) -> Opinion | None:
        """Return what is thought of a track."""
        return self._formed.get(track)

    def form(self, tracker: Tracker, live: Iterable[LiveTrack], now_s: float) -> None:
        """Take in what was asked for, and ask for the track that needs it most."""
        tracks = {one.track: one for one in live}
        for gone in self._formed.keys() - tracks.keys():
            del self._formed[gone]
        self._take(now_s, tracks.keys())
        if self._asked is None and now_s >= self._next_s and self._bench.idle:
            self._ask(tracker, tracks.values(), now_s)

    def _take(self, now_s: float, tracks: Iterable[int]) -> None:
        if self._asked is None or not self._asked[3].done():
            return
        track, views, asked_s, answer = self._asked
        self._asked = None
        self._next_s = max(asked_s + EVERY_S, now_s + (now_s - asked_s) * (1.0 / COST_SHARE - 1.0))
        try:
            judgement: Judgement = answer.result()
        except FruitguiError:
            return
        if track in tracks:
            vote = judgement.vote
            self._formed[track] = Opinion(vote.kind, vote.probability, judgement.volume_m3, views)

    def _ask(self, tracker: Tracker, tracks: Iterable[LiveTrack], now_s: float) -> None:
        due = max(filter(self._is_due, tracks), key=self._need, default=None)
        if due is None:
            return
        track = tracker.so_far(due.track)
        answer = None if track is None else self._bench.ask(Weigh(track), most=1)
        if answer is not None:
            self._asked = (due.track, due.views, now_s, answer)

    def _is_due(self, track: LiveTrack) -> bool:
        before = self._formed.get(track.track)
        return track.whole >= LEAST_VIEWS and (before is None or track.views >= AGAIN * before.views)

    def _need(self, track: LiveTrack) -> tuple[bool, int]:
        """Those without an opinion first, the newest of them first."""
        return track.track not in self._formed, track.track
