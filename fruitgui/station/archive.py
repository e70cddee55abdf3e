"""One zip of JSON and npy: data only. Nothing in it is ever run, and nothing it claims is believed."""

from __future__ import annotations

import io
import json
import zipfile
import zlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fruitgui.errors import InputError
from fruitgui.files import written_whole

MANIFEST = "model.json"
MAX_BYTES = 64 * 1024 * 1024
"""A model has some hundred thousand numbers; what unpacks to more than this is not one."""

MAX_MEMBERS = 256
REMEDY = "Train again, or name a model file that training wrote."

Arrays = dict[str, NDArray[Any]]


def write_archive(path: Path, manifest: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]) -> None:
    """Write the manifest and arrays as one zip, whole or not at all; equal input gives equal bytes.

    Raises:
        WorldError: it cannot be written there.
    """
    with written_whole(path) as beside, zipfile.ZipFile(beside, "w", zipfile.ZIP_DEFLATED) as archive:
        text = json.dumps(manifest, indent=1, allow_nan=False, ensure_ascii=False)
        archive.writestr(zipfile.ZipInfo(MANIFEST), text.encode("utf-8", "backslashreplace"))
        for name, array in arrays.items():
            buffer = io.BytesIO()
            np.save(buffer, array, allow_pickle=False)
            archive.writestr(zipfile.ZipInfo(f"{name}.npy"), buffer.getvalue())


def read_archive(path: Path) -> tuple[dict[str, Any], Arrays]:
    """Return the manifest and arrays of a zip.

    Raises:
        InputError: unreadable, not such a zip, or a member that is not what it claims.
    """
    try:
        with zipfile.ZipFile(path) as archive:
            members = archive.infolist()
            if len(members) > MAX_MEMBERS:
                raise _bad(path, f"{len(members)} members")
            if sum(info.file_size for info in members) > MAX_BYTES:
                raise _bad(path, f"it unpacks to more than {MAX_BYTES // 2**20} MB")
            manifest = _manifest(path, _member(path, archive, MANIFEST))
            arrays = {
                info.filename.removesuffix(".npy"): _array(path, info.filename, _member(path, archive, info.filename))
                for info in members
                if info.filename.endswith(".npy")
            }
    except OSError as error:
        raise InputError(
            "cannot_read", f"Cannot read {path}: {error.strerror or error}.", "Check the name.", file=path
        ) from error
    except (zipfile.BadZipFile, zlib.error, NotImplementedError, RuntimeError, EOFError) as error:
        raise _bad(path, f"it is not a sound zip ({error})") from error
    return manifest, arrays


def _bad(path: Path, what: str, where: str | None = None) -> InputError:
    return InputError("bad_model", f"{path} is not a model: {what}.", REMEDY, file=path, where=where)


def _member(path: Path, archive: zipfile.ZipFile, name: str) -> bytes:
    try:
        return archive.read(name)  # never more than the size that was checked above
    except KeyError as error:
        raise _bad(path, f"it holds no {name}", name) from error


def _manifest(path: Path, data: bytes) -> dict[str, Any]:
    try:
        value = json.loads(data, parse_constant=_no_constant)
    except (ValueError, RecursionError) as error:
        raise _bad(path, f"{MANIFEST} is not JSON ({error})", MANIFEST) from error
    if not isinstance(value, dict):
        raise _bad(path, f"{MANIFEST} is not an object", MANIFEST)
    return value


def _no_constant(name: str) -> float:
    raise ValueError(f"{name} is not a number")


def _array(path: Path, name: str, data: bytes) -> NDArray[Any]:
    """Read an npy of plain numbers, after holding its header against the bytes that are there."""
    stream = io.BytesIO(data)
    try:
        version = np.lib.format.read_magic(stream)
        read_header = np.lib.format.read_array_header_1_0 if version == (1, 0) else np.lib.format.read_array_header_2_0
        shape, _, dtype = read_header(stream)
        count = 1
        for length in shape:
            count *= int(length)
        if dtype.kind not in "fiub" or count * dtype.itemsize != len(data) - stream.tell():
            raise _bad(path, f"{name} does not hold the numbers that it claims", name)
        stream.seek(0)
        array = np.load(stream, allow_pickle=False)
    except ValueError as error:
        raise _bad(path, f"{name} is not an array ({str(error)[:120]})", name) from error
    return np.asarray(array)
