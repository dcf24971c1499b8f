"""Check of the axisymmetric compression: the same in 3-D bricks (C3D20R), compared at the reference's sample points."""
import sys

import numpy as np

from . import ccx, cylinder_compression, cylinders, deck, evaluate, meshes, tables

HALF = 0.5 * cylinder_compression.HEIGHT


def main(folder, out, core=5, ring=8, layers=15, kind="C3D20R"):
    material = deck.NeoHookean.from_shear(1000, 0.49)
    flat = cylinders.half_disc(core, ring, cylinder_compression.POWER, cylinder_compression.RADIUS)
    mesh = meshes.extruded(flat, HALF * meshes.graded(layers, cylinder_compression.POWER))
    x, y, z = mesh.nodes.T
    top, middle, mirror = mesh.where(z > HALF - 1e-6), mesh.where(z < 1e-6), mesh.where(y < 1e-6)
    axis = mesh.where((np.abs(x) < 1e-6) & (y < 1e-6))
    prescribed = (deck.prescribe(top, 1, 0) + deck.prescribe(top, 2, 0) + deck.prescribe(middle, 3, 0)
                  + deck.prescribe(top, 3, -0.5 * cylinder_compression.SHORTENING)
                  + deck.prescribe(np.setdiff1d(mirror, top), 2, 0) + deck.prescribe(np.setdiff1d(axis, top), 1, 0))
    path = f"{folder}/compression_in_bricks.inp"
    deck.write_deck(path, mesh, kind, material, deck.Loading(prescribed, np.linspace(0.2, 1, 5), 0.1),
                    {"TOP": top, "MIDDLE": middle})
    solution = ccx.run(path, len(mesh.nodes))
    rows = tables.read(f"{out}/cylinder_compression.csv")
    points = rows[:, :3] - [0, 0, HALF]
    flip = np.column_stack([np.ones(len(points)), np.where(points[:, 1] < 0, -1, 1), np.where(points[:, 2] < 0, -1, 1)])
    found = evaluate.Interpolator(mesh, points * flip)(solution.fields[1.0]) * flip - [0, 0, 0.5 * cylinder_compression.SHORTENING]
    print(f"{len(mesh.elements)} {kind}: forces {[2e-6 * f[1.0][2] for f in solution.forces.values()]} N, largest, 95 %, mean difference",
          np.round(tables.differences(found, rows[:, 3:]), 4), f"mm, {solution.seconds:.0f} s")


if __name__ == "__main__":
    main(*sys.argv[1:3])
