"""Extension of a square with a kinked cut from its left edge, plane strain: free triangles by gmsh (CPE6). The part above the cut and
the part below it are two surfaces that share the line ahead of the tip only, so that each face of the cut has nodes of its own."""
import subprocess
import sys

import numpy as np
from scipy.stats import qmc

from . import ccx, deck, evaluate, tables, tetrahedra

SIDE, PULL = 100.0, 20.0
PATH = np.array([[0, 50], [30, 50], [50, 62]], float)  # the last one is the tip
LEVELS = [12, 24, 48]  # edges of triangles along a side, far from the places they crowd at
CROWDS = [((50, 62), 40.0, 2.0), ((30, 50), 10.0, 1.5)] + [((x, y), 20.0, 1.5) for x in (0, SIDE) for y in (0, SIDE)]
SHARES = np.linspace(0.1, 1, 10)
LENGTH = np.hypot(*np.diff(PATH, axis=0).T).sum()
FACE_PLACES, OFF = np.linspace(1, LENGTH - 1, 40), 0.01  # samples of the faces: mm from the mouth along the cut, mm off it


def size_field(cells):
    """gmsh's edge lengths: within `reach` of a place those of a grid whose k-th node from there is (k / n)^power of `reach` away."""
    coarsest = SIDE / cells
    fields = [f"{coarsest:.9g}"]
    for (x, y), reach, power in CROWDS:
        first = reach * (coarsest / (power * reach)) ** power
        grows = 1 - 1 / power
        fields.append(f"{coarsest:.9g}*(((x-{x:g})^2+(y-{y:g})^2)/{reach ** 2:g}+{(first / coarsest) ** (2 / grows):.9g})^{grows / 2:.9g}")
    lines = [f'Field[{i}] = MathEval; Field[{i}].F = "{f}";' for i, f in enumerate(fields, 1)]
    numbers = ", ".join(str(i) for i in range(1, len(fields) + 1))
    return lines + [f"Field[{len(fields) + 1}] = Min; Field[{len(fields) + 1}].FieldsList = {{{numbers}}};",
                    f"Background Field = {len(fields) + 1};"]


def meshed(cells, stem):
    """6-node triangles of the square. The points of the cut but its tip are there twice, as are the lines between."""
    tip, right = len(PATH) - 1, [SIDE, PATH[-1, 1]]
    points = [*PATH, right, [SIDE, SIDE], [0, SIDE], [SIDE, 0], [0, 0], *PATH[:-1]]
    above = [*range(tip), tip, tip + 1, tip + 2, tip + 3]
    below = [*range(tip + 6, len(points)), tip, tip + 1, tip + 4, tip + 5]
    loops = [list(zip(chain, chain[1:] + chain[:1])) for chain in (above, below)]
    lines = {ends: number for number, ends in enumerate(dict.fromkeys(loops[0] + loops[1]), 1)}
    with open(stem + ".geo", "w") as geo:
        geo.writelines(f"Point({i}) = {{{p[0]:.12g}, {p[1]:.12g}, 0}};\n" for i, p in enumerate(points, 1))
        geo.writelines(f"Line({number}) = {{{a + 1}, {b + 1}}};\n" for (a, b), number in lines.items())
        for number, loop in enumerate(loops, 1):
            numbers = ", ".join(str(lines[ends]) for ends in loop)
            geo.write(f"Curve Loop({number}) = {{{numbers}}};\nPlane Surface({number}) = {{{number}}};\n")
        geo.write("\n".join(size_field(cells)) + "\nMesh.MeshSizeFromPoints = 0;\nMesh.MeshSizeExtendFromBoundary = 0;\n"
                  "Mesh.MeshSizeMin = 0;\nMesh.Algorithm = 6;\nMesh.SaveAll = 1;\n")
    with open(stem + "_gmsh.log", "w") as log:
        subprocess.run(["gmsh", "-2", stem + ".geo", "-format", "msh22", "-nt", "1", "-o", stem + ".msh"],
                       stdout=log, stderr=subprocess.STDOUT, check=True)
    return tetrahedra.quadratic(tetrahedra.read_msh(stem + ".msh", corners=3))[0]


def solve(cells, folder, material):
    path = f"{folder}/cut_path{cells}.inp"
    mesh = meshed(cells, path[:-len(".inp")])
    y = mesh.nodes[:, 1]
    top, bottom = mesh.where(y > SIDE - 1e-6), mesh.where(y < 1e-6)
    prescribed = (deck.prescribe(top, 1, 0) + deck.prescribe(top, 2, PULL) + deck.prescribe(bottom, 1, 0)
                  + deck.prescribe(bottom, 2, 0))
    deck.write_deck(path, mesh, "CPE6", material, deck.Loading(prescribed, SHARES, 0.5 * SHARES[0]),
                    {"TOP": top, "BOTTOM": bottom}, thickness=1.0)
    return mesh, ccx.run(path, len(mesh.nodes))


def along_path(places):
    """Points of the cut at lengths `places` from its mouth, and the unit normals to the upper face's side there."""
    steps = np.diff(PATH, axis=0)
    lengths = np.hypot(*steps.T)
    starts = np.concatenate([[0], np.cumsum(lengths)])
    part = np.clip(np.searchsorted(starts, places, side="right") - 1, 0, len(steps) - 1)
    along = steps[part] / lengths[part, None]
    return PATH[part] + (places - starts[part])[:, None] * along, along @ [[0, 1], [-1, 0]]


def distance_to_path(points):
    nearest = np.full(len(points), np.inf)
    for a, b in zip(PATH, PATH[1:]):
        t = np.clip((points - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
        nearest = np.minimum(nearest, np.hypot(*(points - a - t[:, None] * (b - a)).T))
    return nearest


def sample_points(seed=22, inside=700, near_tip=60, reach=5.0):
    """Points (x, y) by group; those inside and about the tip are of a seeded Sobol set."""
    unit = qmc.Sobol(2, seed=seed).random(1024)
    points = np.round(SIDE * unit, 4)
    middle, normal = along_path(FACE_PLACES)
    r, angle = reach * np.sqrt(unit[:, 0]), 2 * np.pi * unit[:, 1]
    disc = np.round(PATH[-1] + np.column_stack([r * np.cos(angle), r * np.sin(angle)]), 4)
    return {"inside": points[distance_to_path(points) > 1e-6][:inside],
            f"upper face of the cut ({OFF:g} mm off it)": np.round(middle + OFF * normal, 4),
            f"lower face ({OFF:g} mm off)": np.round(middle - OFF * normal, 4),
            f"within {reach:g} mm of the tip": disc[distance_to_path(disc) > OFF][:near_tip]}


def openings(groups, field):
    """By how much the face samples have gone apart along the cut's normal, from a field at all samples, mm."""
    ends = np.cumsum([len(points) for points in groups.values()])
    upper, lower = field[ends[0]:ends[1]], field[ends[1]:ends[2]]
    return ((upper - lower)[:, :2] * along_path(FACE_PLACES)[1]).sum(1)


def main(folder, out):
    material = deck.NeoHookean.from_young(3000, 0.49)
    groups = sample_points()
    points = np.vstack(list(groups.values()))
    samples, forces = [], []
    for cells in LEVELS:
        mesh, solution = solve(cells, folder, material)
        field = solution.fields[1.0]
        samples.append(np.pad(evaluate.Interpolator(mesh, points)(field)[:, :2], ((0, 0), (0, 1))))
        opening = openings(groups, samples[-1])
        print(f"cut_path: {len(mesh.elements)} CPE6 on {len(mesh.nodes)} nodes, reached {solution.reached}, "
              f"{[1e-6 * f[max(f)][1] for f in solution.forces.values()]} N/mm, least area ratio "
              f"{evaluate.smallest_area_ratio(mesh, field):.3f}, opening {opening.min():.4f} to {opening.max():.4f} mm, "
              f"{solution.seconds:.0f} s", flush=True)
        forces.append(np.array([1e-6 * solution.forces["TOP"][round(s, 6)][1] for s in SHARES]))
    force, lengths, lines = tables.convergence([f[-1] for f in forces], samples, LEVELS)
    about = ["Finite-element reference: extension by 20 % of a square with a kinked cut, plane strain",
             "lengths mm, force N per mm of undeformed thickness; x, y, z is the undeformed place",
             "geometry: 0 <= x <= 100, 0 <= y <= 100; cut from (0, 50) through (30, 50) to its tip (50, 62), of no width",
             f"material: {material}, E = 3000 Pa, nu = 0.49",
             "boundary: y = 0: ux = uy = 0; y = 100: ux = 0, uy = +20; x = 0, x = 100 and the faces of the cut free; static, "
             "large strain; the faces open everywhere and do not touch",
             f"made by fe/cut_path.py with {tables.versions(with_gmsh=True)}",
             f"finest mesh: {len(mesh.elements)} CPE6 on {len(mesh.nodes)} nodes, crowded at the tip, the kink and the held corners",
             *lines, tables.error_line(force, lengths)]
    tables.write_samples(f"{out}/cut_path.csv", about + [tables.row_ranges(groups)],
                         np.column_stack([points, np.zeros(len(points))]), samples[-1])
    tables.write_curve(f"{out}/cut_path_force.csv", about, [[0, 0]] + list(zip(PULL * SHARES, forces[-1])),
                       "displacement_mm,force_N_per_mm")


if __name__ == "__main__":
    main(*sys.argv[1:])
