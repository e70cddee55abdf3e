"""Every error of the core in the operator's language.

The core speaks English and exactly; that goes to the log. A person reads, by the error's code, what happened and what
to do, with the file, sensor or lot that the error names.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from PySide6.QtCore import QCoreApplication

from fruitgui.errors import FruitguiError
from fruitgui.gui.error_words import files, learning, sensors, store
from fruitgui.gui.steps.connect.driver_words import fault_words
from fruitgui.gui.told import Told


def words() -> Mapping[str, tuple[str, str]]:
    """Return what is said by code: what happened, and what to do; names in braces are filled in."""
    return {**files.words(), **store.words(), **learning.words(), **sensors.words(), **fault_words()}


def told(error: FruitguiError) -> Told:
    """Return an error in the language in force; one whose code has no words here speaks for itself."""
    said = words().get(error.code)
    if said is None:
        return Told(error.what, error.remedy)
    place = {} if error.file is None else {"file": Path(error.file).name, "path": error.file}
    values = {name: value() if callable(value) else value for name, value in error.values.items()}
    try:
        what, remedy = (text.format(**values, **place) for text in said)
    except KeyError:
        return Told(error.what, error.remedy)
    if error.where is not None:
        where = QCoreApplication.translate("Errors", "{what} The place: {where}.")
        what = where.format(what=what, where=error.where)
    return Told(what, remedy)
