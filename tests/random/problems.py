# SPDX-License-Identifier: GPL-3.0-or-later
"""A random problem of a seed: body, cloud, cells, tissues and load, as files and arguments of brainshift solve. Numbers
come from random.Random(seed).random() alone, which Python keeps the same in all versions."""
import math
import random
from dataclasses import dataclass, field

import bodies
import clouds
import vtu

FREE = math.nan
YOUNG = 3000.0  # Pa, of the softest tissue
POISSON = (0.0, 0.3, 0.45, 0.45, 0.49, 0.49, 0.49, 0.495, 0.499, 0.4999)
ALPHA = (None, None, -8.0, -4.7, -4.7, 4.0)  # of Ogden's law, one term; None: neo-Hookean
SOLID = ("block", "block", "cylinder", "ball", "ellipsoid", "l", "slab")
FLAT = ("rectangle", "l")
CLOUDS = ("regular", "jittered", "irregular", "irregular", "graded")
CELLS = ("conforming", "simplices", "cut", "cut", "foreign")
LOADS = ("press", "pull", "shear", "twist", "oblique", "indent", "gravity", "plates", "affine")


@dataclass
class Problem:
    seed: int
    small: bool = False
    laws: bool = False  # tissues of other laws than neo-Hookean, too
    random: object = field(init=False)

    def __post_init__(self):
        self.random = random.Random(self.seed).random
        self.dimensions = 2 if self.random() < 0.2 else 3
        self.shape = self.one_of(FLAT if self.dimensions == 2 else SOLID)
        self.body = self.make_body()
        self.up = 1 if self.shape in ("l", "rectangle") else 2
        self.load = self.make_load()
        self.tissues, self.interfaces = self.make_tissues()
        wanted = (80 if self.small else 400) if self.dimensions == 2 else (120 if self.small else 520)
        wanted *= 1 + 0.3 * self.random()
        self.spacing = (self.body.size / wanted) ** (1 / self.dimensions)
        self.cloud = self.one_of(CLOUDS)
        self.cells = self.one_of(CELLS)
        self.basis = self.one_of(("modified_quadratic", "modified_quadratic", "linear"))
        self.plane = self.one_of(("strain", "stress")) if self.dimensions == 2 else ""
        draw = random.Random(7919 * self.seed + 3).random  # its own, so that all else of a seed stays
        self.powers = [ALPHA[int(draw() * len(ALPHA))] if self.laws else None for _ in self.tissues]

    def one_of(self, choices):
        return choices[int(self.random() * len(choices))]

    def between(self, low, high):
        return low + (high - low) * self.random()

    # The body.

    def make_body(self):
        size = self.between(30, 100)
        if self.dimensions == 2:
            cut = (self.between(0.3, 0.7), self.between(0.3, 0.7)) if self.shape == "l" else None
            return bodies.Plane(bodies.Polygon(size, size * self.between(0.5, 1.5), cut))
        if self.shape == "cylinder":
            return bodies.Extruded(bodies.Disc(size / 2), size * self.between(0.5, 1.5))
        if self.shape == "ball":
            return bodies.Ball(size / 2)
        if self.shape == "ellipsoid":
            return bodies.Ball(size / 2, tuple(self.between(0.6, 1) for _ in range(3)))
        sides = [size * self.between(0.5, 1) for _ in range(3)]
        if self.shape == "slab":
            sides[2] = size * self.between(0.08, 0.3)
        cut = (self.between(0.4, 0.6), self.between(0.4, 0.6)) if self.shape == "l" else None
        return bodies.Extruded(bodies.Polygon(sides[0], sides[1], cut), sides[2])

    def height(self):
        return self.body.high[self.up] - self.body.low[self.up]

    # What it is made of.

    def make_tissues(self):
        """(E, nu) by label, and where along the height they change, as shares; a ball's tissues are shells."""
        count = 1 if self.load["kind"] in ("plates", "affine") else self.one_of((1, 1, 2, 3))
        contrast = 10 ** self.between(0, 4)
        stiffness = {1: [1], 2: [1, contrast], 3: [1, contrast, 10 ** self.between(0, math.log10(contrast))]}[count]
        turn = int(count * self.random())
        stiffness = stiffness[turn:] + stiffness[:turn]
        return ([(YOUNG * s, self.one_of(POISSON)) for s in stiffness],
                {1: [], 2: [0.5], 3: [1 / 3, 2 / 3]}[count])

    def label(self, x):
        if self.shape in ("ball", "ellipsoid"):
            share = math.hypot(*(v / h for v, h in zip(x, self.body.high)))
        else:
            share = (x[self.up] - self.body.low[self.up]) / self.height()
        return 1 + sum(share > at for at in self.interfaces)

    # What happens to it.

    def make_load(self):
        kinds = [k for k in LOADS if k != "twist" or self.dimensions == 3]
        if self.shape not in ("block", "slab", "rectangle"):
            kinds.remove("plates")
        kind = self.one_of(kinds)
        amount = self.between(0.02, 0.3)
        load = {"kind": kind, "amount": amount, "direction": [self.between(-1, 1) for _ in range(3)]}
        load["matrix"] = self.kept_volume([[amount * self.between(-1, 1) for _ in range(3)] for _ in range(3)])
        load["radius"] = self.between(0.25, 0.4)
        return load

    def kept_volume(self, matrix):
        """Of a gradient of displacement, scaled so that the volume (area) stays: tissue of nu = 0.4999 keeps it."""
        n = self.dimensions
        (a, b, c), (d, e, f), (g, h, i) = [[matrix[r][k] + (r == k) if max(r, k) < n else float(r == k)
                                            for k in range(3)] for r in range(3)]
        scale = (a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)) ** (-1 / n)
        return [[scale * v - (r == k) for k, v in enumerate(row)]
                for r, row in enumerate(((a, b, c), (d, e, f), (g, h, i)))]

    def has_rim(self):
        """Whether what is held or moved ends inside a smooth part of the surface."""
        return self.load["kind"] == "indent" or (self.shape in ("ball", "ellipsoid") and
                                                 self.load["kind"] not in ("affine", "plates"))

    def prescribed(self, x):
        """At a place of the surface; three components, mm."""
        kind, amount = self.load["kind"], self.load["amount"]
        flat, up, height = self.dimensions == 2, self.up, self.height()
        free = [FREE] * 3
        if kind == "affine":
            matrix = self.load["matrix"]
            return [sum(matrix[i][j] * x[j] for j in range(self.dimensions)) if i < self.dimensions else FREE
                    for i in range(3)]
        tiny = 1e-6 * height
        share = (x[up] - self.body.low[up]) / height
        if kind == "plates":
            for axis in range(self.dimensions):
                if x[axis] - self.body.low[axis] < tiny:
                    free[axis] = 0.0
            if self.body.high[up] - x[up] < tiny:
                free[up] = -amount * height if self.load["direction"][0] < 0 else amount * height
            return free
        caps = 0.22 if self.shape in ("ball", "ellipsoid") else 1e-6
        held = [0.0, 0.0, FREE if flat else 0.0]
        if share < caps:
            return held
        if share < 1 - caps or kind == "gravity":
            return free
        middle = [(l + h) / 2 for l, h in zip(self.body.low, self.body.high)]
        if self.shape == "l":
            middle[0] = self.body.profile.cut[0] * self.body.high[0] / 2
        sides = [i for i in range(self.dimensions) if i != up]
        moved = list(held)
        if kind in ("press", "pull"):
            moved[up] = (-1 if kind == "press" else 1) * amount * height
        elif kind == "shear":
            moved[sides[0]] = amount * height
        elif kind == "oblique":
            for i in range(self.dimensions):
                moved[i] = 0.6 * amount * height * self.load["direction"][i]
        elif kind == "twist":
            a, b = sides
            angle = 2 * amount
            u, v = x[a] - middle[a], x[b] - middle[b]
            moved[a] = u * math.cos(angle) - v * math.sin(angle) - u
            moved[b] = u * math.sin(angle) + v * math.cos(angle) - v
        elif kind == "indent":
            width = min(self.body.high[i] - self.body.low[i] for i in sides)
            if self.shape == "l":
                width = min([2 * middle[0]] + [self.body.high[i] - self.body.low[i] for i in sides[1:]])
            if math.hypot(*(x[i] - middle[i] for i in sides)) > self.load["radius"] * width:
                return free
            moved[up] = -0.6 * amount * height
        return moved

    def gravity(self):
        """m/s²: the weight of a column of the body's height over E is the amount."""
        if self.load["kind"] != "gravity":
            return None
        density, to_si = 1000.0, 1e-3
        size = self.load["amount"] * YOUNG / (density * self.height() * to_si)
        direction = self.load["direction"] if self.dimensions == 3 else self.load["direction"][:2] + [0.0]
        length = math.hypot(*direction)
        return [size * d / length for d in direction]

    def exact(self):
        """The displacement as a function of the place, where it is known; else None."""
        kind = self.load["kind"]
        n = self.dimensions
        if kind == "affine":
            if len(self.tissues) > 1 or self.plane == "stress":
                return None
            matrix = self.load["matrix"]
            return lambda x: tuple(sum(matrix[i][j] * x[j] for j in range(n)) for i in range(n))
        if kind == "plates" and self.powers == [None]:
            stretch = 1 + (-1 if self.load["direction"][0] < 0 else 1) * self.load["amount"]
            side = self.free_stretch(stretch)
            return lambda x: tuple(((stretch if i == self.up else side) - 1) * x[i] for i in range(n))
        return None

    def free_stretch(self, stretch):
        """Across a stretch, so that no stress acts there, of W = mu/2 (J^(-2/3) I1 - 3) + K/2 (J - 1)^2."""
        young, poisson = self.tissues[0]
        mu, bulk = young / 2 / (1 + poisson), young / 3 / (1 - 2 * poisson)

        def stress(side):
            other = 1.0 if self.plane == "strain" else side
            j = stretch * side * other
            first = stretch ** 2 + side ** 2 + other ** 2
            return mu * j ** (-5 / 3) * (side ** 2 - first / 3) + bulk * (j - 1)
        low, high = 0.3, 3.0
        for _ in range(100):
            middle = math.sqrt(low * high)
            low, high = (middle, high) if stress(middle) < 0 else (low, middle)
        return low

    # Its nodes and cells.

    def make_nodes(self, darts):
        """(points, on_surface)."""
        regular = bodies.Grid(self.body, self.body.divisions(self.spacing)).points
        tiny = 1e-6 * self.height()
        if self.cloud in ("regular", "jittered"):
            on_surface = [1 if self.body.depth(x) < tiny else 0 for x in regular]
            if self.cloud == "jittered":
                wide = 0.15 * self.spacing
                regular = [x if s else tuple(v + wide * (2 * darts() - 1) for v in x)
                           for x, s in zip(regular, on_surface)]
            return regular, on_surface
        least = (0.86 if self.dimensions == 3 else 0.84) * self.spacing
        if self.cloud == "irregular":
            return clouds.throw(self.body, lambda x: least, least, darts)
        corner, reach = self.body.high, math.dist(self.body.low, self.body.high)
        fine, coarse = 0.65 * least, 1.7 * least
        return clouds.throw(self.body, lambda x: fine + (coarse - fine) * math.dist(x, corner) / reach, coarse, darts)

    def make_cells(self, darts, spacing):
        """(kind, vertices, cells, fractions or None, octants or None, points a cell or None)."""
        flat = self.dimensions == 2
        whole = "quadrilateral" if flat else "hexahedron"
        if self.cells in ("conforming", "simplices"):
            wide = 1.0 if self.cells == "conforming" or flat else 1.8
            parts = self.body.divisions(wide * spacing)
            grid = bodies.Grid(self.body, self.aligned(parts))
            points, cells = grid.points, grid.cells()
            if self.cells == "conforming":
                return whole, points, cells, None, None, None
            if flat:
                return "triangle", points, bodies.triangles(cells), None, None, None
            points, cells = bodies.tetrahedra(points, cells)
            return "tetrahedron", points, cells, None, None, None
        one = self.cells == "cut" and not flat and self.random() < 0.3
        side = spacing * (0.75 if one else 1.0)
        points, cells, fractions, octants = clouds.cut_cells(self.body, side, darts)
        return whole, points, cells, fractions, None if self.cells == "foreign" or flat else octants, 1 if one else None

    def aligned(self, parts):
        """Cells end where tissues change along the height."""
        count = len(self.interfaces) + 1
        if count == 1 or self.shape in ("ball", "ellipsoid", "l"):
            return parts
        rounded = []
        for p in parts:
            p = list(p)
            p[self.up] = max(count, count * round(p[self.up] / count))
            rounded.append(tuple(p))
        return rounded

    def surface(self):
        grid = bodies.Grid(self.body, self.body.divisions(self.spacing / 1.5))
        faces = {}
        for cell in grid.cells():
            for face in ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)):
                corners = [cell[i] for i in face]
                key = tuple(sorted(corners))
                if key in faces:
                    del faces[key]
                else:
                    faces[key] = corners
        used, triangles = {}, []
        for a, b, c, d in faces.values():
            triangles += [(a, b, c), (a, c, d)]
        triangles = [tuple(used.setdefault(a, len(used)) for a in t) for t in triangles]
        return [grid.points[a] for a in used], triangles

    # Its files.

    def write(self, folder):
        """nodes.vtu, cells.vtu and what else there is; the arguments of brainshift solve."""
        folder.mkdir(parents=True, exist_ok=True)
        darts = random.Random(1000003 * self.seed + 1).random
        points, on_surface = self.make_nodes(darts)
        self.write_nodes(folder / "nodes.vtu", points, on_surface)
        made = self.make_cells(darts, self.spacing)
        self.write_cells(folder / "cells.vtu", *made[:5])
        arguments = ["--nodes", folder / "nodes.vtu", "--cells", folder / "cells.vtu", "--basis", self.basis]
        if made[5]:
            arguments += ["--points-per-cell", made[5]]
        if self.dimensions == 3 and self.cells in ("cut", "foreign"):
            vtu.write_surface(folder / "body.vtp", *self.surface())
            arguments += ["--surface", folder / "body.vtp"]
        self.points = points
        return arguments + self.common(folder)

    def common(self, folder):
        arguments = []
        for label, ((young, poisson), power) in enumerate(zip(self.tissues, self.powers), 1):
            modulus = young / 2 / (1 + poisson)
            arguments += ["--material", f"{label}:{young!r},{poisson!r},1000" if power is None else
                          f"{label}:law=ogden,ogden={modulus!r},{power!r},poisson_ratio={poisson!r},density=1000"]
        if self.plane:
            arguments += ["--plane", self.plane]
        if self.gravity():
            arguments += ["--gravity", " ".join(repr(g) for g in self.gravity())]
        if len(self.tissues) > 1 and self.dimensions == 3:
            self.write_labels(folder / "labels.mha")
            arguments += ["--labels", folder / "labels.mha"]
        return arguments

    def write_reference(self, folder, finer):
        """The same on a regular cloud, `finer` times as fine, with cells that conform; its grid and the arguments."""
        folder.mkdir(parents=True, exist_ok=True)
        parts = [tuple(2 * max(1, round(p / 2)) for p in counts)
                 for counts in self.body.divisions(self.spacing / finer)]
        grid = bodies.Grid(self.body, self.even(parts))
        tiny = 1e-6 * self.height()
        on_surface = [1 if self.body.depth(x) < tiny else 0 for x in grid.points]
        self.write_nodes(folder / "nodes.vtu", grid.points, on_surface)
        cells = bodies.Grid(self.body, self.even(parts))
        self.write_cells(folder / "cells.vtu", "quadrilateral" if self.dimensions == 2 else "hexahedron", cells.points,
                         cells.cells(), None, None)
        arguments = ["--nodes", folder / "nodes.vtu", "--cells", folder / "cells.vtu", "--basis", "modified_quadratic",
                     "--precision", "double", "--tolerance", 0.02 if self.small else 0.005]
        return grid, arguments + self.common(folder)

    def even(self, parts):
        count = len(self.interfaces) + 1
        if count == 1 or self.shape in ("ball", "ellipsoid", "l"):
            return parts
        rounded = []
        for p in parts:
            p, step = list(p), 2 * count
            p[self.up] = max(step, step * round(p[self.up] / step))
            rounded.append(tuple(p))
        return rounded

    def write_nodes(self, file, points, on_surface):
        rows = [tuple(self.prescribed(x)) if s else (FREE,) * 3 for x, s in zip(points, on_surface)]
        vtu.write_grid(file, [(*x, 0.0)[:3] for x in points], "vertex", [[a] for a in range(len(points))],
                       {"on_surface": on_surface, "prescribed_displacement": rows}, {})

    def write_cells(self, file, kind, points, cells, fractions, octants):
        data = {"label": [self.label([sum(points[a][i] for a in c) / len(c) for i in range(self.dimensions)])
                          for c in cells]}
        if fractions:
            data["inside_fraction"] = fractions
        if octants:
            none = ((0.0,) * 8, (0.0,) * 24)
            data["octant_volume"] = [(o or none)[0] for o in octants]
            data["octant_centroid"] = [(o or none)[1] for o in octants]
        vtu.write_grid(file, [(*x, 0.0)[:3] for x in points], kind, cells, {}, data)

    def write_labels(self, file):
        voxel = self.spacing / 4
        counts = [math.ceil((h - l) / voxel) for l, h in zip(self.body.low, self.body.high)]
        first = [l + voxel / 2 for l in self.body.low]
        values = bytes(self.label([f + voxel * i for f, i in zip(first, place)])
                       for place in bodies.product([range(n) for n in counts]))
        sizes = " ".join(map(str, counts))
        file.write_bytes(f"ObjectType = Image\nNDims = 3\nBinaryData = True\nCompressedData = False\n"
                         f"Offset = {' '.join(map(repr, first))}\nElementSpacing = {voxel!r} {voxel!r} {voxel!r}\n"
                         f"DimSize = {sizes}\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n".encode() + values)

    def says(self):
        tissues = "; ".join(f"{young / YOUNG:.3g}, {poisson:g}" + (f", Ogden {power:g}" if power else "")
                            for (young, poisson), power in zip(self.tissues, self.powers))
        plane = f" (plane {self.plane})" if self.plane else ""
        return {"seed": self.seed, "body": self.shape + plane, "cloud": self.cloud, "cells": self.cells,
                "basis": self.basis, "tissues": tissues,
                "load": f"{self.load['kind']} {100 * self.load['amount']:.0f} %"}
