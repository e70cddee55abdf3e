"""What a person changes about a connection: each change returns a new connection."""

from __future__ import annotations

from collections.abc import Sequence

from fruitgui.station.connection import ConnectedSensor, Connection


def renamed(connection: Connection, name: str, new_name: str) -> Connection:
    """Return the connection with a sensor under another name; a reference keeps its role.

    Raises:
        ValueError: the name is taken, or cannot be a name.
    """
    sensors = tuple(
        one.model_copy(update={"name": new_name}) if one.name == name else one for one in connection.sensors
    )
    reference = new_name if connection.reference == name else connection.reference
    return _checked(connection, sensors, reference)


def moved(connection: Connection, name: str, by: int) -> Connection:
    """Return the connection with a sensor moved by so many places; it stays within the row, and so does the reference.

    Who the reference is does not change: where it was only the first, it is named.
    """
    sensors = list(connection.sensors)
    place = _place(sensors, name)
    one = sensors.pop(place)
    sensors.insert(min(max(place + by, 0), len(sensors)), one)
    return _checked(connection, sensors, connection.reference_name)


def referred_to(connection: Connection, name: str) -> Connection:
    """Return the connection with another reference."""
    return _checked(connection, connection.sensors, name)


def without(connection: Connection, name: str) -> Connection:
    """Return the connection without a sensor; where that was the reference, the first of the others becomes it.

    Raises:
        ValueError: it is the only one.
    """
    sensors = [one for one in connection.sensors if one.name != name]
    reference = None if connection.reference_name == name else connection.reference
    return _checked(connection, sensors, reference)


def _place(sensors: Sequence[ConnectedSensor], name: str) -> int:
    return next(place for place, one in enumerate(sensors) if one.name == name)


def _checked(connection: Connection, sensors: Sequence[ConnectedSensor], reference: str | None) -> Connection:
    values = connection.model_dump() | {
        "sensors": [one.model_dump() for one in sensors],
        "reference": reference,
    }
    return Connection.model_validate(values)
