# SPDX-License-Identifier: GPL-3.0-or-later
"""An oblique head whose brain has moved, and what brainshift makes of points and images in it: what other programs are
held against. Places are in mm, LPS; nibabel's affines and files are RAS."""
import csv
import itertools
import subprocess

import nibabel
import numpy as np

TO_RAS = np.array([-1.0, -1.0, 1.0])


def quietly(*command, **options):
    """Runs it; what it says comes with its failure."""
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(map(str, command))}: {done.stdout[-600:]}")
    return done.stdout


def trilinear(values, index):
    """Of an array (nx, ny, nz, c) at indices (n, 3) inside it."""
    low = np.minimum(np.floor(index).astype(int), np.array(values.shape[:3]) - 2)
    part = index - low
    total = np.zeros((len(index), values.shape[3]))
    for corner in itertools.product((0, 1), repeat=3):
        weight = np.prod(np.where(corner, part, 1 - part), axis=1)
        total += weight[:, None] * values[tuple((low + corner).T)]
    return total


class Head:
    def __init__(self, program, folder):
        self.program, self.folder = program, folder
        quietly(program, "phantom", "--size", 48, "--spacing", 4, "--out", folder / "head")
        self.run = folder / "run"
        quietly(program, "run", folder / "head/scene.xml", "--out", self.run, "--until", "register", "--set",
                "discretise.nodes=1500", "--set", "solve.start=coarse")
        self.t1 = nibabel.load(folder / "head/t1.nii.gz")
        self.points_transform = self.run / "register/from-preop_to-intraop_mode-points_xfm.h5"
        self.image_transform = self.run / "register/from-preop_to-intraop_mode-image_xfm.h5"
        self.forward_file = self.run / "register/preop_to_intraop.nii.gz"
        self.resampling_file = self.run / "register/intraop_to_preop.nii.gz"
        self.forward = np.asarray(nibabel.load(self.forward_file).dataobj).squeeze()
        self.points = self._some_points()
        self.moved = self._moved_points()

    def _some_points(self):
        """A voxel or more within the image, where some programs have no place to give, and where it moves."""
        random = np.random.default_rng(1)
        moving = np.argwhere(np.linalg.norm(self.forward, axis=-1) > 0.5)
        index = moving[random.integers(len(moving), size=2000)] + random.uniform(-0.5, 0.5, (2000, 3))
        inner = ((index > 1) & (index < np.array(self.t1.shape) - 2)).all(axis=1)
        return nibabel.affines.apply_affine(self.t1.affine, index[inner]) * TO_RAS

    def _moved_points(self):
        with open(self.folder / "points.csv", "w") as file:
            file.write("# frame: LPS\nx,y,z\n" + "".join("%.6f,%.6f,%.6f\n" % tuple(p) for p in self.points))
        self.warp("points.csv")
        with open(self.folder / "warped_points.csv") as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
            self.errors = np.array([float(row["estimated_error"] or 0) for row in rows])
            return np.array([[float(row[axis]) for axis in "xyz"] for row in rows])

    def warp(self, *names):
        """By brainshift, beside."""
        quietly(self.program, "warp", self.run, *(self.folder / name for name in names), "--out", self.folder)

    def to_index(self, points):
        return nibabel.affines.apply_affine(np.linalg.inv(self.t1.affine), points * TO_RAS)

    def write_ramps(self):
        """Three images of the world's x, y and z (LPS): resampled, each holds where its voxels come from."""
        index = np.moveaxis(np.indices(self.t1.shape), 0, -1)
        world = nibabel.affines.apply_affine(self.t1.affine, index) * TO_RAS
        for axis, name in enumerate("xyz"):
            nibabel.save(nibabel.Nifti1Image(world[..., axis].astype(np.float32), self.t1.affine), self.folder / f"ramp_{name}.nii.gz")
        self.warp(*(f"ramp_{name}.nii.gz" for name in "xyz"))

    def ramps_apart(self, resample):
        """How far apart, mm, the places are from which resample(image, out) and brainshift take a voxel, largest, over
        those that come from well within the image."""
        if not (self.folder / "warped_ramp_x.nii.gz").exists():
            self.write_ramps()
        ours, theirs = [], []
        for name in "xyz":
            out = self.folder / f"theirs_{name}.nii.gz"
            resample(self.folder / f"ramp_{name}.nii.gz", out)
            ours.append(nibabel.load(self.folder / f"warped_ramp_{name}.nii.gz").get_fdata())
            theirs.append(nibabel.load(out).get_fdata().reshape(self.t1.shape))
        ours, theirs = np.stack(ours, axis=-1), np.stack(theirs, axis=-1)
        index = self.to_index(ours.reshape(-1, 3))
        inner = ((index > 1) & (index < np.array(self.t1.shape) - 2)).all(axis=1)
        return int(inner.sum()), np.abs(ours - theirs).reshape(-1, 3)[inner].max()
