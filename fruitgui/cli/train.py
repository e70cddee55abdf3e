"""`fruitgui train`: a model from recordings and what an operator said of the fruit in them."""

from __future__ import annotations

import argparse
from pathlib import Path

from fruitgui.cli.console import Console
from fruitgui.cli.options import Commands, add_json, add_recording_options, check_output, source
from fruitgui.errors import InputError


def add(commands: Commands) -> None:
    """Add the command."""
    command = commands.add_parser("train", help="learn the kinds of fruit from labelled recordings")
    command.add_argument("recordings", type=Path, nargs="+", metavar="R.mcap")
    command.add_argument(
        "--labels", type=Path, nargs="+", required=True, metavar="L.csv", help="one for each recording"
    )
    command.add_argument("--station", type=Path, required=True, metavar="S.json")
    command.add_argument("--model", type=Path, required=True, metavar="OUT", help="the model file to write")
    command.add_argument("--seed", type=int, default=0, help="of the training's own randomness")
    add_recording_options(command)
    add_json(command)
    command.set_defaults(run=run)


def run(options: argparse.Namespace, console: Console) -> int:
    """Train and write the model; print what it learned and how well."""
    from fruitgui.station.train_job import train_recordings

    if len(options.recordings) != len(options.labels):
        raise InputError(
            "usage",
            f"{len(options.recordings)} recordings but {len(options.labels)} labels files.",
            "Give one labels file for each recording, in the same order.",
        )
    out = check_output(options.model, [*options.recordings, *options.labels, options.station])
    labelled = [
        (source(options, recording), labels)
        for recording, labels in zip(options.recordings, options.labels, strict=True)
    ]
    trained = train_recordings(labelled, options.station, out, options.seed, console.progress)
    console.warn(trained.warnings)
    console.result(trained.value(out))
    for line in trained.lines(out):
        console.say(line)
    return 0
