"""A block on its base, the fluid round it drained to half its height: a quarter in bricks, with the fluid's pressure on the
faces that are still wet and the weight that the fluid carried before on all of the tissue."""
import sys

import numpy as np
from scipy.stats import qmc

from . import ccx, deck, evaluate, meshes, study, tables

HALF, HEIGHT, LEVEL = 20.0, 40.0, 20.0  # mm
DENSITY, GRAVITY = 1007e-6, 9806.65  # g/mm3, mm/s2
LEVELS = [4, 6, 8]  # cells in 20 mm


def quarter(cells):
    flat = meshes.rectangle(HALF * meshes.graded(cells, 1.5), HALF * meshes.graded(cells, 1.5))
    layer = meshes.graded(cells, 1.5, both_ends=True)
    return meshes.extruded(flat, LEVEL * np.append(layer, 1 + layer[1:]))


# CalculiX's faces of a brick, by corners.
FACES = np.array([[0, 1, 2, 3], [4, 7, 6, 5], [0, 4, 5, 1], [1, 5, 6, 2], [2, 6, 7, 3], [3, 7, 4, 0]])


def wet_faces(mesh):
    """Lines of *DLOAD: the hydrostatic pressure in the middle of each face on the outer sides below the level, Pa."""
    lines = []
    for number, corners in enumerate(mesh.elements[:, :8]):
        for face, members in enumerate(FACES):
            places = mesh.nodes[corners[members]]
            outer = any(np.all(places[:, axis] > HALF - 1e-6) for axis in (0, 1))
            middle = places[:, 2].mean()
            if outer and middle < LEVEL:
                lines.append(f"{number + 1}, P{face + 1}, {DENSITY * GRAVITY * (LEVEL - middle):.12g}\n")
    return "".join(lines)


def solve(cells, folder, material):
    mesh = quarter(cells)
    x, y, z = mesh.nodes.T
    base = mesh.where(z < 1e-6)
    prescribed = [row for axis in (1, 2, 3) for row in deck.prescribe(base, axis, 0)]
    prescribed += deck.prescribe(mesh.where((x < 1e-6) & (z > 1e-6)), 1, 0)
    prescribed += deck.prescribe(mesh.where((y < 1e-6) & (z > 1e-6)), 2, 0)
    loads = f"*DLOAD\nBODY, GRAV, {GRAVITY:.12g}, 0, 0, -1\n" + wet_faces(mesh)
    path = f"{folder}/wet_block{cells}.inp"
    deck.write_deck(path, mesh, "C3D20R", material, deck.Loading(prescribed, np.array([1.0]), 0.25), {"BASE": base},
                    density=DENSITY, step_lines=loads)
    return mesh, ccx.run(path, len(mesh.nodes))


def main(folder, out):
    material = deck.NeoHookean.from_young(3000, 0.499)
    points = np.round(qmc.Sobol(3, seed=31).random(512) * [HALF, HALF, HEIGHT], 4)
    finest, lines = study.converged("wet_block", "C3D20R", LEVELS, lambda cells: solve(cells, folder, material),
                                    lambda mesh, field: evaluate.Interpolator(mesh, points)(field),
                                    lambda solution, _: 4e-6 * solution.forces["BASE"][1.0][2])
    about = ["Finite-element reference: a block whose fluid has drained to half its height",
             "lengths mm, force N (of the whole block on its base); x, y, z is the undeformed place",
             "geometry: a quarter, 0 <= x <= 20, 0 <= y <= 20, 0 <= z <= 40; the fluid stands at z = 20",
             f"material: {material}, E = 3000 Pa, nu = 0.499",
             f"load: weight of {1e6 * DENSITY:g} kg/m3 with {1e-3 * GRAVITY:g} m/s2 along -z on all of it, and the pressure of a "
             "fluid of that density on the sides below z = 20, which follows them",
             "boundary: u = 0 on z = 0, ux = 0 on x = 0, uy = 0 on y = 0 (mirrors); static, large strain",
             *lines]
    tables.write_samples(f"{out}/wet_block.csv", about, points, finest)


if __name__ == "__main__":
    main(*sys.argv[1:])
