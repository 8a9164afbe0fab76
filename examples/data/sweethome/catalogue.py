# SPDX-FileCopyrightText: 2026 The vantage authors
# SPDX-License-Identifier: MIT
"""What Debian's packages sweethome3d and sweethome3d-furniture hold: example homes, models, textures, licences."""
import functools
import pathlib
import re
import shutil
import struct
import subprocess
import zipfile

import numpy as np

from . import meshes

ETEKS = "CC-BY-3.0 or GPL-2+ (Emmanuel Puybaret / eTeks)"
LICENCES = {  # by library; Reallusion's people are not used
    "Scopia": "CC-BY-3.0 (Emmanuel Puybaret / eTeks and Scopia Visual Interfaces Systems)",
    "KatorLegaz": "CC-BY-3.0 (Kator Legaz / eTeks)",
    "BlendSwap-CC-0": "CC0-1.0",
    "BlendSwap-CC-BY": "CC-BY-3.0 (the creator named, Blend Swap)",
}
# Kept for evaluation: models that nothing is tuned on.
HELD_OUT = ("suv", "smart-car", "scooter", "leather_sofa", "antiquechair", "officetable", "surveillancecamera", "lamp",
            "toytrain")


def properties(text):
    """The entries of a Java properties file with keys like name#7=..., by their number."""
    entries = {}
    for line in re.sub(r"\\\r?\n\s*", "", text).splitlines():
        found = re.match(r"(\w+)#(\d+)\s*=(.*)", line)
        if found:
            entries.setdefault(int(found[2]), {})[found[1]] = found[3].strip()
    return [entries[k] for k in sorted(entries)]


def unzip(archive, folder):
    """Whole or not at all."""
    if not folder.exists():
        part = folder.with_name(folder.name + ".part")
        shutil.rmtree(part, ignore_errors=True)
        with zipfile.ZipFile(archive) as z:
            z.extractall(part)
        part.rename(folder)
    return folder


def version(package, folder):
    """Of a package that is installed, or was extracted; the changelog's first line tells."""
    for root in (pathlib.Path("/"), folder / package):
        changelog = root / "usr/share/doc" / package / "changelog.Debian.gz"
        if changelog.exists():
            line = subprocess.run(["gzip", "-dc", str(changelog)], capture_output=True, text=True).stdout.split("\n")[0]
            found = re.search(r"\((.*?)\)", line)
            if found:
                return f"{package} {found[1]}"
    return package


class Catalogue:
    """`package_path(package, path)` tells where a package's file is."""

    def __init__(self, package_path, cache):
        furniture = package_path("sweethome3d-furniture", "usr/share/sweethome3d/furniture")
        jar = package_path("sweethome3d", "usr/share/sweethome3d/sweethome3d.jar")
        self.jar = unzip(jar, cache / "sweethome3d.jar")
        self.resources = self.jar / "com/eteks/sweethome3d/io"
        self.versions = {p: version(p, cache) for p in ("sweethome3d", "sweethome3d-furniture")}
        self.copyrights = [package_path(p, f"usr/share/doc/{p}/copyright") for p in self.versions]
        self.eteks_licence = ETEKS
        self.models = []
        for library in LICENCES:
            folder = unzip(furniture / f"{library}.sh3f", cache / f"{library}.sh3f")
            for entry in properties((folder / "PluginFurnitureCatalog.properties").read_text(encoding="latin-1")):
                path = folder / entry["model"].lstrip("/")
                self.models.append(dict(entry, library=library, path=path, licence=LICENCES[library]))

    def home(self, name):
        return self.resources / "resources/examples" / f"{name}.xml"

    def usable(self):
        """Models that are not held out."""
        return [m for m in self.models if pathlib.Path(m["model"]).stem.lower() not in HELD_OUT]

    @functools.lru_cache(maxsize=None)
    def pictures(self, path):
        """How many textures a model names."""
        found = set()
        for library in sorted(path.parent.glob("*.[mM][tT][lL]")):
            found.update(re.findall(r"map_Kd\s+(.*)", library.read_text(errors="replace")))
        return len(found)

    def textures(self, category):
        """The eTeks textures for a Floor or a Wall: (name, material, width_m, height_m)."""
        text = (self.resources / "DefaultTexturesCatalog.properties").read_text(encoding="latin-1")
        return [(entry["id"].split("#")[-1],
                 meshes.Material((1.0, 1.0, 1.0), 1.0, str(self.jar / entry["image"].lstrip("/"))),
                 float(entry["width"]) / 100, float(entry["height"]) / 100)
                for entry in properties(text) if entry["category"] == category]

    @functools.cached_property
    def default_materials(self):
        """The colours that models mean which bring no materials: a text constant in the program's OBJ reader."""
        data = (self.jar / "com/eteks/sweethome3d/j3d/OBJLoader.class").read_bytes()
        at = data.find(b"newmtl amber")
        if at < 2:
            return {}
        (size,) = struct.unpack(">H", data[at - 2 : at])
        return meshes.read_materials(data[at : at + size].decode("ascii", "replace"))

    @functools.lru_cache(maxsize=None)
    def parts(self, path):
        return meshes.read_obj(path, self.default_materials)

    def unit_parts(self, path, rotation=None):
        """A model's parts, (name of material, part), as if its bounding box were the unit cube about the origin. Model
        axes: x right, y up, z towards who looks at its front."""
        found = self.parts(path)
        turn = np.array([float(w) for w in rotation.split()]).reshape(3, 3) if rotation else np.eye(3)
        turned = [p.corners @ turn.T for _, p in found]
        points = np.concatenate(turned).reshape(-1, 3)
        low, high = points.min(axis=0), points.max(axis=0)
        size = np.maximum(high - low, 1e-6)
        return [(name, p._replace(corners=(c - (low + high) / 2) / size)) for (name, p), c in zip(found, turned)]
