# ruff: noqa: ANN401 — messages are made at run time
"""Files that are empty, foreign, broken or made to hurt, all through the command line."""

from __future__ import annotations

import copy
import json
import os
import resource
import stat
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from fruitgui.cli import main
from tests.second_rig import hostile_files
from tests.second_rig.camera import LENSES
from tests.second_rig.lines import LinePlan, line
from tests.second_rig.mcap_files import record
from tests.second_rig.product import fruitgui
from tests.second_rig.truth_files import true_station, write_labels

GREEDY_MB = 350.0
"""What a command may take beyond what it takes for a good file: no input below holds more than 2 MB."""


@dataclass(frozen=True, slots=True)
class Ending:
    """How a command ended in this process."""

    code: int
    value: dict[str, Any]
    stderr: str


@dataclass(frozen=True, slots=True)
class Good:
    """Files that are sound: a short line of fruit, its station, its labels, a model trained on it."""

    recording: Path
    station: Path
    labels: Path
    model: Path


def call(capsys: pytest.CaptureFixture[str], *arguments: str | Path) -> Ending:
    """Run a command in this process; its standard output must be one JSON object and nothing else."""
    capsys.readouterr()
    code = main([*map(str, arguments), "--json"])
    said = capsys.readouterr()
    assert "Traceback" not in said.err
    value = json.loads(said.out)
    assert isinstance(value, dict)
    return Ending(code, value, said.err)


def refuse(capsys: pytest.CaptureFixture[str], *arguments: str | Path, file: Path | None) -> dict[str, Any]:
    """Run a command that must end with 2 and say what, where and what to do, and leave no file behind."""
    folder = file.parent if file is not None else None
    before = _listing(folder)
    ending = call(capsys, *arguments)
    assert ending.code == 2, ending
    assert set(ending.value) == {"error"}
    error: dict[str, Any] = ending.value["error"]
    assert {"code", "file", "where", "what", "remedy"} <= set(error)
    assert error["code"]
    assert error["what"]
    assert error["remedy"]
    assert file is None or Path(error["file"]).name == file.name
    assert _listing(folder) == before
    return error


def _listing(folder: Path | None) -> dict[str, int]:
    return {} if folder is None else {str(p): p.stat().st_size for p in sorted(folder.rglob("*")) if p.is_file()}


@pytest.fixture(scope="module")
def good(tmp_path_factory: pytest.TempPathFactory) -> Good:
    folder = tmp_path_factory.mktemp("good")
    scene = line(3, LinePlan(fruit=10, speed_m_s=0.5, lens=LENSES["320x240"]))
    recording = record(scene, folder / "good.mcap")
    station = folder / "good.json"
    station.write_text(json.dumps(true_station(scene)))
    labels = write_labels(folder / "good.csv", scene, per_fruit=3)
    model = folder / "good.model"
    outcome = fruitgui("train", recording, "--labels", labels, "--station", station, "--model", model)
    assert outcome.code == 0, outcome.stderr
    return Good(recording, station, labels, model)


@pytest.fixture
def flat(tmp_path: Path) -> tuple[Path, Path]:
    """A recording of four frames of an empty belt by one tiny sensor, and its station."""
    recording = hostile_files.write_mcap(tmp_path / "flat.mcap", hostile_files.flat_messages())
    return recording, _flat_station(tmp_path)


def _flat_station(folder: Path) -> Path:
    path = folder / "flat.json"
    path.write_text(json.dumps({
        "schema": "fruitgui.station/1", "reference_sensor": "k1",
        "sensors": {"k1": {
            "serial": None, "clock_offset_s": 0.0, "depth_correction": None, "quality": {},
            "pose": {"rotation": np.eye(3).tolist(), "translation_m": [0.0, 0.0, 0.0], "covariance": None},
            "surface": {"normal": [0.0, 0.0, -1.0], "offset_m": 1.0, "region": None},
        }},
        "belt": {"velocity_m_s": None}, "model": None,
    }))  # fmt: skip
    return path


# ------------------------------------------------------------------ recordings


@pytest.mark.parametrize("name", [n for n in hostile_files.raw_recordings() if "bomb" not in n])
@pytest.mark.parametrize("command", ["run", "calibrate"])
def test_a_file_that_is_no_recording_is_refused(
    name: str, command: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    station = _flat_station(tmp_path)
    recording = tmp_path / f"{name}.mcap"
    recording.write_bytes(hostile_files.raw_recordings()[name]())
    rest = ["--station", station, "--report", tmp_path / "out.json"]
    refuse(
        capsys,
        command,
        recording,
        *(rest if command == "run" else ["--station", tmp_path / "new.json"]),
        file=recording,
    )


@pytest.mark.parametrize(
    "name", [n for n in hostile_files.unreadable_streams() if n not in ("ten_thousand_topics", "depth_png_bomb")]
)
def test_a_recording_without_one_readable_frame_is_refused(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    station = _flat_station(tmp_path)
    recording = hostile_files.write_mcap(tmp_path / f"{name}.mcap", hostile_files.unreadable_streams()[name]())
    refuse(capsys, "run", recording, "--station", station, "--report", tmp_path / "out.json", file=recording)


def test_lengths_that_lie_inside_messages_are_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    station = _flat_station(tmp_path)
    recording = hostile_files.cdr_with_lying_lengths(tmp_path)
    refuse(capsys, "run", recording, "--station", station, "--report", tmp_path / "out.json", file=recording)


@pytest.mark.parametrize("place", ["missing.mcap", "", "flat.json"])
def test_a_recording_that_is_not_there_or_not_one_is_refused(
    place: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    station = _flat_station(tmp_path)
    refuse(
        capsys, "run", tmp_path / place, "--station", station, "--report", tmp_path / "out.json", file=tmp_path / place
    )


@pytest.mark.parametrize(
    "case", ["chunk_zstd_bomb", "chunk_zstd_bomb_that_lies", "depth_png_bomb", "ten_thousand_topics"]
)
def test_a_recording_takes_no_more_memory_than_a_good_one(case: str, flat: tuple[Path, Path], tmp_path: Path) -> None:
    recording, station = flat
    fair = fruitgui("run", recording, "--station", station, "--report", tmp_path / "fair.json")
    assert fair.code == 0, fair.stderr
    bad = tmp_path / f"{case}.mcap"
    if case.startswith("chunk"):
        bad.write_bytes(hostile_files.raw_recordings()[case]())
    else:
        hostile_files.write_mcap(bad, hostile_files.unreadable_streams()[case]())
    outcome = fruitgui("run", bad, "--station", station, "--report", tmp_path / "out.json")
    assert outcome.code == 2, outcome
    assert outcome.value is not None
    assert Path(outcome.value["error"]["file"]).name == bad.name
    assert "Traceback" not in outcome.stderr
    assert outcome.peak_mb < fair.peak_mb + GREEDY_MB
    assert not (tmp_path / "out.json").exists()


def test_ten_thousand_topics_beside_a_good_sensor_do_not_hide_it(
    flat: tuple[Path, Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    busy = hostile_files.write_mcap(
        tmp_path / "busy.mcap", hostile_files.with_many_topics(hostile_files.flat_messages())
    )
    ending = call(capsys, "run", busy, "--station", flat[1], "--report", tmp_path / "out.json")
    assert ending.code == 0, ending
    assert [s["frames"] for s in ending.value["sensors"] if s["id"] == "k1"] == [4]
    assert len(ending.stderr) < 20_000


@pytest.mark.parametrize("share", [0.35, 0.6, 0.97])
def test_a_recording_that_was_cut_is_used_up_to_the_cut(
    share: float, good: Good, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    whole = good.recording.read_bytes()
    cut = tmp_path / "cut.mcap"
    cut.write_bytes(whole[: int(share * len(whole))])
    ending = call(capsys, "run", cut, "--station", good.station, "--report", tmp_path / "out.json")
    assert ending.code == 0, ending
    assert sum(sensor["frames"] for sensor in ending.value["sensors"]) > 0
    assert any("cut" in warning or "unread" in warning for warning in ending.value["warnings"])
    assert "warning" in ending.stderr


def test_a_byte_that_flipped_costs_at_most_its_surroundings(
    good: Good, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    data = bytearray(good.recording.read_bytes())
    data[len(data) // 2] ^= 0xFF
    flipped = tmp_path / "flipped.mcap"
    flipped.write_bytes(data)
    ending = call(capsys, "run", flipped, "--station", good.station, "--report", tmp_path / "out.json")
    assert ending.code == 0, ending
    assert ending.value["warnings"]


def test_frames_that_cannot_be_read_among_good_ones_are_left_out(
    flat: tuple[Path, Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    count = 0

    def spoil(what: str, message: Any) -> Any:
        nonlocal count
        count += what == "depth"
        if what == "depth" and count == 2:
            message.data = np.zeros(7, np.uint8)
        return message

    mixed = hostile_files.write_mcap(tmp_path / "mixed.mcap", hostile_files.flat_messages(6, change=spoil))
    ending = call(capsys, "run", mixed, "--station", flat[1], "--report", tmp_path / "out.json")
    assert ending.code == 0, ending
    assert ending.value["sensors"][0]["frames"] >= 5
    assert ending.value["warnings"]


def test_a_cut_recording_is_recovered_into_a_whole_one(
    good: Good, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    whole = good.recording.read_bytes()
    cut, out = tmp_path / "cut.mcap", tmp_path / "whole.mcap"
    cut.write_bytes(whole[: len(whole) // 2])
    assert call(capsys, "record", "--recover", cut, "--out", out).code == 0
    ending = call(capsys, "run", out, "--station", good.station, "--report", tmp_path / "out.json")
    assert ending.code == 0, ending


def test_recovering_into_itself_or_calibrating_over_the_recording_loses_nothing(
    good: Good, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    copied = tmp_path / "copied.mcap"
    copied.write_bytes(good.recording.read_bytes())
    refuse(capsys, "record", "--recover", copied, "--out", copied, file=copied)
    refuse(capsys, "run", copied, "--station", good.station, "--report", copied, file=copied)
    refuse(capsys, "calibrate", copied, "--station", copied, file=copied)
    assert copied.read_bytes() == good.recording.read_bytes()


# ------------------------------------------------------------------ stations


def _two_sensors(folder: Path) -> dict[str, Any]:
    station: dict[str, Any] = json.loads(_flat_station(folder).read_text())
    station["sensors"]["k2"] = copy.deepcopy(station["sensors"]["k1"])
    return station


STATIONS = list(hostile_files.stations({"reference_sensor": "a", "sensors": {n: {
    "pose": {"rotation": np.eye(3).tolist()}, "surface": {}} for n in "ab"}, "belt": {}}))  # fmt: skip


@pytest.mark.parametrize("name", STATIONS)
def test_a_station_that_cannot_be_is_refused(
    name: str, flat: tuple[Path, Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    bad = tmp_path / f"{name}.json"
    bad.write_text(hostile_files.stations(_two_sensors(tmp_path))[name])
    refuse(capsys, "run", flat[0], "--station", bad, "--report", tmp_path / "out.json", file=bad)


@pytest.mark.parametrize(
    "data", [b"\xff\xfe{\x00}\x00", b"\x80\x81\x82", b"\x00" * 100, b'{"schema": "fruitgui.station/1"']
)
def test_a_station_of_odd_bytes_is_refused(
    data: bytes, flat: tuple[Path, Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    bad = tmp_path / "odd.json"
    bad.write_bytes(data)
    refuse(capsys, "run", flat[0], "--station", bad, "--report", tmp_path / "out.json", file=bad)


def test_a_station_of_other_sensors_is_refused_and_one_with_some_of_them_warned_of(
    flat: tuple[Path, Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    both = tmp_path / "both.json"
    both.write_text(json.dumps(_two_sensors(tmp_path)))
    ending = call(capsys, "run", flat[0], "--station", both, "--report", tmp_path / "out.json")
    assert ending.code == 0, ending
    assert any("k2" in warning for warning in ending.value["warnings"])
    other = tmp_path / "other.json"
    other.write_text(flat[1].read_text().replace('"k1"', '"z9"'))
    assert call(capsys, "run", flat[0], "--station", other, "--report", tmp_path / "none.json").code == 2
    assert not (tmp_path / "none.json").exists()


# ------------------------------------------------------------------ models


MODELS = (
    "empty", "text", "cut", "empty_zip", "version_of_tomorrow", "pickle_inside", "nan_weights", "array_shape_lies",
    "array_is_text", "array_missing", "manifest_not_json", "manifest_list", "flipped_bits",
)  # fmt: skip


@pytest.mark.parametrize("name", MODELS)
def test_a_model_that_cannot_be_is_refused(
    name: str, good: Good, flat: tuple[Path, Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    bad = tmp_path / f"{name}.model"
    bad.write_bytes(hostile_files.models(good.model.read_bytes(), name))
    refuse(capsys, "run", flat[0], "--station", flat[1], "--model", bad, "--report", tmp_path / "out.json", file=bad)


@pytest.mark.parametrize("name", ["bomb", "json_bomb"])
def test_a_model_takes_no_more_memory_than_a_good_one(
    name: str, good: Good, flat: tuple[Path, Path], tmp_path: Path
) -> None:
    bad = tmp_path / f"{name}.model"
    bad.write_bytes(hostile_files.models(good.model.read_bytes(), name))
    outcome = fruitgui("run", flat[0], "--station", flat[1], "--model", bad, "--report", tmp_path / "out.json")
    assert outcome.code == 2, outcome
    assert "Traceback" not in outcome.stderr
    assert outcome.peak_mb < 400.0


def test_a_model_named_by_the_station_but_missing_is_refused(
    flat: tuple[Path, Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    station = json.loads(flat[1].read_text()) | {"model": "gone.model"}
    naming = tmp_path / "naming.json"
    naming.write_text(json.dumps(station))
    ending = call(capsys, "run", flat[0], "--station", naming, "--report", tmp_path / "out.json")
    assert ending.code == 2, ending


# ------------------------------------------------------------------ labels


@pytest.mark.parametrize("name", list(hostile_files.labels()))
def test_labels_of_which_no_row_can_be_used_are_refused(
    name: str, good: Good, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    bad = tmp_path / f"{name}.csv"
    bad.write_bytes(hostile_files.labels()[name])
    refuse(
        capsys, "train", good.recording, "--labels", bad, "--station", good.station, "--model", tmp_path / "m", file=bad
    )
    assert not (tmp_path / "m").exists()


def test_rows_that_match_nothing_are_named_by_line_and_the_rest_used(
    good: Good, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    rows = good.labels.read_text().splitlines()
    rows.insert(3, "east,1700000002.0,-500,9000,lemon,")
    mixed = tmp_path / "mixed.csv"
    mixed.write_text("\n".join(rows))
    ending = call(
        capsys, "train", good.recording, "--labels", mixed, "--station", good.station, "--model", tmp_path / "m"
    )
    assert ending.code == 0, ending
    assert (tmp_path / "m").exists()
    assert "4" in ending.stderr


# ------------------------------------------------------------------ outputs and usage


def test_an_output_in_a_folder_that_is_missing_is_refused_before_any_work(
    flat: tuple[Path, Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "no" / "such" / "out.json"
    for arguments in (
        ["run", flat[0], "--station", flat[1], "--report", out],
        ["calibrate", flat[0], "--station", out],
        ["record", "--out", out],
        ["evaluate", "--report", out],
    ):
        error = refuse(capsys, *arguments, file=None)
        assert Path(error["file"]).name == out.name
    assert not (tmp_path / "no").exists()


@pytest.mark.parametrize("out", ["", "flat.mcap/out.json"])
def test_an_output_that_is_a_folder_or_inside_a_file_is_refused(
    out: str, flat: tuple[Path, Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    refuse(capsys, "run", flat[0], "--station", flat[1], "--report", tmp_path / out, file=None)


@pytest.mark.parametrize("arguments", [
    [], ["--no-such-option"], ["fly"], ["run"], ["run", "a.mcap"], ["calibrate", "a.mcap", "--station"],
    ["run", "FLAT", "--station", "STATION", "--report", "OUT", "--topics", "rubbish"],
    ["run", "FLAT", "--station", "STATION", "--report", "OUT", "--topics", "k1:rgb=/nowhere,info=/no,depth=/no"],
    ["run", "FLAT", "--station", "STATION", "--report", "OUT", "--clock-offset", "k1=nan"],
    ["run", "FLAT", "--station", "STATION", "--report", "OUT", "--clock-offset", "k1"],
    ["run", "FLAT", "--station", "STATION", "--report", "OUT", "--belt-speed", "inf"],
    ["run", "FLAT", "--station", "STATION", "--report", "OUT", "--belt-speed", "-1"],
    ["run", "FLAT", "--station", "STATION", "--report", "OUT", "--sensors", "nobody"],
    ["run", "FLAT", "--station", "STATION", "--report", "OUT", "--sensors", ","],
    ["record", "--out", "OUT", "--seconds", "nan"],
    ["calibrate", "FLAT", "--station", "OUT", "--reference", "nobody"],
    ["train", "FLAT", "--labels", "STATION", "STATION", "--station", "STATION", "--model", "OUT"],
], ids=lambda a: " ".join(a)[-40:] or "nothing")  # fmt: skip
def test_bad_usage_ends_with_two_and_says_so(
    arguments: list[str], flat: tuple[Path, Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    named = {"FLAT": str(flat[0]), "STATION": str(flat[1]), "OUT": str(tmp_path / "out.json")}
    refuse(capsys, *[named.get(a, a) for a in arguments], file=None)
    assert not (tmp_path / "out.json").exists()


def test_a_device_as_output_stays_a_device(
    flat: tuple[Path, Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    device = tmp_path / "null"
    try:
        os.mknod(device, 0o666 | stat.S_IFCHR, os.makedev(1, 3))
        device.write_bytes(b"x")
    except OSError:
        pytest.skip("this user may not make devices")
    ending = call(capsys, "run", flat[0], "--station", flat[1], "--report", device)
    assert ending.code in (0, 2)
    assert device.is_char_device(), "the device was replaced by a file"


def test_a_full_disk_is_told_and_nothing_half_written_is_left(flat: tuple[Path, Path], tmp_path: Path) -> None:
    folder = tmp_path / "small"
    folder.mkdir()
    root = Path(__file__).resolve().parents[2]
    done = subprocess.run(
        [sys.executable, "-m", "fruitgui", "run", flat[0], "--station", flat[1], "--report", folder / "r.json",
         "--json"],
        capture_output=True, text=True, check=False, env=os.environ | {"PYTHONPATH": str(root)},
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (64, 64)),
    )  # fmt: skip
    assert done.returncode == 1, done
    assert "Traceback" not in done.stderr
    assert "r.json" in json.loads(done.stdout)["error"]["file"]
    assert list(folder.iterdir()) == []


def test_the_model_that_a_station_names_is_not_written_over(
    good: Good, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    station, model = tmp_path / "station.json", tmp_path / "kept.model"
    model.write_bytes(good.model.read_bytes())
    station.write_text(json.dumps(json.loads(good.station.read_text()) | {"model": model.name}))
    refuse(capsys, "run", good.recording, "--station", station, "--report", model, file=None)
    assert model.read_bytes() == good.model.read_bytes()
