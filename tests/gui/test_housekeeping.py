from __future__ import annotations

from pytestqt.qtbot import QtBot

from fruitgui.gui.housekeeping import Housekeeping
from fruitgui.gui.session import Session
from fruitgui.records.crops import DAY_S
from fruitgui.station.sink import Crop


def _keep(session: Session, key: int, age_days: float) -> None:
    """Keep a picture that is so many days old."""
    crops = session.store.crops
    real = crops._now_s
    crops._now_s = lambda: real() - age_days * DAY_S
    crops.keep("fruit", [(key, Crop(0, "colour", "kinect_1", 0.0, 0, 0, "jpeg", b"picture"))])
    crops._now_s = real


def test_pictures_go_when_they_are_older_than_the_settings_say(qtbot: QtBot, session: Session) -> None:
    session.save_settings(session.settings.model_copy(update={"crops_kept_days": 30}))
    _keep(session, 1, age_days=31.0)
    _keep(session, 2, age_days=29.0)
    keeping = Housekeeping(session)
    keeping.clear_up()
    qtbot.waitUntil(lambda: session.store.crops.of("fruit", 1) == ())
    qtbot.waitUntil(lambda: keeping._task is None)
    assert len(session.store.crops.of("fruit", 2)) == 1
    assert keeping.stop()


def test_pictures_that_are_kept_for_ever_stay(qtbot: QtBot, session: Session) -> None:
    session.save_settings(session.settings.model_copy(update={"crops_kept_days": 0}))
    _keep(session, 1, age_days=4000.0)
    keeping = Housekeeping(session)
    keeping.clear_up()
    qtbot.waitUntil(lambda: keeping._task is None)
    assert len(session.store.crops.of("fruit", 1)) == 1
    assert keeping.stop()
