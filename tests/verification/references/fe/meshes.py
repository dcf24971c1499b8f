"""Structured quadratic meshes: 8-node quadrilaterals from blocks, 20-node bricks by extrusion."""
from dataclasses import dataclass

import numpy as np


@dataclass
class Mesh:
    """Nodes (n, dim) in mm and one kind of quadratic element, in CalculiX's node order, numbered from 0."""

    nodes: np.ndarray
    elements: np.ndarray

    def where(self, condition):
        """Numbers of the nodes for which the boolean array `condition` holds."""
        return np.flatnonzero(condition)


def graded(count, power, both_ends=False):
    """2 count + 1 places in [0, 1], midpoints included, that crowd towards 1 (or towards both ends) as distance^(1/power)."""
    def towards_one(t):
        return 1 - (1 - t) ** power

    t = np.linspace(0, 1, count + 1)
    if both_ends:
        ends = np.where(t <= 0.5, 0.5 - 0.5 * towards_one(np.maximum(1 - 2 * t, 0)), 0.5 + 0.5 * towards_one(np.maximum(2 * t - 1, 0)))
    else:
        ends = towards_one(t)
    return with_midpoints(ends)


def with_midpoints(ends):
    """The places `ends` with the middle of each pair put between: straight elements keep their mid-nodes in the middle."""
    places = np.empty(2 * len(ends) - 1)
    places[::2] = ends
    places[1::2] = 0.5 * (ends[:-1] + ends[1:])
    return places


def quad8(blocks):
    """One mesh of 8-node quadrilaterals from blocks of points (2n+1, 2m+1, 2), right-handed, that share their common nodes."""
    points, corners = [], []
    offset = 0
    for block in blocks:
        n, m = block.shape[:2]
        index = offset + np.arange(n * m).reshape(n, m)
        a, b, c, d = index[:-2:2, :-2:2], index[2::2, :-2:2], index[2::2, 2::2], index[:-2:2, 2::2]
        ab, bc, cd, da = index[1::2, :-2:2], index[2::2, 1::2], index[1::2, 2::2], index[:-2:2, 1::2]
        corners.append(np.stack([a, b, c, d, ab, bc, cd, da], -1).reshape(-1, 8))
        points.append(block.reshape(-1, 2))
        offset += n * m
    return merged(np.vstack(points), np.vstack(corners))


def merged(points, elements, digits=7):
    """Mesh of the nodes that elements use, those that coincide to `digits` decimals made one."""
    keys, first, same = np.unique(np.round(points, digits) + 0.0, axis=0, return_index=True, return_inverse=True)
    elements = same.reshape(-1)[elements]
    used, renumbered = np.unique(elements, return_inverse=True)
    return Mesh(points[first[used]], renumbered.reshape(elements.shape))


def rectangle(x, y):
    """8-node quadrilaterals on the grid of places x by y (each with midpoints)."""
    return quad8([np.stack(np.meshgrid(x, y, indexing="ij"), -1)])


def extruded(flat, z):
    """20-node bricks: a mesh of 8-node quadrilaterals swept through the levels z (2l+1 of them, midpoints included)."""
    n = len(flat.nodes)
    points = np.vstack([np.column_stack([flat.nodes, np.full(n, level)]) for level in z])
    bricks = []
    for level in range(0, len(z) - 1, 2):
        low, middle, high = (flat.elements + n * (level + k) for k in range(3))
        bricks.append(np.hstack([low[:, :4], high[:, :4], low[:, 4:], high[:, 4:], middle[:, :4]]))
    bricks = np.vstack(bricks)
    used, bricks = np.unique(bricks, return_inverse=True)
    return Mesh(points[used], bricks.reshape(-1, 20))


def triangles(flat):
    """Each 8-node quadrilateral cut into two 6-node triangles, along the diagonal that ends in the last corner:
    two triangles meet in that corner, which takes its rim singularity better than one does."""
    a, b, c, d, ab, bc, cd, da = flat.elements.T
    centres = len(flat.nodes) + np.arange(len(flat.elements))
    nodes = np.vstack([flat.nodes, flat.nodes[flat.elements[:, :4]].mean(1)])
    return Mesh(nodes, np.vstack([np.column_stack([a, b, c, ab, bc, centres]), np.column_stack([a, c, d, centres, cd, da])]))
