# SPDX-License-Identifier: GPL-3.0-or-later
"""The same problem by CalculiX, on bricks of 20 nodes with reduced integration (C3D20R)."""
import shutil
import subprocess

import bodies

EDGES = ((1, 0, 0), (2, 1, 0), (1, 2, 0), (0, 1, 0), (1, 0, 2), (2, 1, 2), (1, 2, 2), (0, 1, 2),
         (0, 0, 1), (2, 0, 1), (2, 2, 1), (0, 2, 1))
CORNERS = ((0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2))


def can_solve(problem):
    return shutil.which("ccx") is not None and problem.plane != "stress" and not any(problem.powers)


class Bricks:
    """Every second node of a grid is a corner; in the plane one brick thick."""

    def __init__(self, problem, finer):
        self.problem = problem
        body, parts = problem.body, problem.even(problem.body.divisions(problem.spacing / finer))
        parts = [tuple(2 * max(1, round(p / 2)) for p in counts) for counts in parts]
        if problem.dimensions == 2:
            body = bodies.Extruded(body.profile, problem.spacing)
            parts = [(*counts, 2) for counts in parts]
        self.grid = bodies.Grid(body, problem.even(parts))
        self.elements, self.faces, self.middles = [], [], []
        for nodes, counts in zip(self.grid.blocks, self.grid.parts):
            for first in bodies.product([range(0, n, 2) for n in counts]):
                at = lambda o: nodes[tuple(f + i for f, i in zip(first, o))]
                corners, edges = [at(o) for o in CORNERS], [at(o) for o in EDGES]
                turned = self.grid.right_handed(corners) != corners
                self.elements.append((corners, edges, turned))
                self.middles.append((at((1, 1, 1)), corners, edges))
                for axis in range(3):
                    for end in (0, 2):
                        on = lambda o: o[axis] == end
                        middle = [1, 1, 1]
                        middle[axis] = end
                        self.faces.append((at(middle), [at(o) for o in CORNERS if on(o)],
                                           [at(o) for o in EDGES if on(o)]))

    def numbers(self, corners, edges, turned):
        if not turned:
            return corners + edges
        c, e = corners, edges
        return [c[0], c[3], c[2], c[1], c[4], c[7], c[6], c[5], e[3], e[2], e[1], e[0], e[7], e[6], e[5], e[4],
                e[8], e[11], e[10], e[9]]

    def write(self, file):
        problem, points = self.problem, self.grid.points
        used = sorted({a for corners, edges, _ in self.elements for a in corners + edges})
        lines = ["*NODE, NSET=ALL"] + [f"{a + 1}, {points[a][0]:.12g}, {points[a][1]:.12g}, {points[a][2]:.12g}"
                                       for a in used]
        by_label = {}
        for element in self.elements:
            middle = [sum(points[a][i] for a in element[0]) / 8 for i in range(problem.dimensions)]
            by_label.setdefault(problem.label(middle), []).append(element)
        number = 0
        for label, elements in by_label.items():
            lines.append(f"*ELEMENT, TYPE=C3D20R, ELSET=TISSUE{label}")
            for element in elements:
                number += 1
                nodes = [str(a + 1) for a in self.numbers(*element)]
                lines += [", ".join([str(number)] + nodes[:11]) + ",", ", ".join(nodes[11:])]
        for label in by_label:
            young, poisson = problem.tissues[label - 1]
            mu, bulk = young / 2 / (1 + poisson), young / 3 / (1 - 2 * poisson)
            lines += [f"*MATERIAL, NAME=TISSUE{label}", "*HYPERELASTIC, NEO HOOKE", f"{mu / 2:.12g}, {2 / bulk:.12g}",
                      "*DENSITY", "1e-3", f"*SOLID SECTION, ELSET=TISSUE{label}, MATERIAL=TISSUE{label}"]
        lines += ["*STEP, NLGEOM, INC=200", "*STATIC", "0.2, 1., 1e-3, 0.25", "*BOUNDARY"]
        n, tiny = problem.dimensions, 1e-6 * problem.height()
        for a in used:
            x = points[a][:n]
            prescribed = problem.prescribed(x) if problem.body.depth(x) < tiny else [float("nan")] * 3
            if n == 2:
                prescribed = [*prescribed[:2], 0.0]
            lines += [f"{a + 1}, {i + 1}, {i + 1}, {u:.12g}" for i, u in enumerate(prescribed) if u == u]
        if problem.gravity():
            g = problem.gravity()
            size = sum(v * v for v in g) ** 0.5
            lines.append("*DLOAD")
            lines += [f"TISSUE{label}, GRAV, {1e3 * size:.12g}, " + ", ".join(f"{v / size:.12g}" for v in g)
                      for label in by_label]
        lines += ["*NODE PRINT, NSET=ALL", "U", "*END STEP"]
        file.write_text("\n".join(lines) + "\n")

    def solve(self, folder, seconds):
        """Displacements at the grid's nodes; None where CalculiX does not come to the whole load in time."""
        folder.mkdir(parents=True, exist_ok=True)
        self.write(folder / "deck.inp")
        with open(folder / "deck.log", "w") as log:
            try:
                subprocess.run(["ccx", "-i", "deck"], cwd=folder, stdout=log, stderr=subprocess.STDOUT, timeout=seconds)
            except subprocess.TimeoutExpired:
                return None
        values, whole = {}, False
        for line in (folder / "deck.dat").read_text().splitlines():
            words = line.split()
            if "time" in line:
                whole = abs(float(words[-1]) - 1) < 1e-6
            elif len(words) == 4 and whole:
                values[int(words[0]) - 1] = tuple(float(w) for w in words[1:])
        return self.completed(values) if values else None

    def completed(self, values):
        """With the middles of faces and bricks, by the functions of the 20 nodes."""
        for share, places in ((0.5, self.faces), (0.25, self.middles)):
            for node, corners, edges in places:
                values[node] = tuple(share * sum(values[a][i] for a in edges) -
                                     0.25 * sum(values[a][i] for a in corners) for i in range(3))
        return [values[a] for a in range(len(self.grid.points))]

    def interpolate(self, values, x):
        place = x if self.problem.dimensions == 3 else (*x, self.problem.spacing / 2)
        return self.grid.interpolate(values, place)
