"""Which device each sensor of a lot was: sensors have names that people give, devices have serials."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path

from fruitgui.errors import InputError
from fruitgui.records.store import Store
from fruitgui.station.station_file import station_of


def serials_of(store: Store, lot: int) -> Mapping[str, str]:
    """Return the serials of a lot's sensors, by name; empty where a sensor had none.

    They are read from the station that the lot keeps: a line runs a device under a name only where its serial is that
    of the station. Where a lot keeps no station that can be read, none is known.

    Raises:
        WorldError: the records cannot be read.
    """
    text = store.lots.station_text(lot)
    try:
        sensors = {} if text is None else station_of(json.loads(text), Path("station.json")).sensors
    except (InputError, ValueError):
        return {}
    return {name: sensor.serial for name, sensor in sensors.items()}
