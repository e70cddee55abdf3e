"""A simulated rig and line: frames in order of time, and the truth about them."""

from __future__ import annotations

import threading
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from fruitgui.frame import F64, U16, Frame
from fruitgui.geometry.plane import Plane, Surface
from fruitgui.geometry.pose import Pose
from fruitgui.geometry.rig import Mount, Rig
from fruitgui.simulation.body import Body
from fruitgui.simulation.device import Device
from fruitgui.simulation.light import Light
from fruitgui.simulation.mesh import callipers, outline_length_m
from fruitgui.simulation.motion import SpeedProfile
from fruitgui.simulation.rays import Caster
from fruitgui.simulation.render import Eye, Placed
from fruitgui.simulation.surroundings import Surroundings

UP = np.array([0.0, 0.0, 1.0])
BODY_MARGIN_M = 0.2
"""Bodies whose centre is farther than this outside the sensors' sight along the belt are left out of the pictures."""


MOST_CASTERS = 200
"""Bodies kept ready for rays, the latest used; a long line does not eat the memory."""


@dataclass(frozen=True, slots=True)
class Capture:
    """One capture: the true time (the reference sensor's clock) and the sensor."""

    time_s: float
    sensor: str


@dataclass(frozen=True, slots=True, eq=False)
class Scene:
    """Everything that is simulated; the same scene gives the same frames bit for bit.

    Attributes:
        seed: of all chance in the pictures.
        devices: the sensors, the first is the reference.
        surroundings: belt, rails, floor.
        light: of the hall.
        bodies: fruit and foreign objects.
        speed: of the belt.
        captures: in order of time.
    """

    seed: int
    devices: tuple[Device, ...]
    surroundings: Surroundings
    light: Light
    bodies: tuple[Body, ...]
    speed: SpeedProfile
    captures: tuple[Capture, ...]


@dataclass(frozen=True, slots=True)
class TrueFruit:
    """The truth about one thing on the belt.

    Attributes:
        fruit_id: its number, from 1.
        kind: what it is.
        volume_m3: of its mesh.
        length_m: the largest calliper distance.
        diameter_m: the largest calliper distance at right angles to the length.
        perimeter_m: of its outline projected along the belt's normal, at rest.
        foreign: not a fruit.
        touching: it touches another.
    """

    fruit_id: int
    kind: str
    volume_m3: float
    length_m: float
    diameter_m: float
    perimeter_m: float
    foreign: bool
    touching: bool


class Truth:
    """What is true of a scene; positions and poses are in the reference sensor's optical frame."""

    def __init__(self, scene: Scene) -> None:
        self._scene = scene
        self._bodies = {body.fruit_id: body for body in scene.bodies}
        self._from_world = scene.devices[0].pose.inverse()

    @cached_property
    def poses(self) -> Mapping[str, Pose]:
        """By sensor: the pose from its optical frame into the reference sensor's, without error."""
        exact = {}
        for device in self._scene.devices:
            pose = self._from_world @ device.pose
            exact[device.sensor] = Pose(pose.rotation, pose.translation_m, np.zeros((6, 6)))
        return exact

    @cached_property
    def surfaces(self) -> Mapping[str, Surface]:
        """By sensor: the belt's plane and region in its own optical frame."""
        return {device.sensor: _surface(device, self._scene.surroundings) for device in self._scene.devices}

    @cached_property
    def fruit(self) -> tuple[TrueFruit, ...]:
        """Everything on the belt, measured on its mesh."""
        return tuple(measured_on_mesh(body) for body in self._scene.bodies)

    def position_m(self, fruit_id: int, time_s: float) -> F64:
        """Return the centre of volume (3,) of a fruit at a true time, reference frame."""
        return self._from_world.apply(self.pose_in_world(fruit_id, time_s).translation_m)

    def pose_in_world(self, fruit_id: int, time_s: float) -> Pose:
        """Return the pose from a fruit's mesh frame into the world (on the belt, z up) at a true time."""
        return self._bodies[fruit_id].pose(time_s, self._scene.speed.travel_m(time_s))

    def velocity_m_s(self, time_s: float) -> F64:
        """Return the belt's velocity (3,) in the reference frame at a true time."""
        return self._from_world.turn(np.array([self._scene.speed.speed_m_s(time_s), 0.0, 0.0]))


def measured_on_mesh(body: Body) -> TrueFruit:
    """Return the truth about one body."""
    size = callipers(body.mesh)
    perimeter_m = outline_length_m(body.mesh, UP)
    return TrueFruit(
        body.fruit_id, body.kind, body.mesh.volume_m3(), size.length_m, size.diameter_m, perimeter_m, body.foreign,
        body.touching,
    )  # fmt: skip


def _surface(device: Device, surroundings: Surroundings, reach_m: float = 2.5) -> Surface:
    to_sensor = device.pose.inverse()
    belt, middle = surroundings.belt, float(device.pose.translation_m[0])
    low, high = max(belt.ends_m[0], middle - reach_m), min(belt.ends_m[1], middle + reach_m)
    half = belt.width_m / 2
    corners = np.array([[low, -half, 0.0], [high, -half, 0.0], [high, half, 0.0], [low, half, 0.0]])
    return Surface(Plane(UP, 0.0).mapped(to_sensor), to_sensor.apply(corners))


class Simulation:
    """Plays a scene. Frames depend on nothing but the scene and their number."""

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.truth = Truth(scene)
        self._eyes: dict[str, Eye] = {}
        self._casters: dict[int, Caster] = {}
        self._lock = threading.Lock()
        self._sights: dict[str, tuple[float, float]] = {}
        self._numbers = _sequence_numbers(scene)

    @property
    def sensors(self) -> tuple[str, ...]:
        """The sensors' ids; the first is the reference."""
        return tuple(device.sensor for device in self.scene.devices)

    @property
    def captures(self) -> tuple[Capture, ...]:
        """All captures that give a frame, in order of time."""
        return self.scene.captures

    def rig(self) -> Rig:
        """Return the rig with true poses and true surfaces."""
        mounts = {
            device.sensor: Mount(
                device.sensor, self.truth.poses[device.sensor], self.truth.surfaces[device.sensor], device.color_camera
            )
            for device in self.scene.devices
        }
        return Rig(self.sensors[0], mounts)

    def device(self, sensor: str) -> Device:
        """Return a sensor's description."""
        return next(device for device in self.scene.devices if device.sensor == sensor)

    def frames(self) -> Iterator[Frame]:
        """Yield all frames in order of true time, rendered as they are asked for."""
        for number in range(len(self.scene.captures)):
            yield self.frame(number)

    def frame(self, number: int) -> Frame:
        """Return the frame of capture `number` of `captures`."""
        capture = self.scene.captures[number]
        eye = self.eye(capture.sensor)
        rng = self._chance(number)
        bodies = self.in_sight(capture)
        depth_mm = eye.depth(bodies, rng)
        color_s = capture.time_s + eye.device.color_delay_s
        if eye.device.color_delay_s:
            bodies = self.in_sight(Capture(color_s, capture.sensor))
        speed = self.scene.speed
        color = eye.color(bodies, speed.travel_m(color_s), speed.speed_m_s(color_s), rng)
        stamp_s = capture.time_s - eye.device.clock_offset_s
        return Frame(capture.sensor, self._numbers[number], stamp_s, color, depth_mm, eye.device.color_camera)

    def showing(self, scene: Scene) -> Simulation:
        """Return another scene of the same rig and place and light; what was made ready of them is shared.

        A body that both scenes have must have the same number, and another body another one.
        """
        other = Simulation(scene)
        other._eyes, other._sights = self._eyes, self._sights
        other._casters, other._lock = self._casters, self._lock
        return other

    def own_depth_mm(self, number: int) -> U16:
        """Return the depth of capture `number` in the infrared camera's own picture, not registered to colour.

        Its camera is the device's `depth_camera`, `depth_to_color` the pose to the colour camera.
        """
        capture = self.scene.captures[number]
        return self.eye(capture.sensor).own_depth(self.in_sight(capture), self._chance(number))

    def _chance(self, number: int) -> np.random.Generator:
        return np.random.default_rng([self.scene.seed, 2, number])

    def in_sight(self, capture: Capture) -> tuple[Placed, ...]:
        """Return the bodies that may be in a capture's picture, placed at its time."""
        low, high = self._sight(capture.sensor)
        travel_m = self.scene.speed.travel_m(capture.time_s)
        near = [b for b in self.scene.bodies if low - BODY_MARGIN_M < b.start_m[0] + travel_m < high + BODY_MARGIN_M]
        return tuple(Placed(body, self._caster(body), body.pose(capture.time_s, travel_m)) for body in near)

    def rig_mount(self, sensor: str) -> Mount:
        """Return a sensor's true mount."""
        return Mount(sensor, self.truth.poses[sensor], self.truth.surfaces[sensor], self.device(sensor).color_camera)

    def _sight(self, sensor: str) -> tuple[float, float]:
        if sensor not in self._sights:
            self._sights[sensor] = sight_along_belt(self.rig_mount(sensor), self.device(sensor))
        return self._sights[sensor]

    def eye(self, sensor: str) -> Eye:
        """Return what renders a sensor's pictures."""
        if sensor not in self._eyes:
            number = self.sensors.index(sensor)
            rng = np.random.default_rng([self.scene.seed, 1, number])
            self._eyes[sensor] = Eye(self.device(sensor), self.scene.surroundings, self.scene.light, rng)
        return self._eyes[sensor]

    def _caster(self, body: Body) -> Caster:
        with self._lock:
            found = self._casters.pop(body.fruit_id, None) or Caster(body.mesh)
            self._casters[body.fruit_id] = found
            while len(self._casters) > MOST_CASTERS:
                del self._casters[next(iter(self._casters))]
            return found


def sight_along_belt(mount: Mount, device: Device) -> tuple[float, float]:
    """Return the smallest and largest x of the world that a sensor sees on the belt's plane; (0, 0) for none."""
    footprint = device.pose.apply(mount.footprint_m())
    if len(footprint) == 0:
        return 0.0, 0.0
    return float(footprint[:, 0].min()), float(footprint[:, 0].max())


def _sequence_numbers(scene: Scene) -> list[int]:
    counts: dict[str, int] = {}
    numbers = []
    for capture in scene.captures:
        numbers.append(counts.get(capture.sensor, 0))
        counts[capture.sensor] = numbers[-1] + 1
    return numbers
