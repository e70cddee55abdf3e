"""Closed triangle meshes: their volume, centre of volume, callipers and outline."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fruitgui.frame import F32, F64, Ints


@dataclass(frozen=True, slots=True, eq=False)
class Mesh:
    """A closed surface of triangles, seen from outside counter-clockwise.

    Attributes:
        vertices_m: (V, 3), in the body's own frame.
        triangles: (T, 3) indices of vertices.
        albedo: (V, 3) linear RGB reflectance, 0–1.
        gloss: brightness of the lamp's mirror image on it, 0 for matt.
    """

    vertices_m: F64
    triangles: Ints
    albedo: F32
    gloss: float = 0.0

    def volume_m3(self) -> float:
        """Return the enclosed volume (divergence theorem; exact for the mesh)."""
        a, b, c = self._corners()
        return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6.0)

    def centre_m(self) -> F64:
        """Return the centre of the enclosed volume, (3,)."""
        a, b, c = self._corners()
        six_volumes = np.einsum("ij,ij->i", a, np.cross(b, c))
        return np.asarray(((a + b + c) * six_volumes[:, None]).sum(axis=0) / (4.0 * six_volumes.sum()))

    def centred(self) -> Mesh:
        """Return the same body with its centre of volume at the origin."""
        return Mesh(self.vertices_m - self.centre_m(), self.triangles, self.albedo, self.gloss)

    def scaled_to(self, volume_m3: float) -> Mesh:
        """Return the same shape with the given volume."""
        return Mesh(
            self.vertices_m * (volume_m3 / self.volume_m3()) ** (1 / 3), self.triangles, self.albedo, self.gloss
        )

    def turned(self, rotation: F64) -> Mesh:
        """Return the body turned about its origin by a 3×3 rotation."""
        return Mesh(self.vertices_m @ rotation.T, self.triangles, self.albedo, self.gloss)

    def vertex_normals(self) -> F32:
        """Return unit outward normals at the vertices, (V, 3), triangles weighted by their area."""
        a, b, c = self._corners()
        facets = np.cross(b - a, c - a)
        corners, count = self.triangles.T.ravel(), len(self.vertices_m)
        normals = np.stack([np.bincount(corners, np.tile(part, 3), count) for part in facets.T], axis=1)
        lengths = np.linalg.norm(normals, axis=1, keepdims=True)
        return np.asarray(normals / np.maximum(lengths, 1e-30), dtype=np.float32)

    def _corners(self) -> tuple[F64, F64, F64]:
        corners = self.vertices_m[self.triangles]
        return corners[:, 0], corners[:, 1], corners[:, 2]


@dataclass(frozen=True, slots=True)
class Callipers:
    """Size of a body.

    Attributes:
        length_m: the largest calliper distance.
        diameter_m: the largest calliper distance at right angles to the length.
    """

    length_m: float
    diameter_m: float


def callipers(mesh: Mesh) -> Callipers:
    """Measure a body's length and diameter from its vertices."""
    start, end = farthest_pair(mesh.vertices_m)
    axis = end - start
    length_m = float(np.linalg.norm(axis))
    _, _, Vt = np.linalg.svd(axis[None, :] / length_m)
    across = mesh.vertices_m @ Vt[1:].T
    first, second = farthest_pair(across[_hull_2d(across)])
    return Callipers(length_m, float(np.linalg.norm(second - first)))


def extreme_points(points: F64, directions: int) -> F64:
    """Return those of (N, D) points that lie farthest in one of so many directions, spread evenly at random."""
    toward = np.random.default_rng(0).normal(size=(directions, points.shape[1])).astype(np.float32)
    return np.asarray(points[np.unique((toward @ points.T.astype(np.float32)).argmax(axis=1))])


def farthest_pair(points: F64) -> tuple[F64, F64]:
    """Return the two points farthest apart of (N, D) points: all pairs of those that are extreme in some direction."""
    extreme = extreme_points(points, 300)
    gaps = np.linalg.norm(extreme[:, None] - extreme[None, :], axis=2)
    start = extreme[int(gaps.max(axis=1).argmax())]
    for _ in range(8):
        end = points[int(np.linalg.norm(points - start, axis=1).argmax())]
        start, end = end, start
    return start, points[int(np.linalg.norm(points - start, axis=1).argmax())]


def _hull_2d(points: F64) -> Ints:
    import cv2

    hull: Ints = cv2.convexHull(points.astype(np.float32), returnPoints=False).ravel()
    return hull


def outline_length_m(mesh: Mesh, normal: F64, directions: int = 720) -> float:
    """Return the perimeter of the body's outline seen along `normal` (3,), the body star-shaped in that view.

    The outline of a mesh consists of projected edges; it is traced by rays from the middle
    of the projection to the farthest edge in each direction.
    """
    _, _, Vt = np.linalg.svd(normal[None, :])
    flat = mesh.vertices_m @ Vt[1:].T
    flat = flat - flat[_hull_2d(flat)].mean(axis=0)
    edges = _edges(mesh.triangles)
    start, end = flat[edges[:, 0]], flat[edges[:, 1]]
    radii = _farthest_crossing(start, end, directions)
    angles = np.arange(directions) * 2 * np.pi / directions
    rim = np.stack([radii * np.cos(angles), radii * np.sin(angles)], axis=1)
    return float(np.linalg.norm(rim - np.roll(rim, 1, axis=0), axis=1).sum())


def _edges(triangles: Ints) -> Ints:
    """Return each edge of a closed mesh once, (E, 2)."""
    pairs = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    return pairs[pairs[:, 0] < pairs[:, 1]]


def _farthest_crossing(start: F64, end: F64, directions: int) -> F64:
    """Return per direction the largest distance from the origin at which its ray crosses a segment."""
    step = 2 * np.pi / directions
    first = np.arctan2(start[:, 1], start[:, 0])
    turn = (np.arctan2(end[:, 1], end[:, 0]) - first + np.pi) % (2 * np.pi) - np.pi
    low, high = np.minimum(first, first + turn), np.maximum(first, first + turn)
    from_step, to_step = np.ceil(low / step).astype(int), np.floor(high / step).astype(int)
    counts = np.maximum(to_step - from_step + 1, 0)
    segment = np.repeat(np.arange(len(start)), counts)
    offset = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    index = from_step[segment] + offset
    ray = np.stack([np.cos(index * step), np.sin(index * step)], axis=1)
    along = end[segment] - start[segment]
    cross = ray[:, 0] * along[:, 1] - ray[:, 1] * along[:, 0]
    crossing = start[segment, 0] * along[:, 1] - start[segment, 1] * along[:, 0]
    distance = crossing / np.where(np.abs(cross) < 1e-15, 1e-15, cross)
    radii = np.zeros(directions)
    np.maximum.at(radii, index % directions, np.where(np.abs(cross) < 1e-15, 0.0, distance))
    return radii


def icosphere(subdivisions: int) -> tuple[F64, Ints]:
    """Return unit directions (V, 3) and triangles (T, 3) of a subdivided icosahedron (T = 20·4^subdivisions)."""
    golden = (1 + 5**0.5) / 2
    corners: list[tuple[float, float, float]] = [
        (-1, golden, 0),
        (1, golden, 0),
        (-1, -golden, 0),
        (1, -golden, 0),
        (0, -1, golden),
        (0, 1, golden),
    ]
    corners += [(0, -1, -golden), (0, 1, -golden), (golden, 0, -1), (golden, 0, 1), (-golden, 0, -1), (-golden, 0, 1)]
    vertices = np.array(corners, dtype=np.float64)
    triangles = np.array(
        [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6),
         (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10),
         (8, 6, 7), (9, 8, 1)]
    )  # fmt: skip
    for _ in range(subdivisions):
        vertices, triangles = _subdivided(vertices, triangles)
    return vertices / np.linalg.norm(vertices, axis=1, keepdims=True), triangles


def _subdivided(vertices: F64, triangles: Ints) -> tuple[F64, Ints]:
    sides = np.sort(np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2), axis=2)
    edges, inverse = np.unique(sides.reshape(-1, 2), axis=0, return_inverse=True)
    middles = vertices[edges].mean(axis=1)
    middles /= np.linalg.norm(middles, axis=1, keepdims=True) / np.linalg.norm(vertices[0])
    ab, bc, ca = (inverse.reshape(-1, 3) + len(vertices)).T
    a, b, c = triangles.T
    parts = [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
    return np.vstack([vertices, middles]), np.concatenate([np.stack(part, axis=1) for part in parts])
