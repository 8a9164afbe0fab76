# SPDX-FileCopyrightText: 2026 The vantage authors
# SPDX-License-Identifier: MIT
"""What a piece of furniture is, by its catalogue name, and which textured model may stand in for a plain one."""
import math
import re

# The first pattern that a catalogue name (after eTeks#) matches tells the class.
BY_CATALOGUE = [(re.compile(pattern, re.IGNORECASE), kind) for pattern, kind in (
    ("sofa", "sofa"), ("armchair", "armchair"), ("stool", "stool"), ("chair", "chair"), ("coffeetable", "coffee_table"),
    ("bedsidetable", "nightstand"), ("table", "table"), ("desk", "desk"), ("bed|crib", "bed"), ("bookcase", "bookcase"),
    ("wardrobe", "wardrobe"), ("chest|dresser", "chest_of_drawers"), ("glassdoorcabinet", "cabinet"),
    ("tvunit", "tv_stand"), ("tv", "tv"), ("laptop", "laptop"), ("lamp|uplight|spotlight|lightsource", "lamp"),
    ("plant|flowers", "plant"), ("fridge", "refrigerator"), ("cooker|oven", "oven"), ("hood", "range_hood"),
    ("washer", "washing_machine"), ("washbasin|^sink", "sink"), ("kitchen", "kitchen_cabinet"), ("toilet", "toilet"),
    ("bath", "bathtub"), ("shower", "shower"), ("radiator", "radiator"), ("curtain|blind", "curtain"),
    ("frame", "picture"), ("fireplace", "fireplace"), ("piano", "piano"), ("aquarium", "aquarium"))]
# Boxes and cylinders are what their owner called them.
BY_NAME = ("mirror", "pipe", "shelf", "carpet", "railing", "picture", "curtain", "worktop", "table")

# class: (words that a stand-in's name must have, words that it must not have)
STAND_INS = {kind: tuple(re.compile(words or "(?!)") for words in both) for kind, both in {
    "sofa": ("sofa|couch", "convertible|rattan|dog|bench|bed"),
    "armchair": ("arm ?chair", "rattan|garden|office"),
    "chair": (r"\bchair\b", "wheel|deck|baby|high|office|garden|rattan|rocking|electric|lounge|dentist|sitting|arm"),
    "stool": (r"\bstool", "bar"),
    "coffee_table": ("(coffee|low) table", ""),
    "table": (r"\btable\b", "coffee|bedside|night|pool|foot|tennis|billiard|ironing|operating|lamp|picnic|dressing|"
                            "garden|sitting|side"),
    "desk": (r"\bdesk\b", "lamp|chair|reception|sitting"),
    "nightstand": ("bedside|night ?(stand|table)", ""),
    "bed": (r"\bbed\b", "baby|hospital|dog|cat|bunk|sofa|side|air|flower|canopy|mezzanine"),
    "bookcase": ("book ?(case|shel)|library|shelves", "wall|hanging"),
    "wardrobe": ("wardrobe|cupboard|armoire|closet", ""),
    "chest_of_drawers": ("chest|dresser|drawers|sideboard|buffet", "treasure|freezer"),
    "tv_stand": ("tv (unit|stand|table|furniture)", ""),
    "lamp": ("lamp", "street|outdoor|wall|pendant|ceiling|post|camping|spot"),
    "plant": ("plant|flower|bonsai|yucca|ficus|orchid|cactus|fern|bouquet", r"tree|box|palm|\bbed\b"),
    "tv": (r"\btv\b|television", "unit|stand|table|old|remote"),
}.items()}
NOT_FOR_ROOMS = ("Exterior", "Characters", "Vehicles")
MOST_BYTES = 900_000  # of a model's OBJ file, so that a home stays below some 300,000 triangles


def kind_of(piece):
    catalogue, name = piece.catalogue.split("#")[-1], piece.name.lower()
    if piece.opening:
        return "door" if re.search("door|hatch", catalogue, re.IGNORECASE) else "window"
    if not catalogue.startswith("texturable"):
        for pattern, kind in BY_CATALOGUE:
            if pattern.search(catalogue):
                return kind
    return next((kind for kind in BY_NAME if kind in name), "structure")


def difference(a, b):
    """How much a (width, depth, height) has to be bent to become another, in powers of e."""
    proportion = [math.log(x / y) for x, y in zip(a, b)]
    mean = sum(proportion) / 3
    return sum(abs(p - mean) for p in proportion) + 0.25 * abs(mean)


def stand_in(piece, kind, catalogue, count, choice):
    """A textured model of the same class and about the same proportions, chosen by `choice`; or none. `count`: how many
    such pieces there are."""
    may_stand_on_things = kind in ("plant", "lamp", "tv")
    if kind not in STAND_INS or piece.rotation or not (may_stand_on_things or 0 <= piece.elevation < 0.05):
        return None
    if re.search("pendant|wall|spot|corner|bunk|loft|crib", piece.catalogue, re.IGNORECASE):
        return None
    wanted, unwanted = STAND_INS[kind]
    limit = 1.6 if kind in ("plant", "lamp") else 1.1
    fitting = []
    for model in catalogue.usable():
        name = model["name"].lower()
        if not wanted.search(name) or unwanted.search(name) or model["category"] in NOT_FOR_ROOMS:
            continue
        if model.get("doorOrWindow") == "true" or float(model.get("elevation") or 0) > 5:
            continue
        bytes_ = model["path"].stat().st_size
        if bytes_ > MOST_BYTES or bytes_ * count > 2 * MOST_BYTES or catalogue.pictures(model["path"]) == 0:
            continue
        size = [float(model[k]) / 100 for k in ("width", "depth", "height")]
        d = difference(size, piece.size)
        if d < limit:
            fitting.append((d, model["id"], model))
    fitting.sort(key=lambda f: f[:2])
    return choice([f[2] for f in fitting[:4]]) if fitting else None
