from __future__ import annotations

import io
import json
import pickle
import tracemalloc
import zipfile
from pathlib import Path

import numpy as np
import pytest

from fruitgui.errors import InputError
from fruitgui.station.archive import MAX_BYTES, read_archive, write_archive


def zipped(tmp_path: Path, **members: bytes) -> Path:
    path = tmp_path / "m.fruit"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in members.items():
            archive.writestr(name.replace("__", "."), data)
    return path


def npy(array: object, *, allow_pickle: bool = False) -> bytes:
    buffer = io.BytesIO()
    np.save(buffer, np.asarray(array), allow_pickle=allow_pickle)
    return buffer.getvalue()


def test_what_is_written_comes_back_and_the_same_gives_the_same_bytes(tmp_path: Path) -> None:
    arrays = {"w0": np.arange(6, dtype=np.float32).reshape(2, 3), "w1": np.zeros(0)}
    first, second = tmp_path / "a", tmp_path / "b"
    write_archive(first, {"kinds": ["límón"]}, arrays)
    write_archive(second, {"kinds": ["límón"]}, arrays)
    manifest, back = read_archive(first)
    assert manifest == {"kinds": ["límón"]}
    np.testing.assert_array_equal(back["w0"], arrays["w0"])
    assert first.read_bytes() == second.read_bytes()


def _lying_header() -> bytes:
    return npy(np.zeros(4)).replace(b"(4,)", b"(9,)")


def _huge_header() -> bytes:
    return npy(np.zeros(1)).replace(b"(1,), }       ", b"(999999999,), }")


@pytest.mark.parametrize(
    "members",
    [
        {},
        {"model__json": b"{"},
        {"model__json": b"[]"},
        {"model__json": b'{"a": NaN}'},
        {"model__json": b"[" * 50_000},
        {"model__json": b"{}", "w__npy": b"nothing"},
        {"model__json": b"{}", "w__npy": npy([{"a": 1}], allow_pickle=True)},
        {"model__json": b"{}", "w__npy": pickle.dumps(1)},
        {"model__json": b"{}", "w__npy": npy(["text"])},
        {"model__json": b"{}", "w__npy": npy(np.zeros(4))[:-3]},
        {"model__json": b"{}", "w__npy": _lying_header()},
        {"model__json": b"{}", "w__npy": _huge_header()},
        {"model__json": b"{}", "w__npy": b"\0" * (MAX_BYTES + 2)},
    ],
)
def test_what_is_not_data_as_claimed_is_refused(tmp_path: Path, members: dict[str, bytes]) -> None:
    with pytest.raises(InputError) as caught:
        read_archive(zipped(tmp_path, **members))
    assert caught.value.file


def test_a_damaged_zip_is_refused_wherever_it_is_damaged(tmp_path: Path) -> None:
    good = tmp_path / "good"
    write_archive(good, {"a": list(range(50))}, {"w": np.random.default_rng(1).normal(size=200)})
    data = good.read_bytes()
    bad = tmp_path / "bad"
    for cut in range(0, len(data), 97):
        bad.write_bytes(data[:cut])
        with pytest.raises(InputError):
            read_archive(bad)


def test_a_bomb_is_refused_before_it_is_unpacked(tmp_path: Path) -> None:
    path = zipped(tmp_path, model__json=b"{}", w__npy=b"\0" * (4 * MAX_BYTES))
    tracemalloc.start()
    with pytest.raises(InputError):
        read_archive(path)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 2**20


def test_too_many_members_are_refused(tmp_path: Path) -> None:
    members = {f"m{i}": b"" for i in range(300)}
    with pytest.raises(InputError):
        read_archive(zipped(tmp_path, model__json=json.dumps({}).encode(), **members))


def test_a_missing_model_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError) as caught:
        read_archive(tmp_path / "none")
    assert caught.value.code == "cannot_read"
