"""`fruitgui run`: a recording through the line; a report in which every fruit is counted once."""

from __future__ import annotations

import argparse
from pathlib import Path

from fruitgui.cli.console import Console
from fruitgui.cli.options import Commands, add_json, add_recording_options, check_output, finite, source
from fruitgui.errors import InputError

FASTEST_BELT_M_S = 10.0


def add(commands: Commands) -> None:
    """Add the command."""
    command = commands.add_parser("run", help="count and measure the fruit of a recording")
    command.add_argument("recording", type=Path, metavar="R.mcap")
    command.add_argument("--station", type=Path, required=True, metavar="S.json")
    command.add_argument("--model", type=Path, metavar="M", help="instead of the model that the station names")
    command.add_argument("--paper", action="store_true", help="add each fruit's volume by the source's method")
    command.add_argument("--belt-speed", metavar="M_S", help="metres per second, where it is known")
    command.add_argument("--report", type=Path, required=True, metavar="OUT.json")
    add_recording_options(command)
    add_json(command)
    command.set_defaults(run=run)


def run(options: argparse.Namespace, console: Console) -> int:
    """Run the line over the recording and write the report."""
    from fruitgui.station.report import summary_lines, write_report
    from fruitgui.station.run_job import RunOptions, named_model, run_recording

    out = check_output(options.report, [options.recording, options.station, options.model])
    check_output(out, [named_model(options.station)])
    wishes = RunOptions(options.model, options.paper, _belt_speed(options.belt_speed))
    report = run_recording(source(options, options.recording), options.station, wishes, console.progress)
    write_report(out, report)
    console.warn(report["warnings"])
    console.result(report)
    for line in summary_lines(report):
        console.say(line)
    console.say(f"Report: {out}")
    return 0


def _belt_speed(text: str | None) -> float | None:
    if text is None:
        return None
    speed_m_s = finite(text, "--belt-speed")
    if not 0.0 < speed_m_s <= FASTEST_BELT_M_S:
        raise InputError(
            "usage", f"--belt-speed {speed_m_s:g} m/s cannot be.", f"Give 0 to {FASTEST_BELT_M_S:g} metres per second."
        )
    return speed_m_s
