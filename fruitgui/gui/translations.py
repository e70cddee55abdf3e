"""`python -m fruitgui.gui.translations`: gathers what the window says, and compiles what was translated.

One `.ts` file for each part of the window, so that parts can be worked on side by side; Qt's own tools do the work.
What is said of errors is a part of its own: it follows the core, not a screen.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

import PySide6

from fruitgui.gui.translate import LANGUAGES
from fruitgui.resources import folder

GUI = Path(__file__).parent


def parts() -> Mapping[str, Sequence[Path]]:
    """Return the source files of every part: one for each step, `errors`, and `window` for all that they share."""
    steps = {path.name: sorted(path.rglob("*.py")) for path in sorted((GUI / "steps").iterdir()) if path.is_dir()}
    steps = {name: files for name, files in steps.items() if files and not name.startswith("_")}
    taken = {file for files in steps.values() for file in files}
    errors = sorted((GUI / "error_words").glob("*.py"))
    taken.update(errors)
    shared = sorted(file for file in GUI.rglob("*.py") if file not in taken and "shots" not in file.parts)
    return {"window": shared, "errors": errors, **steps}


def gather(into: Path, language: str) -> None:
    """Bring the `.ts` files of a language in a folder up to date with the source."""
    for part, files in parts().items():
        names = [str(file.relative_to(GUI.parents[1])) for file in files]
        _tool("lupdate", *names, "-ts", str(into / f"{part}.ts"), "-no-obsolete", "-locations", "none",
              "-target-language", language, "-silent")  # fmt: skip


def compile_all(into: Path) -> None:
    """Compile every `.ts` file of a folder."""
    for path in sorted(into.glob("*.ts")):
        _tool("lrelease", str(path), "-qm", str(path.with_suffix(".qm")), "-silent")


def _tool(name: str, *arguments: str) -> None:
    tool = Path(PySide6.__file__).parent / name
    subprocess.run([str(tool), *arguments], check=True, cwd=GUI.parents[1])  # noqa: S603 - Qt's own


def main() -> int:
    """Gather and compile all languages but English, which stands in the source."""
    for language in LANGUAGES:
        if language != "en":
            place = folder("translations") / language
            gather(place, language)
            compile_all(place)
    return 0


if __name__ == "__main__":
    sys.exit(main())
