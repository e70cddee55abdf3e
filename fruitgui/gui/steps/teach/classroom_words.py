"""What the window says of what was done on the teaching screen."""

from __future__ import annotations

from PySide6.QtCore import QCoreApplication

from fruitgui.gui.kind_words import kind_name
from fruitgui.gui.told import Told

translate = QCoreApplication.translate


def named_text(count: int, kind: str) -> str:
    """Return that so many fruit were given a kind."""
    if count == 1:
        return translate("Classroom", "Named: {kind}.").format(kind=kind_name(kind))
    return translate("Classroom", "{count} fruit named: {kind}.").format(count=count, kind=kind_name(kind))


def step_text(count: int, *, back: bool) -> str:
    """Return that a step on so many fruit was taken back, or done again."""
    done = (
        translate("Classroom", "Taken back on {count} fruit.")
        if back
        else translate("Classroom", "Done again on {count} fruit.")
    )
    return done.format(count=count)


def no_step_text(*, back: bool) -> str:
    """Return that there is nothing to take back, or to do again."""
    if back:
        return translate("Classroom", "There is nothing to undo.")
    return translate("Classroom", "There is nothing to do again.")


def labels_text(rows: int, source: str, file: str) -> str:
    """Return that so many labels were written."""
    text = translate("Classroom", "{rows} labels of {source} are in {file}.")
    return text.format(rows=rows, source=source, file=file)


def labelled_text(fruit: int, rows: int) -> str:
    """Return how many fruit were named by so many rows of a labels file."""
    return translate("Classroom", "{fruit} fruit were named by {rows} labels.").format(fruit=fruit, rows=rows)


def left_out_told(rows: int) -> Told:
    """Return that so many rows of a labels file point at nothing, and where to find out which."""
    what = translate("Classroom", "{count} rows of the file point at no fruit and were left out.").format(count=rows)
    return Told(what, translate("Classroom", "The log says which: open the help, then Show log."))
