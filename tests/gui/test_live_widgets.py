from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QRectF, QSizeF, Qt
from PySide6.QtGui import QColor, QPainter
from pytestqt.qtbot import QtBot

from fruitgui.gui.drawn import BeltMap, DrawnFruit, DrawnPicture, KindLine, LastFruit, MappedFruit
from fruitgui.gui.steps.live.belt_map import BeltView
from fruitgui.gui.steps.live.belt_tags import tag_places
from fruitgui.gui.steps.live.counts import LEAST, TOTAL, CountsView, places_for
from fruitgui.gui.steps.live.last_fruit import LastFruitView
from fruitgui.gui.steps.live.layout import LiveLayout, Pictures, columns_for
from fruitgui.gui.steps.live.presenter import stale_words
from fruitgui.gui.steps.live.standing import StandingBand
from fruitgui.gui.theme.kinds import kind_marks
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.widgets import fitting
from fruitgui.gui.widgets.sensor_picture import WORDS_FROM, Overlays, SensorPicture
from fruitgui.sensors.feed import Running, SensorHealth
from fruitgui.station.live.state import Spread

MARKS = kind_marks(["lemon", "red apple"])
GREY = np.full((480, 640, 3), 90, np.uint8)


def _fruit() -> DrawnFruit:
    outline = np.array([[280, 200], [360, 200], [360, 280], [280, 280]], dtype=np.float32)
    ellipse = Spread(320.0, 240.0, 12.0, 6.0, 0.0)
    return DrawnFruit(7, MARKS["lemon"], outline, ("lemon 98 %", "112 ± 4 ml"), ellipse, np.zeros((0, 2), np.float32))


def _count_of(widget: SensorPicture, colour: str) -> int:
    image = widget.grab().toImage()
    wanted = QColor(colour).rgb()
    return sum(image.pixel(x, y) == wanted for x in range(image.width()) for y in range(image.height()))


def test_outlines_are_where_the_fruit_is_and_can_be_left_out(qtbot: QtBot, theme: Theme) -> None:
    view = SensorPicture("kinect_1", theme)
    qtbot.addWidget(view)
    view.resize(640, 480)
    view.show_picture(DrawnPicture("kinect_1", GREY, (_fruit(),), "good", "10.0/s"))
    view.show_overlays(Overlays(labels=False, ellipses=False))
    image = view.grab().toImage()
    ratio = image.width() / 640
    assert image.pixelColor(QPoint(round(320 * ratio), round(200 * ratio))) == QColor(MARKS["lemon"].colour)
    assert image.pixelColor(QPoint(round(320 * ratio), round(240 * ratio))) == QColor(90, 90, 90)
    view.show_overlays(Overlays(outlines=False, labels=False, ellipses=False, trails=False))
    assert _count_of(view, MARKS["lemon"].colour) == 0


def test_a_picture_that_is_not_of_now_is_grey_veiled_and_shows_no_fruit(qtbot: QtBot, theme: Theme) -> None:
    view = SensorPicture("kinect_1", theme)
    qtbot.addWidget(view)
    view.resize(640, 480)
    red = np.full((480, 640, 3), (220, 40, 40), np.uint8)
    view.show_picture(DrawnPicture("kinect_1", red, (_fruit(),), "good", ""))
    assert view.grab().toImage().pixelColor(100, 400) == QColor(220, 40, 40)
    view.show_picture(DrawnPicture("kinect_1", red, (_fruit(),), "bad", "silent", "no picture for 12 s"))
    seen = view.grab().toImage().pixelColor(100, 400)
    assert seen.hslSaturationF() < 0.15
    assert seen.lightness() < 80
    assert _count_of(view, MARKS["lemon"].colour) == 0
    assert view.accessibleDescription() == "no picture for 12 s"
    view.show_picture(DrawnPicture("kinect_1", red, (), "good", ""))
    assert view.grab().toImage().pixelColor(100, 400) == QColor(220, 40, 40), "it is back"


@pytest.mark.parametrize(
    ("health", "words"),
    [
        (SensorHealth("kinect_1", Running.RUNNING, age_s=0.1), ""),
        (SensorHealth("kinect_1", Running.STARTING), ""),
        (SensorHealth("kinect_1", Running.SILENT, age_s=12.4), "no picture for 12\u2009s"),
        (SensorHealth("kinect_1", Running.RUNNING, age_s=8.0, hangs=True), "no picture for 8\u2009s"),
        (SensorHealth("kinect_1", Running.FAILED, age_s=200.0), "no picture for 3\u2009min"),
        (SensorHealth("kinect_1", Running.FAILED), "no picture yet"),
        (SensorHealth("kinect_1", Running.ENDED, age_s=9.0), "the last picture of the recording"),
    ],
)
def test_a_sensor_that_gives_nothing_says_since_when(health: SensorHealth, words: str) -> None:
    assert stale_words(health) == words


def test_a_picture_keeps_its_shape_whatever_room_it_has(qtbot: QtBot, theme: Theme) -> None:
    view = SensorPicture("kinect_1", theme)
    qtbot.addWidget(view)
    view.resize(900, 480)
    view.show_picture(DrawnPicture("kinect_1", GREY, (), "good", ""))
    image = view.grab().toImage()
    assert image.pixelColor(40, 240) == theme.colour("picture")
    assert image.pixelColor(450, 240) == QColor(90, 90, 90)


def test_a_picture_does_not_outlive_or_change_with_its_array(qtbot: QtBot, theme: Theme) -> None:
    view = SensorPicture("kinect_1", theme)
    qtbot.addWidget(view)
    view.resize(640, 480)
    frame = GREY.copy()
    view.show_picture(DrawnPicture("kinect_1", frame, (), "good", ""))
    frame[:] = 255
    assert view.grab().toImage().pixelColor(320, 240) == QColor(90, 90, 90)


@pytest.mark.parametrize("key", [Qt.Key.Key_Return, Qt.Key.Key_Space])
def test_one_picture_is_made_large_and_small_again(qtbot: QtBot, theme: Theme, key: Qt.Key) -> None:
    pictures = Pictures(theme)
    qtbot.addWidget(pictures)
    pictures.show_sensors(["kinect_1", "kinect_2", "kinect_3"])
    pictures.show()
    qtbot.keyClick(pictures.pictures["kinect_2"], key)
    assert [name for name, one in pictures.pictures.items() if one.isVisible()] == ["kinect_2"]
    qtbot.mouseClick(pictures.pictures["kinect_2"], Qt.MouseButton.LeftButton)
    assert all(one.isVisible() for one in pictures.pictures.values())


@pytest.mark.parametrize(("sensors", "columns"), [(1, 1), (2, 2), (3, 2), (4, 2), (5, 3), (8, 3)])
def test_pictures_arrange_themselves(sensors: int, columns: int) -> None:
    assert columns_for(sensors) == columns


def _line(kind: str, count: int) -> KindLine:
    return KindLine(MARKS[kind], kind, count, 110.0, 2.0, 8.0, 0.11 * count, None, 31)


def test_counts_say_what_they_show_to_a_screen_reader(qtbot: QtBot, theme: Theme) -> None:
    view = CountsView(theme)
    qtbot.addWidget(view)
    view.show_lines([_line("lemon", 1248), _line("red apple", 417)])
    assert view.accessibleDescription() == "lemon: 1248; red apple: 417"


def test_counts_are_high_enough_for_two_metres(qtbot: QtBot, theme: Theme) -> None:
    """Six rows in the room that they have in a window of 1280×720: figures of 40 pixels have capitals of 29."""
    view = CountsView(theme)
    qtbot.addWidget(view)
    view.resize(360, 380)
    view.show_lines([_line("lemon", 8)] * 6)
    image = view.grab().toImage()
    ink = theme.colour("text")
    top = TOTAL
    rows = [y for y in range(top, top + 56) if any(image.pixelColor(x, y) == ink for x in range(325, 360))]
    assert rows[-1] - rows[0] + 1 >= 29


@pytest.mark.parametrize(("width", "height"), [(360, 380), (360, 308), (600, 640), (1350, 1480), (300, 200)])
@pytest.mark.parametrize("rows", [0, 1, 6, 8, 12])
def test_all_kinds_are_in_view(rows: int, width: int, height: int) -> None:
    places = places_for(rows, width, height)
    corners = [places.place(number, rows) for number in range(rows)]
    assert len({one.toTuple() for one in corners}) == rows
    for corner in corners:
        assert corner.x() + places.width <= width + 1e-6
        assert places.top <= corner.y() <= height - places.height + 1e-6
    assert places.columns == 1 or (height - places.top) / rows < LEAST, "in two columns only where there is no room"


def _ink_height(view: CountsView, row: int, rows: int) -> int:
    """Return how high the figure at the right of a row is, pixels."""
    places, image = places_for(rows, view.width(), view.height()), view.grab().toImage()
    ink, top = view._theme.colour("text"), round(places.place(row, rows).y())
    columns = range(round(places.width) - 40, round(places.width))
    lines = [y for y in range(top, round(top + places.height)) if any(image.pixelColor(x, y) == ink for x in columns)]
    return lines[-1] - lines[0] + 1


def test_counts_grow_with_the_room_that_there_is(qtbot: QtBot, theme: Theme) -> None:
    view = CountsView(theme)
    qtbot.addWidget(view)
    view.show_lines([_line("lemon", 8)] * 6)
    view.resize(600, 640)
    usual = _ink_height(view, 5, 6)
    view.resize(1350, 1480)
    assert _ink_height(view, 5, 6) > 1.5 * usual
    assert _ink_height(view, 5, 6) > 64


def test_counts_of_ten_kinds_are_read_from_two_metres_in_the_least_window(qtbot: QtBot, theme: Theme) -> None:
    """Ten kinds and what is unknown, in the room that the live screen has in a window of 1280×720."""
    body = LiveLayout(theme)
    qtbot.addWidget(body)
    body.resize(1040, 554)
    body.show()
    body.show_counts([_line("lemon", 8)] * 6)
    assert body.histogram.isVisible()
    body.show_counts([_line("lemon", 8)] * 9)
    assert not body.histogram.isVisible()
    assert body.no_histogram.isVisible()
    assert body.counts.toolTip() == ""
    body.show_counts([_line("lemon", 8)] * 11)
    qtbot.waitUntil(lambda: body.counts.height() >= body.counts.far_height)
    assert not body.histogram.isVisible(), "it gives way"
    assert "step 7" in body.counts.toolTip(), "and that is said where it takes no room"
    assert _ink_height(body.counts, 10, 11) >= 29, "as high as the digits of six kinds"
    body.resize(1680, 914)
    qtbot.waitUntil(lambda: body.histogram.isVisible() and body.counts.height() >= body.counts.far_height)


def test_eight_rows_are_drawn_in_the_least_room(qtbot: QtBot, theme: Theme) -> None:
    """A window of 1280×720 with seven kinds and the band that says that nothing is counted."""
    view = CountsView(theme)
    qtbot.addWidget(view)
    view.resize(360, 308)
    view.show_lines([_line("lemon", 8)] * 8)
    assert _ink_height(view, 7, 8) >= 14


@pytest.mark.parametrize(("width", "height"), [(360, 64), (600, 72), (1350, 144)])
def test_the_band_over_the_counts_grows_with_them(qtbot: QtBot, theme: Theme, width: int, height: int) -> None:
    band = StandingBand(theme)
    qtbot.addWidget(band)
    assert band.isHidden(), "it takes no room before there is something to say"
    band.resize(width, 64)
    band.show_words("Nothing is counted", "Lot 1184 is paused.")
    assert band.height() == height
    image = band.grab().toImage()
    assert image.pixelColor(width // 2, 3) == theme.colour("warn")
    band.show_words("", "")
    assert band.isHidden()


def test_the_belt_is_drawn_with_what_is_on_it(qtbot: QtBot, theme: Theme) -> None:
    view = BeltView(theme)
    qtbot.addWidget(view)
    view.resize(600, 200)
    corners = np.array([[0.0, 0.0], [1.2, 0.0], [1.2, 0.4], [0.0, 0.4]])
    fruit = MappedFruit(3, MARKS["red apple"], 0.04, Spread(0.3, 0.2, 1e-3, 1e-3, 0.0), np.zeros((0, 2)))
    view.show_map(BeltMap({"kinect_1": corners}, frozenset(), (fruit,), 0.1))
    image = view.grab().toImage()
    scale = min(600 / (1.2 * 1.08), 200 / (0.4 * 1.08))
    x, y = 300 + (0.3 - 0.6) * scale, 100 - (0.2 - 0.2) * scale
    assert image.pixelColor(round(x + 0.3 * 0.04 * scale), round(y + 0.3 * 0.04 * scale)) == QColor(
        MARKS["red apple"].colour
    )


@pytest.mark.parametrize(("sensors", "size"), [(2, (600, 150)), (4, (600, 150)), (8, (600, 150)), (8, (1900, 500))])
def test_names_on_the_belt_hide_no_other_and_stand_on_the_edge_of_their_footprint(
    sensors: int, size: tuple[int, int]
) -> None:
    names = [f"kinect_{number}" for number in range(1, sensors + 1)]
    step, wide = 0.5 * size[0] / sensors, size[0] / sensors
    first = np.array([[0.0, 12.0], [wide, 6.0], [wide, size[1] - 6.0], [9.0, size[1] - 12.0]])
    edges = {name: first + np.array([number * step, 0.0]) for number, name in enumerate(names)}
    room, speed = QRectF(0, 0, *size), QRectF(0, 0, 90, 22)
    places = tag_places(edges, dict.fromkeys(names, QSizeF(66.0, 18.0)), room, [speed])
    boxes = [speed, *places.values()]
    assert all(room.contains(one) for one in boxes)
    assert not any(one.intersects(other) for n, one in enumerate(boxes) for other in boxes[:n])
    for name, box in places.items():
        assert box.left() <= edges[name][:, 0].max()
        assert box.right() >= edges[name][:, 0].min()
        assert box.top() < 44 or box.bottom() > size[1] - 44, "at an edge, not in the middle of the belt"


def test_the_newest_fruit_comes_first(qtbot: QtBot, theme: Theme) -> None:
    view = LastFruitView(theme)
    qtbot.addWidget(view)
    view.resize(700, 88)
    empty = view.grab().toImage()
    fruit = [LastFruit(n, n, MARKS["lemon"], "Lemon", 0.98, 112.0, 2.0, b"no picture") for n in (3, 2, 1)]
    view.show_fruit(fruit)
    assert view.grab().toImage() != empty


def test_a_large_picture_has_all_the_room_beside_the_counts(qtbot: QtBot, theme: Theme) -> None:
    body = LiveLayout(theme)
    qtbot.addWidget(body)
    body.pictures.show_sensors(["kinect_1", "kinect_2"])
    body.resize(1040, 554)
    body.show()
    picture = body.pictures.pictures["kinect_1"]
    before = picture.width()
    body.pictures.toggle("kinect_1")
    qtbot.waitUntil(lambda: picture.width() > before and picture.height() == body.height())
    assert not body.belt.isVisible()
    assert body.counts.isVisible()
    assert min(picture.width() / 640, picture.height() / 480) >= WORDS_FROM, "its labels have words"
    body.pictures.toggle("kinect_1")
    qtbot.waitUntil(lambda: picture.width() == before and body.belt.isVisible() and body.last.isVisible())


@pytest.mark.parametrize("width", [300, 360, 394])
def test_the_name_of_a_single_kind_is_whole(
    qtbot: QtBot, theme: Theme, monkeypatch: pytest.MonkeyPatch, width: int
) -> None:
    drawn: list[str] = []
    whole = fitting.cut

    def cut(painter: QPainter, text: str, room: float) -> str:
        drawn.append(whole(painter, text, room))
        return drawn[-1]

    monkeypatch.setattr(fitting, "cut", cut)
    view = CountsView(theme)
    qtbot.addWidget(view)
    view.resize(width, 400)
    unknown = kind_marks([])["unknown"]
    view.show_lines([KindLine(unknown, "Desconocida", 0, None, None, 0.0, 0.0, None, 0)])
    view.grab()
    assert drawn == ["Desconocida"]
