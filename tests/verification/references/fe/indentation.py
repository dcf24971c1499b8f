"""Indentation of a bonded soft cylinder by a flat bonded punch, axisymmetric, as deep as CalculiX gets. Mesh columns: r and z."""
import sys

import numpy as np

from . import ccx, cylinders, deck, disc, evaluate, tables

RADIUS, HEIGHT, PUNCH, DEEPEST = 15.0, 17.0, 5.0, 8.0
LEVELS = [4, 8, 16]  # cells under the punch; as many beside it and 3/2 as many in the height
STEP = 0.25
SHARES = np.arange(1, int(DEEPEST / STEP) + 1) * STEP / DEEPEST
SAMPLED = [2.0, 4.0]
CASE = disc.Case("indentation", RADIUS, HEIGHT, PUNCH, DEEPEST, 0.49)


def solve(cells, folder, material):
    mesh = disc.section(CASE, cells)
    r, z = mesh.nodes.T
    punch, bottom, axis = mesh.where((z > HEIGHT - 1e-6) & (r < PUNCH + 1e-6)), mesh.where(z < 1e-6), mesh.where(r < 1e-6)
    prescribed = (deck.prescribe(punch, 1, 0) + deck.prescribe(punch, 2, -DEEPEST) + deck.prescribe(bottom, 1, 0)
                  + deck.prescribe(bottom, 2, 0) + deck.prescribe(np.setdiff1d(axis, np.append(punch, bottom)), 1, 0))
    path = f"{folder}/indentation{cells}.inp"
    deck.write_deck(path, mesh, "CAX6", material, deck.Loading(prescribed, SHARES, SHARES[0]), {"PUNCH": punch, "BOTTOM": bottom})
    return mesh, ccx.run(path, len(mesh.nodes))


def sound_curve(mesh, run):
    """Rows depth, force as far as they can be trusted: to the first snap (a step of the force 5 % below the one before: the
    elements at the punch edge fold) or element turned inside out. CalculiX goes on after both."""
    rows = [[0.0, 0.0]]
    for share, force in sorted(run.forces["PUNCH"].items()):
        row = [DEEPEST * share, -disc.TO_NEWTON * force[1]]
        snaps = len(rows) > 1 and row[1] - rows[-1][1] < 0.95 * (rows[-1][1] - rows[-2][1])
        if snaps or evaluate.smallest_area_ratio(mesh, run.fields[share]) <= 0:
            break
        rows.append(row)
    return np.array(rows[1:])


def main(folder, out):
    material = deck.NeoHookean.from_young(5000, CASE.nu)
    points = cylinders.sample_points(RADIUS, HEIGHT, [(PUNCH, HEIGHT), (RADIUS, 0)])
    runs = [solve(cells, folder, material) for cells in LEVELS]
    curves = [sound_curve(mesh, run) for mesh, run in runs]
    reached = [curve[-1, 0] for curve in curves]
    for (mesh, run), curve in zip(runs, curves):
        print(f"indentation: {len(mesh.elements)} CAX6, stopped after {DEEPEST * run.reached:g} mm, sound to {curve[-1]}, bottom "
              f"{run.forces['BOTTOM'][round(curve[-1, 0] / DEEPEST, 6)][1] * disc.TO_NEWTON:.6f} N, {run.seconds:.0f} s", flush=True)
    finest = runs[-1][0]

    def about(title, lines):
        return [f"Finite-element reference: indentation of a soft cylinder by a bonded flat punch, {title}",
                "lengths mm, force N; x, y, z is the undeformed place",
                "geometry: diameter 30, height 17, axis z through x = y = 0, bottom face z = 0; punch of diameter 10 on the top face",
                f"material: {material}, E = 5000 Pa, nu = 0.49",
                "boundary: z = 0: u = 0; z = 17 and r <= 5: uz = -depth, ux = uy = 0; the rest free; static, large strain",
                f"made by fe/indentation.py with {tables.versions()}",
                f"finest mesh: {len(finest.elements)} CAX6 on {len(finest.nodes)} nodes in the axial section, "
                f"graded to the punch edge with power {disc.POWER}",
                f"with {', '.join(map(str, LEVELS))} cells under the punch CalculiX stopped after "
                f"{', '.join(f'{DEEPEST * run.reached:g}' for _, run in runs)} mm; the last depth before the elements at the "
                f"punch edge fold (the force snaps) is {', '.join(f'{d:g}' for d in reached)} mm",
                *lines]

    for depth in sorted({min(d, min(reached)) for d in SAMPLED}):
        share = round(depth / DEEPEST, 6)
        samples = [disc.at_points(mesh, run.fields[share], points) for mesh, run in runs]
        forces = [-disc.TO_NEWTON * run.forces["PUNCH"][share][1] for _, run in runs]
        force, lengths, lines = tables.convergence(forces, samples, LEVELS)
        comments = about(f"depth {depth:g} mm", [f"force {forces[-1]:.6g} N", *lines, tables.error_line(force, lengths)])
        tables.write_samples(f"{out}/indentation_{depth:g}mm.csv", comments, points, samples[-1])
    deepest = min(len(c) for c in curves) - 1
    changes = [f"force with {n} cells under the punch at {depth:g} mm: {curve[row, 1]:.6g} N" for row in sorted({7, 15, deepest})
               for n, curve, depth in zip(LEVELS, curves, [curves[0][row, 0]] * len(LEVELS)) if row <= deepest]
    tables.write_curve(f"{out}/indentation_force.csv", about("force", changes + [*lines, "the error line is that of the deepest samples",
                                                             tables.error_line(force, lengths)]),
                       np.vstack([[0, 0], curves[-1]]))


if __name__ == "__main__":
    main(*sys.argv[1:])
