#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The script of cells runs and draws: usage: phantom_test.py SCRIPT. Exit 77 where nibabel or matplotlib is missing."""
import importlib.util
import subprocess
import sys
import tempfile
from pathlib import Path

missing = [name for name in ("nibabel", "matplotlib") if importlib.util.find_spec(name) is None]
if missing:
    print("skipped:", ", ".join(missing), "cannot be imported")
    sys.exit(77)

import matplotlib.image  # noqa: E402
import numpy as np  # noqa: E402

import brainshift  # noqa: E402

with tempfile.TemporaryDirectory() as folder:
    subprocess.run([sys.executable, sys.argv[1], folder], check=True)
    picture = matplotlib.image.imread(Path(folder) / "phantom.png")
    middle = picture[:, : picture.shape[1] // 3, :3]
    assert picture.shape[0] > 400 and picture.shape[1] > 1200, picture.shape
    assert len(np.unique(middle)) > 20, "the slice before is not drawn"
    before, after = (brainshift.read_image(Path(folder) / name) for name in ("t1.nii.gz", "warped.nii.gz"))
    np.testing.assert_allclose(before.affine, after.affine, atol=1e-4)
    assert np.abs(before.voxels - after.voxels).max() > 100, "nothing moved"
