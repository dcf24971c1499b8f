# SPDX-License-Identifier: GPL-3.0-or-later
"""The same brain shift by CalculiX and by brainshift: seconds, peak memory, and the error of each.

The body, the load and the reference (66,027 nodes of quadratic tetrahedra, refined around the load) are those of the
verification: the brain of the Colin 27 head, one neo-Hookean material (3000 Pa, 0.49), a craniotomy pushed in by 8 mm, the
far side held, no contact. CalculiX solves a coarser mesh of its kind: quadratic tetrahedra, and linear ones on the same nodes.

usage: brain.py OUT.csv FOLDER BRAINSHIFT BRAIN_LOAD [quick|usual|full]   (the built programs)
"""
import json
import os
import sys

import numpy as np

import timed

REFERENCES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../verification/references")
sys.path.insert(0, REFERENCES)
from fe import brain, ccx, deck, evaluate, tables, tetrahedra, vtp  # noqa: E402

LIMIT = 300  # s, for one solution
UNREFINED = "C3D10 unrefined"


def meshes(folder):
    """By name: mesh and prescribed displacements of its nodes. Those of C3D10 and C3D4 have the same nodes; UNREFINED is not finer
    around the load, so that CalculiX, too, has a coarse answer to show."""
    surface = vtp.read_surface(f"{REFERENCES}/brain_surface.vtp")
    load = tables.read(f"{REFERENCES}/brain_load.csv")
    refined, values = brain.fill(1, surface, load, folder)
    quadratic, at_nodes = brain.with_midnodes(refined, values)
    return {"C3D10": (quadratic, at_nodes), "C3D4": (tetrahedra.refined(refined), at_nodes),
            UNREFINED: brain.with_midnodes(*brain.fill(0, surface, load, folder))}


def as_quadratic(mesh, field):
    """Linear tetrahedra as quadratic ones, which the interpolation knows."""
    if mesh.elements.shape[1] == 10:
        return mesh, field
    fine, edges = tetrahedra.quadratic(mesh)
    return fine, np.vstack([field, field[edges].mean(1)])


def errors(difference):
    lengths = np.linalg.norm(difference, axis=1)
    return {"error_95_mm": np.percentile(lengths, 95), "error_largest_mm": lengths.max(), "error_mean_mm": lengths.mean()}


def calculix(name, mesh, values, solver, threads, folder, reference):
    stem = f"{folder}/{name}_{solver}_{threads}".replace(" ", "_")
    held = np.flatnonzero(np.isfinite(values[:, 0]))
    rows = [row for axis in range(3) for row in deck.prescribe(held, axis + 1, values[held, axis])]
    deck.write_deck(stem + ".inp", mesh, name.split()[0], deck.NeoHookean.from_young(brain.YOUNG, brain.NU),
                    deck.Loading(rows, np.array([1.0]), 1.0), {"HELD": held}, solver=solver)
    if os.path.exists(stem + ".dat"):
        os.remove(stem + ".dat")
    took = timed.run(["ccx", "-i", os.path.basename(stem)], threads, stem + ".log", folder, LIMIT)
    row = {"program": "CalculiX", "setting": f"{name}, {solver.lower()}", "threads": threads, "nodes": len(mesh.nodes),
           "seconds": took.seconds, "peak_mb": took.peak_mb, **errors(np.full((1, 3), np.nan))}
    solution = ccx.read_dat(stem + ".dat", len(mesh.nodes)) if os.path.exists(stem + ".dat") else ccx.Solution()
    if took.status == 124 or 1.0 not in solution.fields:
        return {**row, "note": f"stopped after {LIMIT} s" if took.status == 124 else "no solution"}
    fine, field = as_quadratic(mesh, solution.fields[1.0])
    row.update(errors(evaluate.Interpolator(fine, reference[:, :3])(field) - reference[:, 3:]))
    ratio = evaluate.smallest_area_ratio(fine, field)
    return {**row, "note": "" if ratio > 0 else f"folded elements (volume ratio {ratio:.2f})"}


def brainshift(program, loader, nodes, spread, setting, threads, folder, reference):
    """spread: uniform or refined. setting: name and options of `brainshift solve`."""
    name, options = setting
    place = f"{folder}/{nodes}_{spread}_{name.replace(' ', '_').replace(',', '')}_{threads}"
    os.makedirs(place, exist_ok=True)
    made = timed.run([loader, spread, place, nodes], threads, place + "/cloud.log")
    took = timed.run([program, "--threads", str(threads), "solve", "--nodes", f"{place}/nodes.vtu", "--cells",
                      f"{place}/cells.vtu", "--material", "1:3000,0.49,1000", "--out", place, *options], threads,
                     place + "/solve.log", limit=LIMIT)
    if made.status != 0 or took.status != 0:
        raise RuntimeError(f"{name}: see {place}/cloud.log and solve.log")
    timed.run([loader, "at", f"{place}/solution.vtu", f"{place}/samples.csv"], threads, place + "/at.log")
    samples = np.loadtxt(f"{place}/samples.csv", delimiter=",", skiprows=1)
    with open(f"{place}/stage.json") as file:
        sizes = json.load(file)["entry"]["sizes"]
    return {"program": "brainshift", "setting": f"{spread}, {name}", "threads": threads, "nodes": sizes["nodes"], "seconds": took.seconds,
            "peak_mb": took.peak_mb, **errors(samples - reference[:, 3:]),
            "note": f"{sizes['steps']} steps; cloud and cells: {made.seconds:.1f} s"}


LINEAR = ("linear", ["--basis", "linear"])
LINEAR_TO_TENTH = ("linear, stop at 0.1 mm", ["--basis", "linear", "--tolerance", "0.1"])
MODIFIED = ("MMLS", [])
MODIFIED_TO_TENTH = ("MMLS, stop at 0.1 mm", ["--tolerance", "0.1"])
# Debian's CalculiX has neither PARDISO nor PaStiX.
SOLVERS = [("C3D10", "SPOOLES"), ("C3D10", "ITERATIVE SCALING"), (UNREFINED, "SPOOLES"), ("C3D4", "SPOOLES"), ("C3D4", "ITERATIVE CHOLESKY")]
SLOW = [("C3D10", "ITERATIVE CHOLESKY"), ("C3D4", "ITERATIVE SCALING")]
# Nodes, how they are spread, settings.
USUAL = [("5000", "uniform", [LINEAR, LINEAR_TO_TENTH]), ("10000", "uniform", [LINEAR, LINEAR_TO_TENTH]),
         ("20000", "uniform", [LINEAR, LINEAR_TO_TENTH, MODIFIED]), ("7000", "refined", [LINEAR_TO_TENTH, MODIFIED_TO_TENTH]),
         ("8000", "refined", [LINEAR_TO_TENTH, MODIFIED_TO_TENTH]), ("10000", "refined", [LINEAR_TO_TENTH, MODIFIED_TO_TENTH])]
CLOUDS = {"quick": [("2000", "refined", [LINEAR])], "usual": USUAL, "full": USUAL}


def main(out, folder, program, loader, size="usual"):
    os.makedirs(folder, exist_ok=True)
    folder = os.path.abspath(folder)
    reference = tables.read(f"{REFERENCES}/brain.csv")
    rows = []

    def keep(row):
        rows.append(row)
        print(f"{row['program']}, {row['setting']}, {row['threads']} threads: {row['seconds']:.1f} s", flush=True)
        timed.write_rows(out, rows)

    filled = meshes(folder)
    solvers = {"quick": [("C3D4", "ITERATIVE CHOLESKY")], "usual": SOLVERS, "full": SOLVERS + SLOW}[size]
    for threads in (1, 2):
        for nodes, spread, settings in CLOUDS[size]:
            for setting in settings:
                keep(brainshift(program, loader, nodes, spread, setting, threads, folder, reference))
        for name, solver in solvers:
            keep(calculix(name, *filled[name], solver, threads, folder, reference))


if __name__ == "__main__":
    main(*sys.argv[1:])
