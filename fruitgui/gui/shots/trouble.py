"""What is seen when a line's records cannot be opened."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path

from PySide6.QtWidgets import QWidget

from fruitgui.errors import FruitguiError, WorldError
from fruitgui.gui.shots.stage import Scene, Stage
from fruitgui.gui.store_trouble import StoreTrouble
from fruitgui.records.backup import back_up, backup_path
from fruitgui.records.store import open_store

BACKED_UP_S = 1_773_500_400.0


@contextmanager
def _damaged(stage: Stage, *, backed_up: bool) -> Iterator[QWidget]:
    with tempfile.TemporaryDirectory(dir=stage.folder) as name:
        folder = Path(name)
        open_store(folder).close()
        if backed_up:
            back_up(folder, backup_path(folder, BACKED_UP_S), BACKED_UP_S)
        (folder / "records.sqlite").write_bytes(b"scratched " * 1000)
        dialog = StoreTrouble(folder, _error(folder))
        dialog.show()
        stage.wait_until(lambda: not dialog.busy)
        try:
            yield dialog
        finally:
            dialog.reject()
            dialog.deleteLater()
            stage.settle()


def _error(folder: Path) -> FruitguiError:
    """Return what opening fails with, of a folder as a packing house might name it."""
    try:
        open_store(folder).close()
    except WorldError as error:
        place = str(Path("/data/packing/line_2"))
        what, file = (text.replace(str(folder), place) for text in (error.what, error.file or ""))
        return WorldError(error.code, what, error.remedy, file=file)
    raise AssertionError("a damaged store was opened")


SCENES: tuple[Scene, ...] = (
    Scene("trouble-backup", partial(_damaged, backed_up=True)),
    Scene("trouble-none", partial(_damaged, backed_up=False)),
)
