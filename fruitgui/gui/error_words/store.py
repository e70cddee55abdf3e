"""What is said of the records: lots, fruit, and the file that holds them: by code, what happened and what to do."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import QCoreApplication

translate = QCoreApplication.translate


def words() -> Mapping[str, tuple[str, str]]:
    """Return the sentences by code, in the language in force."""
    return {
        "bad_kind": (
            translate("Errors", "This cannot be the name of a kind."),
            translate("Errors", "Use 1 to {most} printable letters."),
        ),
        "bad_measure": (
            translate("Errors", "{value} is no measure."),
            translate("Errors", "Type a number above zero."),
        ),
        "line_open": (
            translate("Errors", "Another window has this line open."),
            translate("Errors", "Go on in that window, or close it and try again."),
        ),
        "lot_ended": (
            translate("Errors", "Lot {lot} is ended."),
            translate("Errors", "Start another lot."),
        ),
        "lot_open": (
            translate("Errors", "Lot {lot} is still open."),
            translate("Errors", "End it first."),
        ),
        "lot_without_name": (
            translate("Errors", "The lot has no name."),
            translate("Errors", "Give it a name or a number."),
        ),
        "no_such_fruit": (
            translate("Errors", "That fruit is not there any more."),
            translate("Errors", "Choose another of the list."),
        ),
        "no_such_lot": (
            translate("Errors", "That lot is not there any more."),
            translate("Errors", "Choose another of the list."),
        ),
        "numbers_damaged": (
            translate("Errors", "Some numbers of a fruit in the records are damaged."),
            translate("Errors", "The other fruit can be used; restore the last good backup to have this one too."),
        ),
        "restore_waits": (
            translate(
                "Errors", "A backup is put in place at the next start; what is counted until then would go aside."
            ),
            translate("Errors", "Close the window and start again, or choose “Do not restore after all” at step 7."),
        ),
        "store_damaged": (
            translate("Errors", "{file} is damaged."),
            translate("Errors", "A good backup, where there is one, can be restored; what is there now is kept aside."),
        ),
        "store_failed": (
            translate("Errors", "{file} could not be read or written."),
            translate("Errors", "Check the disk; if this comes back, restore the last good backup."),
        ),
        "store_locked": (
            translate("Errors", "Another program holds {file}."),
            translate("Errors", "Close other windows that have this line open, and try again."),
        ),
        "store_newer": (
            translate("Errors", "{file} was written by a newer version of this program."),
            translate("Errors", "Start the newer version, or restore a backup that this version made."),
        ),
        "store_read_only": (
            translate("Errors", "{file} cannot be opened or written."),
            translate("Errors", "Check that its folder exists and may be written to."),
        ),
        "taught_already": (
            translate("Errors", "A fruit of {source} is kept already."),
            translate("Errors", "Remove it first, or watch something else."),
        ),
    }
