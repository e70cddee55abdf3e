"""What a person set once for a line: language, look, how long things are kept."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from fruitgui.station.written import Written


class Settings(Written):
    """The settings of one line; what is not in the file has its usual value.

    Attributes:
        language: of the window; empty for the system's.
        theme: of the window.
        words_percent: of the usual size of the window's words, and of all that is drawn and pressed with them.
        crops_kept_days: pictures of fruit older than this are deleted; 0 keeps all.
        least_free_mb: recording and keeping pictures stop before the disk has less room than this.
    """

    language: Literal["", "en", "es"] = ""
    theme: Literal["system", "light", "dark"] = "system"
    words_percent: Literal[100, 125, 150, 200] = 100
    crops_kept_days: Annotated[int, Field(ge=0, le=36_500)] = 90
    least_free_mb: Annotated[int, Field(ge=0, le=10_000_000)] = 2_000
