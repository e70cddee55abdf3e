"""What is said of sensors, recordings, and the line that works on them: by code, what happened and what to do."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import QCoreApplication

translate = QCoreApplication.translate


def words() -> Mapping[str, tuple[str, str]]:
    """Return the sentences by code, in the language in force."""
    return {
        "bad_layout": (
            translate("Errors", "There is no simulated rig of this kind."),
            translate("Errors", "Choose one of the list."),
        ),
        "bad_source": (
            translate("Errors", "What the line was connected to cannot be read."),
            translate("Errors", "Connect again in step 1."),
        ),
        "bad_stamp": (
            translate("Errors", "A picture has a time that cannot be."),
            translate("Errors", "Check the sensor's clock."),
        ),
        "bad_topics": (
            translate("Errors", "The names of the topics cannot be read."),
            translate("Errors", "Check how they are written."),
        ),
        "cannot_encode": (
            translate("Errors", "A colour picture cannot be packed."),
            translate("Errors", "Look at the sensor."),
        ),
        "empty_recording": (
            translate("Errors", "{file} is empty."),
            translate("Errors", "Record again, or choose another file."),
        ),
        "end_of_stream": (
            translate("Errors", "The recording of {sensor} is over."),
            translate("Errors", "Start it again to see it anew."),
        ),
        "frame_size": (
            translate("Errors", "{sensor} gives pictures of another size than when it was calibrated."),
            translate("Errors", "Calibrate again."),
        ),
        "helper_lost": (
            translate("Errors", "A helping process has ended."),
            translate("Errors", "The line goes on without it."),
        ),
        "job_failed": (
            translate("Errors", "A part of the line's work failed."),
            translate("Errors", "The line goes on; if this comes often, calibrate again. The log says more."),
        ),
        "line_not_started": (
            translate("Errors", "The line could not be started."),
            translate("Errors", "Close other programs and try again. The log says more."),
        ),
        "matroska": (
            translate("Errors", "{file} is a video of an Azure Kinect's recorder, which cannot be read here."),
            translate("Errors", "Play it through the Azure Kinect's ROS driver and record that as .mcap or .bag."),
        ),
        "mixed_sizes": (
            translate("Errors", "The pictures of one sensor differ in size."),
            translate("Errors", "Record all of them at one resolution."),
        ),
        "no_frame": (
            translate("Errors", "Not one picture of {file} can be read."),
            translate("Errors", "Record again, or choose another file."),
        ),
        "no_frames": (
            translate("Errors", "A sensor gave no pictures."),
            translate("Errors", "Check that all sensors run, and try again."),
        ),
        "no_message": (
            translate("Errors", "Nothing can be saved from {file}."),
            translate("Errors", "Record again."),
        ),
        "no_process": (
            translate("Errors", "The simulated rig cannot be started."),
            translate("Errors", "Close other programs and try again."),
        ),
        "no_sensor": (
            translate("Errors", "{file} holds no sensor that this program knows."),
            translate("Errors", "Choose another recording."),
        ),
        "no_sensor_in_common": (
            translate("Errors", "None of the sensors is one of those that were calibrated."),
            translate("Errors", "Connect the sensors that were calibrated, or calibrate again."),
        ),
        "no_such_sensor": (
            translate("Errors", "The reference sensor is not there."),
            translate("Errors", "Choose another reference in step 1."),
        ),
        "no_turns": (
            translate("Errors", "No two of these sensors have to take turns."),
            translate("Errors", "There is nothing to measure; go on."),
        ),
        "no_views": (
            translate("Errors", "Fewer than two poses have a picture in the recording."),
            translate("Errors", "Check that poses and recording belong together."),
        ),
        "not_a_file": (
            translate("Errors", "{file} is a folder."),
            translate("Errors", "Choose a recording (.mcap or .bag)."),
        ),
        "not_a_recording": (
            translate("Errors", "{file} is not a recording that can be read."),
            translate("Errors", "Choose a recording (.mcap or .bag)."),
        ),
        "not_mcap": (
            translate("Errors", "{file} needs no recovery."),
            translate("Errors", "Use it as it is; it is read as far as it is sound."),
        ),
        "projector_not_seen": (
            translate("Errors", "{sensor} gave no picture in its turns."),
            translate("Errors", "Check its cable and power, or leave it out, and measure again."),
        ),
        "same_file": (
            translate("Errors", "{file} is the file that is to be recovered."),
            translate("Errors", "Choose another file to write to."),
        ),
        "sensor_failed": (
            translate("Errors", "{sensor} failed."),
            translate("Errors", "It is opened again by itself; if it stays away, unplug it and plug it in again."),
        ),
        "sensor_not_open": (
            translate("Errors", "A sensor is not open."),
            translate("Errors", "Connect again in step 1."),
        ),
        "sensor_not_started": (
            translate("Errors", "A sensor is not running."),
            translate("Errors", "Connect again in step 1."),
        ),
        "sensor_silent": (
            translate("Errors", "{sensor} gives no pictures."),
            translate("Errors", "Check its cable and power; it is opened again by itself when it returns."),
        ),
        "simulation_ended": (
            translate("Errors", "The simulated rig has ended."),
            translate("Errors", "It is started again by itself."),
        ),
        "sqlite_recording": (
            translate("Errors", "{file} is a ROS 2 recording in an SQLite file, which cannot be read here."),
            translate("Errors", "Turn it into MCAP with rosbags-convert, or choose another recording."),
        ),
        "too_many_sensors": (
            translate("Errors", "{file} holds more sensors than can be read together."),
            translate("Errors", "Choose a recording with fewer."),
        ),
        "unexpected": (
            translate("Errors", "Something went wrong in “{doing}” that this program did not foresee."),
            translate(
                "Errors",
                "Nothing that was saved is lost. Try again; if it happens again, send the log file (Help, Show log).",
            ),
        ),
        "unknown_sensor": (
            translate("Errors", "A sensor that is wanted is not there: {sensor}."),
            translate("Errors", "Leave it out, or calibrate again with it."),
        ),
        "unusable_sensor": (
            translate("Errors", "A sensor in the recording {file} cannot be used."),
            translate(
                "Errors", "Record it again with colour, depth, and their calibration. The log says what is missing."
            ),
        ),
        "no_udev": (
            translate("Errors", "This system has no udev."),
            translate("Errors", "The rules are of use on Linux with udev only; nothing is to be done."),
        ),
        "not_administrator": (
            translate("Errors", "Only the administrator of this computer may do that."),
            translate("Errors", "Ask whoever looks after this computer to do it."),
        ),
        "rules_not_installed": (
            translate("Errors", "The rules for the sensors were not installed."),
            translate(
                "Errors",
                "Try again with the administrator's password, or ask whoever looks after this computer.",
            ),
        ),
        "no_usb": (
            translate("Errors", "USB cannot be used on this computer."),
            translate("Errors", "Check that it is switched on."),
        ),
    }
