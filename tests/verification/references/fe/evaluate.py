"""Displacement of a quadratic mesh at any point: the element that holds the point, its local place, its shape functions."""
import numpy as np

QUAD = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1], [0, -1], [1, 0], [0, 1], [-1, 0]], float)
BRICK = np.array([[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1],
                  [0, -1, -1], [1, 0, -1], [0, 1, -1], [-1, 0, -1], [0, -1, 1], [1, 0, 1], [0, 1, 1], [-1, 0, 1],
                  [-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], float)
SIMPLEX_EDGES = {2: [(0, 1), (1, 2), (2, 0)], 3: [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]}


def serendipity(local, corners):
    """Shape functions (8 or 20) of a quadrilateral or brick at local places (..., dim) in [-1, 1]."""
    dim = corners.shape[1]
    factors = 1 + local[..., None, :] * corners
    bubbles = 1 - local[..., None, :] ** 2
    middle = corners == 0
    linear = np.where(middle, bubbles, factors).prod(-1)
    corner = linear * ((local[..., None, :] * corners).sum(-1) - (dim - 1)) / 2 ** dim
    return np.where(middle.any(1), linear / 2 ** (dim - 1), corner)


def simplex(local):
    """Shape functions (6 or 10) of a triangle or tetrahedron at local places (..., dim)."""
    weights = np.concatenate([1 - local.sum(-1, keepdims=True), local], -1)
    edges = SIMPLEX_EDGES[local.shape[-1]]
    return np.concatenate([weights * (2 * weights - 1), np.stack([4 * weights[..., a] * weights[..., b] for a, b in edges], -1)], -1)


def shape_functions(node_count):
    """The functions of an element with so many nodes, its local middle, and how far outside it a local place is."""
    if node_count in (8, 20):
        corners = QUAD if node_count == 8 else BRICK
        return (lambda local: serendipity(local, corners), np.zeros(corners.shape[1]), lambda local: np.abs(local).max(-1) - 1)
    dim = {6: 2, 10: 3}[node_count]
    return simplex, np.full(dim, 1 / (dim + 1)), lambda local: np.maximum(-local.min(-1), local.sum(-1) - 1)


def slopes(functions, local, step=1e-5):
    """Derivatives of the shape functions by the local places (exact to rounding: the functions are at most cubic in each)."""
    columns = []
    for axis in np.eye(local.shape[-1]):
        columns.append((functions(local + step * axis) - functions(local - step * axis)) / (2 * step))
    return np.stack(columns, -1)


def smallest_area_ratio(mesh, field):
    """Least ratio of deformed to undeformed area (or volume) at the integration points, in the plane of a flat mesh.
    CalculiX accepts elements turned inside out: a solution with a negative ratio is none."""
    count, dim = mesh.elements.shape[1], mesh.nodes.shape[1]
    functions, _, _ = shape_functions(count)
    if count in (8, 20):
        local = np.stack(np.meshgrid(*[[-3 ** -0.5, 3 ** -0.5]] * dim), -1).reshape(-1, dim)
    else:
        inner = {2: 1 / 6, 3: 0.1381966}[dim]
        local = np.vstack([np.full(dim, inner), inner + (1 - (dim + 1) * inner) * np.eye(dim)])
    gradients = slopes(functions, local)
    before = mesh.nodes[mesh.elements]
    after = before + field[mesh.elements][:, :, :dim]
    return min((np.linalg.det(np.einsum("ead,ak->edk", after, g)) / np.linalg.det(np.einsum("ead,ak->edk", before, g))).min()
               for g in gradients)


class Interpolator:
    """Finds the elements and weights of `points` in `mesh` once; evaluates any nodal field there."""

    def __init__(self, mesh, points):
        functions, middle, outside = shape_functions(mesh.elements.shape[1])
        corners = mesh.nodes[mesh.elements]
        low, high = corners.min(1), corners.max(1)
        slack = 0.02 * (high - low).max(1, keepdims=True)
        self.nodes = np.zeros((len(points), mesh.elements.shape[1]), int)
        self.weights = np.zeros(self.nodes.shape)
        self.farthest_outside = 0.0
        for i, point in enumerate(points):
            near = np.flatnonzero(((point >= low - slack) & (point <= high + slack)).all(1))
            local = np.tile(middle, (len(near), 1))
            for _ in range(12):
                error = point - np.einsum("ea,ead->ed", functions(local), corners[near])
                jacobian = np.einsum("ead,eak->edk", corners[near], slopes(functions, local))
                local = np.clip(local + np.linalg.solve(jacobian, error[..., None])[..., 0], -2, 2)
            best = np.argmin(outside(local))
            self.farthest_outside = max(self.farthest_outside, float(outside(local)[best]))
            self.nodes[i] = mesh.elements[near[best]]
            self.weights[i] = functions(local[best])
        reproduced = np.einsum("pa,pad->pd", self.weights, mesh.nodes[self.nodes])
        mismatch = np.abs(reproduced - points).max()
        if mismatch > 1e-5 or self.farthest_outside > 0.1:
            raise RuntimeError(f"sample points not found in the mesh: {mismatch:.2g} mm off, {self.farthest_outside:.2g} outside")

    def __call__(self, field):
        return np.einsum("pa,pad->pd", self.weights, field[self.nodes])
