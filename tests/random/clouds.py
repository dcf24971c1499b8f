# SPDX-License-Identifier: GPL-3.0-or-later
"""Irregular nodes, and background cells that do not conform."""
import math

from bodies import product


class Darts:
    """A node is kept when no other lies nearer than the least distance at its place. `distance`: a function of the
    place; `random`: numbers in [0, 1)."""

    def __init__(self, body, distance, largest, random, patience):
        self.body, self.distance, self.random, self.patience = body, distance, random, patience
        self.side = largest
        self.buckets, self.points, self.on_surface = {}, [], []

    def bucket(self, x):
        return tuple(math.floor(v / self.side) for v in x)

    def put(self, x, on_surface):
        least = self.distance(x)
        middle = self.bucket(x)
        for offset in product([range(-1, 2)] * len(x)):
            for y in self.buckets.get(tuple(m + o for m, o in zip(middle, offset)), ()):
                if math.dist(x, y) < least:
                    return False
        self.buckets.setdefault(middle, []).append(x)
        self.points.append(x)
        self.on_surface.append(1 if on_surface else 0)
        return True

    def fill(self, place, on_surface):
        in_vain = 0
        while in_vain < self.patience:
            in_vain = 0 if self.put(place(), on_surface) else in_vain + 1

    def along(self, length, place):
        """As many as fit, evenly but for a tenth of their distance, as far apart as the line asks for."""
        share = 0.0
        while share < 1:
            self.put(place(share), True)
            share += self.distance(place(share)) * (1.04 + 0.1 * self.random()) / length

    def within(self, region):
        while True:
            x = tuple(l + (h - l) * self.random() for l, h in zip(region.low, region.high))
            if region.depth(x) >= 0:
                return x

    def inside(self):
        x = self.within(self.body)
        while self.body.depth(x) < 0.5 * self.distance(x):
            x = self.within(self.body)
        return x


def throw(body, distance, largest, random, patience=150):
    """(points, on_surface)."""
    darts = Darts(body, distance, largest, random, patience)
    body.boundary(darts)
    darts.fill(darts.inside, False)
    return darts.points, darts.on_surface


def cut_cells(body, side, random):
    """Cubes (squares) that cover the body, from a random place on; of each that the surface cuts what lies inside, by
    a fine lattice, and for a cube the same of each octant. (vertices, cells, fractions, octants); octants: (volumes,
    centroids) or None where the cell is whole."""
    dimensions, fine = body.dimensions, 6
    start = [l - side * (0.05 + 0.9 * random()) for l in body.low]
    counts = [math.ceil((h - s) / side) for h, s in zip(body.high, start)]
    around = [(0, 0), (1, 0), (1, 1), (0, 1)]
    corners = around if dimensions == 2 else [(i, j, k) for k in (0, 1) for i, j in around]
    lattice = list(product([range(fine)] * dimensions))
    vertices, index, cells, fractions, octants = [], {}, [], [], []
    for place in product([range(n) for n in counts]):
        base = [s + side * p for s, p in zip(start, place)]
        depth = body.depth([b + side / 2 for b in base])
        if depth < -side * math.sqrt(dimensions) / 2:
            continue
        whole = depth > side * math.sqrt(dimensions) / 2
        parts = {}
        if not whole:
            for sub in lattice:
                x = [b + side * (s + 0.5) / fine for b, s in zip(base, sub)]
                if body.depth(x) >= 0:
                    part = sum(1 << i for i, s in enumerate(sub) if 2 * s >= fine)
                    parts.setdefault(part, []).append(x)
            inside = sum(len(p) for p in parts.values()) / len(lattice)
            if inside < 0.005:
                continue
            whole = inside == 1
        fractions.append(1.0 if whole else inside)
        cell = []
        for corner in corners:
            key = tuple(p + c for p, c in zip(place, corner))
            if key not in index:
                index[key] = len(vertices)
                vertices.append(tuple(s + side * k for s, k in zip(start, key)))
            cell.append(index[key])
        cells.append(cell)
        if whole or dimensions == 2:
            octants.append(None)
            continue
        volume = [0.0] * 8
        centroid = [0.0] * 24
        for part, places in parts.items():
            volume[part] = len(places) / len(lattice) * side ** 3
            for i in range(3):
                centroid[3 * part + i] = sum(x[i] for x in places) / len(places)
        octants.append((tuple(volume), tuple(centroid)))
    return vertices, cells, fractions, octants
