"""A half ball on its flat face, the fluid round it drained to half its height: axisymmetric, with the fluid's pressure on
what is still wet and the weight that the fluid carried before on all of the tissue."""
import sys

import numpy as np
from scipy.stats import qmc

from . import ccx, cylinders, deck, evaluate, meshes, study, tables

RADIUS, LEVEL = 30.0, 15.0  # mm
DENSITY, GRAVITY = 1007e-6, 9806.65  # g/mm3, mm/s2
LEVELS = [9, 16, 25]  # cells in half the core's side


def half_section(cells):
    """(r, z) of the half ball: half of the cylinders' half disc, its axis turned up."""
    disc = cylinders.half_disc(cells, cells, 1.5, RADIUS)
    nodes = np.column_stack([disc.nodes[:, 1], -disc.nodes[:, 0]])
    return meshes.merged(nodes, disc.elements[nodes[disc.elements].mean(1)[:, 1] > 0])


def wet_faces(mesh):
    """Lines of *DLOAD: the hydrostatic pressure in the middle of each face on the surface below the fluid's level, Pa."""
    lines = []
    for number, corners in enumerate(mesh.elements[:, :4]):
        for face in range(4):
            places = mesh.nodes[corners[[face, (face + 1) % 4]]]
            middle = places[:, 1].mean()
            if np.all(np.linalg.norm(places, axis=1) > RADIUS - 1e-6) and middle < LEVEL:
                lines.append(f"{number + 1}, P{face + 1}, {DENSITY * GRAVITY * (LEVEL - middle):.12g}\n")
    return "".join(lines)


def solve(cells, folder, material):
    mesh = half_section(cells)
    r, z = mesh.nodes.T
    held = mesh.where(z < 1e-6)
    axis = np.setdiff1d(mesh.where(r < 1e-6), held)
    prescribed = deck.prescribe(held, 1, 0) + deck.prescribe(held, 2, 0) + deck.prescribe(axis, 1, 0)
    loads = f"*DLOAD\nBODY, GRAV, {GRAVITY:.12g}, 0, -1, 0\n" + wet_faces(mesh)
    path = f"{folder}/wet_ball{cells}.inp"
    deck.write_deck(path, mesh, "CAX8R", material, deck.Loading(prescribed, np.array([1.0]), 0.25), {"HELD": held},
                    density=DENSITY, step_lines=loads)
    return mesh, ccx.run(path, len(mesh.nodes))


def sample_points(count=512):
    unit = qmc.Sobol(3, seed=37).random(count)
    r, angle, up = RADIUS * np.cbrt(unit[:, 0]) * 0.995, 2 * np.pi * unit[:, 1], unit[:, 2]
    flat = r * np.sqrt(1 - up ** 2)
    return np.round(np.column_stack([flat * np.cos(angle), flat * np.sin(angle), r * up]), 4)


def at_points(mesh, field, points):
    flat = np.linalg.norm(points[:, :2], axis=1)
    found = evaluate.Interpolator(mesh, np.column_stack([flat, points[:, 2]]))(field)
    outwards = points[:, :2] / np.maximum(flat, 1e-12)[:, None]
    return np.column_stack([found[:, :1] * outwards, found[:, 1]])


def main(folder, out):
    material = deck.NeoHookean.from_young(3000, 0.499)
    points = sample_points()
    finest, lines = study.converged("wet_ball", "CAX8R", LEVELS, lambda cells: solve(cells, folder, material),
                                    lambda mesh, field: at_points(mesh, field, points),
                                    lambda _, field: field[:, 1].min(), "lowest uz, mm")
    about = ["Finite-element reference: a half ball whose fluid has drained to half its height",
             "lengths mm; x, y, z is the undeformed place",
             "geometry: radius 30 about the origin, z > 0; z = 0 is held; the fluid stands at z = 15",
             f"material: {material}, E = 3000 Pa, nu = 0.499",
             f"load: weight of {1e6 * DENSITY:g} kg/m3 with {1e-3 * GRAVITY:g} m/s2 along -z on all of it, and the pressure of a "
             "fluid of that density on the surface below z = 15, which follows it",
             *lines]
    tables.write_samples(f"{out}/wet_ball.csv", about, points, finest)


if __name__ == "__main__":
    main(*sys.argv[1:])
