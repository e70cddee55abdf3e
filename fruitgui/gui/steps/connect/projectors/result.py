"""The cards that show what trying the projectors came to."""

from __future__ import annotations

from PySide6.QtCore import QCoreApplication, Qt
from PySide6.QtWidgets import QGridLayout, QLabel, QSizePolicy, QVBoxLayout, QWidget

from fruitgui.calibration.projectors.settling import Settled
from fruitgui.gui.steps.connect.projectors.words import (
    HEALTH,
    change_text,
    effect_text,
    harm_word,
    refusal_text,
    settled_text,
    untold_text,
)
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.cards import Card, label, set_health
from fruitgui.station.tried import Pair, Tried
from fruitgui.station.turn_plan import TurnPlan

translate = QCoreApplication.translate


def result_cards(tried: Tried, before: TurnPlan | None, after: TurnPlan | None) -> QWidget:
    """Return cards: each sensor alone, every two together, and what it changes for rate and belt."""
    inner = QWidget()
    inner.setProperty("role", "scrolled")
    column = QVBoxLayout(inner)
    column.setContentsMargins(0, 0, GRID, 0)
    column.setSpacing(2 * GRID)
    cards = [_alone(tried)]
    if tried.pairs:
        cards.append(_together(tried.pairs))
    if before is not None and after is not None and tried.projectors.settlings:
        cards.append(Card(translate("Projectors", "What it changes")))
        cards[-1].body.addWidget(_wrapped(label(effect_text(before, after))))
    for card in cards:
        card.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Maximum)
        column.addWidget(card)
    column.addStretch()
    return inner


def _alone(tried: Tried) -> Card:
    card, table = _table(translate("Projectors", "Each alone"))
    for row, (sensor, found) in enumerate(tried.alone.items()):
        table.addWidget(label(sensor, "strong"), row, 0, Qt.AlignmentFlag.AlignTop)
        good = isinstance(found, Settled)
        text = _wrapped(label(settled_text(found) if isinstance(found, Settled) else refusal_text(found)))
        set_health(text, "" if good else "warn")
        table.addWidget(text, row, 1)
    return card


def _together(pairs: tuple[Pair, ...]) -> Card:
    card, table = _table(translate("Projectors", "Two at a time"))
    row = 0
    for pair in pairs:
        if pair.seen is None:
            table.addWidget(label(" + ".join(pair.sensors), "strong"), row, 0, Qt.AlignmentFlag.AlignTop)
            table.addWidget(_wrapped(label(untold_text(), "dim")), row, 1)
            row += 1
            continue
        for sensor, other, seen in zip(pair.sensors, pair.sensors[::-1], pair.seen, strict=True):
            text = translate("Projectors", "{sensor} beside {other}").format(sensor=sensor, other=other)
            table.addWidget(label(text, "strong"), row, 0, Qt.AlignmentFlag.AlignTop)
            table.addWidget(_wrapped(label(change_text(seen))), row, 1, Qt.AlignmentFlag.AlignTop)
            word = label(harm_word(seen.harm), "strong")
            set_health(word, HEALTH[seen.harm])
            table.addWidget(word, row, 2, Qt.AlignmentFlag.AlignTop)
            row += 1
    return card


def _table(title: str) -> tuple[Card, QGridLayout]:
    card, table = Card(title), QGridLayout()
    table.setHorizontalSpacing(3 * GRID)
    table.setVerticalSpacing(GRID)
    table.setColumnStretch(1, 1)
    card.body.addLayout(table)
    return card, table


def _wrapped(text: QLabel) -> QLabel:
    text.setWordWrap(True)
    return text
