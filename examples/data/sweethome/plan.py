# SPDX-FileCopyrightText: 2026 The vantage authors
# SPDX-License-Identifier: MIT
"""Plane geometry of floor plans. Points are (x, y) in metres, x right, y up, so that left is counter-clockwise."""
import math

import numpy as np


def cross(a, b):
    return a[0] * b[1] - a[1] * b[0]


def area(polygon):
    """Positive if counter-clockwise."""
    p = np.asarray(polygon)
    q = np.roll(p, -1, axis=0)
    return float(np.sum(p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]) / 2)


def inside(point, polygon):
    """Even-odd rule."""
    x, y = point
    odd = False
    for (x0, y0), (x1, y1) in zip(polygon, [*polygon[1:], polygon[0]]):
        if (y0 > y) != (y1 > y) and x < x0 + (y - y0) / (y1 - y0) * (x1 - x0):
            odd = not odd
    return odd


def distance_to_segment(point, a, b):
    p, a, b = (np.asarray(v, float) for v in (point, a, b))
    d = b - a
    t = float(np.clip(np.dot(p - a, d) / max(np.dot(d, d), 1e-12), 0, 1))
    return float(np.linalg.norm(p - a - t * d))


def distance_to_outline(point, polygon):
    return min(distance_to_segment(point, a, b) for a, b in zip(polygon, [*polygon[1:], polygon[0]]))


def distance(point, polygon):
    """0 inside."""
    return 0.0 if inside(point, polygon) else distance_to_outline(point, polygon)


def triangulate(polygon):
    """Ear clipping: triples of indices, counter-clockwise, of a simple polygon of either sense. Colinear corners and
    bridges to holes are allowed."""
    p = [tuple(float(c) for c in q) for q in polygon]
    left = list(range(len(p)))
    if area(p) < 0:
        left.reverse()
    out = []

    def corner(k):
        return left[k - 1], left[k], left[(k + 1) % len(left)]

    def turn(i, j, k):
        return cross((p[j][0] - p[i][0], p[j][1] - p[i][1]), (p[k][0] - p[j][0], p[k][1] - p[j][1]))

    def is_ear(i, j, k):
        if turn(i, j, k) <= 0:
            return False
        for m in left:
            if p[m] in (p[i], p[j], p[k]):
                continue
            if turn(i, j, m) >= 0 and turn(j, k, m) >= 0 and turn(k, i, m) >= 0:
                return False
        return True

    while len(left) > 3:
        flat = next((k for k in range(len(left)) if abs(turn(*corner(k))) < 1e-10), None)
        if flat is not None:
            del left[flat]
            continue
        k = next((k for k in range(len(left)) if is_ear(*corner(k))), 0)
        out.append(corner(k))
        del left[k]
    return out + [tuple(left)]


def meet(a, u, b, v):
    """Where the line a + s u meets b + t v; None if they are nearly parallel."""
    d = cross(u, v)
    if abs(d) < 1e-3 * math.hypot(*u) * math.hypot(*v):
        return None
    return a + cross(b - a, v) / d * u


def arc(start, end, extent_rad, pieces=24):
    """Points of the circular arc from start to end whose tangent turns by `extent_rad`, positive counter-clockwise."""
    start, end = np.asarray(start, float), np.asarray(end, float)
    chord = end - start
    radius = float(np.hypot(*chord)) / (2 * math.sin(abs(extent_rad) / 2))
    left = np.array([-chord[1], chord[0]]) / np.hypot(*chord)
    centre = (start + end) / 2 + math.copysign(radius * math.cos(extent_rad / 2), extent_rad) * left
    a = math.atan2(*(start - centre)[::-1])
    angles = a + extent_rad * np.linspace(0, 1, pieces + 1)
    return [centre + radius * np.array([math.cos(t), math.sin(t)]) for t in angles]
