"""The Spanish window says everything, and says it of the window as it is now."""

from __future__ import annotations

import shutil
import string
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from fruitgui.gui import translations
from fruitgui.resources import folder

SPANISH = folder("translations") / "es"
PARTS = sorted(translations.parts())


def _messages(path: Path) -> dict[tuple[str, str], str]:
    """Return what a `.ts` file holds, unfinished ones as nothing."""
    found = {}
    for context in ET.parse(path).getroot().iter("context"):  # noqa: S314 - a file of our own
        for message in context.iter("message"):
            translation = message.find("translation")
            assert translation is not None
            text = "" if translation.get("type") == "unfinished" else translation.text or ""
            found[context.findtext("name", ""), message.findtext("source", "")] = text
    return found


@pytest.fixture(scope="module")
def gathered(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Copy the files and gather anew: what the source says today."""
    place = tmp_path_factory.mktemp("es")
    for path in SPANISH.glob("*.ts"):
        shutil.copy(path, place)
    translations.gather(place, "es")
    return place


@pytest.mark.parametrize("part", PARTS)
def test_everything_that_the_window_says_is_translated(gathered: Path, part: str) -> None:
    now = _messages(gathered / f"{part}.ts")
    assert now, "nothing is said in this part"
    assert [source for source, text in now.items() if not text] == []
    assert now.keys() == _messages(SPANISH / f"{part}.ts").keys(), "run python -m fruitgui.gui.translations"


@pytest.mark.parametrize("part", PARTS)
def test_what_is_filled_in_is_the_same_in_both_languages(part: str) -> None:
    def fields(text: str) -> set[str]:
        return {name for _, name, _, _ in string.Formatter().parse(text) if name is not None}

    for (_, source), text in _messages(SPANISH / f"{part}.ts").items():
        assert fields(source) == fields(text), source


@pytest.mark.parametrize("part", PARTS)
def test_what_is_compiled_is_what_is_translated(gathered: Path, part: str) -> None:
    committed = (SPANISH / f"{part}.qm").read_bytes()
    shutil.copy(SPANISH / f"{part}.ts", gathered / f"{part}.ts")
    translations.compile_all(gathered)
    assert (gathered / f"{part}.qm").read_bytes() == committed, "run python -m fruitgui.gui.translations"
