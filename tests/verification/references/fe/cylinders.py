"""Geometry that the cylinder cases share: the cross-section mesh and the sample points. Axis z, bottom face at z = 0."""
import numpy as np
from scipy.stats import qmc

from . import meshes


def half_disc(core, ring, power, radius):
    """8-node quadrilaterals of y >= 0: a square core (2 core by core) in a ring of `ring` layers graded to the rim."""
    side = 0.5 * radius
    along, up = np.linspace(-side, side, 4 * core + 1), np.linspace(0, side, 2 * core + 1)
    outwards = meshes.graded(ring, power)[:, None, None]

    def layer(inner, angles):
        return inner * (1 - outwards) + radius * np.column_stack([np.cos(angles), np.sin(angles)]) * outwards

    back, down, flat = along[::-1], up[::-1], np.full(len(up), side)
    return meshes.quad8([np.stack(np.meshgrid(along, up, indexing="ij"), -1),
                         layer(np.column_stack([flat, up]), np.pi / 4 * up / side),
                         layer(np.column_stack([back, np.full(len(back), side)]), np.pi / 2 - np.pi / 4 * back / side),
                         layer(np.column_stack([-flat, down]), np.pi - np.pi / 4 * down / side)])


def sample_points(radius, height, rims, seed=20, volume=480, lateral=140, near_rim=160):
    """Points of a seeded Sobol set: in the volume, on the free lateral surface, and within 5 % of the height of the circles
    `rims` (pairs of radius, z)."""
    def unit(count, dim):
        return qmc.Sobol(dim, seed=seed).random(1024)[:count]

    inside = unit(volume, 3)
    r, angle, z = radius * np.sqrt(inside[:, 0]), 2 * np.pi * inside[:, 1], height * inside[:, 2]
    surface = unit(lateral, 2)
    r = np.append(r, np.full(lateral, radius))
    angle, z = np.append(angle, 2 * np.pi * surface[:, 0]), np.append(z, height * surface[:, 1])
    edge = unit(near_rim, 3)
    which = np.array(rims)[np.arange(near_rim) % len(rims)]
    reach = 0.05 * height
    r = np.append(r, np.clip(which[:, 0] + reach * (2 * edge[:, 0] - 1), 0, radius))
    z = np.append(z, np.clip(which[:, 1] + reach * (2 * edge[:, 2] - 1), 0, height))
    angle = np.append(angle, 2 * np.pi * edge[:, 1])
    return np.round(np.column_stack([r * np.cos(angle), r * np.sin(angle), z]), 4)
