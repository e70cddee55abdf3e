"""The few choices that a source has: which simulated rig; which file, and how it is played."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from PySide6.QtCore import QSize, Signal
from PySide6.QtWidgets import QFormLayout, QLabel, QPushButton, QWidget

from fruitgui.gui.steps.connect.made_list import MadeList
from fruitgui.gui.steps.connect.offers import (
    DEVICES,
    RECORDING,
    SIMULATED,
    Offer,
    as_simulated,
    device_lines,
    preset_name,
)
from fruitgui.gui.theme import icons
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID, TOUCH
from fruitgui.gui.widgets.cards import Card, label
from fruitgui.gui.widgets.choice_box import ChoiceBox
from fruitgui.gui.widgets.stepper import Stepper
from fruitgui.gui.widgets.tick_box import TickBox
from fruitgui.gui.widgets.worded import Worded
from fruitgui.station.recordings_made import MadeRecording
from fruitgui.station.sources import RecordedSource, Source

MOST_RIGS = 999
SPEEDS_M_S = (0.02, 0.6)


class SourceForm(Worded, Card):
    """Shows the choices of one offer; `source` is what they come to.

    Attributes:
        changed: `source` may be another.
        file_wanted: the person asks for a file.
    """

    changed = Signal()
    file_wanted = Signal()

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__("", parent)
        self._theme = theme
        self._offer: Offer | None = None
        self._path: Path | None = None
        self.preset = ChoiceBox()
        self.rig, self.speed = Stepper(theme), Stepper(theme, 2, "m/s")
        self.file, self.again = QPushButton(), TickBox()
        self.made = MadeList()
        self._what, self._file_name = label("", "dim"), label("", "strong")
        self._form = QFormLayout()
        self._labels = {part: QLabel() for part in ("preset", "rig", "speed")}
        self._lay_out()
        self._connect()
        self._say_words()

    @property
    def source(self) -> Source | None:
        """The source as chosen; None while something is missing."""
        if self._offer is None:
            return None
        if self._offer.key == RECORDING:
            return None if self._path is None else RecordedSource(self._path, looped=self.again.isChecked())
        if self._offer.key != SIMULATED:
            return self._offer.sources[0]
        preset = as_simulated(self.preset.currentData())
        if preset is None:
            return self.preset.currentData()  # type: ignore[no-any-return]  # a source of its own make
        options = replace(preset.options, rig_seed=int(self.rig.value), speed_m_s=round(self.speed.value, 3))
        return replace(preset, options=options)

    def show_offer(self, offer: Offer) -> None:
        """Show the choices of an offer."""
        self._offer = offer
        self._say_words()
        simulated, recorded = offer.key == SIMULATED, offer.key == RECORDING
        self._fill_presets()
        for part, field in (("preset", self.preset), ("rig", self.rig), ("speed", self.speed)):
            shown = simulated and (part == "preset" or as_simulated(self.preset.currentData()) is not None)
            self._form.setRowVisible(field, shown)
        for one in (self.file, self._file_name, self.again):
            one.setVisible(recorded)
        self._show_list()

    def take_file(self, path: Path) -> None:
        """Take a recording's file."""
        self._path = path
        self.made.choose_path(path)
        self._say_words()
        self.changed.emit()

    def show_made(self, made: Sequence[MadeRecording]) -> None:
        """List the recordings that were made here."""
        self.made.show_made(made)
        self._show_list()

    def _show_list(self) -> None:
        shown = self._offer is not None and self._offer.key == RECORDING and self.made.list.count() > 0
        self.made.setVisible(shown)
        self.body.setStretch(self.body.count() - 1, 0 if shown else 1)

    def _lay_out(self) -> None:
        self._what.setWordWrap(True)
        self._file_name.setWordWrap(True)
        self.rig.set_range(1, MOST_RIGS, 1)
        self.speed.set_range(*SPEEDS_M_S, 0.02)
        self.again.setChecked(True)
        self._form.setSpacing(2 * GRID)
        for part, field in (("preset", self.preset), ("rig", self.rig), ("speed", self.speed)):
            self._labels[part].setBuddy(field.box if isinstance(field, Stepper) else field)
            self._labels[part].setMinimumHeight(TOUCH)
            self._form.addRow(self._labels[part], field)
        self.body.setSpacing(2 * GRID)
        self.body.addWidget(self._what)
        self.body.addLayout(self._form)
        for one in (self.file, self._file_name, self.again):
            self.body.addWidget(one)
        self.body.addWidget(self.made, 1)
        self.body.addStretch()

    def _connect(self) -> None:
        self.file.clicked.connect(self.file_wanted)
        self.again.toggled.connect(self.changed)
        self.made.chosen.connect(self.take_file)
        self.preset.currentIndexChanged.connect(self._take_preset)
        self.rig.changed.connect(self.changed)
        self.speed.changed.connect(self.changed)
        self._theme.changed.connect(self._draw_icon)
        self._draw_icon()

    def _draw_icon(self) -> None:
        self.file.setIcon(icons.icon("folder", self._theme.colour("text")))
        self.file.setIconSize(QSize(20, 20))

    def _fill_presets(self) -> None:
        sources = () if self._offer is None or self._offer.key != SIMULATED else self._offer.sources
        at = max(self.preset.currentIndex(), 0)
        self.preset.blockSignals(True)
        self.preset.clear()
        for source in sources:
            self.preset.addItem(preset_name(source), source)
        if sources:
            self.preset.setCurrentIndex(min(at, len(sources) - 1))
        self.preset.blockSignals(False)
        self._take_preset()

    def _take_preset(self) -> None:
        preset = as_simulated(self.preset.currentData())
        if preset is not None:
            self.rig.show_value(preset.options.rig_seed)
            self.speed.show_value(preset.options.speed_m_s)
        self.changed.emit()

    def _say_words(self) -> None:
        key = "" if self._offer is None else self._offer.key
        self.set_title("" if self._offer is None else self._offer.name)
        self._what.setText(self._explanation(key))
        self._labels["preset"].setText(self.tr("&Rig"))
        self._labels["rig"].setText(self.tr("&Number of the rig"))
        self._labels["speed"].setText(self.tr("Belt s&peed"))
        names = {part: text.text().replace("&", "") for part, text in self._labels.items()}
        self.preset.setAccessibleName(names["preset"])
        tip = self.tr("Each number stands for sensors put up by other hands, over another belt")
        self.rig.name(names["rig"], tip, self.tr("The one before"), self.tr("The next one"))
        self.speed.name(names["speed"], names["speed"], self.tr("Slower"), self.tr("Faster"))
        self.file.setText(self.tr("Choose a file…"))
        self.file.setShortcut("Ctrl+O")
        self.file.setToolTip(self.tr("Choose the file of a recording (Ctrl+O)"))
        self.again.setText(self.tr("Begin again at the end"))
        self._file_name.setText(self.tr("No file is chosen yet.") if self._path is None else self._name_of(self._path))
        if key == SIMULATED:
            for number in range(self.preset.count()):
                self.preset.setItemText(number, preset_name(self.preset.itemData(number)))

    def _name_of(self, path: Path) -> str:
        """Return what a file is called: one that was recorded here needs no folder."""
        return path.name if self.made.lists(path) else str(path)

    def _explanation(self, key: str) -> str:
        if key == RECORDING:
            return self.tr(
                "A recording holds colour, depth and camera info of each sensor: an MCAP file of ROS 2, or a bag of "
                "ROS 1. It plays at the speed at which it was recorded."
            )
        if key == SIMULATED:
            return self.tr(
                "Simulated Kinects over a simulated belt, with the noise and the errors of real ones. Everything works "
                "as with real sensors, and the truth is known."
            )
        if key == DEVICES and self._offer is not None:
            words = self.tr("These sensors are plugged in. One that is unplugged comes back by itself when it returns.")
            return "\n\n".join([words, *device_lines(self._offer)])
        return self.tr("A device that is plugged in.")
