"""A disc pressed into a cylinder and into a round slab on a bonded base, axisymmetric. Mesh columns: r and z."""
import sys
from dataclasses import dataclass

import numpy as np
from scipy.stats import qmc

from . import ccx, deck, evaluate, meshes, study, tables


@dataclass
class Case:
    """Lengths in mm."""

    name: str
    radius: float
    height: float
    disc: float
    depth: float
    nu: float


CASES = [Case("disc_cylinder", 20.0, 30.0, 10.0, 4.0, 0.32), Case("disc_slab", 30.0, 13.0, 11.6, 1.5, 0.13)]
YOUNG = 3000  # Pa
LEVELS = [6, 12, 24]  # cells under the disc; as many beside it and 3/2 as many in the height
POWER = 1.25
TO_NEWTON = 180e-6  # CalculiX gives the force of its sector of 2 degrees, here in micronewton


def section(case, cells):
    """Triangles of the half section, graded to the disc's rim; diagonals end there from both sides."""
    beside = case.radius - case.disc
    z = case.height * meshes.graded(cells * 3 // 2, POWER)
    left = meshes.triangles(meshes.rectangle(case.disc * meshes.graded(cells, POWER), z))
    right = meshes.triangles(meshes.rectangle(beside * meshes.graded(cells, POWER), z))
    right_nodes = right.nodes * [-1, 1] + [case.radius, 0]
    flipped = right.elements[:, [0, 2, 1, 5, 4, 3]]
    return meshes.merged(np.vstack([left.nodes, right_nodes]), np.vstack([left.elements, flipped + len(left.nodes)]))


def solve(case, cells, folder, material):
    mesh = section(case, cells)
    r, z = mesh.nodes.T
    disc = mesh.where((z > case.height - 1e-6) & (r < case.disc + 1e-6))
    bottom, axis = mesh.where(z < 1e-6), mesh.where(r < 1e-6)
    prescribed = (deck.prescribe(disc, 1, 0) + deck.prescribe(disc, 2, -case.depth) + deck.prescribe(bottom, 1, 0)
                  + deck.prescribe(bottom, 2, 0) + deck.prescribe(np.setdiff1d(axis, np.append(disc, bottom)), 1, 0))
    path = f"{folder}/{case.name}{cells}.inp"
    deck.write_deck(path, mesh, "CAX6", material, deck.Loading(prescribed, np.array([1.0]), 0.1), {"DISC": disc})
    return mesh, ccx.run(path, len(mesh.nodes))


def sample_points(case, volume=480, surface=320):
    """Points of seeded Sobol sets: in the volume; on the side and on the face that the disc is pressed into, by area."""
    lateral = round(surface * 2 * case.height / (2 * case.height + case.radius))
    top = surface - lateral
    inside = qmc.Sobol(3, seed=41).random(512)[:volume]
    side = qmc.Sobol(2, seed=42).random(256)[:lateral]
    flat = qmc.Sobol(2, seed=43).random(256)[:top]
    r = case.radius * np.concatenate([np.sqrt(inside[:, 0]), np.ones(lateral), np.sqrt(flat[:, 0])])
    angle = 2 * np.pi * np.concatenate([inside[:, 1], side[:, 0], flat[:, 1]])
    z = case.height * np.concatenate([inside[:, 2], side[:, 1], np.ones(top)])
    return np.round(np.column_stack([r * np.cos(angle), r * np.sin(angle), z]), 4)


def at_points(mesh, field, points):
    r = np.hypot(points[:, 0], points[:, 1])
    values = evaluate.Interpolator(mesh, np.column_stack([r, points[:, 2]]))(field)
    return np.column_stack([points[:, :2] / np.maximum(r, 1e-9)[:, None] * values[:, :1], values[:, 1]])


def make(case, folder, out):
    material = deck.NeoHookean.from_young(YOUNG, case.nu)
    points = sample_points(case)
    finest, lines = study.converged(case.name, "CAX6", LEVELS, lambda cells: solve(case, cells, folder, material),
                                    lambda mesh, field: at_points(mesh, field, points),
                                    lambda solution, _: -TO_NEWTON * solution.forces["DISC"][1.0][1])
    about = ["Finite-element reference: a disc pressed into one end of a body of revolution that stands on the other",
             "lengths mm, force N; x, y, z is the undeformed place",
             f"geometry: radius {case.radius:g}, height {case.height:g}, axis z through x = y = 0, bottom face z = 0; disc of radius "
             f"{case.disc:g} on the top face",
             f"material: {material}, E = {YOUNG} Pa, nu = {case.nu}",
             f"boundary: z = 0: u = 0; z = {case.height:g} and r <= {case.disc:g}: uz = -{case.depth:g}, ux = uy = 0; the rest free; "
             "static, large strain",
             *lines]
    tables.write_samples(f"{out}/{case.name}.csv", about, points, finest)


def main(folder, out):
    for case in CASES:
        make(case, folder, out)


if __name__ == "__main__":
    main(*sys.argv[1:])
