# SPDX-FileCopyrightText: 2026 The vantage authors
# SPDX-License-Identifier: MIT
"""Wavefront OBJ in and out: triangles in parts of one material each."""
import hashlib
import pathlib
import re
import typing

import numpy as np
from PIL import Image

from . import plan


class Material(typing.NamedTuple):
    colour: tuple = (0.8, 0.8, 0.8)
    opacity: float = 1.0
    texture: typing.Optional[str] = None  # a picture's path; the colour then is its factor

    def textured(self):
        return self.texture is not None


class Part(typing.NamedTuple):
    material: Material
    corners: np.ndarray  # (n, 3, 3): triangle, corner, coordinate
    uv: typing.Optional[np.ndarray] = None  # (n, 3, 2)


def find_picture(name, folder):
    """The file that a material means; names in these libraries differ in case and in the kind of slash."""
    wanted = re.split(r"[\\/]", name)[-1].lower()
    return next((str(f) for f in sorted(folder.iterdir()) if f.name.lower() == wanted), None)


def read_materials(text, folder=None):
    """The materials of an MTL text by name. Pictures are looked for in the folder."""
    out, name = {}, None
    for line in text.splitlines():
        key, _, value = line.strip().partition(" ")
        value = value.strip()
        if key == "newmtl":
            name = value
            out[name] = Material()
        elif name is not None and value:
            try:
                if key == "Kd":
                    out[name] = out[name]._replace(colour=tuple(float(c) for c in value.split()[:3]))
                elif key == "d":
                    out[name] = out[name]._replace(opacity=float(value.split()[-1]))
                elif key == "map_Kd" and folder is not None:
                    out[name] = out[name]._replace(texture=find_picture(value, folder))
            except ValueError:
                pass  # an option that these fields do not know
    return {n: m._replace(colour=(1.0, 1.0, 1.0)) if m.textured() else m for n, m in out.items()}


def triangles_of(polygon):
    """Index triples of a polygon in space."""
    if len(polygon) <= 4:
        return [(0, k, k + 1) for k in range(1, len(polygon) - 1)]
    p = np.array(polygon)
    normal = np.cross(p - p[0], np.roll(p, -1, axis=0) - p[0]).sum(axis=0)
    drop = int(np.argmax(np.abs(normal)))
    keep = [(1, 2), (2, 0), (0, 1)][drop]
    return plan.triangulate(p[:, keep if normal[drop] > 0 else keep[::-1]])


def read_obj(path, default_materials):
    """The parts of an OBJ file, as (name of material, part). Faces with an index that does not exist are left out."""
    path = pathlib.Path(path)
    points, uvs, materials, faces, current = [], [], {}, {}, "default"
    for line in path.read_text(errors="replace").replace("\\\n", " ").splitlines():
        key, *words = line.split() or [""]
        if key == "v":
            points.append([float(w) for w in words[:3]])
        elif key == "vt":
            uvs.append([float(w) for w in (words + ["0"])[:2]])
        elif key == "usemtl":
            current = " ".join(words)
        elif key == "mtllib":
            library = path.parent / " ".join(words)
            if library.is_file():
                materials.update(read_materials(library.read_text(errors="replace"), path.parent))
        elif key == "f":
            corners = [[int(i) if i else 0 for i in w.split("/")] + [0, 0] for w in words if w[:1] in "-0123456789"]
            at = [c[0] - 1 if c[0] > 0 else len(points) + c[0] for c in corners]
            uv = [c[1] - 1 if c[1] > 0 else len(uvs) + c[1] for c in corners] if all(c[1] for c in corners) else None
            if len(at) < 3 or not all(0 <= i < len(points) for i in at):
                continue
            if uv is not None and not all(0 <= i < len(uvs) for i in uv):
                uv = None
            corners_out, uv_out = faces.setdefault(current, ([], []))
            for triple in triangles_of([points[i] for i in at]):
                corners_out.append([points[at[k]] for k in triple])
                uv_out.append([uvs[uv[k]] for k in triple] if uv is not None else [[0, 0]] * 3)
    found = []
    for name, (corners, uv) in faces.items():
        material = materials.get(name) or default_materials.get(name, Material())
        uv = np.array(uv, float) if material.textured() else None
        found.append((name, Part(material, np.array(corners, float), uv)))
    return found


class Instance(typing.NamedTuple):
    name: str
    kind: str
    parts: list
    about: dict  # whatever else is told of it


class SceneFiles:
    """Instances gathered, to be written as one OBJ, its MTL and its textures."""

    def __init__(self, name):
        self.name, self.instances = name, []

    def add(self, name, kind, parts, /, **about):
        parts = [p for p in parts if len(p.corners)]
        if parts:
            self.instances.append(Instance(name, kind, parts, about))

    def parts(self):
        return [p for i in self.instances for p in i.parts]

    def corners(self):
        return np.concatenate([p.corners for p in self.parts()])

    def bounds(self):
        points = self.corners().reshape(-1, 3)
        return points.min(axis=0), points.max(axis=0)

    def move(self, by):
        for part in self.parts():
            part.corners[...] += by

    def materials(self):
        return list(dict.fromkeys(p.material for p in self.parts()))

    def textured_share(self):
        """Of the area."""
        total = textured = 0.0
        for part in self.parts():
            a, b, c = (part.corners[:, k] for k in range(3))
            size = float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum())
            total += size
            textured += size if part.material.textured() else 0
        return textured / total

    def write(self, folder, stem, most_texture_px):
        """The files, into an empty folder; returns how many textures there are."""
        folder = pathlib.Path(folder)
        names = {m: f"m{k:03d}" for k, m in enumerate(self.materials())}
        textures, lines = {}, []
        for material, name in names.items():
            lines += [f"newmtl {name}", "Kd %.4f %.4f %.4f" % material.colour, f"d {material.opacity:g}"]
            if material.textured():
                if material.texture not in textures:
                    textures[material.texture] = write_texture(material.texture, folder, most_texture_px)
                lines.append(f"map_Kd {textures[material.texture]}")
        (folder / f"{stem}.mtl").write_text("\n".join(lines) + "\n")

        points, uvs, lines = {}, {}, [f"# {self.name}: metres, z up; see the JSON file beside", f"mtllib {stem}.mtl"]

        def index(seen, key, prefix):
            if key not in seen:
                seen[key] = len(seen) + 1
                lines.append(f"{prefix} {key}")
            return seen[key]

        for instance in self.instances:
            lines.append(f"o {instance.name}")
            for part in instance.parts:
                lines.append(f"usemtl {names[part.material]}")
                for k, triangle in enumerate(part.corners):
                    corner = [index(points, "%.4f %.4f %.4f" % tuple(p), "v") for p in triangle]
                    if len(set(corner)) < 3:
                        continue  # degenerate
                    if part.uv is None:
                        lines.append("f %d %d %d" % tuple(corner))
                    else:
                        uv = [index(uvs, "%.4f %.4f" % tuple(t), "vt") for t in part.uv[k]]
                        lines.append("f %d/%d %d/%d %d/%d" % (corner[0], uv[0], corner[1], uv[1], corner[2], uv[2]))
        (folder / f"{stem}.obj").write_text("\n".join(lines) + "\n")
        return len(textures)


def write_texture(source, folder, most_px):
    """A picture, made smaller if need be: PNG if it is transparent somewhere, else JPEG. Returns its name."""
    image = Image.open(source)
    image = image.convert("RGBA" if image.mode in ("RGBA", "LA") or "transparency" in image.info else "RGB")
    if image.mode == "RGBA" and image.getextrema()[3][0] >= 250:
        image = image.convert("RGB")
    image.thumbnail((most_px, most_px), Image.LANCZOS)
    stem = re.sub(r"\W+", "_", pathlib.Path(source).stem)[:32]
    tag = hashlib.sha1("/".join(pathlib.Path(source).parts[-3:]).encode()).hexdigest()[:6]
    name = f"tex/{stem}_{tag}.{'png' if image.mode == 'RGBA' else 'jpg'}"
    (folder / "tex").mkdir(exist_ok=True)
    image.save(folder / name, **({} if image.mode == "RGBA" else {"quality": 85}))
    return name
