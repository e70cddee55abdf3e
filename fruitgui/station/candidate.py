"""A trained model that waits to be accepted, kept in the workspace: closing the window does not lose it.

The model's file comes first and its facts after: a model without facts was being written when the power went, and
counts for nothing.
"""

from __future__ import annotations

import contextlib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic import Field

from fruitgui.errors import InputError
from fruitgui.station.judging import FEATURES
from fruitgui.station.model import Model, read_model
from fruitgui.station.written import Written, read_written, write_written

MODEL, FACTS = "candidate.fruit", "candidate.json"
BEING_MADE = "candidate-new.fruit"


class CandidateFacts(Written):
    """What is known of a candidate.

    Attributes:
        taught: fingerprint of what it learned from.
        trained_on, held_out: as the list of models keeps them.
        made_s: when it was trained, Unix seconds.
    """

    taught: str = ""
    trained_on: dict[str, Any] = Field(default_factory=dict)
    held_out: dict[str, float] = Field(default_factory=dict)
    made_s: float = 0.0


@dataclass(frozen=True, slots=True, eq=False)
class Candidate:
    """A model that waits to be accepted."""

    model: Model
    facts: CandidateFacts

    @property
    def held_out(self) -> Mapping[str, Any]:
        """How it did on fruit held out."""
        return self.facts.held_out


def keep_candidate(folder: Path, facts: CandidateFacts) -> None:
    """Let the model that was written as `BEING_MADE` be the one that waits, in place of another.

    Raises:
        WorldError: it cannot be kept.
        OSError: the folder is gone.
    """
    forget_candidate(folder)
    (folder / BEING_MADE).replace(folder / MODEL)
    write_written(folder / FACTS, facts)


def read_candidate(folder: Path) -> Candidate | None:
    """Return the model that waits to be accepted; None where there is none that can be read."""
    try:
        if not (folder / FACTS).exists():
            return None
        return Candidate(read_model(folder / MODEL, FEATURES), read_written(folder / FACTS, CandidateFacts))
    except InputError:  # it can be trained again; what the line uses is another file
        return None


def forget_candidate(folder: Path) -> None:
    """Let no model wait any more; its facts go first."""
    for name in (FACTS, MODEL):
        with contextlib.suppress(OSError):
            (folder / name).unlink(missing_ok=True)
