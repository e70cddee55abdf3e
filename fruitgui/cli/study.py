"""`fruitgui study`: how far registration is off, against poses that are known."""

from __future__ import annotations

import argparse
from pathlib import Path

from fruitgui.cli.console import Console
from fruitgui.cli.options import Commands, add_json, add_recording_options, check_output, source


def add(commands: Commands) -> None:
    """Add the command."""
    command = commands.add_parser("study", help="hold registration against known poses (the source's figure 7)")
    command.add_argument("recording", type=Path, metavar="R.mcap")
    command.add_argument("--poses", type=Path, required=True, metavar="P.csv")
    command.add_argument("--report", type=Path, required=True, metavar="OUT.json")
    add_recording_options(command)
    add_json(command)
    command.set_defaults(run=run)


def run(options: argparse.Namespace, console: Console) -> int:
    """Study and write the report."""
    from fruitgui.files import write_json
    from fruitgui.station.study_job import study_recording, summary_lines

    out = check_output(options.report, [options.recording, options.poses])
    value = study_recording(source(options, options.recording), options.poses, console.progress)
    write_json(out, value)
    console.warn(value.get("warnings", []))
    console.result(value)
    for line in summary_lines(value):
        console.say(line)
    return 0
