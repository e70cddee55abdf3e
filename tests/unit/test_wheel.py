from __future__ import annotations

import configparser
import zipfile
from pathlib import Path

from hatchling.builders.wheel import WheelBuilder

ROOT = Path(__file__).parents[2]


def test_the_wheel_carries_the_manual_its_pictures_and_the_rules_for_sensors(tmp_path: Path) -> None:
    (wheel,) = WheelBuilder(str(ROOT)).build(directory=str(tmp_path))
    with zipfile.ZipFile(wheel) as archive:
        carried = set(archive.namelist())
    docs = ROOT / "resources" / "docs"
    wanted = [*(docs / "manual").iterdir(), *(docs / "pictures" / "manual").iterdir()]
    wanted += (ROOT / "resources" / "udev").iterdir()
    assert {f"fruitgui/{path.relative_to(ROOT).as_posix()}" for path in wanted} <= carried


def test_the_desktop_finds_program_and_icon_by_the_name_of_the_window() -> None:
    entry = configparser.RawConfigParser()
    entry.optionxform = str  # type: ignore[assignment,method-assign]
    entry.read(ROOT / "installer" / "fruitgui.desktop", encoding="utf-8")
    desktop = entry["Desktop Entry"]
    assert desktop["Exec"] == desktop["Icon"] == desktop["StartupWMClass"] == "fruitgui"
    assert (ROOT / "resources" / "icons" / f"{desktop['Icon']}.svg").is_file()
