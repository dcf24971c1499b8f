# SPDX-License-Identifier: GPL-3.0-or-later
"""How the brain moved in an operation, by mechanics, and the MRI warped to match.

Either a scene as the program computes it, with all its files:

    record = brainshift.run("scene.xml", "run")

or the stages on arrays, in memory:

    labels = brainshift.from_nibabel(nibabel.load("labels.nii.gz"), labels=True)
    head = brainshift.segment(labels)                                  # surfaces
    body = brainshift.discretise(head.brain, labels, nodes=3000)       # nodes and background cells
    moved = brainshift.solve(body, {1: "brain", 2: "ventricle"}, load, labels, head.skull)
    warped = brainshift.register(moved, head.brain, t1, labels)        # fields and images

All positions and displacements are in mm and in LPS (ITK, DICOM): x to the patient's left, y to the back, z to the
head. nibabel is in RAS; from_nibabel(), to_nibabel() and flip_ras_lps() go between the two. Fields go one way each:
Registration.forward moves preoperative points, Registration.resampling warps preoperative images.

Arrays that come back are views of the result's own memory. Long calls let other threads run, end by Ctrl-C, and tell
how far they are to a function progress(fraction, what). ValueError: the input's fault; RuntimeError: a fault of ours,
as a full disk; NotConverged: the computation found no rest. Research software, not a medical device.
"""
import numpy as _numpy

from . import _core
from ._core import (  # noqa: F401  (the module's face)
    Body,
    LabelMap,
    Load,
    Registration,
    ScalarImage,
    Segmentation,
    Solution,
    Surface,
    VectorImage,
    __version__,
    discretise,
    read_field,
    read_image,
    read_label_map,
    read_load,
    read_surface,
    register,
    segment,
    set_threads,
    solve_each,
    warp,
    warp_files,
    warp_points,
    write_image,
    write_phantom,
    write_surface,
)

if not _core.knows_numpy_2 and int(_numpy.__version__.partition(".")[0]) >= 2:
    raise ImportError(f"brainshift was built with a pybind11 older than 2.12, which reads NumPy {_numpy.__version__}'s "
                      "arrays wrongly; take NumPy 1, or build it with a newer pybind11")


class NotConverged(RuntimeError):
    """The computation did not converge or went unstable. `result` is what it has: of run() the record, else the
    Solution."""

    def __init__(self, sentence, result):
        super().__init__(sentence)
        self.result = result


def _turned(affine):
    return _numpy.diag([-1.0, -1.0, 1.0, 1.0]) @ affine


def flip_ras_lps(points):
    """Points or vectors (..., 3) from RAS to LPS, or from LPS to RAS: x and y change their signs."""
    return _numpy.asarray(points, dtype=float) * [-1.0, -1.0, 1.0]


def from_nibabel(image, labels=False):
    """A ScalarImage, or a LabelMap with labels=True, of a nibabel image in three dimensions, RAS to LPS. The values are
    copied once, scaled by the header's slope. Its affine is the one that nibabel takes of header's two."""
    kind = LabelMap if labels else ScalarImage
    return kind(_numpy.asanyarray(image.dataobj), _turned(image.affine))


def to_nibabel(image):
    """A nibabel.Nifti1Image that shares the memory of a ScalarImage or LabelMap, LPS to RAS. A VectorImage becomes a
    field as ITK writes it: (nx, ny, nz, 1, 3), components still in LPS, intent 1007."""
    import nibabel

    voxels = image.voxels
    if isinstance(image, VectorImage):
        voxels = voxels[:, :, :, None, :]
    result = nibabel.Nifti1Image(voxels, _turned(image.affine))
    result.header.set_xyzt_units("mm")
    if isinstance(image, VectorImage):
        result.header.set_intent("vector")
    return result


def solve(body, materials, load, labels=None, skull=None, boundary=None, progress=None, **options):
    result = _core.solve(body, materials, load, labels, skull, boundary, progress, **options)
    if not result.converged:
        raise NotConverged(result.failure, result)
    return result


solve.__doc__ = _core.solve.__doc__.split("\n", 2)[2]


def run(scene, out, until="report", force=False, preset="", set=None, progress=None):
    """Runs a scene's stages in the folder `out`, as `brainshift run`; finished stages there are kept. Returns run.json
    as a dict.

    until: segment, discretise, solve, register or report; force: run stages that have not changed, too; preset: fast,
    balanced or accurate; set: {path: value} on top of the scene, as {"discretise.nodes": 3000}. A command that the
    scene names for a stage is waited for, whatever is pressed."""
    record, failure = _core.run(scene, out, until, force, preset, set or {}, progress)
    if failure:
        raise NotConverged(failure, record)
    return record
