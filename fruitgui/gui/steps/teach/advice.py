"""What the teaching screen says: what to do next, and why nothing is there. Plain words, no widgets."""

from __future__ import annotations

from PySide6.QtCore import QCoreApplication

from fruitgui.gui.steps.teach.desk import Desk, Pile, Shelf

translate = QCoreApplication.translate


def advice(desk: Desk, shelf: Shelf, *, first: str, running: bool, connected: bool) -> str:
    """Return what to do next.

    Args:
        desk: what lies on it. shelf: that is looked at.
        first: what is to be finished before fruit can come in; empty where nothing is.
        running: a lot runs, so that none do now. connected: sensors run.
    """
    if first:
        return first
    if running:
        return translate(
            "TeachPage", "A lot is running; fruit can be named meanwhile, but none come in until it is ended."
        )
    waiting = len(desk.keys(Shelf()))
    if shelf.pile is Pile.DOUBTFUL and desk.keys(shelf):
        return translate("TeachPage", "Look closely: a key keeps or changes the kind.")
    if waiting and not desk.order:
        return translate("TeachPage", "Type the name of the first kind at the top; the chosen fruit get it.")
    if waiting:
        return translate("TeachPage", "Press the key of a kind, and go on to the next fruit.")
    if desk.done:
        return translate("TeachPage", "Enough is taught; go on to training.")
    if not connected:
        return translate("TeachPage", "No sensor runs: connect them, or open a recording that was made of this line.")
    return translate("TeachPage", "Let fruit of every kind come in.")


def nothing_words(desk: Desk, shelf: Shelf, *, in_lesson: bool) -> tuple[str, str]:
    """Return what is said where a shelf is empty, and what would fill it."""
    if shelf.pile is Pile.NAMED:
        return (
            translate("TeachPage", "Nothing is named yet"),
            translate("TeachPage", "Fruit that were given a kind can be looked over here."),
        )
    if shelf.pile is Pile.DOUBTFUL:
        return _no_doubts(desk)
    if in_lesson:
        return (
            translate("TeachPage", "Fruit will appear here"),
            translate("TeachPage", "Each one comes in once it has left the belt."),
        )
    if desk.fruit:
        return (
            translate("TeachPage", "Every fruit has a kind"),
            translate("TeachPage", "Let more fruit pass, or go on to training."),
        )
    return (
        translate("TeachPage", "No fruit yet"),
        translate("TeachPage", "Watch the line while fruit of each kind pass, or open a recording; each fruit appears "
                  "here with its picture, and a key says what it is."),
    )  # fmt: skip


def _no_doubts(desk: Desk) -> tuple[str, str]:
    if desk.insight.guesses or desk.insight.mistakes:
        return (
            translate("TeachPage", "No likely mistakes"),
            translate("TeachPage", "A model that never saw them agrees with every kind given."),
        )
    return (
        translate("TeachPage", "Nobody looked for mistakes yet"),
        translate("TeachPage", "Press “Suggest” once some fruit of two kinds are named: each is then judged by a model "
                  "that never saw it."),
    )  # fmt: skip
