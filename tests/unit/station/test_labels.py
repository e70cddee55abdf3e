from __future__ import annotations

from pathlib import Path

import pytest

from fruitgui.errors import InputError
from fruitgui.station.labels import read_labels

HEADER = "sensor,time_s,u_px,v_px,kind,volume_ml"


def written(tmp_path: Path, text: str) -> Path:
    path = tmp_path / "l.csv"
    path.write_bytes(text.encode())
    return path


def test_rows_are_read_with_and_without_the_optional_columns(tmp_path: Path) -> None:
    path = written(tmp_path, HEADER + ",fruit,mass_g\r\nk1,1.5,10,20,limón,112.5,f1,120\r\nk2,2,3,4,lemon,,,\r\n")
    first, second = read_labels(path).labels
    assert (first.sensor, first.kind, first.volume_ml, first.fruit, first.mass_g) == ("k1", "limón", 112.5, "f1", 120.0)
    assert (second.volume_ml, second.fruit, second.mass_g, second.line) == (None, None, None, 3)
    assert [label.fruit for label in read_labels(written(tmp_path, HEADER + "\nk1,1,2,3,a,\n")).labels] == [None]


def test_a_byte_order_mark_and_quotes_are_no_trouble(tmp_path: Path) -> None:
    text = "\ufeff" + HEADER + '\nk1,1,2,3,"apple, red",\n'
    assert read_labels(written(tmp_path, text)).labels[0].kind == "apple, red"


def test_spaces_after_the_commas_are_no_trouble(tmp_path: Path) -> None:
    text = HEADER.replace(",", ", ") + "\nk1, 1, 2, 3, lemon, 4\n"
    label = read_labels(written(tmp_path, text)).labels[0]
    assert (label.kind, label.volume_ml) == ("lemon", 4.0)


@pytest.mark.parametrize(
    "row",
    ["k1,x,2,3,a,", "k1,nan,2,3,a,", "k1,1,inf,3,a,", "k1,1,2,3,,", ",1,2,3,a,", "k1,1,2,3,a,-4", "k1,1,2,3,a,much",
     "k1,1", "k1,1,2,3," + "a" * 65 + ",", "k1,1,2,3,a\x07,"],
)  # fmt: skip
def test_a_row_that_cannot_be_is_left_out_with_its_line(tmp_path: Path, row: str) -> None:
    read = read_labels(written(tmp_path, f"{HEADER}\nk1,1,2,3,a,\n{row}\n"))
    assert len(read.labels) == 1
    assert "line 3" in read.warnings[0]
    with pytest.raises(InputError) as caught:
        read_labels(written(tmp_path, f"{HEADER}\n{row}\n"))
    assert (caught.value.where or "").startswith("line 2, column ")


@pytest.mark.parametrize(
    ("row", "column", "value", "remedy"),
    [
        ("k1,nan,2,3,a,", "time_s", "'nan'", "Write a number"),
        ("k1,1,2,-inf,a,", "v_px", "'-inf'", "Write a number"),
        ("k1,1,2,3,a,much", "volume_ml", "'much'", "Write a number"),
        ("k1,1,2,3,a,-4", "volume_ml", "-4", "Write what was measured"),
        ("k1,1,2,3,a\x07,", "kind", "'a\\x07'", "printable letters"),
    ],
)
def test_what_is_wrong_is_told_with_file_line_column_value_and_remedy(
    tmp_path: Path, row: str, column: str, value: str, remedy: str
) -> None:
    path = written(tmp_path, f"{HEADER}\nk1,1,2,3,a,\n{row}\n")
    (warning,) = read_labels(path).warnings
    assert warning.startswith(f"{path}: line 3, column {column}: {value} is ")
    assert remedy in warning
    path = written(tmp_path, f"{HEADER}\n{row}\n")
    with pytest.raises(InputError) as caught:
        read_labels(path)
    error = caught.value
    assert (error.code, error.file, error.where) == ("bad_labels", str(path), f"line 2, column {column}")
    assert value in error.what
    assert remedy in error.remedy


@pytest.mark.parametrize("text", ["", "sensor,time_s\n1,2\n", HEADER, "\0\0\0", '"' + "x" * 200_000])
def test_a_file_that_is_no_labels_file_is_refused(tmp_path: Path, text: str) -> None:
    with pytest.raises(InputError) as caught:
        read_labels(written(tmp_path, text))
    assert caught.value.file
