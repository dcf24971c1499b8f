"""Brain shift: a closed surface filled with tetrahedra, displacements prescribed at some of its points, the rest free.

usage: fe/brain.py folder out surface.vtp load.csv
load.csv: rows x,y,z,ux,uy,uz of every vertex of the surface that is held or moved. Between them the displacement is linear
on the triangles with three such corners. Everything else is free.
"""
import sys

import numpy as np
from scipy.spatial import cKDTree
from scipy.stats import qmc

from . import ccx, deck, evaluate, tables, tetrahedra, vtp

YOUNG, NU = 3000.0, 0.49
SHARES = np.array([0.5, 1.0])
LEVELS = 2  # meshes: the first filling, then each tetrahedron cut into eight


def at_vertices(nodes, load):
    """Prescribed displacement (nodes, 3) of the vertices of the first mesh, nan where free."""
    distance, row = cKDTree(load[:, :3]).query(nodes)
    values = load[row, 3:].copy()
    values[distance > 1e-3] = np.nan
    if len(np.unique(row[distance <= 1e-3])) != len(load):
        raise RuntimeError("points of the load are no vertices of the mesh")
    return values


def with_midnodes(mesh, values):
    """The quadratic mesh and the prescribed displacement of its nodes: the mean of two ends on edges of wholly prescribed triangles."""
    fine, edges = tetrahedra.quadratic(mesh)
    faces = tetrahedra.boundary_triangles(mesh.elements)
    faces = faces[np.isfinite(values[faces, 0]).all(1)]
    outer = np.sort(faces[:, [(0, 1), (1, 2), (0, 2)]].reshape(-1, 2), axis=1)
    key = len(mesh.nodes)
    prescribed = np.isin(edges[:, 0] * key + edges[:, 1], outer[:, 0] * key + outer[:, 1])
    between = values[edges].mean(1)
    between[~prescribed] = np.nan
    return fine, np.vstack([values, between])


def solve(level, mesh, values, folder, material):
    fine, values = with_midnodes(mesh, values)
    held = np.flatnonzero(np.isfinite(values[:, 0]))
    moved = held[np.linalg.norm(values[held], axis=1) > 0]
    rows = [row for direction in range(3) for row in deck.prescribe(held, direction + 1, values[held, direction])]
    path = f"{folder}/brain{level}.inp"
    deck.write_deck(path, fine, "C3D10", material, deck.Loading(rows, SHARES, SHARES[0]),
                    {"MOVED": moved, "HELD": np.setdiff1d(held, moved)}, solver="ITERATIVE CHOLESKY")
    return fine, values, ccx.run(path, len(fine.nodes))


def sample_points(mesh, surface_points, inside=600, surface=200, seed=22):
    """Points of a seeded Sobol set that lie in the first mesh, and vertices of the surface evenly along its list."""
    low, high = mesh.nodes.min(0), mesh.nodes.max(0)
    tries = low + (high - low) * qmc.Sobol(3, seed=seed).random(4096)
    corners = mesh.nodes[mesh.elements]
    inverse = np.linalg.inv(np.swapaxes(corners[:, 1:] - corners[:, :1], 1, 2))
    found = []
    for point in tries:
        local = np.einsum("edk,ek->ed", inverse, point - corners[:, 0])
        if ((local.min(1) > 1e-3) & (local.sum(1) < 1 - 1e-3)).any():
            found.append(point)
        if len(found) == inside:
            break
    picked = surface_points[np.linspace(0, len(surface_points) - 1, surface).astype(int)]
    return np.vstack([np.round(found, 4), picked])


def main(folder, out, surface, load):
    points, triangles = vtp.read_surface(surface)
    load = np.loadtxt(load, delimiter=",", skiprows=1 + tables.comment_count(load), comments="#")
    material = deck.NeoHookean.from_young(YOUNG, NU)
    mesh = tetrahedra.fill(points, triangles, f"{folder}/brain")
    values = at_vertices(mesh.nodes, load)
    places = sample_points(mesh, points)
    samples, forces, sizes = [], [], []
    for level in range(LEVELS):
        fine, nodal, solution = solve(level, mesh, values, folder, material)
        total = {name: f[1.0] * 1e-6 for name, f in solution.forces.items()}
        print(f"brain: {len(fine.elements)} C3D10, {len(fine.nodes)} nodes, least volume ratio "
              f"{evaluate.smallest_area_ratio(fine, solution.fields[1.0]):.3f}, reactions {total} N, {solution.seconds:.0f} s", flush=True)
        samples.append(evaluate.Interpolator(fine, places)(solution.fields[1.0]))
        forces.append(np.linalg.norm(total["MOVED"]))
        sizes.append(2 ** level)
        mesh, values = tetrahedra.refined(mesh), nodal
    force, lengths, lines = tables.convergence(forces, samples, sizes)
    about = ["Finite-element reference: brain shift, displacements prescribed on part of a brain's surface",
             "lengths mm, force N; x, y, z is the undeformed place, in the frame of the surface file",
             f"geometry: the inside of a closed surface of {len(triangles)} triangles, {tetrahedra.volume(mesh) / 1000:.4g} ml",
             f"material: {material}, E = {YOUNG:g} Pa, nu = {NU}",
             f"boundary: {len(load)} of {len(points)} vertices of the surface prescribed, linear between them, the rest free; "
             "static, large strain",
             f"made by fe/brain.py with {tables.versions(with_gmsh=True)}",
             f"finest mesh: {len(fine.elements)} C3D10 on {len(fine.nodes)} nodes, straight edges",
             f"force on the moved points {forces[-1]:.6g} N",
             *lines, tables.error_line(force, lengths)]
    tables.write_samples(f"{out}/brain.csv", about, places, samples[-1])


if __name__ == "__main__":
    main(*sys.argv[1:])
