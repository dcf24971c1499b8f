"""Brain shift: a closed surface filled with tetrahedra, displacements prescribed at some of its points, the rest free.

usage: fe/brain.py folder out [surface.vtp load.csv]   (default: the Colin 27 head here, see brain_inputs.py)
load.csv: rows x,y,z,ux,uy,uz of every vertex of the surface that is held or moved. Between them the displacement is linear
on the triangles with three such corners. Everything else is free.
"""
import os
import sys

import numpy as np
from scipy.spatial import cKDTree
from scipy.stats import qmc

from . import ccx, deck, evaluate, tables, tetrahedra, vtp

YOUNG, NU = 3000.0, 0.49
INSIDE, SURFACE = 600, 200  # sample points
SHARES = np.array([1, 2, 3]) / 3  # of the load, one increment each: in fine meshes more at once folds elements
# What the meshes are: in mm from the moved points, the triangles of the surface are cut into four, once for each width, before
# it is filled; the tetrahedra inside grow from those of the surface. The mesh `level` takes the first `level` widths.
FINER = (50.0, 22.0, 8.0)


def cut_in_four(points, triangles, values, chosen):
    """The same surface with the chosen triangles cut into four and their neighbours to match. `values` (points, 3): the
    prescribed displacements, nan where free."""
    sides = np.sort(triangles[:, [(0, 1), (1, 2), (2, 0)]], axis=2)
    whole = np.isfinite(values[triangles, 0]).all(1)
    cut = np.unique(sides[chosen].reshape(-1, 2), axis=0)
    of_whole = set(map(tuple, sides[whole].reshape(-1, 2)))
    between = values[cut].mean(1)
    between[[tuple(side) not in of_whole for side in cut]] = np.nan
    number = {tuple(side): len(points) + i for i, side in enumerate(cut)}
    out = []
    for triangle, side in zip(triangles, sides):
        middles = [number.get(tuple(s)) for s in side]
        count = sum(m is not None for m in middles)
        turn = {0: 0, 1: [m is not None for m in middles].index(True) if count else 0,
                2: (middles.index(None) + 1) % 3 if count == 2 else 0, 3: 0}[count]
        a, b, c = np.roll(triangle, -turn)
        ab, bc, ca = middles[turn:] + middles[:turn]
        out += {0: [(a, b, c)], 1: [(a, ab, c), (ab, b, c)], 2: [(ab, b, bc), (a, ab, c), (ab, bc, c)],
                3: [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]}[count]
    return np.vstack([points, points[cut].mean(1)]), np.array(out), np.vstack([values, between])


def finer_around(points, triangles, values, widths):
    """The surface with smaller triangles where it is moved and around, where the solution changes fast."""
    moved = cKDTree(points[np.linalg.norm(np.nan_to_num(values), axis=1) > 0])
    for width in widths:
        near = moved.query(points[triangles].mean(1))[0] < width
        points, triangles, values = cut_in_four(points, triangles, values, near)
    return points, triangles, values


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


def fill(level, surface, load, folder):
    """Linear tetrahedra and the prescribed displacements of their nodes."""
    points, triangles = surface
    points, triangles, values = finer_around(points, triangles, at_vertices(points, load), FINER[:level])
    mesh = tetrahedra.fill(points, triangles, f"{folder}/brain{level}")
    return mesh, at_vertices(mesh.nodes, np.hstack([points, values])[np.isfinite(values[:, 0])])


def solve(level, mesh, values, folder, material):
    fine, values = with_midnodes(mesh, values)
    held = np.flatnonzero(np.isfinite(values[:, 0]))
    moved = held[np.linalg.norm(values[held], axis=1) > 0]
    rows = [row for direction in range(3) for row in deck.prescribe(held, direction + 1, values[held, direction])]
    path = f"{folder}/brain{level}.inp"
    deck.write_deck(path, fine, "C3D10", material, deck.Loading(rows, SHARES, SHARES[0]),
                    {"MOVED": moved, "HELD": np.setdiff1d(held, moved)}, solver="ITERATIVE CHOLESKY")
    return fine, ccx.run(path, len(fine.nodes))


def sample_points(mesh, surface_points, seed=22):
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
        if len(found) == INSIDE:
            break
    picked = surface_points[np.linspace(0, len(surface_points) - 1, SURFACE).astype(int)]
    return np.vstack([np.round(found, 4), picked])


def main(folder, out, surface_file="brain_surface.vtp", load_file="brain_load.csv"):
    points, triangles = surface = vtp.read_surface(surface_file)
    load = tables.read(load_file)
    material = deck.NeoHookean.from_young(YOUNG, NU)
    places = sample_points(fill(0, surface, load, folder)[0], points)
    samples, forces, counts = [], [], []
    for level in range(1, len(FINER) + 1):
        mesh, values = fill(level, surface, load, folder)
        fine, solution = solve(level, mesh, values, folder, material)
        if solution.reached < 1:
            raise RuntimeError(f"CalculiX stopped at {solution.reached:g} of the load: see {folder}/brain{level}.log")
        total = {name: f[1.0] * 1e-6 for name, f in solution.forces.items()}
        ratio = evaluate.smallest_area_ratio(fine, solution.fields[1.0])
        print(f"brain: {len(fine.elements)} C3D10, {len(fine.nodes)} nodes, least volume ratio {ratio:.3f}, reactions {total} N, "
              f"{solution.seconds:.0f} s", flush=True)
        samples.append(evaluate.Interpolator(fine, places)(solution.fields[1.0]))
        forces.append(np.linalg.norm(total["MOVED"]))
        counts.append(len(fine.elements))
    force, lengths, lines = tables.convergence(forces, samples, [2 ** level for level in range(1, len(FINER) + 1)])
    size = np.linalg.norm(samples[-1], axis=1)
    about = ["Finite-element reference: brain shift, displacements prescribed on part of a brain's surface",
             "lengths mm, force N; x, y, z is the undeformed place, in the frame of the surface file",
             f"geometry: the inside of {os.path.basename(surface_file)}, {len(triangles)} triangles, {tetrahedra.volume(mesh) / 1000:.4g} ml",
             f"material: {material}, E = {YOUNG:g} Pa, nu = {NU}",
             f"boundary: {os.path.basename(load_file)}: {len(load)} of {len(points)} vertices of the surface prescribed, linear on "
             "triangles with three of them, the rest free; static, large strain",
             f"made by fe/brain.py with {tables.versions(with_gmsh=True)}",
             f"finest mesh: {len(fine.elements)} C3D10 on {len(fine.nodes)} nodes, straight edges; meshes: "
             f"{', '.join(map(str, counts))} C3D10, triangles of the surface halved {', '.join(map(str, range(1, len(FINER) + 1)))} times, "
             f"up to {', '.join(f'{w:g}' for w in FINER)} mm from the moved points",
             f"samples: first {len(places) - SURFACE} inside, then {SURFACE} vertices of the surface",
             f"displacement of the samples: largest {size.max():.4f}, mean {size.mean():.4f}, mean inside {size[:-SURFACE].mean():.4f} mm",
             f"force_vector: {' '.join(f'{f:.6g}' for f in total['MOVED'])}  (on the moved points, N; length {forces[-1]:.6g})",
             *lines, tables.error_line(force, lengths)]
    tables.write_samples(f"{out}/brain.csv", about, places, samples[-1])


if __name__ == "__main__":
    main(*sys.argv[1:])
