"""How fast one frame is perceived, beside Open3D's own plane and clusters on the same frame."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from time import thread_time

import numpy as np

from fruitgui.frame import Frame
from fruitgui.geometry.plane import Surface
from fruitgui.perception.perceiver import Perceiver


@dataclass(frozen=True, slots=True)
class PerceptionBenchmark:
    """Figures of one run.

    Attributes:
        fruit: views found in the frame.
        perceive_ms: median CPU time of one frame, all product features, one thread.
        open3d_ms: CPU time of Open3D's `segment_plane` and `cluster_dbscan` on the same frame.
        open3d_clusters: clusters that it found.
    """

    fruit: int
    perceive_ms: float
    open3d_ms: float
    open3d_clusters: int

    def __str__(self) -> str:
        ratio = self.open3d_ms / self.perceive_ms
        return (
            f"perceiving one frame with {self.fruit} fruit: {self.perceive_ms:.1f} ms; Open3D segment_plane + "
            f"cluster_dbscan: {self.open3d_ms:.0f} ms ({self.open3d_clusters} clusters); ratio {ratio:.0f}"
        )


def crowded_frame(fruit: int = 28, touching: float = 0.0) -> tuple[Frame, Surface]:
    """Return the first simulated frame that shows each of so many fruit, and the belt in it."""
    from fruitgui.simulation.scenes import still_scene

    for seed in range(20):
        scene = still_scene(seed, "opposed", fruit, captures=1, touching=touching)
        for frame in scene.frames():
            surface = scene.truth.surfaces[frame.sensor]
            if len(Perceiver(frame.sensor, frame.intrinsics, surface).observe(frame, 0.0).views) == fruit:
                return frame, surface
    raise RuntimeError(f"no simulated frame shows {fruit} fruit")


def benchmark(fruit: int = 28, repeats: int = 60, *, touching: float = 0.0) -> PerceptionBenchmark:
    """Time the perception of one crowded 640×480 frame and Open3D on the same frame."""
    frame, surface = crowded_frame(fruit, touching)
    perceiver = Perceiver(frame.sensor, frame.intrinsics, surface)
    seen = perceiver.observe(frame, 0.0).views
    ours = median_ms(lambda: perceiver.observe(frame, 0.0), repeats)
    started = thread_time()
    clusters = open3d_clusters(frame)
    return PerceptionBenchmark(len(seen), ours, (thread_time() - started) * 1e3, clusters)


def median_ms(work: Callable[[], object], repeats: int) -> float:
    """Return the median CPU time of this thread for a piece of work, milliseconds, after three runs to warm up."""
    for _ in range(3):
        work()
    times = []
    for _ in range(repeats):
        started = thread_time()
        work()
        times.append(thread_time() - started)
    return float(np.median(times) * 1e3)


def open3d_clusters(frame: Frame) -> int:
    """Return how many clusters Open3D finds above the plane that it fits: the plain way of doing this."""
    import open3d

    points = frame.points().reshape(-1, 3)
    cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(points[points[:, 2] > 0].astype(np.float64)))
    _, inside = cloud.segment_plane(distance_threshold=0.008, ransac_n=3, num_iterations=200)
    above = cloud.select_by_index(inside, invert=True)
    labels = np.asarray(above.cluster_dbscan(eps=0.008, min_points=10))
    return int(labels.max(initial=-1)) + 1
