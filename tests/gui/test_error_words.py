"""Whatever the core complains of, the window has words for, in both languages."""

from __future__ import annotations

import ast
import importlib
import re
import string
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest
from PySide6.QtWidgets import QApplication

import fruitgui
from fruitgui.errors import FruitguiError, InputError, WorldError
from fruitgui.gui.error_words import told, words
from fruitgui.gui.health import warning_message
from fruitgui.gui.help_window import manual_page
from fruitgui.gui.messages import Level
from fruitgui.gui.session import Session
from fruitgui.gui.translate import LANGUAGES, Language
from fruitgui.records.told import _SAID
from fruitgui.station.live.state import LiveWarning

SOURCE = Path(fruitgui.__file__).parent
ROOMS = tuple(
    name for name in ("calibration", "classification", "geometry", "measurement", "perception", "records", "sensors",
                      "simulation", "station", "tracking") if (SOURCE / name).is_dir()
)  # fmt: skip
ERRORS = {"InputError", "WorldError", "FruitguiError"}
STOPPED = "cancelled"
"""What a person did; nobody tells it back."""

PASSED_ON = {"error.code", "code"}
"""Where an error is told again with its own code."""


@dataclass(frozen=True, slots=True)
class Site:
    """A place in the source that raises an error of a code and gives these names to its words."""

    code: str
    at: str
    given: frozenset[str]


def _codes(node: ast.expr, module: object) -> list[str]:
    """Return the codes that an expression can be."""
    match node:
        case ast.Constant(value=str(code)):
            return [code]
        case ast.IfExp(body=one, orelse=other):
            return _codes(one, module) + _codes(other, module)
        case ast.Name(id=name) if hasattr(module, name):
            return [str(getattr(module, name))]
        case _:
            assert ast.unparse(node) in PASSED_ON, f"{ast.unparse(node)} is no code that can be looked up"
            return []


def _given(call: ast.Call) -> frozenset[str]:
    names = {"file", "path"} if any(one.arg == "file" for one in call.keywords) else set()
    for one in call.keywords:
        if one.arg == "values" and isinstance(one.value, ast.Dict):
            names |= {str(key.value) for key in one.value.keys if isinstance(key, ast.Constant)}
    return frozenset(names)


def _raises(call: ast.Call) -> bool:
    match call.func:
        case ast.Name(id=name):
            return name in ERRORS
        case ast.Attribute(attr="__init__", value=ast.Call(func=ast.Name(id="super"))):
            return len(call.args) > 1  # an error of a class of its own
        case _:
            return False


def _sites() -> Iterator[Site]:
    rooms = (path for room in ROOMS for path in sorted((SOURCE / room).rglob("*.py")))
    for path in (*rooms, *sorted(SOURCE.glob("*.py"))):
        name = ".".join(("fruitgui", *path.relative_to(SOURCE).with_suffix("").parts))
        calls = [node for node in ast.walk(ast.parse(path.read_text("utf-8"))) if isinstance(node, ast.Call)]
        for call in calls:
            if _raises(call) and call.args:
                if isinstance(call.func, ast.Attribute) and not isinstance(call.args[0], ast.Constant):
                    continue
                codes = _codes(call.args[0], importlib.import_module(name))
                yield from (Site(code, f"{name}:{call.lineno}", _given(call)) for code in codes if code != STOPPED)
    yield from (Site(code, "fruitgui.records.told", frozenset({"file", "path"})) for code in _SAID)


SITES = tuple(_sites())


def _fields(code: str) -> set[str]:
    return {name for text in words()[code] for _, name, _, _ in string.Formatter().parse(text) if name}


def test_every_error_of_the_core_has_words() -> None:
    assert len({site.code for site in SITES}) > 50
    assert {site.code: site.at for site in SITES if site.code not in words()} == {}


def test_every_error_gives_what_its_words_name() -> None:
    lacking = {site.at: _fields(site.code) - site.given for site in SITES if _fields(site.code) - site.given}
    assert lacking == {}


def test_no_words_are_left_of_errors_that_are_gone() -> None:
    assert set(words()) - {site.code for site in SITES} == {"unexpected"}, "the window's own edge raises that one"


def _warnings() -> set[str]:
    """Return the codes of all that the running line warns of."""
    codes = set()
    for path in sorted((SOURCE / "station" / "live").rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            match node:
                case ast.Call(
                    func=ast.Attribute(attr="add" | "_warn") | ast.Name(id="LiveWarning"),
                    args=[ast.Constant(value=str(code)), _, *_],
                ):
                    codes.add(code)
                case _:
                    pass
    assert len(codes) > 6
    return codes


def test_every_warning_of_the_running_line_has_words() -> None:
    for code in _warnings():
        assert warning_message(LiveWarning(code, "as the core says it", ("left_1",))).what != "as the core says it", (
            code
        )


@pytest.mark.parametrize("name", sorted(LANGUAGES))
def test_the_manual_tells_of_every_warning_in_the_windows_words(qapp: QApplication, name: str) -> None:
    language = Language()
    told = [phrase.split("…") for phrase in re.findall(r"\*([^*\n]+)\*", manual_page(name).read_text("utf-8"))]
    language.put_on(qapp, name)
    try:
        said = {code: warning_message(LiveWarning(code, "", ("left_1",))).what for code in _warnings()}
    finally:
        language.put_on(qapp, "en")
    for code, what in said.items():
        assert any(all(part.strip() in what for part in parts) for parts in told if len("".join(parts)) > 12), code


@pytest.mark.parametrize("code", sorted(words()))
def test_the_core_speaks_spanish(qapp: QApplication, code: str) -> None:
    language = Language()
    english = words()[code]
    language.put_on(qapp, "es")
    try:
        spanish = words()[code]
        assert all(one != other for one, other in zip(english, spanish, strict=True))
    finally:
        language.put_on(qapp, "en")


def test_what_an_error_names_is_said() -> None:
    said = told(InputError("lot_open", "…", "…", values={"lot": "1184 {x}"}))
    assert said.what == "Lot 1184 {x} is still open."
    said = told(InputError("bad_labels", "…", "…", file=Path("/far/away/labels.csv"), where="line 3"))
    assert said.what.startswith("labels.csv cannot be used")
    assert "line 3" in said.what
    assert "/far" not in said.what
    assert "/far/away/labels.csv" in told(InputError("cannot_read", "…", "…", file=Path("/far/away/labels.csv"))).what


@pytest.mark.parametrize(
    "error",
    [WorldError("never_heard_of", "It broke.", "Mend it."), WorldError("sensor_silent", "It broke.", "Mend it.")],
)
def test_an_error_that_cannot_be_worded_speaks_for_itself(error: FruitguiError) -> None:
    assert (told(error).what, told(error).remedy) == ("It broke.", "Mend it.")


def test_the_log_keeps_what_the_core_said_exactly(session: Session, caplog: pytest.LogCaptureFixture) -> None:
    messages = session.messages
    messages.error(InputError("bad_station", "station.json: sensors.a.pose: not a rotation.", "Calibrate again."))
    assert messages.history[-1].level is Level.BAD
    assert "not a rotation" in caplog.text
