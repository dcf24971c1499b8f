# SPDX-License-Identifier: GPL-3.0-or-later
#
# From a label map and measured displacements to the warped image, in memory: a synthetic head, in cells for an editor
# or a notebook.
#
#   python3 phantom.py [FOLDER]     the head and phantom.png come there; Debian: python3-nibabel python3-matplotlib

# %% A synthetic head: what a scanner, a segmentation and a tracker give
import sys
from pathlib import Path

import brainshift
import matplotlib
import nibabel
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (after the choice of what draws)

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "phantom")
brainshift.write_phantom(folder, size=64, spacing=3)
t1 = brainshift.from_nibabel(nibabel.load(folder / "t1.nii.gz"))
labels = brainshift.from_nibabel(nibabel.load(folder / "labels.nii.gz"), labels=True)
load = brainshift.read_load(folder / "craniotomy.csv")
print(t1, labels, f"{len(load.positions)} measured points", sep="\n")

# %% Labels to surfaces, and the brain to nodes and cells
head = brainshift.segment(labels)
body = brainshift.discretise(head.brain, labels, nodes=2000)
print(head.brain, f"{len(body.nodes)} nodes, {len(body.cells)} cells", sep="\n")

# %% How the brain moves
materials = {1: "brain", 2: "ventricle", 3: "tumour"}
moved = brainshift.solve(body, materials, load, labels, head.skull)
print(f"the nodes move by {np.linalg.norm(moved.displacement, axis=1).max():.2f} mm at most, "
      f"{np.percentile(moved.estimated_error, 95):.2f} mm of it uncertain for want of nodes")

# %% Fields, the warped image, and a point that is taken along
warped = brainshift.register(moved, head.brain, t1, labels)
deepest = load.positions[np.linalg.norm(load.displacement, axis=1).argmax()]
print("a point of the cortex goes from", deepest.round(1), "to", brainshift.warp_points(warped.forward, [deepest])[0].round(1))
nibabel.save(brainshift.to_nibabel(warped.warped), folder / "warped.nii.gz")

# %% The slice that moves most
length = np.linalg.norm(warped.forward.voxels, axis=-1)
k = length.max(axis=(0, 1)).argmax()
figure, axes = plt.subplots(1, 3, figsize=(12, 4.4), layout="constrained")
for axis, title, image in ((axes[0], "before", t1), (axes[1], "after", warped.warped)):
    axis.imshow(image.voxels[:, :, k].T, cmap="gray", origin="lower")
    axis.set_title(title)
shift = axes[2].imshow(length[:, :, k].T, cmap="magma", origin="lower")
axes[2].set_title("shift, mm")
figure.colorbar(shift, ax=axes[2], shrink=0.8)
for axis in axes:
    axis.set_axis_off()
figure.savefig(folder / "phantom.png", dpi=120)
