"""Rays cast on one mesh (Embree through Open3D), on the calling thread only."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fruitgui.frame import F32, F64, Ints
from fruitgui.simulation.mesh import Mesh, extreme_points

RIM_DIRECTIONS = 400


@dataclass(frozen=True, slots=True, eq=False)
class Hits:
    """Where rays met a mesh; K of N rays did.

    Attributes:
        ray: (K,) their numbers.
        distance: (K,) in units of the ray's direction.
        facet: (K,) number of the triangle.
        normal: (K, 3) of the triangle, outward, unit length, in the mesh's frame.
        weight: (K, 2) of the triangle's second and third corner at the place hit.
    """

    ray: Ints
    distance: F32
    facet: Ints
    normal: F32
    weight: F32


class Caster:
    """A mesh made ready for rays.

    Attributes:
        rim_m: (R, 3) vertices that are extreme in some direction; enough to know where the body is in a picture.
        reach_m: the largest distance of a vertex from the origin.
    """

    def __init__(self, mesh: Mesh) -> None:
        import open3d as o3d

        self._tensor = o3d.core.Tensor
        self._scene = o3d.t.geometry.RaycastingScene(nthreads=1)
        self._scene.add_triangles(
            o3d.core.Tensor(np.ascontiguousarray(mesh.vertices_m, dtype=np.float32)),
            o3d.core.Tensor(np.ascontiguousarray(mesh.triangles, dtype=np.uint32)),
        )
        self._triangles = mesh.triangles
        self._skin = np.hstack([mesh.vertex_normals(), mesh.albedo]).astype(np.float32)
        self.rim_m: F64 = extreme_points(mesh.vertices_m, RIM_DIRECTIONS)
        self.reach_m = float(np.linalg.norm(mesh.vertices_m, axis=1).max())

    def distances(self, rays: F32) -> F32:
        """Return the distances (N,) along rays (N, 6: origin, direction), inf where they miss."""
        found: F32 = self._scene.cast_rays(self._tensor(rays), nthreads=1)["t_hit"].numpy()
        return found

    def hits(self, rays: F32) -> Hits:
        """Return what rays (N, 6: origin, direction) meet first."""
        answer = self._scene.cast_rays(self._tensor(rays), nthreads=1)
        distance = answer["t_hit"].numpy()
        ray = np.flatnonzero(np.isfinite(distance))
        parts = (
            answer[name].numpy().take(ray, axis=0) for name in ("primitive_ids", "primitive_normals", "primitive_uvs")
        )
        return Hits(ray, distance.take(ray), *parts)

    def skin(self, hits: Hits, which: Ints) -> tuple[F32, F32]:
        """Return normals (M, 3), smooth between vertices but not of unit length, and reflectances (M, 3) at hits."""
        corners = self._triangles.take(hits.facet.take(which), axis=0)
        second, third = hits.weight.take(which, axis=0).T[:, :, None]
        mixed = self._skin.take(corners[:, 0], axis=0) * (1 - second - third)
        mixed += self._skin.take(corners[:, 1], axis=0) * second
        mixed += self._skin.take(corners[:, 2], axis=0) * third
        return mixed[:, :3], mixed[:, 3:]
