"""Shear of a bonded cylinder: a quarter of it in bricks, for the solution is its own mirror image in y = 0 and its own image
under a half turn about the line x = 0, z = 50 (less the mean translation of 10 mm)."""
import sys

import numpy as np

from . import ccx, cylinders, deck, evaluate, meshes, tables

RADIUS, HEIGHT, SHIFT = 50.0, 100.0, 20.0
LEVELS = [(2, 3, 6), (4, 6, 12), (5, 8, 15)]  # cells across half the core, through the ring, in half the height
POWER = 1.5
SHARES = np.linspace(0.2, 1, 5)  # few: the force is almost proportional and each solution in 3-D costs minutes


def upper_half(core, ring, layers):
    """Mesh of y >= 0, 0 <= z - 50 <= 50, with z counted from the middle."""
    return meshes.extruded(cylinders.half_disc(core, ring, POWER, RADIUS), 0.5 * HEIGHT * meshes.graded(layers, POWER))


def half_turn(mesh, middle):
    """Conditions of the half turn on the middle plane: fixed components (rows) and equations between (x, y) and (-x, y)."""
    x, y = mesh.nodes[:, 0], mesh.nodes[:, 1]
    place = {tuple(np.round(mesh.nodes[a, :2], 5) + 0.0): a for a in middle}
    fixed, equations = [], []
    for a in middle:
        if abs(x[a]) < 1e-6:
            fixed += [(int(a), 1, 0.0), (int(a), 3, 0.0)]
        elif x[a] > 0:
            b = place[(round(-x[a], 5), round(y[a], 5) + 0.0)]
            equations += [[(a, 1, 1), (b, 1, 1)], [(a, 3, 1), (b, 3, 1)]]
            if y[a] > 1e-6:
                equations.append([(a, 2, 1), (b, 2, -1)])
    return fixed, equations


def solve(level, folder, material):
    mesh = upper_half(*LEVELS[level])
    y, z = mesh.nodes[:, 1], mesh.nodes[:, 2]
    top, middle, mirror = mesh.where(z > 0.5 * HEIGHT - 1e-6), mesh.where(z < 1e-6), mesh.where(y < 1e-6)
    fixed, equations = half_turn(mesh, middle)
    prescribed = (deck.prescribe(top, 1, 0.5 * SHIFT) + deck.prescribe(top, 2, 0) + deck.prescribe(top, 3, 0)
                  + deck.prescribe(np.setdiff1d(mirror, top), 2, 0) + fixed)
    path = f"{folder}/shear{level}.inp"
    deck.write_deck(path, mesh, "C3D20R", material, deck.Loading(prescribed, SHARES, 0.2), {"TOP": top}, equations=equations)
    return mesh, ccx.run(path, len(mesh.nodes))


def at_points(mesh, field, points):
    """Displacement at points of the whole cylinder from that of the quarter."""
    local = points - [0, 0, 0.5 * HEIGHT]
    turn = np.where(local[:, 2:] < 0, [-1.0, 1.0, -1.0], 1.0)
    mirror = np.where(local[:, 1:2] < 0, [1.0, -1.0, 1.0], 1.0)
    values = evaluate.Interpolator(mesh, local * turn * mirror)(field)
    return values * turn * mirror + [0.5 * SHIFT, 0, 0]


def main(folder, out):
    material = deck.NeoHookean.from_shear(1000, 0.49)
    points = cylinders.sample_points(RADIUS, HEIGHT, [(RADIUS, 0), (RADIUS, HEIGHT)])
    samples, forces, seconds = [], [], []
    for level in range(len(LEVELS)):
        mesh, solution = solve(level, folder, material)
        samples.append(at_points(mesh, solution.fields[1.0], points))
        forces.append(np.array([2e-6 * solution.forces["TOP"][round(s, 6)][0] for s in SHARES]))
        seconds.append(solution.seconds)
        print(f"cylinder_shear: {len(mesh.elements)} C3D20R, {forces[-1][-1]:.5f} N, {seconds[-1]:.0f} s", flush=True)
    force, lengths, lines = tables.convergence([f[-1] for f in forces], samples, [n[0] for n in LEVELS])
    about = ["Finite-element reference: shear of a cylinder between bonded faces, 20 mm on 100 mm",
             "lengths mm, force N; x, y, z is the undeformed place",
             "geometry: diameter 100, height 100, axis z through x = y = 0, bottom face z = 0",
             f"material: {material}, nu = 0.49",
             "boundary: z = 0: u = 0; z = 100: ux = +20, uy = uz = 0; lateral surface free; static, large strain",
             f"made by fe/cylinder_shear.py with {tables.versions()}",
             f"finest mesh: {len(mesh.elements)} C3D20R on {len(mesh.nodes)} nodes in a quarter of the cylinder "
             f"(mirror y = 0, half turn about y), graded to the rims with power {POWER}",
             *lines, tables.error_line(force, lengths)]
    tables.write_samples(f"{out}/cylinder_shear.csv", about, points, samples[-1])
    tables.write_curve(f"{out}/cylinder_shear_force.csv", about + ["force in x on the top face"],
                       [[0, 0]] + list(zip(SHIFT * SHARES, forces[-1])))


if __name__ == "__main__":
    main(*sys.argv[1:])
