# SPDX-License-Identifier: GPL-3.0-or-later
"""Bodies that are images of a few unit cubes (squares): what is inside, where edges and faces are, and regular grids of
nodes and cells that conform to them."""
import math

CORE = {2: 0.5, 3: 0.4}  # half side of the square in a disc and of the cube in a ball, over the radius


class Box:
    """An axis-parallel image of the unit cube."""

    def __init__(self, low, high):
        self.low, self.high = low, high

    def at(self, place):
        return tuple(l + (h - l) * p for l, h, p in zip(self.low, self.high, place))

    def places(self, x):
        return tuple((v - l) / (h - l) for v, l, h in zip(x, self.low, self.high))


class Shell:
    """Between a square (cube) about the origin and its disc (ball), on one of its sides, along rays."""

    def __init__(self, radius, axis, sign, dimensions):
        self.radius, self.axis, self.sign, self.dimensions = radius, axis, sign, dimensions
        self.core = CORE[dimensions]

    def turned(self, x):
        """The side's direction becomes the first; right-handed."""
        n = self.dimensions
        y = [x[(self.axis + i) % n] for i in range(n)]
        if n == 2 and self.axis == 1:
            y[1] = -y[1]
        if self.sign < 0:
            y[0], y[1] = -y[0], -y[1]
        return y

    def back(self, y):
        n, y = self.dimensions, list(y)
        if self.sign < 0:
            y[0], y[1] = -y[0], -y[1]
        if n == 2 and self.axis == 1:
            y[1] = -y[1]
        x = [0.0] * n
        for i in range(n):
            x[(self.axis + i) % n] = y[i]
        return tuple(x)

    def at(self, place):
        ray = [1.0] + [2 * p - 1 for p in place[1:]]
        length = math.sqrt(sum(r * r for r in ray))
        far = self.radius * (self.core + (1 / length - self.core) * place[0])
        return self.back([far * r for r in ray])

    def places(self, x):
        y = self.turned(x)
        if y[0] <= 0:
            return (math.inf,) * self.dimensions
        ray = [v / y[0] for v in y]
        length = math.sqrt(sum(r * r for r in ray))
        return ((y[0] / self.radius - self.core) / (1 / length - self.core), *((r + 1) / 2 for r in ray[1:]))


class Upright:
    """A block of a plane body, raised."""

    def __init__(self, block, height):
        self.block, self.height = block, height

    def at(self, place):
        return (*self.block.at(place[:2]), self.height * place[2])

    def places(self, x):
        return (*self.block.places(x[:2]), x[2] / self.height)


class Stretched:
    def __init__(self, block, factors):
        self.block, self.factors = block, factors

    def at(self, place):
        return tuple(f * v for f, v in zip(self.factors, self.block.at(place)))

    def places(self, x):
        return self.block.places(tuple(v / f for v, f in zip(x, self.factors)))


def parts_of(length, spacing):
    return max(1, round(length / spacing))


class Polygon:
    """A rectangle, or an L: a rectangle without its upper right quarter, cut at the given shares."""

    def __init__(self, width, height, cut=None):
        self.low, self.high = (0.0, 0.0), (width, height)
        if cut is None:
            self.corners = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)]
            self.blocks = [Box((0.0, 0.0), (width, height))]
        else:
            x, y = cut[0] * width, cut[1] * height
            self.corners = [(0.0, 0.0), (width, 0.0), (width, y), (x, y), (x, height), (0.0, height)]
            self.blocks = [Box((0.0, 0.0), (x, y)), Box((x, 0.0), (width, y)), Box((0.0, y), (x, height))]
        self.cut = cut

    def depth(self, x):
        inner = min(x[0], x[1], self.high[0] - x[0], self.high[1] - x[1])
        if self.cut is None:
            return inner
        from_cut = (self.cut[0] * self.high[0] - x[0], self.cut[1] * self.high[1] - x[1])
        if max(from_cut) < 0:
            return max(from_cut)
        away = math.hypot(*from_cut) if min(from_cut) > 0 else max(from_cut)
        return min(inner, away)

    def divisions(self, spacing):
        return [tuple(parts_of(h - l, spacing) for l, h in zip(b.low, b.high)) for b in self.blocks]

    def edges(self):
        """(length, share -> place) of each side."""
        sides = zip(self.corners, self.corners[1:] + self.corners[:1])
        return [(math.dist(a, b), lambda s, a=a, b=b: tuple(u + (v - u) * s for u, v in zip(a, b))) for a, b in sides]

    def area(self):
        pairs = zip(self.corners, self.corners[1:] + self.corners[:1])
        return sum(a[0] * b[1] - b[0] * a[1] for a, b in pairs) / 2


class Disc:
    def __init__(self, radius):
        self.radius = radius
        self.low, self.high = (-radius, -radius), (radius, radius)
        self.corners = []
        side = CORE[2] * radius
        self.blocks = [Box((-side, -side), (side, side))] + [Shell(radius, axis, sign, 2)
                                                              for axis in (0, 1) for sign in (1, -1)]

    def depth(self, x):
        return self.radius - math.hypot(*x)

    def divisions(self, spacing):
        core = parts_of(1.3 * self.radius, spacing)
        shell = parts_of((1 - 1.2 * CORE[2]) * self.radius, spacing)
        return [(core, core)] + [(shell, core)] * 4

    def edges(self):
        r = self.radius
        return [(2 * math.pi * r, lambda s: (r * math.cos(2 * math.pi * s), r * math.sin(2 * math.pi * s)))]

    def area(self):
        return math.pi * self.radius ** 2


class Plane:
    """A plane body: its sections, one block each."""

    def __init__(self, profile):
        self.profile, self.blocks = profile, profile.blocks
        self.low, self.high, self.depth, self.divisions = profile.low, profile.high, profile.depth, profile.divisions
        self.size = profile.area()
        self.dimensions = 2

    def boundary(self, darts):
        for corner in self.profile.corners:
            darts.put(corner, True)
        for length, place in self.profile.edges():
            darts.along(length, place)


class Extruded:
    """A plane body raised to a height."""

    def __init__(self, profile, height):
        self.profile, self.height = profile, height
        self.blocks = [Upright(b, height) for b in profile.blocks]
        self.low, self.high = (*profile.low, 0.0), (*profile.high, height)
        self.size = profile.area() * height
        self.dimensions = 3

    def depth(self, x):
        return min(self.profile.depth(x[:2]), x[2], self.height - x[2])

    def divisions(self, spacing):
        return [(*d, parts_of(self.height, spacing)) for d in self.profile.divisions(spacing)]

    def boundary(self, darts):
        profile, height = self.profile, self.height
        levels = (0.0, height)
        for x, y in profile.corners:
            for z in levels:
                darts.put((x, y, z), True)
        for length, place in profile.edges():
            for z in levels:
                darts.along(length, lambda s, p=place, z=z: (*p(s), z))
        for x, y in profile.corners:
            darts.along(height, lambda s, x=x, y=y: (x, y, height * s))
        for z in levels:
            darts.fill(lambda z=z: (*darts.within(profile), z), True)
        for length, place in profile.edges():
            darts.fill(lambda p=place: (*p(darts.random()), height * darts.random()), True)


class Ball:
    """A ball, or an ellipsoid: stretched by factors."""

    def __init__(self, radius, factors=(1.0, 1.0, 1.0)):
        self.radius, self.factors = radius, factors
        side = CORE[3] * radius
        blocks = [Box((-side,) * 3, (side,) * 3)] + [Shell(radius, axis, sign, 3)
                                                     for axis in (0, 1, 2) for sign in (1, -1)]
        self.blocks = [Stretched(b, factors) for b in blocks]
        self.high = tuple(radius * f for f in factors)
        self.low = tuple(-h for h in self.high)
        self.size = 4 / 3 * math.pi * math.prod(self.high)
        self.dimensions = 3

    def depth(self, x):
        """Zero on the surface, and at least a third of the distance inside."""
        return (1 - math.hypot(*(v / h for v, h in zip(x, self.high)))) * min(self.high)

    def divisions(self, spacing):
        spacing = spacing / (math.prod(self.factors) ** (1 / 3))
        core = parts_of(1.2 * self.radius, spacing)
        shell = parts_of((1 - 1.3 * CORE[3]) * self.radius, spacing)
        return [(core,) * 3] + [(shell, core, core)] * 6

    def boundary(self, darts):
        def place():
            while True:
                x = [2 * darts.random() - 1 for _ in range(3)]
                length = math.hypot(*x)
                if 0.1 < length <= 1:
                    return tuple(h * v / length for h, v in zip(self.high, x))
        darts.fill(place, True)


class Grid:
    """Regular nodes of all blocks, those that two blocks share once; `parts`: of each block along its axes."""

    def __init__(self, body, parts):
        self.body, self.parts = body, parts
        self.points, self.index, self.blocks = [], {}, []
        scale = 1e-6 * max(h - l for l, h in zip(body.low, body.high))
        for block, counts in zip(body.blocks, parts):
            ranges = [range(n + 1) for n in counts]
            nodes = {}
            for place in product(ranges):
                x = block.at(tuple(i / n for i, n in zip(place, counts)))
                key = tuple(round(v / scale / 8) for v in x)
                if key not in self.index:
                    self.index[key] = len(self.points)
                    self.points.append(x)
                nodes[place] = self.index[key]
            self.blocks.append(nodes)

    def cells(self):
        """Hexahedra or quadrilaterals, VTK order."""
        around = [(0, 0), (1, 0), (1, 1), (0, 1)]
        corners = around if self.body.dimensions == 2 else [(i, j, k) for k in (0, 1) for i, j in around]
        found = []
        for nodes, counts in zip(self.blocks, self.parts):
            for place in product([range(n) for n in counts]):
                found.append([nodes[tuple(p + c for p, c in zip(place, corner))] for corner in corners])
        return [self.right_handed(cell) for cell in found]

    def right_handed(self, cell):
        a, b, d = (self.points[cell[i]] for i in (0, 1, 3))
        u, v = [q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, d)]
        turn = u[0] * v[1] - u[1] * v[0]
        if self.body.dimensions == 3:
            w = [q - p for p, q in zip(a, self.points[cell[4]])]
            turn = (turn * w[2] + (u[1] * v[2] - u[2] * v[1]) * w[0] + (u[2] * v[0] - u[0] * v[2]) * w[1])
        if turn > 0:
            return cell
        return [cell[i] for i in ((0, 3, 2, 1) if len(cell) == 4 else (0, 3, 2, 1, 4, 7, 6, 5))]

    def interpolate(self, values, x):
        """By quadratic functions of 3 nodes a direction; the grid's parts are even."""
        best, where = math.inf, None
        for number, block in enumerate(self.body.blocks):
            place = block.places(x)
            out = max(max(-p, p - 1) for p in place)
            if out < best:
                best, where = out, (number, place)
        number, place = where
        first, weights = [], []
        for p, n in zip(place, self.parts[number]):
            i = min(max(int(p * n / 2), 0), n // 2 - 1)
            t = p * n - 2 * i - 1
            first.append(2 * i)
            weights.append((t * (t - 1) / 2, 1 - t * t, t * (t + 1) / 2))
        sums = [0.0] * len(values[0])
        for offset in product([range(3)] * len(first)):
            weight = math.prod(w[o] for w, o in zip(weights, offset))
            row = values[self.blocks[number][tuple(f + o for f, o in zip(first, offset))]]
            sums = [s + weight * v for s, v in zip(sums, row)]
        return tuple(sums)


def product(ranges):
    """itertools.product, the first index fastest."""
    if not ranges:
        yield ()
        return
    for rest in product(ranges[1:]):
        for i in ranges[0]:
            yield (i, *rest)


def tetrahedra(points, cells):
    """Twelve of each hexahedron, about its middle; a face's diagonal starts at its lowest number, so that neighbours
    agree. Returns the points with the middles, and the cells."""
    faces = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))  # outward
    points, found = list(points), []
    for cell in cells:
        middle = len(points)
        points.append(tuple(sum(points[a][i] for a in cell) / 8 for i in range(3)))
        for face in faces:
            a = [cell[i] for i in face]
            start = a.index(min(a))
            a = a[start:] + a[:start]
            found += [[a[0], a[2], a[1], middle], [a[0], a[3], a[2], middle]]
    return points, found


def triangles(cells):
    return [half for a, b, c, d in cells for half in ([a, b, c], [a, c, d])]
