"""Where the files that travel with the program are: presets, icons, fonts, translations."""

from __future__ import annotations

from functools import cache
from importlib import resources
from pathlib import Path


@cache
def folder(name: str) -> Path:
    """Return the folder of that name inside `resources`, installed or beside the source.

    Raises:
        FileNotFoundError: the installation is not whole.
    """
    installed = Path(str(resources.files("fruitgui"))) / "resources" / name
    beside = Path(__file__).parents[1] / "resources" / name
    for place in (installed, beside):
        if place.is_dir():
            return place
    raise FileNotFoundError(f"fruitgui was installed without its folder resources/{name}; install it again.")
