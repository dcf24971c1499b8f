"""A block with a rigid sheet half through its middle, pressed towards the sheet and sheared along it: half of it in bricks, for
y = 15 is a plane of symmetry. The faces above and below the sheet touch a fixed plate each, by contact without friction."""
import sys

import numpy as np
from scipy.stats import qmc

from . import ccx, deck, evaluate, meshes, tables

SIZE = np.array([60.0, 30.0, 60.0])
RIM = 30.0  # x where the sheet ends, z where it lies
BEYOND, THICK = 12.0, 3.0  # mm that the plates reach beyond the block, and their thickness
CASES = {"pressed": (3, -6.0), "sheared": (1, 6.0)}  # direction and mm of the top face
LEVELS = [2, 3, 4]  # cells in 15 mm
POWER = 1.5
STIFFNESS = 2e5  # of the contact, Pa/mm


def halves(cells):
    """The lower and the upper half of the block, y counted from the plane of symmetry, as one mesh joined where x >= 30."""
    ends = meshes.graded(2 * cells, POWER, both_ends=True)
    flat = meshes.rectangle(RIM * np.append(ends, 1 + ends[1:]), 0.5 * SIZE[1] * meshes.graded(cells, POWER))
    lower, upper = meshes.extruded(flat, RIM * ends), meshes.extruded(flat, RIM + RIM * ends)
    count = len(lower.nodes)
    renumbered = count + np.arange(len(upper.nodes))
    middle = {tuple(np.round(p[:2], 6)): a for a, p in enumerate(lower.nodes) if p[2] > RIM - 1e-6}
    for a in upper.where((upper.nodes[:, 2] < RIM + 1e-6) & (upper.nodes[:, 0] > RIM - 1e-6)):
        renumbered[a] = middle[tuple(np.round(upper.nodes[a, :2], 6))]
    nodes = np.vstack([lower.nodes, upper.nodes])
    used, elements = np.unique(np.vstack([lower.elements, renumbered[upper.elements]]), return_inverse=True)
    return meshes.Mesh(nodes[used], elements.reshape(-1, 20)), len(lower.elements)


def plate(cells, bottom):
    flat = meshes.rectangle(np.linspace(-BEYOND, RIM, 4 * cells + 1), np.linspace(0, 0.5 * SIZE[1] + BEYOND, 4 * cells + 1))
    return meshes.extruded(flat, np.linspace(bottom, bottom + THICK, 3))


def with_plates(cells):
    """The block, then the plate that carries its upper half, then the one above its lower half; elements where each begins."""
    block, lower = halves(cells)
    nodes, elements, begins = [block.nodes], [block.elements], [0, lower, len(block.elements)]
    for bottom in (RIM - THICK, RIM):
        part = plate(cells, bottom)
        elements.append(part.elements + sum(map(len, nodes)))
        nodes.append(part.nodes)
        begins.append(begins[-1] + len(part.elements))
    return block, meshes.Mesh(np.vstack(nodes), np.vstack(elements)), begins


def contact(mesh, begins):
    """Surfaces in the plane of the sheet, by their elements' faces (1 below, 2 above), and the two contact pairs."""
    def surface(name, first, last, face):
        corners = mesh.nodes[mesh.elements[first:last, :4] if face == 1 else mesh.elements[first:last, 4:8]]
        on = (np.abs(corners[:, :, 2] - RIM) < 1e-6).all(1) & (corners[:, :, 0] < RIM + 1e-6).all(1)
        return f"*SURFACE, NAME={name}\n" + "".join(f"{first + e + 1}, S{face}\n" for e in np.flatnonzero(on))

    _, upper, first_plate, second_plate, end = begins
    return (surface("UPPER", upper, first_plate, 1) + surface("LOWER", 0, upper, 2)
            + surface("FLOOR", first_plate, second_plate, 2) + surface("CEILING", second_plate, end, 1)
            + f"*SURFACE INTERACTION, NAME=SLIDING\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n{STIFFNESS:g}, 0.1\n"
            + "*CONTACT PAIR, INTERACTION=SLIDING, TYPE=SURFACE TO SURFACE\nUPPER, FLOOR\n"
            + "*CONTACT PAIR, INTERACTION=SLIDING, TYPE=SURFACE TO SURFACE\nLOWER, CEILING\n")


def solve(case, cells, folder, material):
    axis, way = CASES[case]
    block, mesh, begins = with_plates(cells)
    x, y, z = block.nodes.T
    ends, top = block.where((z < 1e-6) | (z > SIZE[2] - 1e-6)), block.where(z > SIZE[2] - 1e-6)
    fixed = np.arange(len(block.nodes), len(mesh.nodes))
    prescribed = deck.prescribe(np.setdiff1d(block.where(y < 1e-6), ends), 2, 0)
    for direction in (1, 2, 3):
        prescribed += deck.prescribe(fixed, direction, 0) + deck.prescribe(np.setdiff1d(ends, top), direction, 0)
        prescribed += deck.prescribe(top, direction, way if direction == axis else 0)
    path = f"{folder}/septum_{case}{cells}.inp"
    deck.write_deck(path, mesh, "C3D20R", material, deck.Loading(prescribed, np.array([1.0]), 0.1), {"TOP": top},
                    model_lines=contact(mesh, begins))
    return block, ccx.run(path, len(block.nodes))


def samples():
    """Points of a seeded Sobol set in the block; none within a millimetre of the sheet's rim, where the stress has no bound."""
    points = np.round(qmc.Sobol(3, seed=37).random(512) * SIZE, 4)
    return points[np.hypot(points[:, 0] - RIM, points[:, 2] - RIM) > 1]


def at_points(mesh, field, points):
    local = points - [0, 0.5 * SIZE[1], 0]
    mirror = np.where(local[:, 1] < 0, -1.0, 1.0)
    folded = np.column_stack([local[:, 0], np.abs(local[:, 1]), local[:, 2]])
    return evaluate.Interpolator(mesh, folded)(field) * np.column_stack([np.ones(len(mirror)), mirror, np.ones(len(mirror))])


def reference(case, folder, out):
    material = deck.NeoHookean.from_young(3000, 0.49)
    axis, way = CASES[case]
    points, fields, forces = samples(), [], []
    for cells in LEVELS:
        mesh, solution = solve(case, cells, folder, material)
        field = solution.fields[1.0][:len(mesh.nodes)]
        fields.append(at_points(mesh, field, points))
        forces.append(2e-6 * solution.forces["TOP"][1.0][axis - 1])
        faces = mesh.where((np.abs(mesh.nodes[:, 2] - RIM) < 1e-6) & (mesh.nodes[:, 0] < RIM - 1e-6))
        print(f"septum_{case}: {len(mesh.elements)} C3D20R, reached {solution.reached}, {forces[-1]:.6f} N, faces from "
              f"{field[faces, 2].min():.4f} to {field[faces, 2].max():.4f} mm off the sheet, {solution.seconds:.0f} s", flush=True)
    force, lengths, lines = tables.convergence(forces, fields, LEVELS)
    about = [f"Finite-element reference: a block with a rigid sheet half through its middle, {case}",
             "lengths mm, force N; x, y, z is the undeformed place",
             "geometry: 0 <= x <= 60, 0 <= y <= 30, 0 <= z <= 60; sheet z = 30, x <= 30, all y, of no width, fixed, and reaching "
             f"{BEYOND:g} mm beyond the block",
             f"material: {material}, E = 3000 Pa, nu = 0.49",
             f"boundary: u = 0 on z = 0; u{'xyz'[axis - 1]} = {way:g} mm and nothing across on z = 60; the sides free; the two faces at the "
             f"sheet in contact with it, without friction, {STIFFNESS:g} Pa/mm; static, large strain",
             f"made by fe/septum_block.py with {tables.versions()}",
             f"finest mesh: {len(mesh.elements)} C3D20R on {len(mesh.nodes)} nodes in a half of the block (mirror y = 15)",
             *lines, tables.error_line(force, lengths)]
    tables.write_samples(f"{out}/septum_{case}.csv", about, points, fields[-1])


def main(folder, out):
    for case in CASES:
        reference(case, folder, out)


if __name__ == "__main__":
    main(*sys.argv[1:])
