from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from fruitgui.sensors.kinect.clock import FRAME_TICKS
from fruitgui.sensors.kinect.packets import PacketLog, Stream
from fruitgui.sensors.kinect.pairing import ColorPicture, DepthPicture, Pair, Pairing

RAW, COLOR = np.zeros((1, 1), np.uint16), np.zeros((1, 1, 3), np.uint8)


def depth(ticks: int, whole: bool = True) -> DepthPicture:
    return DepthPicture(ticks, 0.0, RAW, whole)


def color(ticks: int, whole: bool = True) -> ColorPicture:
    return ColorPicture(ticks, COLOR, whole)


def stamps(pairs: list[Pair]) -> list[tuple[int, int]]:
    return [(pair.depth.ticks, pair.color.ticks) for pair in pairs]


@given(st.lists(st.tuples(st.booleans(), st.booleans()), min_size=3, max_size=40), st.integers(-400_000, 400_000))
def test_pictures_of_one_moment_find_each_other_whichever_comes_first(
    order: list[tuple[bool, bool]], apart: int
) -> None:
    pairing = Pairing()
    pairs = []
    for count, (depth_first, _) in enumerate(order):
        at = count * FRAME_TICKS
        adds = [lambda at=at: pairing.add_depth(depth(at)), lambda at=at: pairing.add_color(color(at + apart))]
        for add in adds if depth_first else reversed(adds):
            pairs += add()
    found = stamps(pairs)
    assert all(two == one + apart for one, two in found)
    assert len(found) >= len(order) - 1
    assert pairing.alone == 0


def test_a_picture_without_a_partner_is_let_go() -> None:
    pairing = Pairing()
    assert pairing.add_depth(depth(0)) == []
    assert stamps(pairing.add_color(color(FRAME_TICKS))) == []
    assert pairing.alone == 1
    assert stamps(pairing.add_depth(depth(FRAME_TICKS + 5))) == [(FRAME_TICKS + 5, FRAME_TICKS)]


def test_colour_alone_waits_for_nobody_and_holds_nothing_up() -> None:
    pairing = Pairing()
    for count in range(100):
        assert pairing.add_color(color(count * FRAME_TICKS)) == []
    assert stamps(pairing.add_depth(depth(99 * FRAME_TICKS))) == [(99 * FRAME_TICKS, 99 * FRAME_TICKS)]


def test_depth_alone_is_counted() -> None:
    pairing = Pairing()
    for count in range(10):
        assert pairing.add_depth(depth(count * FRAME_TICKS)) == []
    assert pairing.alone == 7


def test_a_pair_is_whole_where_both_are() -> None:
    assert Pair(depth(0), color(0)).whole
    assert not Pair(depth(0, whole=False), color(0)).whole
    assert not Pair(depth(0), color(0, whole=False)).whole


def test_the_log_says_which_pictures_are_whole() -> None:
    log = PacketLog()
    log.hear(6, "Got depth frame of size 422400/422400, 242/242 packets arrived, TS 0000c350")
    assert log.is_whole(Stream.DEPTH)
    log.hear(6, "Got video frame of size 307200/307200, 160/162 packets arrived, TS 0000c350")
    assert log.is_whole(Stream.DEPTH)
    assert not log.is_whole(Stream.VIDEO)
    log.hear(2, "[Stream 70] Expected 1748 data bytes, but got 868")
    log.hear(6, "Got depth frame of size 422400/422400, 242/242 packets arrived, TS 0000c350")
    assert not log.is_whole(Stream.DEPTH)
    log.hear(6, "Got depth frame of size 422400/422400, 242/242 packets arrived, TS 0000c350")
    assert log.is_whole(Stream.DEPTH)


def test_the_log_says_what_went_wrong() -> None:
    log = PacketLog()
    log.hear(1, "send_cmd: Output control transfer failed (-9)")
    assert log.not_done()
    assert not log.gone
    log.forget()
    assert not log.not_done()
    log.hear(2, "Failed to submit isochronous transfer 3: -1")
    assert log.no_room
    log.hear(1, "USB camera marked dead, stopping streams")
    assert log.gone
    for _ in range(1000):
        log.hear(1, "again and again")
    assert len(log.errors) < 20
