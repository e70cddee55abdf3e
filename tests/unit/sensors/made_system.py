"""Linux systems made of files: the parts of sysfs, proc and dev that tell of USB, as the kernel lays them out."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from fruitgui.sensors.usb.machine import Machine

PCI = "sys/devices/pci0000:00"
KINECT_CAMERA, KINECT_MOTOR, KINECT_AUDIO = 0x02AE, 0x02B0, 0x02AD


@dataclass
class MadeSystem:
    """A system below a folder; `closed` are the paths of devices that the person may not use."""

    root: Path
    closed: set[str] = field(default_factory=set)
    _addresses: dict[str, int] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for part in ("sys/bus/usb/devices", "proc", "dev/bus/usb", "etc/udev"):
            (self.root / part).mkdir(parents=True, exist_ok=True)

    @property
    def machine(self) -> Machine:
        return Machine(self.root, self._usable)

    def controller(self, address: str, *buses: int, driver: str = "xhci_hcd") -> None:
        """Add a controller; the first of its buses is USB 2, a second one USB 3."""
        chip = self.root / PCI / address
        drivers = self.root / "sys/bus/pci/drivers" / driver
        drivers.mkdir(parents=True, exist_ok=True)
        for number, bus in enumerate(buses):
            hub = chip / f"usb{bus}"
            hub.mkdir(parents=True)
            self._write(hub, idVendor="1d6b", idProduct="0002", busnum=bus, devnum=1, speed=5000 if number else 480)
            self._link(hub)
        (chip / "driver").symlink_to(drivers)

    def plug(
        self, path: str, vendor: int, product: int, *, serial: str = "", speed: float = 480, release: int = 0,
        name: str = "", driver: str = "", node: bool = True, **attributes: object,
    ) -> None:  # fmt: skip
        """Plug a device in at a port, for example 1-1.4."""
        bus = int(path.partition("-")[0])
        address = self._addresses[path] = len(self._addresses) + 2
        place = self._root_hub(bus) / path
        place.mkdir(parents=True)
        texts = {"serial": serial, "product": name, "bcdDevice": f"{release:04x}" if release else ""}
        self._write(
            place, idVendor=f"{vendor:04x}", idProduct=f"{product:04x}", busnum=bus, devnum=address, speed=f"{speed:g}",
            bMaxPower="500mA", version=" 2.00", **{key: text for key, text in texts.items() if text}, **attributes,
        )  # fmt: skip
        self._link(place)
        if driver:
            interface = place / f"{path}:1.0"
            interface.mkdir()
            (interface / "driver").symlink_to(f"../../../../bus/usb/drivers/{driver}")
            self._link(interface)
        if node:
            self._node(bus, address).parent.mkdir(parents=True, exist_ok=True)
            self._node(bus, address).touch()

    def kinect(
        self, hub: str, serial: str, *, release: int = 0x010B, driver: str = "", powered: bool = True,
        microphone: str = "",
    ) -> str:  # fmt: skip
        """Plug a Kinect in: its own hub with motor, audio and camera; return the camera's path."""
        self.plug(hub, 0x0409, 0x005A)
        self.plug(f"{hub}.1", 0x045E, KINECT_MOTOR, name="Xbox NUI Motor", speed=12)
        if powered:
            self.plug(f"{hub}.2", 0x045E, KINECT_AUDIO, name="Xbox NUI Audio", serial=microphone)
            self.plug(f"{hub}.3", 0x045E, KINECT_CAMERA, serial=serial, release=release, driver=driver)
        return f"{hub}.3"

    def run(self, pid: int, program: str, *held: str) -> None:
        """Let a program run that has devices open."""
        folder = self.root / "proc" / str(pid) / "fd"
        folder.mkdir(parents=True)
        (folder.parent / "comm").write_text(f"{program}\n")
        (folder / "0").symlink_to("/dev/null")
        for number, path in enumerate(held, start=3):
            (folder / str(number)).symlink_to(f"/dev/bus/usb/{int(path[0]):03d}/{self._addresses[path]:03d}")

    def address(self, path: str) -> int:
        return self._addresses[path]

    def usbfs_memory(self, text: object) -> None:
        file = self.machine.usbfs_memory
        file.parent.mkdir(parents=True)
        file.write_text(f"{text}\n")

    def _usable(self, node: Path) -> bool:
        return node not in {self._node(int(path[0]), self._addresses[path]) for path in self.closed}

    def _node(self, bus: int, address: int) -> Path:
        return self.root / f"dev/bus/usb/{bus:03d}/{address:03d}"

    def _root_hub(self, bus: int) -> Path:
        return next((self.root / PCI).glob(f"*/usb{bus}"))

    def _link(self, place: Path) -> None:
        link = self.root / "sys/bus/usb/devices" / place.name
        link.symlink_to(Path("../../../devices") / place.relative_to(self.root / "sys/devices"))

    def _write(self, place: Path, **attributes: object) -> None:
        for name, value in attributes.items():
            (place / name).write_text(f"{value}\n")


def made_system(root: Path) -> MadeSystem:
    """Return a system with one USB 3 controller, as most computers have: bus 1 for USB 2, bus 2 for USB 3."""
    system = MadeSystem(root)
    system.controller("0000:00:14.0", 1, 2)
    return system
