# SPDX-FileCopyrightText: 2026 The vantage authors
# SPDX-License-Identifier: MIT
"""A home, or one room of it, as triangles: walls with their openings, floors, ceilings, furniture. What the authors
left plain is dressed by seed: textures on floors and half of the walls, textured stand-ins for plain furniture."""
import collections
import math
import random
import re

import numpy as np

from . import kinds, meshes, plan
from .home import CLOSED_DOOR, PASSAGES

GAP = 0.005  # between faces that would lie in each other


def quad(a, b, c, d):
    return [[a, b, c], [a, c, d]]


def solid(colour):
    return meshes.Material(tuple(colour))


def surface(material, triangles, uv=None):
    uv = None if uv is None else np.array(uv, float)
    return meshes.Part(material, np.array(triangles, float).reshape(-1, 3, 3), uv)


class Builder:
    """`room`: the name of the only room wanted; None: all of them."""

    def __init__(self, name, home, catalogue, room=None):
        self.home, self.catalogue, self.name = home, catalogue, name
        self.scene = meshes.SceneFiles(name)
        self.rooms = [r for r in home.rooms if room in (None, r.name)][: None if room is None else 1]
        if not self.rooms:
            raise ValueError(f"no room '{room}' (there are: {', '.join(r.name for r in home.rooms)})")
        self.only = self.rooms[0].polygon if room is not None else None

    def build(self):
        for wall in self.home.walls.values():
            if self.only is None or self.borders(wall):
                self.add_wall(wall)
        for k, room in enumerate(self.rooms):
            self.add_floor_and_ceiling(k, room)
        if self.only is not None:
            self.close_outline()
        self.add_furniture()
        self.centre()
        self.add_shell()
        return self.scene

    def random(self, *what):
        """The same for the same thing, whatever else there is."""
        return random.Random("|".join([self.name, *map(str, what)]))

    def material(self, category, key, colour, probability, wanted):
        """A texture with its size, by chance, or the plain colour."""
        r = self.random(category, key)
        fitting = [t for t in self.catalogue.textures(category) if re.search(wanted, t[0], re.IGNORECASE)]
        if r.random() >= probability or not fitting:
            return solid(colour), None
        _, material, width, height = r.choice(fitting)
        return material, np.array([width, height])

    # ---- walls

    def borders(self, wall):
        return any(plan.distance_to_outline(q, self.only) < wall.thickness / 2 + 0.06
                   for a, b in zip(wall.points, wall.points[1:]) for q in np.linspace(a, b, 20))

    def add_wall(self, wall):
        sides = {side: ([], []) for side in ("left", "right")}
        edges = []
        for k in range(len(wall.points) - 1):
            self.add_stretch(wall, k, sides, edges)
        parts = []
        for side, (triangles, uv) in sides.items():
            material, size = self.material("Wall", wall.name + side, wall.colours[side], 0.5,
                                           "^(?!boxTree|blueTiles|stone2Wall)")
            parts.append(surface(material, triangles, None if size is None or not uv else np.array(uv) / size))
        self.scene.add(f"wall_{wall.name}", "wall", parts + [surface(solid((0.9, 0.89, 0.86)), edges)])

    def add_stretch(self, wall, k, sides, edges):
        """A straight piece of wall: in its own frame s runs along it, n to its left, z up."""
        a, b = wall.points[k], wall.points[k + 1]
        u = (b - a) / np.linalg.norm(b - a)
        left = np.array([-u[1], u[0]])
        corners = [np.array([np.dot(c - a, u), np.dot(c - a, left)]) for c in self.home.footprint(wall, k)]

        def point(s, n, z):
            return [*(a + s * u + n * left), z]

        holes = []
        for centre, width, yaw, bottom, top, thickness in self.home.holes():
            s, n = np.dot(centre - a, u), np.dot(centre - a, left)
            slanted = abs(math.sin(yaw - math.atan2(u[1], u[0])))
            if slanted < (0.8 if wall.round else 0.1) and abs(n) <= (wall.thickness + thickness) / 2 - 0.01:
                holes.append((s - width / 2, s + width / 2, max(0.0, bottom), min(wall.height, top)))
        ends = {"left": (corners[0], corners[1]), "right": (corners[3], corners[2])}
        for side, (begin, end) in ends.items():
            cuts = lambda low, high, values: sorted({low, high} | {min(max(v, low), high) for v in values})
            along = cuts(begin[0], end[0], [h[i] for h in holes for i in (0, 1)])
            up = cuts(0.0, wall.height, [h[i] for h in holes for i in (2, 3)])
            for s0, s1 in zip(along, along[1:]):
                for z0, z1 in zip(up, up[1:]):
                    s, z = (s0 + s1) / 2, (z0 + z1) / 2
                    if any(h[0] < s < h[1] and h[2] < z < h[3] for h in holes):
                        continue
                    cell = [(s0, z0), (s1, z0), (s1, z1), (s0, z1)]
                    cell = cell[::-1] if side == "left" else cell  # seen from outside
                    sides[side][0].extend(quad(*(point(s, begin[1], z) for s, z in cell)))
                    sides[side][1].extend(quad(*cell))
        low, high = (min(c[0] for c in corners), max(c[0] for c in corners))
        n0, n1 = corners[3][1], corners[0][1]
        for s0, s1, z0, z1 in holes:
            s0, s1 = max(s0, low), min(s1, high)
            if s0 < s1:
                ring = [(s0, z0), (s1, z0), (s1, z1), (s0, z1)]
                for (sa, za), (sb, zb) in zip(ring, ring[1:] + ring[:1]):
                    edges += quad(point(sa, n0, za), point(sb, n0, zb), point(sb, n1, zb), point(sa, n1, za))
        top = [point(*c, wall.height) for c in corners]
        edges += quad(*top[::-1])
        for i, j in ((3, 0), (1, 2)):
            edges += quad(point(*corners[i], 0), point(*corners[j], 0), top[j], top[i])

    # ---- floors, ceilings, and what closes a scene

    def add_floor_and_ceiling(self, k, room):
        triangles = plan.triangulate(room.polygon)
        flat = np.array([[room.polygon[i] for i in t] for t in triangles])
        wet = re.search("bath|kitchen|toilet|shower", room.name, re.IGNORECASE)
        material, size = self.material("Floor", f"{room.name}{k}", room.floor, 1.0,
                                       "Tile" if wet else "wooden|redTiles|stoneTiles")
        height = np.zeros((*flat.shape[:2], 1))
        floor = surface(material, np.concatenate([flat, height], axis=2), None if size is None else flat / size)
        self.scene.add(f"floor_{k}", "floor", [floor], name=room.name)
        above = np.concatenate([flat, height + self.home.wall_height - GAP], axis=2)[:, ::-1]
        self.scene.add(f"ceiling_{k}", "ceiling", [surface(solid(room.ceiling), above)], name=room.name)

    def close_outline(self):
        """Puts a wall where the only room's outline has none: in a passage without a door."""
        lines = [(wall.thickness / 2 + 0.06, a, b) for wall in self.home.walls.values()
                 for a, b in zip(wall.points, wall.points[1:])]
        for k, b in enumerate(self.only):
            a = self.only[k - 1]
            length = math.dist(a, b)
            samples = np.linspace(a, b, max(5, int(length / 0.15)))[1:-1]
            bare = [q for q in samples if not any(plan.distance_to_segment(q, c, d) < most for most, c, d in lines)]
            if length > 0.08 and bare:
                h = self.home.wall_height
                stretch = quad([*a, 0], [*b, 0], [*b, h], [*a, h])
                self.scene.add(f"closure_{k}", "wall", [surface(solid((0.9, 0.9, 0.87)), stretch)])

    def add_shell(self):
        """A floor and a ceiling under and over everything, and a box around it: no ray gets out."""
        low, high = self.scene.bounds()
        low, high = low - 0.05, high + 0.05
        for z, kind in ((-2 * GAP, "floor"), (self.home.wall_height, "ceiling")):
            slab = quad([low[0], low[1], z], [high[0], low[1], z], [high[0], high[1], z], [low[0], high[1], z])
            self.scene.add(f"{kind}_slab", kind, [surface(solid((0.7, 0.68, 0.65)), slab)])
        low[2], high[2] = min(low[2], -0.05), max(high[2], self.home.wall_height + 0.05)
        (x0, y0, z0), (x1, y1, z1) = low, high
        p = [[x, y, z] for z in (z0, z1) for x, y in ((x0, y0), (x1, y0), (x1, y1), (x0, y1))]
        faces = ((0, 1, 2, 3), (7, 6, 5, 4), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0))  # seen from inside
        box = [quad(*(p[i] for i in f)) for f in faces]
        self.scene.add("outer_shell", "wall", [surface(solid((0.8, 0.8, 0.78)), box)])

    # ---- furniture

    def add_furniture(self):
        wanted = [p for p in self.home.pieces if self.belongs(p)]
        alike = collections.Counter(p.catalogue for p in wanted)
        numbers = collections.Counter()
        for piece in wanted:
            kind = kinds.kind_of(piece)
            name = f"{kind}_{numbers[kind]:02d}"
            numbers[kind] += 1
            model = None
            if not piece.opening:
                choice = self.random("piece", piece.catalogue, piece.name).choice
                model = kinds.stand_in(piece, kind, self.catalogue, alike[piece.catalogue], choice)
            self.place(piece, name, kind, model)

    def belongs(self, piece):
        at = (piece.x, piece.y)
        if piece.opening:
            return self.only is None or plan.distance_to_outline(at, self.only) < 0.45
        if piece.elevation > self.home.wall_height - 0.05:
            return False
        if self.only is not None:
            return plan.inside(at, self.only)
        return min(plan.distance(at, r.polygon) for r in self.rooms) < 0.25

    def place(self, piece, name, kind, stand_in):
        path, rotation = self.catalogue.jar / piece.model, piece.rotation
        x, y, (width, depth, height) = piece.x, piece.y, piece.size
        if stand_in is not None:
            path, rotation = stand_in["path"], stand_in.get("modelRotation")
        elif piece.opening and piece.catalogue.split("#")[-1] in PASSAGES and self.leads_out(piece):
            path, rotation = self.catalogue.jar / CLOSED_DOOR, None
            (x, y), thickness = piece.wall_part()
            depth = 1.5 * thickness
        c, s = math.cos(piece.yaw), math.sin(piece.yaw)
        scale = np.diag([-width if piece.mirrored else width, depth, height])
        stand = np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]])  # y up -> z up
        turn = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]) @ scale @ stand
        at = np.array([x, y, piece.elevation + height / 2])
        parts = []
        for material_name, part in self.catalogue.unit_parts(path, rotation):
            corners, uv, material = part.corners @ turn.T + at, part.uv, part.material
            if piece.mirrored:
                corners, uv = corners[:, ::-1], None if uv is None else uv[:, ::-1]
            repainted = piece.materials.get(material_name) or piece.colour
            if repainted is not None and stand_in is None:
                material, uv = material._replace(colour=repainted, texture=None), None
            parts.append(meshes.Part(material, corners.copy(), uv))
        self.scene.add(name, kind, parts, name=piece.name, centre=at.copy(), size=[width, depth, height], yaw=piece.yaw,
                       model="/".join(path.parts[-3:]),
                       model_creator=stand_in["creator"] if stand_in else piece.creator,
                       model_license=stand_in["licence"] if stand_in else self.catalogue.eteks_licence,
                       replaces=piece.catalogue if stand_in else None)

    def leads_out(self, piece):
        near = sum(plan.distance((piece.x, piece.y), r.polygon) < 0.45 for r in self.home.rooms)
        return self.only is not None or near < 2

    def centre(self):
        """The origin to the middle of the floor plan, the floor to z = 0."""
        corners = np.array([q for r in self.rooms for q in r.polygon])
        middle = (corners.min(axis=0) + corners.max(axis=0)) / 2
        self.offset = np.array([-middle[0], -middle[1], 0.0])
        self.scene.move(self.offset)
        for instance in self.scene.instances:
            if "centre" in instance.about:
                instance.about["centre"] += self.offset
        self.polygons = [[tuple(np.array(q) + self.offset[:2]) for q in r.polygon] for r in self.rooms]
