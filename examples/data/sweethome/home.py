# SPDX-FileCopyrightText: 2026 The vantage authors
# SPDX-License-Identifier: MIT
"""An example home of Sweet Home 3D, read from its XML and turned into metres: x right, y up on the plan (the file's y
runs down), z up. One storey."""
import dataclasses
import math
import typing
import xml.etree.ElementTree as ET

import numpy as np

from . import plan

CLOSED_DOOR = "com/eteks/sweethome3d/io/resources/door.obj"
PASSAGES = ("openDoor", "doorFrame", "roundDoorFrame", "slidingDoors", "serviceHatch")  # one can look through


def metres(value, default=0.0):
    return float(value) / 100 if value is not None else default


def colour(argb, default):
    if argb is None:
        return default
    value = int(argb, 16)
    return tuple((value >> shift & 255) / 255 for shift in (16, 8, 0))


@dataclasses.dataclass
class Wall:
    name: str
    points: list  # of the centre line: two, or more of a round one
    round: bool
    thickness: float
    height: float
    neighbours: tuple  # names of the walls at its start and its end, or None
    colours: dict  # left and right as seen from its start


@dataclasses.dataclass
class Room:
    name: str
    polygon: list
    floor: tuple
    ceiling: tuple


@dataclasses.dataclass
class Piece:
    catalogue: str
    name: str
    creator: str
    model: str
    x: float
    y: float
    elevation: float
    size: tuple  # width, depth, height
    yaw: float
    mirrored: bool
    rotation: typing.Optional[str]
    colour: typing.Optional[tuple]
    materials: dict  # colours that replace the model's
    opening: bool
    in_wall: tuple  # an opening's part that lies in the wall, of its depth from the back: begin, length

    def wall_part(self):
        """Centre and thickness of the part that lies in the wall."""
        begin, length = self.in_wall
        front = np.array([math.sin(self.yaw), -math.cos(self.yaw)])
        return np.array([self.x, self.y]) + (begin + length / 2 - 0.5) * self.size[1] * front, length * self.size[1]


class Home:
    def __init__(self, path):
        root = ET.parse(path).getroot()
        if root.find("level") is not None:
            raise ValueError(f"{path.stem} has several storeys; this reads homes of one")
        self.wall_height = metres(root.get("wallHeight"), 2.5)
        self.walls = {e.get("id"): self.read_wall(e) for e in root.iter("wall")}
        self.rooms = [self.read_room(e, k) for k, e in enumerate(root.iter("room"))
                      if e.get("ceilingVisible") != "false" and e.get("floorVisible") != "false"]
        kinds = ("pieceOfFurniture", "doorOrWindow", "light")
        self.pieces = [self.read_piece(e) for e in root.iter() if e.tag in kinds and e.get("visible") != "false"]
        self.cameras = [dict(name=e.get("name"), position=[metres(e.get("x")), -metres(e.get("y")), metres(e.get("z"))],
                             yaw_sh3d=float(e.get("yaw")), pitch_sh3d=float(e.get("pitch")))
                        for e in root.iter("observerCamera") if e.get("attribute") == "storedCamera"]

    def read_wall(self, e):
        start, end = (np.array([metres(e.get("x" + s)), -metres(e.get("y" + s))]) for s in ("Start", "End"))
        bend = -float(e.get("arcExtent") or 0)
        plain = (0.95, 0.94, 0.9)
        return Wall(e.get("id"), plan.arc(start, end, bend) if bend else [start, end], bool(bend),
                    metres(e.get("thickness")), metres(e.get("height"), self.wall_height),
                    (e.get("wallAtStart"), e.get("wallAtEnd")),
                    {side: colour(e.get(side + "SideColor"), plain) for side in ("left", "right")})

    def read_room(self, e, index):
        polygon = [(metres(p.get("x")), -metres(p.get("y"))) for p in e.findall("point")]
        return Room(e.get("name") or f"Room {index}", polygon, colour(e.get("floorColor"), (0.6, 0.5, 0.4)),
                    colour(e.get("ceilingColor"), (0.96, 0.96, 0.95)))

    @staticmethod
    def read_piece(e):
        return Piece(
            e.get("catalogId") or "", e.get("name") or "", e.get("creator") or "eTeks", e.get("model"),
            metres(e.get("x")), -metres(e.get("y")), metres(e.get("elevation")),
            tuple(metres(e.get(k)) for k in ("width", "depth", "height")), -float(e.get("angle") or 0),
            e.get("modelMirrored") == "true", e.get("modelRotation"),
            colour(e.get("color"), None) if e.get("color") else None,
            {m.get("name"): colour(m.get("color"), None) for m in e.findall("material") if m.get("color")},
            e.tag == "doorOrWindow", (float(e.get("wallDistance") or 0), float(e.get("wallThickness") or 1)))

    def holes(self):
        """Of openings: centre, width, yaw, bottom, top, thickness. A little smaller than the frames that fill them."""
        return [(p.wall_part()[0], p.size[0] - 0.005, p.yaw, p.elevation, p.elevation + p.size[2] - 0.002,
                 max(p.wall_part()[1], 0.08)) for p in self.pieces if p.opening]

    def footprint(self, wall, k):
        """Corners of a stretch of a wall on the plan: left start, left end, right end, right start. Where two straight
        walls join, their sides run until they meet."""
        a, b = wall.points[k], wall.points[k + 1]
        u = (b - a) / np.linalg.norm(b - a)
        left = np.array([-u[1], u[0]]) * wall.thickness / 2
        if wall.round:
            a, b = a - 0.006 * u, b + 0.006 * u  # stretches overlap: no gap on the outer side
        corners = [a + left, b + left, b - left, a - left]
        for end, at in enumerate((wall.points[0], wall.points[-1])):
            other = self.walls.get(wall.neighbours[end])
            if other is None or wall.round or other.round:
                continue
            # Both directions as seen from the joint: this wall's left side then meets the other's right one.
            away = u if end == 0 else -u
            near, far = sorted(other.points, key=lambda q: np.linalg.norm(q - at))
            v = (far - near) / np.linalg.norm(far - near)
            other_left = np.array([-v[1], v[0]]) * other.thickness / 2
            my_left = np.array([-away[1], away[0]]) * wall.thickness / 2
            for side in (1, -1):
                corner = plan.meet(at + side * my_left, away, near - side * other_left, v)
                if corner is not None and np.linalg.norm(corner - at) < 2.5 * wall.thickness:
                    index = (0 if side == 1 else 3) if end == 0 else (2 if side == 1 else 1)
                    corners[index] = corner
        return corners
