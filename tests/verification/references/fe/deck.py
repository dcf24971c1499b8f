"""CalculiX input decks: one hyperelastic body, prescribed displacements, large strain.

Units are mm, g, s: moduli in Pa and forces in micronewton, so that no number is small enough to meet an absolute tolerance.
"""
from dataclasses import dataclass

import numpy as np


@dataclass
class NeoHookean:
    """W = mu/2 (I1bar - 3) + K/2 (J - 1)^2, moduli in Pa."""

    mu: float
    bulk: float

    @staticmethod
    def from_shear(mu, nu):
        return NeoHookean(mu, 2 * mu * (1 + nu) / (3 * (1 - 2 * nu)))

    @staticmethod
    def from_young(young, nu):
        return NeoHookean.from_shear(young / (2 * (1 + nu)), nu)

    def __str__(self):
        return (f"neo-Hookean W = mu/2 (I1bar - 3) + K/2 (J - 1)^2, mu = {self.mu:.6g} Pa, K = {self.bulk:.6g} Pa "
                "(CalculiX NEO HOOKE, C10 = mu/2, D1 = 2/K)")


@dataclass
class Loading:
    """Prescribed displacements: rows (node, direction 1..3, mm at the end), written at `outputs` (shares of the load, ending in 1)."""

    prescribed: list
    outputs: np.ndarray
    largest_increment: float


def prescribe(nodes, direction, values):
    """Rows for Loading.prescribed: one value, or one for each node."""
    return [(int(a), direction, float(v)) for a, v in zip(nodes, np.broadcast_to(values, len(nodes)))]


def numbered_lines(numbers, per_line=12):
    return "\n".join(", ".join(str(int(a) + 1) for a in numbers[i:i + per_line]) for i in range(0, len(numbers), per_line)) + "\n"


@dataclass
class Layer:
    """Elements that swell by a share of their volume when the load has come, as heat would make them."""

    elements: np.ndarray
    swelling: float


def heated(layers, material):
    """Model and step lines for Layer: each a section of its own material, and one degree for every node."""
    model, numbers = "", ""
    for i, layer in enumerate(layers):
        numbers += f"*ELSET, ELSET=LAYER{i}\n" + numbered_lines(layer.elements)
        model += (f"*MATERIAL, NAME=LAYER{i}\n*HYPERELASTIC, NEO HOOKE\n{material.mu / 2:.12g}, {2 / material.bulk:.12g}\n"
                  f"*EXPANSION, ZERO=0\n{(1 + layer.swelling) ** (1 / 3) - 1:.12g}\n"
                  f"*SOLID SECTION, ELSET=LAYER{i}, MATERIAL=LAYER{i}\n")
    return numbers + model + "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nALL, 0\n", "*TEMPERATURE\nALL, 1\n"


def write_deck(path, mesh, kind, material, loading, force_sets, thickness=None, equations=(), solver="SPOOLES", density=None,
               step_lines="", layers=(), model_lines=""):
    """Write the deck. `force_sets` names the node sets whose total reaction is printed at each output, as are the
    displacements of all nodes (CalculiX knows one list of time points a step). `density` in g/mm3; `step_lines` are
    further loads, `model_lines` what the body touches."""
    nodes = np.zeros((len(mesh.nodes), 3))
    nodes[:, :mesh.nodes.shape[1]] = mesh.nodes
    with open(path, "w") as deck:
        deck.write("*NODE, NSET=ALL\n")
        deck.writelines(f"{i + 1}, {p[0]:.12g}, {p[1]:.12g}, {p[2]:.12g}\n" for i, p in enumerate(nodes))
        deck.write(f"*ELEMENT, TYPE={kind}, ELSET=BODY\n")
        for i, element in enumerate(mesh.elements):
            numbers = [str(i + 1)] + [str(int(a) + 1) for a in element]
            deck.write(", ".join(numbers[:12]) + (",\n" + ", ".join(numbers[12:]) if len(numbers) > 12 else "") + "\n")
        for name, members in force_sets.items():
            deck.write(f"*NSET, NSET={name}\n" + numbered_lines(members))
        for terms in equations:
            deck.write(f"*EQUATION\n{len(terms)}\n" + "".join(f"{a + 1}, {d}, {c:.12g}\n" for a, d, c in terms))
        if layers:
            model, heat = heated(layers, material)
            deck.write(model)
            step_lines += heat
        else:
            deck.write(f"*MATERIAL, NAME=SOFT\n*HYPERELASTIC, NEO HOOKE\n{material.mu / 2:.12g}, {2 / material.bulk:.12g}\n")
            deck.write(f"*DENSITY\n{density:.12g}\n" if density else "")
            deck.write("*SOLID SECTION, ELSET=BODY, MATERIAL=SOFT\n" + (f"{thickness:.12g}\n" if thickness else ""))
        deck.write(model_lines)
        deck.write("*TIME POINTS, NAME=OUTPUTS\n" + "".join(f"{t:.9g},\n" for t in loading.outputs))
        step = loading.largest_increment
        deck.write(f"*STEP, NLGEOM, INC=2000\n*STATIC, SOLVER={solver}\n{step:.9g}, 1., 1e-4, {step:.9g}\n*BOUNDARY\n")
        deck.writelines(f"{a + 1}, {d}, {d}, {v:.12g}\n" for a, d, v in loading.prescribed)
        deck.write(step_lines)
        for name in force_sets:
            deck.write(f"*NODE PRINT, NSET={name}, TOTALS=ONLY, TIME POINTS=OUTPUTS\nRF\n")
        deck.write("*NODE PRINT, NSET=ALL, TIME POINTS=OUTPUTS\nU\n*END STEP\n")
