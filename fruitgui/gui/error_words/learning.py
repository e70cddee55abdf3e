"""What is said of what was taught and what was learned: by code, what happened and what to do."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import QCoreApplication

translate = QCoreApplication.translate


def words() -> Mapping[str, tuple[str, str]]:
    """Return the sentences by code, in the language in force."""
    return {
        "bad_evidence": (
            translate("Errors", "What was seen of a fruit cannot be used."),
            translate("Errors", "Leave this fruit out."),
        ),
        "bad_kinds": (
            translate("Errors", "The names of the kinds cannot be used."),
            translate("Errors", "Rename the kinds."),
        ),
        "bad_model": (
            translate("Errors", "The model cannot be used."),
            translate("Errors", "Train again, or roll back to the model before; no lot starts with it."),
        ),
        "model_already": (
            translate("Errors", "A model of this name is kept already."),
            translate("Errors", "Give it another name."),
        ),
        "no_label_matched": (
            translate("Errors", "No row of {file} points at a fruit that was seen."),
            translate("Errors", "Check that the file belongs to this recording."),
        ),
        "no_labels": (
            translate("Errors", "No fruit has a kind yet."),
            translate("Errors", "Name some fruit first."),
        ),
        "no_model_before": (
            translate("Errors", "No model was in use before this one."),
            translate("Errors", "There is nothing to go back to."),
        ),
        "no_such_model": (
            translate("Errors", "That model is not there any more."),
            translate("Errors", "Choose another, or train again."),
        ),
        "other_features": (
            translate("Errors", "The model was trained by another version of this program."),
            translate("Errors", "Train again; no lot starts with it."),
        ),
    }
