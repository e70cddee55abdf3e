"""Rays cast on one mesh (Embree through Open3D), on the calling thread only."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fruitgui.frame import F32, Bools
from fruitgui.simulation.mesh import Mesh


@dataclass(frozen=True, slots=True, eq=False)
class Hits:
    """Where rays met a mesh.

    Attributes:
        hit: (N,) which rays did.
        distance: (K,) of those, in units of the ray's direction.
        normal: (K, 3) outward, smooth between vertices, in the mesh's frame.
        albedo: (K, 3) linear reflectance.
    """

    hit: Bools
    distance: F32
    normal: F32
    albedo: F32


class Caster:
    """A mesh made ready for rays."""

    def __init__(self, mesh: Mesh) -> None:
        import open3d as o3d

        self._tensor = o3d.core.Tensor
        self._scene = o3d.t.geometry.RaycastingScene(nthreads=1)
        self._scene.add_triangles(
            o3d.core.Tensor(np.ascontiguousarray(mesh.vertices_m, dtype=np.float32)),
            o3d.core.Tensor(np.ascontiguousarray(mesh.triangles, dtype=np.uint32)),
        )
        self._corners = np.hstack([mesh.vertex_normals(), mesh.albedo])[mesh.triangles].astype(np.float32)

    def distances(self, rays: F32) -> F32:
        """Return the distances (N,) along rays (N, 6: origin, direction), inf where they miss."""
        answer = self._scene.cast_rays(self._tensor(rays), nthreads=1)
        found: F32 = answer["t_hit"].numpy()
        return found

    def hits(self, rays: F32) -> Hits:
        """Return what rays (N, 6: origin, direction) meet first."""
        answer = self._scene.cast_rays(self._tensor(rays), nthreads=1)
        distance = answer["t_hit"].numpy()
        hit = np.isfinite(distance)
        corners = self._corners[answer["primitive_ids"].numpy()[hit]]
        u, v = answer["primitive_uvs"].numpy()[hit].T[:, :, None]
        mixed = corners[:, 0] * (1 - u - v) + corners[:, 1] * u + corners[:, 2] * v
        normal = mixed[:, :3] / np.linalg.norm(mixed[:, :3], axis=1, keepdims=True)
        return Hits(hit, distance[hit], normal, mixed[:, 3:])
