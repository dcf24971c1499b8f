"""Extension of a rectangle between held edges, plane strain and plane stress: the lower half of it, for y = 20 is a plane of
symmetry. Modelled flat (CPE6, CPS6). CalculiX makes the flat elements
one layer of solid ones: thin, for in plane stress shear across a thick layer would hinder the narrowing near the held edges."""
import sys

import numpy as np
from scipy.stats import qmc

from . import ccx, deck, evaluate, meshes, tables

LENGTH, WIDTH, PULL = 100.0, 40.0, 30.0
LEVELS = [6, 12, 24]  # cells in half the width; twice as many in half the length
POWER = 1.5
THICKNESS = {"plane_strain": 1.0, "plane_stress": 0.05}
SHARES = np.linspace(1 / 15, 1, 15)
STATES = {"plane_strain": "CPE6", "plane_stress": "CPS6"}


def quarter(cells):
    """Triangles of 0 <= x <= 50, 0 <= y <= 20 counted from the middle, graded to the held corner."""
    flat = meshes.rectangle(0.5 * LENGTH * meshes.graded(2 * cells, POWER), 0.5 * WIDTH * meshes.graded(cells, POWER))
    return meshes.triangles(flat)


def solve(cells, state, folder, material):
    mesh = quarter(cells)
    x, y = mesh.nodes.T
    right, middle, axis = mesh.where(x > 0.5 * LENGTH - 1e-6), mesh.where(x < 1e-6), mesh.where(y < 1e-6)
    prescribed = (deck.prescribe(right, 1, 0.5 * PULL) + deck.prescribe(right, 2, 0) + deck.prescribe(middle, 1, 0)
                  + deck.prescribe(np.setdiff1d(axis, right), 2, 0))
    path = f"{folder}/{state}{cells}.inp"
    deck.write_deck(path, mesh, STATES[state], material, deck.Loading(prescribed, SHARES, SHARES[0]),
                    {"RIGHT": right, "MIDDLE": middle}, thickness=THICKNESS[state])
    return mesh, ccx.run(path, len(mesh.nodes))


def sample_points(seed=21, inside=420, edges=100, corners=80):
    """Points (x, y) of a seeded Sobol set: inside, on the free edges, and within 4 mm of the held corners."""
    def unit(count):
        return qmc.Sobol(2, seed=seed).random(512)[:count]

    free, near = unit(edges), unit(corners)
    which = np.arange(corners)
    return np.round(np.vstack([
        unit(inside) * [LENGTH, WIDTH],
        np.column_stack([LENGTH * free[:, 0], np.where(np.arange(edges) % 2, 0, WIDTH)]),
        np.column_stack([np.where(which % 2, 4 * near[:, 0], LENGTH - 4 * near[:, 0]),
                         np.where(which // 2 % 2, 4 * near[:, 1], WIDTH - 4 * near[:, 1])])]), 4)


def at_points(mesh, field, points):
    """Displacement (ux, uy, 0) at points of the whole rectangle from that of the quarter."""
    local = points - [0.5 * LENGTH, 0.5 * WIDTH]
    values = evaluate.Interpolator(mesh, np.abs(local))(field)[:, :2]
    return np.column_stack([values * np.where(local < 0, -1, 1) + [0.5 * PULL, 0], np.zeros(len(points))])


def main(folder, out):
    material = deck.NeoHookean.from_young(3000, 0.49)
    points = sample_points()
    nodes = np.loadtxt(f"{out}/extension_nodes.csv", delimiter=",", skiprows=2)[:, :2]
    for state, kind in STATES.items():
        samples, forces = [], []
        for cells in LEVELS:
            mesh, solution = solve(cells, state, folder, material)
            print(f"extension_{state}: {len(mesh.elements)} {kind}, reached {solution.reached}, "
                  f"{[2e-6 / THICKNESS[state] * f[max(f)][0] for f in solution.forces.values()]} N/mm, {solution.seconds:.0f} s", flush=True)
            samples.append(at_points(mesh, solution.fields[1.0], points))
            forces.append(np.array([2e-6 / THICKNESS[state] * solution.forces["RIGHT"][round(s, 6)][0] for s in SHARES]))
        force, lengths, lines = tables.convergence([f[-1] for f in forces], samples, LEVELS)
        about = [f"Finite-element reference: extension of a rectangle by 30 %, {state.replace('_', ' ')}",
                 "lengths mm, force N per mm of undeformed thickness; x, y, z is the undeformed place",
                 "geometry: 0 <= x <= 100, 0 <= y <= 40",
                 f"material: {material}, E = 3000 Pa, nu = 0.49",
                 "boundary: x = 0: ux = uy = 0; x = 100: ux = +30, uy = 0; y = 0 and y = 40 free; static, large strain",
                 f"made by fe/extension.py with {tables.versions()}",
                 f"finest mesh: {len(mesh.elements)} {kind} on {len(mesh.nodes)} nodes in a quarter of the rectangle, "
                 f"graded to the held corner with power {POWER}",
                 *lines, tables.error_line(force, lengths)]
        tables.write_samples(f"{out}/extension_{state}.csv", about, np.column_stack([points, np.zeros(len(points))]), samples[-1])
        tables.write_samples(f"{out}/extension_{state}_nodes.csv", about + ["at the nodes of extension_nodes.csv"],
                             np.column_stack([nodes, np.zeros(len(nodes))]), at_points(mesh, solution.fields[1.0], nodes))
        tables.write_curve(f"{out}/extension_{state}_force.csv", about, [[0, 0]] + list(zip(PULL * SHARES, forces[-1])),
                           "displacement_mm,force_N_per_mm")


if __name__ == "__main__":
    main(*sys.argv[1:])
