# SPDX-FileCopyrightText: 2026 The vantage authors
# SPDX-License-Identifier: MIT
"""Where in a room a robot may start: the point at eye height that is farthest from every surface."""
import numpy as np

from . import plan

EYE_HEIGHT = 1.3
STEP = 0.2


def to_triangles(p, corners):
    """The distance from a point to the nearest of the triangles (n, 3, 3): the least of the distances to their planes, where
    the foot of the perpendicular lies inside, and to their edges."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    normal = np.cross(b - a, c - a)
    size = np.maximum(np.linalg.norm(normal, axis=1), 1e-12)
    height = np.einsum("ij,ij->i", p - a, normal) / size
    foot = p - (height / size)[:, None] * normal
    over = np.ones(len(corners), bool)
    best = np.full(len(corners), np.inf)
    for s, e in ((a, b), (b, c), (c, a)):
        d = e - s
        over &= np.einsum("ij,ij->i", np.cross(d, foot - s), normal) >= 0
        t = np.clip(np.einsum("ij,ij->i", p - s, d) / np.maximum(np.einsum("ij,ij->i", d, d), 1e-12), 0, 1)
        best = np.minimum(best, np.linalg.norm(p - s - t[:, None] * d, axis=1))
    return float(np.minimum(best, np.where(over, np.abs(height), np.inf)).min())


class Clearance:
    def __init__(self, corners):
        self.corners = corners
        self.middle = corners.mean(axis=1)
        self.radius = np.linalg.norm(corners - self.middle[:, None], axis=2).max(axis=1)

    def at(self, p):
        """Only triangles whose bounding sphere comes near enough are looked at."""
        to_middle = np.linalg.norm(self.middle - p, axis=1)
        near = to_middle - self.radius <= (to_middle + self.radius).min()
        return to_triangles(p, self.corners[near])

    def freest(self, polygon):
        """(position, clearance) in a room; none if no lattice point lies in it."""
        corners = np.array(polygon)
        (x0, y0), (x1, y1) = corners.min(axis=0), corners.max(axis=0)
        best = None
        for x in np.arange(x0 + STEP / 2, x1, STEP):
            for y in np.arange(y0 + STEP / 2, y1, STEP):
                if plan.inside((x, y), polygon):
                    c = self.at(np.array([x, y, EYE_HEIGHT]))
                    if best is None or c > best[1]:
                        best = ([x, y, EYE_HEIGHT], c)
        return best
