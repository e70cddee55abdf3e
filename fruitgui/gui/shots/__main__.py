"""`python -m fruitgui.gui.shots FOLDER`: takes every screen in every state, size, theme and language."""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

from fruitgui.gui.shots.stage import SIZES, Scene, Stage, taken
from fruitgui.gui.translate import LANGUAGES


def main(arguments: Sequence[str] | None = None) -> int:
    """Take the pictures that are asked for, all unless told otherwise; print their names."""
    options = _parser().parse_args(arguments)
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    from fruitgui.gui.app import make_qt
    from fruitgui.gui.shots.scenes import SCENES
    from fruitgui.gui.theme.theme import load_fonts

    options.out.mkdir(parents=True, exist_ok=True)
    qt = make_qt()
    load_fonts()
    with tempfile.TemporaryDirectory(prefix="fruitgui-shots-") as folder:
        stage = Stage(qt, Path(folder))
        for scene in _chosen(SCENES, options.only):
            for path in taken(stage, scene, options.sizes, options.themes, options.languages, options.out):
                sys.stdout.write(f"{path}\n")
                sys.stdout.flush()
    return 0


def _chosen(scenes: Sequence[Scene], only: Sequence[str]) -> list[Scene]:
    return [scene for scene in scenes if not only or any(scene.name.startswith(name) for name in only)]


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m fruitgui.gui.shots", description=__doc__)
    parser.add_argument("out", type=Path, help="folder for the pictures")
    parser.add_argument("--only", nargs="*", default=(), metavar="NAME", help="scenes whose names begin so")
    parser.add_argument("--sizes", nargs="*", default=tuple(SIZES), choices=tuple(SIZES))
    parser.add_argument("--themes", nargs="*", default=("dark", "light"), choices=("dark", "light"))
    parser.add_argument("--languages", nargs="*", default=tuple(LANGUAGES), choices=tuple(LANGUAGES))
    return parser


if __name__ == "__main__":
    sys.exit(main())
