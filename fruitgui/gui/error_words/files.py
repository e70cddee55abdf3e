"""What is said of files: what cannot be read, written or used: by code, what happened and what to do."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import QCoreApplication

translate = QCoreApplication.translate


def words() -> Mapping[str, tuple[str, str]]:
    """Return the sentences by code, in the language in force."""
    return {
        "bad_backup": (
            translate("Errors", "{file} is not a whole backup."),
            translate("Errors", "Choose another backup; nothing was changed."),
        ),
        "bad_file": (
            translate("Errors", "{file} cannot be used: something in it is wrong."),
            translate("Errors", "Do that step again, or take a file that was good."),
        ),
        "bad_labels": (
            translate("Errors", "{file} cannot be used as labels."),
            translate("Errors", "Save it as this program exports it: sensor, time, place and kind in each row."),
        ),
        "bad_poses": (
            translate("Errors", "{file} cannot be used as poses."),
            translate("Errors", "Each row needs a time, a sensor, a place and a unit quaternion."),
        ),
        "bad_station": (
            translate("Errors", "The calibration in {file} cannot be used."),
            translate("Errors", "Calibrate again, or take the last good one."),
        ),
        "cannot_read": (
            translate("Errors", "{path} cannot be read."),
            translate("Errors", "Check that it is still there and may be read."),
        ),
        "cannot_restore": (
            translate("Errors", "The backup could not be put in place."),
            translate(
                "Errors",
                "Check that the folder {file} may be written to, and start the program again: the restore goes on.",
            ),
        ),
        "cannot_write": (
            translate("Errors", "{path} cannot be written."),
            translate("Errors", "Check that its folder exists, may be written to, and has room."),
        ),
        "disk_full": (
            translate("Errors", "The disk is full; {file} cannot take more."),
            translate(
                "Errors", "Make room on the disk, or keep pictures for fewer days. Nothing that was counted is lost."
            ),
        ),
        "file_too_large": (
            translate("Errors", "{file} is too large to be a file of this program."),
            translate("Errors", "Choose the right file."),
        ),
        "not_json": (
            translate("Errors", "{file} is not a file of this program."),
            translate("Errors", "Choose a file that this program wrote."),
        ),
        "not_text": (
            translate("Errors", "{file} is not a text file."),
            translate("Errors", "Save it as UTF-8, or choose the right file."),
        ),
        "unfinished_recording": (
            translate("Errors", "{file} is there: a recording that was cut off, or one that is being made right now."),
            translate("Errors", "Let it end, or save what is in it first, or delete it."),
        ),
        "recording_not_finished": (
            translate("Errors", "The recording cannot be finished: the disk is full, or gone."),
            translate("Errors", "What was recorded is in {file}: find it among the recordings of step 1."),
        ),
        "parts_there": (
            translate("Errors", "{file} is there already, where a part of this recording would go."),
            translate("Errors", "Give the recording another name, or move that file away."),
        ),
        "too_many_parts": (
            translate("Errors", "The recording {file} has too many parts."),
            translate("Errors", "Let its parts be larger."),
        ),
    }
