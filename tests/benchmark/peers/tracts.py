# SPDX-License-Identifier: GPL-3.0-or-later
"""Tracts moved by brainshift warp, by a trilinear look-up of the field in numpy and by MRtrix' tcktransform: how far their points
lie apart. They are written as .tck and as .trk in four voxel orders by nibabel. An oblique head shows most.

usage: tracts.py BRAINSHIFT RUN T1 FOLDER     (the program; a run and its T1; a new folder). Debian: python3-nibabel mrtrix3
"""
import itertools
import os
import subprocess
import sys

import nibabel
import numpy as np
from nibabel.streamlines import Tractogram, TrkFile

ORDERS = ("LAS", "LPS", "RAS", "SAL")
LARGEST = 0.05  # mm
TO_RAS = np.array([-1, -1, 1])


def some_tracts(field, affine, random):
    """Random walks about places that move, in RAS, single precision."""
    moving = np.argwhere(np.linalg.norm(field, axis=-1) > 0.5)
    tracts = []
    for _ in range(2000):
        steps = 0.3 * random.normal(size=3) + 0.1 * random.normal(size=(40, 3))
        voxels = moving[random.integers(len(moving))] + random.uniform(-0.5, 0.5, 3) + np.cumsum(steps, axis=0)
        tracts.append((voxels @ affine[:3, :3].T + affine[:3, 3]).astype(np.float32))
    return tracts


def to_voxels(points, affine):
    return np.linalg.solve(affine[:3, :3], (points.astype(float) - affine[:3, 3]).T).T


def moved(points, field, affine):
    """Points and their displacements in RAS, zero outside the outermost half voxel."""
    size = np.array(field.shape[:3])
    index = to_voxels(points, affine)
    inside = ((index >= -0.5) & (index <= size - 0.5)).all(axis=1)
    index = np.clip(index, 0, size - 1)
    low = np.minimum(np.floor(index).astype(int), size - 2)
    part = index - low
    sum_ = np.zeros(points.shape)
    for corner in itertools.product((0, 1), repeat=3):
        weight = np.prod(np.where(corner, part, 1 - part), axis=1)
        sum_ += weight[:, None] * field[tuple((low + corner).T)]
    return points + np.where(inside[:, None], sum_ * TO_RAS, 0)


def write_tracts(tracts, image, folder):
    nibabel.streamlines.save(Tractogram(tracts, affine_to_rasmm=np.eye(4)), f"{folder}/tracts.tck")
    counts = [np.arange(len(tract), dtype=np.float32)[:, None] for tract in tracts]
    with_scalars = Tractogram(tracts, affine_to_rasmm=np.eye(4), data_per_point={"count": counts})
    for order in ORDERS:
        header = {"voxel_to_rasmm": image.affine, "voxel_sizes": image.header.get_zooms(), "dimensions": image.shape,
                  "voxel_order": order.encode()}
        nibabel.streamlines.save(TrkFile(with_scalars, header=header), f"{folder}/tracts_{order}.trk")
    return ["tracts.tck"] + [f"tracts_{order}.trk" for order in ORDERS]


def header_of(path):
    with open(path, "rb") as file:
        content = file.read()
    return content[:1000] if path.endswith(".trk") else content[:content.index(b"END")]


def by_mrtrix(field, affine, folder):
    """MRtrix wants places, in RAS."""
    nibabel.save(nibabel.Nifti1Image((field * TO_RAS).astype(np.float32), affine), f"{folder}/field.nii")
    for command in (["warpconvert", f"{folder}/field.nii", "displacement2deformation", f"{folder}/places.mif"],
                    ["tcktransform", f"{folder}/tracts.tck", f"{folder}/places.mif", f"{folder}/mrtrix.tck"]):
        subprocess.run(command + ["-quiet"], check=True)
    return nibabel.streamlines.load(f"{folder}/mrtrix.tck").streamlines.get_data()


def main(program, run, t1, folder):
    os.makedirs(folder)
    image = nibabel.load(t1)
    field = np.asarray(nibabel.load(f"{run}/register/preop_to_intraop.nii.gz").dataobj).squeeze()
    tracts = some_tracts(field, image.affine, np.random.default_rng(1))
    points = np.concatenate(tracts)
    expected = moved(points, field, image.affine)
    names = write_tracts(tracts, image, folder)
    subprocess.run([program, "--quiet", "warp", run, *(f"{folder}/{name}" for name in names), "--out", f"{folder}/out"], check=True)
    worst = 0
    for name in names:
        assert header_of(f"{folder}/{name}") == header_of(f"{folder}/out/warped_{name}"), name
        ours = nibabel.streamlines.load(f"{folder}/out/warped_{name}").streamlines.get_data()
        apart = np.abs(ours - expected).max()
        worst = max(worst, apart)
        print(f"{name}: {len(points)} points, {apart:.1g} mm from numpy")
    ours = nibabel.streamlines.load(f"{folder}/out/warped_tracts.tck").streamlines.get_data()
    # At the border MRtrix has no place to give.
    index = to_voxels(points, image.affine)
    inner = ((index > 1) & (index < np.array(field.shape[:3]) - 2)).all(axis=1)
    apart = np.abs(by_mrtrix(field, image.affine, folder) - ours)[inner].max()
    print(f"tcktransform: {inner.sum()} points, {apart:.1g} mm from ours")
    return 0 if max(worst, apart) < LARGEST else 1


if __name__ == "__main__":
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
