"""Compression of a bonded cylinder, axisymmetric: the upper half of the half-section, for z = 50 is a plane of symmetry
(less the mean translation of -10 mm). Columns of the mesh: r and z."""
import sys

import numpy as np

from . import ccx, cylinders, deck, evaluate, meshes, tables

RADIUS, HEIGHT, SHORTENING = 50.0, 100.0, 20.0
LEVELS = [8, 16, 32]  # cells along the radius and half the height; the finer ones fold at the rim and stop before 20 mm
POWER = 1.5
SHARES = np.linspace(0.1, 1, 10)
TO_NEWTON = 180e-6  # CalculiX gives the force of its sector of 2 degrees, here in micronewton


def solve(cells, name, folder, material):
    mesh = meshes.triangles(meshes.rectangle(RADIUS * meshes.graded(cells, POWER), 0.5 * HEIGHT * meshes.graded(cells, POWER)))
    r, z = mesh.nodes.T
    top, middle, axis = mesh.where(z > 0.5 * HEIGHT - 1e-6), mesh.where(z < 1e-6), mesh.where(r < 1e-6)
    prescribed = (deck.prescribe(top, 1, 0) + deck.prescribe(top, 2, -0.5 * SHORTENING) + deck.prescribe(middle, 2, 0)
                  + deck.prescribe(np.setdiff1d(axis, top), 1, 0))
    path = f"{folder}/{name}{cells}.inp"
    deck.write_deck(path, mesh, "CAX6", material, deck.Loading(prescribed, SHARES, 0.1), {"TOP": top, "MIDDLE": middle})
    return mesh, ccx.run(path, len(mesh.nodes))


def at_points(mesh, field, points):
    """Displacement at points of the whole cylinder from that of the half-section."""
    r, below = np.hypot(points[:, 0], points[:, 1]), points[:, 2] < 0.5 * HEIGHT
    values = evaluate.Interpolator(mesh, np.column_stack([r, np.abs(points[:, 2] - 0.5 * HEIGHT)]))(field)
    outwards = points[:, :2] / np.maximum(r, 1e-9)[:, None]
    return np.column_stack([outwards * values[:, :1], np.where(below, -values[:, 1], values[:, 1]) - 0.5 * SHORTENING])


def main(folder, out, nu=0.49, name="cylinder_compression"):
    material = deck.NeoHookean.from_shear(1000, nu)
    points = cylinders.sample_points(RADIUS, HEIGHT, [(RADIUS, 0), (RADIUS, HEIGHT)])
    samples, forces = [], []
    for cells in LEVELS:
        mesh, solution = solve(cells, name, folder, material)
        print(f"{name}: {len(mesh.elements)} CAX6, reached {solution.reached}, "
              f"{[f[max(f)][1] * TO_NEWTON for f in solution.forces.values()]} N, {solution.seconds:.0f} s", flush=True)
        samples.append(at_points(mesh, solution.fields[1.0], points))
        forces.append(np.array([-TO_NEWTON * solution.forces["TOP"][round(s, 6)][1] for s in SHARES]))
    force, lengths, lines = tables.convergence([f[-1] for f in forces], samples, LEVELS)
    about = ["Finite-element reference: compression of a cylinder between bonded faces, 20 mm on 100 mm",
             "lengths mm, force N; x, y, z is the undeformed place",
             "geometry: diameter 100, height 100, axis z through x = y = 0, bottom face z = 0",
             f"material: {material}, nu = {nu}",
             "boundary: z = 0: u = 0; z = 100: uz = -20, ux = uy = 0; lateral surface free; static, large strain",
             f"made by fe/{name}.py with {tables.versions()}",
             f"finest mesh: {len(mesh.elements)} CAX6 on {len(mesh.nodes)} nodes in a quarter of the axial section, "
             f"graded to the rim with power {POWER}; samples turned to angles of a low-discrepancy set",
             *lines, tables.error_line(force, lengths)]
    tables.write_samples(f"{out}/{name}.csv", about, points, samples[-1])
    tables.write_curve(f"{out}/{name}_force.csv", about, [[0, 0]] + list(zip(SHORTENING * SHARES, forces[-1])))


if __name__ == "__main__":
    main(*sys.argv[1:])
