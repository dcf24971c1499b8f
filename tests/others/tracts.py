# SPDX-License-Identifier: GPL-3.0-or-later
"""The places of a Head as tracts: .tck, and .trk in four voxel orders, written and read by nibabel."""
import nibabel
import numpy as np
from head import TO_RAS
from nibabel.streamlines import Tractogram, TrkFile

ORDERS = ("LAS", "LPS", "RAS", "SAL")


def write_tck(path, tracts):
    nibabel.streamlines.save(Tractogram([tract.astype(np.float32) for tract in tracts], affine_to_rasmm=np.eye(4)), str(path))


def write_trk(path, tracts, image, order):
    counts = [np.arange(len(tract), dtype=np.float32)[:, None] for tract in tracts]
    with_scalars = Tractogram([tract.astype(np.float32) for tract in tracts], affine_to_rasmm=np.eye(4),
                              data_per_point={"count": counts})
    header = {"voxel_to_rasmm": image.affine, "voxel_sizes": image.header.get_zooms(), "dimensions": image.shape,
              "voxel_order": order.encode()}
    nibabel.streamlines.save(TrkFile(with_scalars, header=header), str(path))


def header_of(path):
    """Of a .trk without its scalars, which become more."""
    content = path.read_bytes()
    return content[:36] + content[238:1000] if path.suffix == ".trk" else content[:content.index(b"END")]


def apart(head):
    """Names, and how many points brainshift warp lays how far from where the Head's points went; of a .trk, too, how far
    the estimated error of its points is from that of the Head's."""
    tracts = np.array_split(head.points * TO_RAS, 40)
    write_tck(head.folder / "tracts.tck", tracts)
    for order in ORDERS:
        write_trk(head.folder / f"tracts_{order}.trk", tracts, head.t1, order)
    for name in ["tracts.tck"] + [f"tracts_{order}.trk" for order in ORDERS]:
        head.warp(name)
        assert header_of(head.folder / name) == header_of(head.folder / f"warped_{name}"), name
        moved = nibabel.streamlines.load(str(head.folder / f"warped_{name}"))
        ours = moved.streamlines.get_data()
        yield name, (len(ours), np.abs(ours * TO_RAS - head.moved).max())
        if name.endswith(".trk"):
            values = moved.tractogram.data_per_point
            assert set(values) == {"count", "estimated_error"}, set(values)
            yield f"{name}, values", (len(ours), np.abs(values["estimated_error"].get_data()[:, 0] - head.errors).max())
