from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

from fruitgui.cli import main


def test_help_names_only_commands_that_are_built(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--help"]) == 0
    text = capsys.readouterr().out
    assert all(word in text for word in ("demo", "sensors", "record", "calibrate", "train", "run", "study", "evaluate"))


@pytest.mark.parametrize(
    "arguments",
    [
        ["fly"],
        ["run"],
        ["run", "r.mcap", "--station", "s.json", "--report", "out.json", "--belt-speed", "fast"],
        ["run", "r.mcap", "--station", "s.json", "--report", "out.json", "--belt-speed", "nan"],
        ["run", "r.mcap", "--station", "s.json", "--report", "out.json", "--belt-speed", "-1"],
        ["run", "r.mcap", "--station", "s.json", "--report", "out.json", "--clock-offset", "k1"],
        ["run", "r.mcap", "--station", "s.json", "--report", "out.json", "--clock-offset", "k1=soon"],
        ["run", "r.mcap", "--station", "s.json", "--report", "no/such/folder/out.json"],
        ["run", "r.mcap", "--station", "s.json", "--report", "."],
        ["train", "a", "b", "--labels", "c", "--station", "s", "--model", "m"],
        ["demo", "--seconds", "inf"],
        ["evaluate", "--fruit", "0", "--report", "e.json"],
        ["record", "--out", "r.mcap", "--seconds", "0"],
    ],
)
def test_bad_usage_ends_with_2_and_what_to_do(
    arguments: list[str], capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main([*arguments, "--json"]) == 2
    printed = capsys.readouterr()
    assert "Traceback" not in printed.err
    assert list(tmp_path.iterdir()) == []
    error = json.loads(printed.out)["error"]
    assert set(error) == {"code", "file", "where", "what", "remedy"}
    assert error["remedy"]


def test_without_a_screen_the_window_says_so_and_what_else_there_is(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"):
        monkeypatch.delenv(name, raising=False)
    assert main([]) == 1
    assert "no screen" in capsys.readouterr().err


def test_the_window_s_folder_must_be_one(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    file = tmp_path / "file"
    file.touch()
    assert main(["--folder", str(file)]) == 2
    assert str(file) in capsys.readouterr().err


def test_the_package_and_its_help_load_nothing_heavy() -> None:
    heavy = {"numpy", "cv2", "open3d", "sklearn", "scipy", "pydantic", "rosbags", "rich"}
    script = (
        "import sys, fruitgui, fruitgui.cli; fruitgui.cli.main(['--help']); print(sorted(sys.modules), file=sys.stderr)"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    loaded = {name for name in heavy if f"'{name}'" in done.stderr}
    assert loaded == set()
