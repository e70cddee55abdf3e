"""`python -m tests.emulated_usb SCRIPT ARGUMENTS…`: a command of fruitgui among emulated Kinects that stream.

SCRIPT is a JSON object (or the name of a file that holds one):
    {"kinects": [{"serial": "A1", "model": 0, "bus": 1}, …],
     "faults": [{"at_s": 2.0, "what": "unplug", "kinect": 0, "value": 1}, …],
     "seed": 0, "control_fd": N}
Lines of JSON that come on the file descriptor `control_fd` are faults that happen at once.
"""

from __future__ import annotations

import json
import os
import sys
import threading
from pathlib import Path
from typing import Any

from tests.emulated_usb.emulation import Emulation, Kinect
from tests.emulated_usb.player import Fault, Player


def main(arguments: list[str]) -> int:
    """Run a command."""
    script: dict[str, Any] = json.loads(
        arguments[0] if arguments[0].startswith("{") else Path(arguments[0]).read_text()
    )
    usb = Emulation()
    usb.plug_in(*(Kinect(**one) for one in script.get("kinects", [])))
    player = Player(usb, faults=[Fault(**one) for one in script.get("faults", [])], seed=script.get("seed", 0))
    if "control_fd" in script:
        threading.Thread(target=_listen, args=(player, script["control_fd"]), daemon=True).start()
    from fruitgui.cli import main as fruitgui

    with player:
        return fruitgui(arguments[1:])


def _listen(player: Player, descriptor: int) -> None:
    with os.fdopen(descriptor) as lines:
        for line in lines:
            player.do(Fault(**{"at_s": 0.0, **json.loads(line)}))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
