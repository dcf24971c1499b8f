#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Points, tracts, surfaces and images moved by other programs with a run's own transforms, on one oblique head, against
`brainshift warp`. Those that are not there are named and skipped; exit 1 where one is farther off than 0.05 mm.

usage: compare.py BRAINSHIFT [FOLDER]
  Debian: python3-nibabel mrtrix3 connectome-workbench plastimatch elastix; pip: SimpleITK
  npm, in FOLDER/node_modules or above it: @itk-wasm/transform-io @itk-wasm/image-io
"""
import importlib.util
import json
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

if importlib.util.find_spec("nibabel") is None:
    print("skipped: nibabel cannot be imported (Debian: python3-nibabel)")
    sys.exit(77)

import nibabel  # noqa: E402
import numpy as np  # noqa: E402
import tracts  # noqa: E402
from head import TO_RAS, Head, quietly, trilinear  # noqa: E402

LARGEST = 0.05  # mm
HERE = Path(__file__).resolve().parent


def points_apart(head, theirs):
    return len(theirs), np.abs(np.asarray(theirs) - head.moved).max()


def by_numpy(head):
    """nibabel's reading of the field, and a look-up of our own."""
    yield "points", points_apart(head, head.points + trilinear(head.forward, head.to_index(head.points)))


def tracts_by_nibabel(head):
    yield from tracts.apart(head)


def surface_by_nibabel(head):
    """The same places as vertices of a GIFTI surface; FreeSurfer's matrix to the scanner's frame stays."""
    for name, space in (("plain", None), ("matrix", nibabel.affines.from_matvec(np.diag([-1.0, 1, -1]), [5, -7, 40]))):
        write_surface(head.folder / f"{name}.surf.gii", head.points * TO_RAS, space)
        head.warp(f"{name}.surf.gii")
        surface = nibabel.load(head.folder / f"warped_{name}.surf.gii")
        vertices, triangles = surface.agg_data(("pointset", "triangle"))
        assert (triangles == some_triangles(len(head.points))).all()
        scanner = vertices if space is None else nibabel.affines.apply_affine(surface.darrays[0].coordsys.xform, vertices)
        yield f"surface, {name}", points_apart(head, scanner * TO_RAS)


def some_triangles(count):
    return (np.arange(count)[:, None] + [0, 1, 2]) % count


def write_surface(path, ras, space):
    points = ras if space is None else nibabel.affines.apply_affine(np.linalg.inv(space), ras)
    system = nibabel.gifti.GiftiCoordSystem("NIFTI_XFORM_UNKNOWN" if space is not None else "NIFTI_XFORM_SCANNER_ANAT",
                                            "NIFTI_XFORM_SCANNER_ANAT", np.eye(4) if space is None else space)
    arrays = [nibabel.gifti.GiftiDataArray(points.astype(np.float32), "NIFTI_INTENT_POINTSET", coordsys=system,
                                           meta={"AnatomicalStructurePrimary": "CortexLeft"}),
              nibabel.gifti.GiftiDataArray(some_triangles(len(points)).astype(np.int32), "NIFTI_INTENT_TRIANGLE")]
    nibabel.save(nibabel.gifti.GiftiImage(darrays=arrays), path)


def mrtrix_places(head, field, out):
    """MRtrix wants places, in RAS."""
    u = np.asarray(nibabel.load(field).dataobj).squeeze() * TO_RAS
    nibabel.save(nibabel.Nifti1Image(u.astype(np.float32), head.t1.affine), head.folder / "field.nii")
    quietly("warpconvert", head.folder / "field.nii", "displacement2deformation", out, "-force", "-quiet")


def by_mrtrix(head):
    places = head.folder / "places.mif"
    mrtrix_places(head, head.forward_file, places)
    tracts.write_tck(head.folder / "in.tck", [head.points * TO_RAS])
    quietly("tcktransform", head.folder / "in.tck", places, head.folder / "mrtrix.tck", "-force", "-quiet")
    moved = nibabel.streamlines.load(str(head.folder / "mrtrix.tck")).streamlines.get_data()
    yield "tract", points_apart(head, moved * TO_RAS)
    head.warp("in.tck")
    quietly("tsfinfo", "-ascii", head.folder / "errors", head.folder / "estimated_error_warped_in.tsf", "-force", "-quiet")
    errors = np.loadtxt(next(head.folder.glob("errors*.txt"))).ravel()
    yield "values along a tract", (len(errors), np.abs(errors - head.errors).max())
    mrtrix_places(head, head.resampling_file, places)
    yield "image", head.ramps_apart(lambda image, out: quietly(
        "mrtransform", image, "-warp", places, "-interp", "linear", out, "-force", "-quiet"))


def by_fnirt(head):
    """FSL's own convention, as Workbench writes it: relative, at voxels scaled to mm, of which a head with a positive
    determinant counts x from the other side. numpy looks it up."""
    fnirt = head.folder / "fnirt.nii.gz"
    quietly("wb_command", "-convert-warpfield", "-from-itk", head.resampling_file, "-to-fnirt", fnirt,
            head.folder / "head/t1.nii.gz")
    scale = np.diag([*head.t1.header.get_zooms()[:3], 1])
    if np.linalg.det(head.t1.affine) > 0:
        scale = np.diag([-1, 1, 1, 1]) @ scale
        scale[0, 3] = -scale[0, 0] * (1 - head.t1.shape[0])
    shift = np.asarray(nibabel.load(fnirt).dataobj).squeeze()
    index = np.moveaxis(np.indices(head.t1.shape), 0, -1)
    places = nibabel.affines.apply_affine(np.linalg.inv(scale), nibabel.affines.apply_affine(scale, index) + shift)
    yield "FSL's field", head.ramps_apart(lambda image, out: look_up(image, places, out))


def look_up(image, index, out):
    """An image's values at indices, one for each voxel; 0 outside."""
    image = nibabel.load(image)
    inside = ((index >= 0) & (index <= np.array(image.shape) - 1)).all(axis=-1)
    values = np.zeros(image.shape)
    values[inside] = trilinear(image.get_fdata()[..., None], index[inside])[:, 0]
    nibabel.save(nibabel.Nifti1Image(values, image.affine), out)


def by_workbench(head):
    for field, name in ((head.forward_file, "forward"), (head.resampling_file, "resampling")):
        quietly("wb_command", "-convert-warpfield", "-from-itk", field, "-to-world", head.folder / f"{name}_world.nii.gz")
    write_surface(head.folder / "wb.surf.gii", head.points * TO_RAS, None)
    quietly("wb_command", "-surface-apply-warpfield", head.folder / "wb.surf.gii", head.folder / "forward_world.nii.gz",
            head.folder / "theirs.surf.gii")
    yield "surface", points_apart(head, nibabel.load(head.folder / "theirs.surf.gii").agg_data("pointset") * TO_RAS)
    # It reads ours, and what the error is at its vertices.
    head.warp("wb.surf.gii")
    quietly("wb_command", "-surface-coordinates-to-metric", head.folder / "warped_wb.surf.gii", head.folder / "xyz.func.gii")
    ours = np.stack(nibabel.load(head.folder / "xyz.func.gii").agg_data(), axis=-1)
    yield "our surface, read", points_apart(head, ours * TO_RAS)
    said = quietly("wb_command", "-file-information", head.folder / "estimated_error_warped_wb.shape.gii")
    assert str(len(head.points)) in said, said
    yield "image", head.ramps_apart(lambda image, out: quietly(
        "wb_command", "-volume-warpfield-resample", image, head.folder / "resampling_world.nii.gz", image, "TRILINEAR", out))


def write_fcsv(path, ras):
    with open(path, "w") as file:
        file.write("# Markups fiducial file version = 4.6\n# CoordinateSystem = RAS\n")
        file.write("# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label\n")
        file.writelines("%d,%.6f,%.6f,%.6f,0,0,0,1,1,1,0,p\n" % (i, *p) for i, p in enumerate(ras))


def read_fcsv(path):
    """Places in RAS."""
    text = Path(path).read_text()
    places = np.array([[float(word) for word in line.split(",")[1:4]] for line in text.splitlines() if line[:1] != "#"])
    return places * TO_RAS if "CoordinateSystem = LPS" in text else places


def by_plastimatch(head):
    """Its .fcsv is in RAS, whatever the file says. Points it moves by the displacement of the nearest voxel, so it is
    asked at voxels; between them it is off by as much as the field changes in half a voxel."""
    voxels = nibabel.affines.apply_affine(head.t1.affine, np.unique(np.rint(head.to_index(head.points)), axis=0))
    write_fcsv(head.folder / "voxels.fcsv", voxels)
    head.warp("voxels.fcsv")
    quietly("plastimatch", "convert", "--input", head.folder / "voxels.fcsv", "--xf", head.forward_file, "--output-pointset",
            head.folder / "theirs.fcsv")
    theirs, ours = (read_fcsv(head.folder / name) for name in ("theirs.fcsv", "warped_voxels.fcsv"))
    yield "points at voxels", (len(theirs), np.abs(theirs - ours).max())
    yield "image", head.ramps_apart(lambda image, out: quietly(
        "plastimatch", "convert", "--input", image, "--xf", head.resampling_file, "--interpolation", "linear", "--output-img", out))


def transformix_parameters(head, field, path):
    affine = np.diag([*TO_RAS, 1]) @ head.t1.affine
    spacing = np.linalg.norm(affine[:3, :3], axis=0)
    numbers = lambda values: " ".join(f"{value:.12g}" for value in values)  # noqa: E731
    about = {
        "Transform": '"DeformationFieldTransform"', "NumberOfParameters": "0", "DeformationFieldFileName": f'"{field}"',
        "DeformationFieldInterpolationOrder": "1", "InitialTransformParametersFileName": '"NoInitialTransform"',
        "HowToCombineTransforms": '"Compose"', "FixedImageDimension": "3", "MovingImageDimension": "3",
        "FixedInternalImagePixelType": '"float"', "MovingInternalImagePixelType": '"float"',
        "Size": numbers(head.t1.shape), "Index": "0 0 0", "Spacing": numbers(spacing), "Origin": numbers(affine[:3, 3]),
        "Direction": numbers((affine[:3, :3] / spacing).T.ravel()), "UseDirectionCosines": '"true"',
        "ResampleInterpolator": '"FinalBSplineInterpolator"', "FinalBSplineInterpolationOrder": "1",
        "Resampler": '"DefaultResampler"', "DefaultPixelValue": "0", "ResultImageFormat": '"nii.gz"',
        "ResultImagePixelType": '"float"', "CompressResultImage": '"true"'}
    path.write_text("".join(f"({key} {value})\n" for key, value in about.items()))
    return path


def by_transformix(head):
    work = head.folder / "transformix"
    work.mkdir()
    text = f"point\n{len(head.points)}\n" + "".join("%.6f %.6f %.6f\n" % tuple(p) for p in head.points)
    (work / "in.txt").write_text(text)
    quietly("transformix", "-def", work / "in.txt", "-out", work, "-tp",
            transformix_parameters(head, head.forward_file, work / "points.txt"))
    moved = [line.split("OutputPoint = [")[1].split("]")[0].split() for line in open(work / "outputpoints.txt")]
    yield "points", points_apart(head, np.array(moved, dtype=float))
    parameters = transformix_parameters(head, head.resampling_file, work / "image.txt")

    def resample(image, out):
        quietly("transformix", "-in", image, "-out", work, "-tp", parameters)
        shutil.move(work / "result.nii.gz", out)

    yield "image", head.ramps_apart(resample)


def by_simpleitk(head):
    import SimpleITK

    points = SimpleITK.ReadTransform(str(head.points_transform))
    yield "points", points_apart(head, [points.TransformPoint(list(p)) for p in head.points])

    def resample(image, out):
        image = SimpleITK.ReadImage(str(image))
        transform = SimpleITK.ReadTransform(str(head.image_transform))
        SimpleITK.WriteImage(SimpleITK.Resample(image, image, transform, SimpleITK.sitkLinear), str(out))

    yield "image", head.ramps_apart(resample)


def by_itk_wasm(head):
    """ITK 5.4 in JavaScript reads transforms and fields; numpy looks up what it read."""
    for what, path in (("transform .h5", head.points_transform), ("field .nii.gz", head.forward_file)):
        yield f"points, {what}", points_apart(head, head.points + read_by_itk_wasm(head, path)(head.points))
    index = np.moveaxis(np.indices(head.t1.shape), 0, -1)
    voxels = nibabel.affines.apply_affine(head.t1.affine, index) * TO_RAS
    slicers = head.image_transform.with_suffix(".nrrd")
    for what, path in (("transform .h5", head.image_transform), ("field .nrrd", slicers), ("field .nii.gz", head.resampling_file)):
        places = head.to_index(voxels + read_by_itk_wasm(head, path)(voxels))
        yield f"image, {what}", head.ramps_apart(lambda image, out: look_up(image, places, out))  # noqa: B023


def read_by_itk_wasm(head, path):
    """What it read, as a function: the displacement at places; 0 beyond the grid, as ITK has it."""
    out = head.folder / "read.json"
    quietly("node", HERE / "read_itk_wasm.mjs", head.folder, path, out)
    read = json.loads(out.read_text())
    affine = np.eye(4)
    affine[:3, :3] = np.reshape(read["direction"], (3, 3)) @ np.diag(read["spacing"])
    affine[:3, 3] = read["origin"]
    values = np.fromfile(str(out) + ".values", dtype=np.float64).reshape([*read["size"][::-1], 3]).transpose(2, 1, 0, 3)

    def displacement(points):
        index = nibabel.affines.apply_affine(np.linalg.inv(affine), points)
        inside = ((index >= 0) & (index <= np.array(read["size"]) - 1)).all(axis=-1)
        found = np.zeros_like(points)
        found[inside] = trilinear(values, index[inside])
        return found

    return displacement


def has_itk_wasm(folder):
    check = [f"require.resolve('@itk-wasm/{name}', {{paths: [process.argv[1]]}})" for name in ("transform-io", "image-io")]
    return shutil.which("node") and subprocess.run(["node", "-e", ";".join(check), str(folder)], capture_output=True).returncode == 0


def main(program, folder):
    has = shutil.which
    checks = [("nibabel", by_numpy, True), ("nibabel", tracts_by_nibabel, True), ("nibabel", surface_by_nibabel, True),
              ("MRtrix", by_mrtrix, has("tcktransform") and has("mrtransform")), ("Workbench", by_workbench, has("wb_command")),
              ("Workbench", by_fnirt, has("wb_command")),
              ("plastimatch", by_plastimatch, has("plastimatch")), ("transformix", by_transformix, has("transformix")),
              ("SimpleITK", by_simpleitk, importlib.util.find_spec("SimpleITK")), ("itk-wasm", by_itk_wasm, has_itk_wasm(folder))]
    head = Head(program, folder)
    print(f"{len(head.points)} points that move by up to {np.linalg.norm(head.moved - head.points, axis=1).max():.1f} mm")
    failed = False
    for name, check, there in checks:
        if not there:
            print(f"{name:12} skipped: it is not installed")
            continue
        for what, (count, apart) in check(head):
            failed = failed or not apart < LARGEST
            print(f"{name:12} {what:24} {count:7} places, {apart:.1g} mm apart at most{'' if apart < LARGEST else ': TOO FAR'}")
    return 1 if failed else 0


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    with tempfile.TemporaryDirectory() as scratch:
        place = Path(sys.argv[2] if len(sys.argv) == 3 else scratch).resolve()
        place.mkdir(parents=True, exist_ok=True)
        sys.exit(main(Path(sys.argv[1]).resolve(), place))
