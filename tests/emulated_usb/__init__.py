"""Kinects that do not exist, on a USB bus that does not exist, under the real libfreenect.

`emulated_usb.c` stands in for libusb (see its head). It is built with gcc into a
temporary folder and loaded before anything else, so whatever meets it runs in a
process of its own.

A test that runs in such a process is written as any other and takes an
`Emulation` (`emulation.py`: plug, push pictures, faults, the register log):

    @inside
    def test_a_kinect_is_found(usb: Emulation, tmp_path: Path) -> None:
        usb.plug_in(Kinect("A1"), Kinect("B2", model=MODEL_1473))
        assert [one.serial for one in KinectDriver().devices()] == ["A1", "B2"]

Outside, pytest starts the process and shows what it printed where it fails; it
fails, too, where a thread or a USB handle is left over.

A `Player` (`player.py`) lets plugged-in Kinects stream by themselves, at their
pace or flat out, with faults by a script:

    with Player(usb, faults=[Fault(1.0, "unplug", 0), Fault(3.0, "plug_in", 0)]):
        ...

A command of fruitgui runs among emulated Kinects that stream with

    LD_PRELOAD=$(python -m tests.emulated_usb.outside) \\
        python -m tests.emulated_usb '{"kinects": [{"serial": "A1"}, {"serial": "B2"}]}' sensors --json

or, from a test, `run_command(script, "sensors", "--json")`, or `Command(script, …)` with faults on command
(`outside.py`).
"""
