"""Recordings: MCAP files with ROS 2 messages and ROS 1 bags, read and written."""

from fruitgui.sensors.recordings.recording import Recording, open_recording
from fruitgui.sensors.recordings.recovery import Recovered, recover
from fruitgui.sensors.recordings.series import parts_after
from fruitgui.sensors.recordings.series_writer import SeriesWriter, Split
from fruitgui.sensors.recordings.topics import SensorTopics, parse_topics
from fruitgui.sensors.recordings.writer import RecordingWriter

__all__ = [
    "Recording",
    "RecordingWriter",
    "Recovered",
    "SensorTopics",
    "SeriesWriter",
    "Split",
    "open_recording",
    "parse_topics",
    "parts_after",
    "recover",
]
