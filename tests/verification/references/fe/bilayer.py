"""A bar of two bonded layers of which one swells: a quarter of it in bricks, for x = 0 and y = 0 are planes of symmetry."""
import sys

import numpy as np
from scipy.stats import qmc

from . import ccx, deck, evaluate, meshes, study, tables

SIZE = np.array([40.0, 10.0, 20.0])  # of the quarter
SEAM = 10.0  # z where the layers meet; the lower one swells
SWELLING = 0.01  # CalculiX takes the thermal strain off the Green-Lagrange strain, which is off by its square
LEVELS = [3, 4, 6]  # cells in 10 mm


def quarter(cells):
    flat = meshes.rectangle(SIZE[0] * meshes.graded(2 * cells, 1.5), SIZE[1] * meshes.graded(cells, 1.5))
    layer = meshes.graded(cells, 1.5, both_ends=True)
    return meshes.extruded(flat, SEAM * np.append(layer, 1 + layer[1:]))


def solve(cells, folder, material):
    mesh = quarter(cells)
    x, y, z = mesh.nodes.T
    corner = mesh.where((x < 1e-6) & (y < 1e-6) & (z < 1e-6))
    prescribed = (deck.prescribe(mesh.where(x < 1e-6), 1, 0) + deck.prescribe(mesh.where(y < 1e-6), 2, 0)
                  + deck.prescribe(corner, 3, 0))
    lower = mesh.nodes[mesh.elements].mean(1)[:, 2] < SEAM
    layers = [deck.Layer(np.flatnonzero(lower), SWELLING), deck.Layer(np.flatnonzero(~lower), 0)]
    path = f"{folder}/bilayer{cells}.inp"
    deck.write_deck(path, mesh, "C3D20R", material, deck.Loading(prescribed, np.array([1.0]), 0.25), {"CORNER": corner},
                    layers=layers)
    return mesh, ccx.run(path, len(mesh.nodes))


def main(folder, out):
    material = deck.NeoHookean.from_young(3000, 0.49)
    points = np.round(qmc.Sobol(3, seed=29).random(512) * SIZE, 4)
    finest, lines = study.converged("bilayer", "C3D20R", LEVELS, lambda cells: solve(cells, folder, material),
                                    lambda mesh, field: evaluate.Interpolator(mesh, points)(field),
                                    lambda _, field: field[:, 2].max(), "highest uz, mm")
    about = ["Finite-element reference: a bar of two bonded layers, the lower one swollen by 1 % of its volume",
             "lengths mm; x, y, z is the undeformed place",
             "geometry: a quarter, 0 <= x <= 40, 0 <= y <= 10, 0 <= z <= 20; the layers meet at z = 10",
             f"material of both: {material}, E = 3000 Pa, nu = 0.49; swelling as the thermal strain of CalculiX, "
             "(1 + 0.01)^(1/3) - 1 along each axis",
             "boundary: ux = 0 on x = 0, uy = 0 on y = 0 (mirrors), uz = 0 at the origin; all else free; static, large strain",
             *lines]
    tables.write_samples(f"{out}/bilayer.csv", about, points, finest)


if __name__ == "__main__":
    main(*sys.argv[1:])
