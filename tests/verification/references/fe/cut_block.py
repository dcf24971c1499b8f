"""Extension of a block cut half through by a plane sheet: a quarter of it in bricks, for y = 15 is a plane of symmetry, and z = 30,
the plane of the cut, is one less the mean translation of 6 mm."""
import sys

import numpy as np
from scipy.stats import qmc

from . import ccx, deck, evaluate, meshes, tables

SIZE, PULL = np.array([60.0, 30.0, 60.0]), 12.0
FRONT = 30.0  # x where the cut ends
LEVELS = [2, 4, 8]  # cells in 15 mm of each direction
POWER = 1.75
SHARES = np.linspace(0.1, 1, 10)
OFF = 0.01  # mm from the cut to the samples of its faces


def quarter(cells):
    """Bricks of 0 <= x <= 60, 0 <= 15 - y <= 15, 0 <= z - 30 <= 30, with y and z counted from the planes of symmetry."""
    ends = meshes.graded(2 * cells, POWER, both_ends=True)
    x = FRONT * np.append(ends, 1 + ends[1:])
    flat = meshes.rectangle(x, 0.5 * SIZE[1] * meshes.graded(cells, POWER))
    return meshes.extruded(flat, 0.5 * SIZE[2] * ends)


def solve(cells, folder, material):
    mesh = quarter(cells)
    x, y, z = mesh.nodes.T
    top, ahead, mirror = mesh.where(z > 0.5 * SIZE[2] - 1e-6), mesh.where((z < 1e-6) & (x > FRONT - 1e-6)), mesh.where(y < 1e-6)
    prescribed = (deck.prescribe(top, 1, 0) + deck.prescribe(top, 2, 0) + deck.prescribe(top, 3, 0.5 * PULL)
                  + deck.prescribe(ahead, 3, 0) + deck.prescribe(np.setdiff1d(mirror, top), 2, 0))
    path = f"{folder}/cut_block{cells}.inp"
    deck.write_deck(path, mesh, "C3D20R", material, deck.Loading(prescribed, SHARES, SHARES[0]), {"TOP": top, "AHEAD": ahead})
    return mesh, ccx.run(path, len(mesh.nodes))


def at_points(mesh, field, points):
    """Displacement at points of the whole block from that of the quarter."""
    local = points - [0, 0.5 * SIZE[1], 0.5 * SIZE[2]]
    mirror = np.where(local < 0, -1, 1)
    return evaluate.Interpolator(mesh, np.abs(local))(field) * mirror + [0, 0, 0.5 * PULL]


def sample_points(seed=23, inside=600, face=40, near_front=60, reach=5.0):
    """Points of a seeded Sobol set by group."""
    def unit(count, dim):
        return qmc.Sobol(dim, seed=seed).random(1024)[:count]

    on_face = 1 + unit(face, 2) * [FRONT - 2, SIZE[1] - 2]
    edge = unit(near_front, 3)
    r, angle = reach * np.sqrt(edge[:, 0]), 2 * np.pi * edge[:, 1]
    groups = {"inside": unit(inside, 3) * SIZE,
              f"upper face of the cut ({OFF:g} mm off it)": np.column_stack([on_face, np.full(face, 0.5 * SIZE[2] + OFF)]),
              f"lower face ({OFF:g} mm off)": np.column_stack([on_face, np.full(face, 0.5 * SIZE[2] - OFF)]),
              f"within {reach:g} mm of the front": np.column_stack([FRONT + r * np.cos(angle), SIZE[1] * edge[:, 2],
                                                                    0.5 * SIZE[2] + r * np.sin(angle)])}
    return {name: np.round(points, 4) for name, points in groups.items()}


def main(folder, out):
    material = deck.NeoHookean.from_young(3000, 0.49)
    groups = sample_points()
    points = np.vstack(list(groups.values()))
    samples, forces = [], []
    for cells in LEVELS:
        mesh, solution = solve(cells, folder, material)
        field = solution.fields[1.0]
        opening = field[mesh.where((mesh.nodes[:, 2] < 1e-6) & (mesh.nodes[:, 0] < FRONT - 1e-6)), 2]
        print(f"cut_block: {len(mesh.elements)} C3D20R on {len(mesh.nodes)} nodes, reached {solution.reached}, "
              f"{[2e-6 * f[max(f)][2] for f in solution.forces.values()]} N, least volume ratio "
              f"{evaluate.smallest_area_ratio(mesh, field):.3f}, opening {2 * opening.min():.4f} to {2 * opening.max():.4f} mm, "
              f"{solution.seconds:.0f} s", flush=True)
        samples.append(at_points(mesh, field, points))
        forces.append(np.array([2e-6 * solution.forces["TOP"][round(s, 6)][2] for s in SHARES]))
    force, lengths, lines = tables.convergence([f[-1] for f in forces], samples, LEVELS)
    about = ["Finite-element reference: extension by 20 % of a block cut half through by a plane sheet",
             "lengths mm, force N; x, y, z is the undeformed place",
             "geometry: 0 <= x <= 60, 0 <= y <= 30, 0 <= z <= 60; cut z = 30, 0 <= x <= 30, all y, of no width; its front x = z = 30",
             f"material: {material}, E = 3000 Pa, nu = 0.49",
             "boundary: z = 0: u = 0; z = 60: ux = uy = 0, uz = +12; the other sides and the faces of the cut free; static, "
             "large strain; the faces open everywhere and do not touch",
             f"made by fe/cut_block.py with {tables.versions()}",
             f"finest mesh: {len(mesh.elements)} C3D20R on {len(mesh.nodes)} nodes in a quarter of the block (mirrors y = 15 and "
             f"z = 30), graded to the front, the held faces and the sides with power {POWER}",
             *lines, tables.error_line(force, lengths)]
    tables.write_samples(f"{out}/cut_block.csv", about + [tables.row_ranges(groups)], points, samples[-1])
    tables.write_curve(f"{out}/cut_block_force.csv", about, [[0, 0]] + list(zip(PULL * SHARES, forces[-1])))


if __name__ == "__main__":
    main(*sys.argv[1:])
