# SPDX-License-Identifier: GPL-3.0-or-later
"""The same image resampled with the same displacement field by brainshift, plastimatch and elastix's transformix: seconds, and
how far their images lie apart. Linear interpolation, on the image's own grid.

usage: resample.py OUT.csv FOLDER RESAMPLE T1 FIELD     (the built program; a run's image and its intraop_to_preop)
"""
import os
import re
import sys
import zlib

import numpy as np

import timed

TYPES = {"MET_FLOAT": np.float32, "MET_DOUBLE": np.float64, "MET_SHORT": np.int16, "MET_UCHAR": np.uint8}


def read_mha(path):
    """Header (lines in order) and voxels, x fastest, components last."""
    with open(path, "rb") as file:
        header = {}
        while "ElementDataFile" not in header:
            key, _, value = file.readline().decode().partition(" = ")
            header[key] = value.strip()
        data = file.read()
    if header.get("CompressedData") == "True":
        data = zlib.decompress(data)
    return header, np.frombuffer(data, TYPES[header["ElementType"]])


def unpack(path):
    """Writes the file again without compression, so that nobody is timed for it."""
    header, voxels = read_mha(path)
    header.pop("CompressedDataSize", None)
    header["CompressedData"] = "False"
    with open(path, "wb") as file:
        file.writelines(f"{key} = {value}\n".encode() for key, value in header.items())
        file.write(voxels.tobytes())


def transformix_parameters(path, field, header):
    """A transform that is the field, on the grid of the field. Debian's build lacks the plain linear interpolator; B-splines of
    order 1 are the same."""
    size = header["DimSize"]
    about = {
        "Transform": '"DeformationFieldTransform"', "NumberOfParameters": "0", "DeformationFieldFileName": f'"{field}"',
        "DeformationFieldInterpolationOrder": "1", "InitialTransformParametersFileName": '"NoInitialTransform"',
        "HowToCombineTransforms": '"Compose"', "FixedImageDimension": "3", "MovingImageDimension": "3",
        "FixedInternalImagePixelType": '"float"', "MovingInternalImagePixelType": '"float"', "Size": size, "Index": "0 0 0",
        "Spacing": header["ElementSpacing"], "Origin": header["Offset"], "Direction": header["TransformMatrix"],
        "UseDirectionCosines": '"true"', "ResampleInterpolator": '"FinalBSplineInterpolator"',
        "FinalBSplineInterpolationOrder": "1", "Resampler": '"DefaultResampler"',
        "DefaultPixelValue": "0", "ResultImageFormat": '"mha"', "ResultImagePixelType": '"float"', "CompressResultImage": '"false"'}
    with open(path, "w") as file:
        file.writelines(f"({key} {value})\n" for key, value in about.items())


def least(command, threads, log, times=3):
    """The fastest of some runs; the program must succeed."""
    all_of_them = [timed.run(command, threads, log) for _ in range(times)]
    if any(took.status != 0 for took in all_of_them):
        raise RuntimeError(f"{command[0]} failed, see {log}")
    return min(all_of_them, key=lambda took: took.seconds)


def apart(path, ours):
    """Of the intensities, per cent of the image's range: largest, 99.9 % and mean difference."""
    voxels = read_mha(path)[1].astype(float)
    difference = 100 * np.abs(voxels - ours) / (ours.max() - ours.min())
    return {"largest_percent": difference.max(), "percent_999": np.percentile(difference, 99.9), "mean_percent": difference.mean()}


def by_brainshift(folder, resample, threads):
    """Seconds of the resampling alone, what the whole program took, how the first was found, the image."""
    log, warped = f"{folder}/brainshift.log", f"{folder}/brainshift.mha"
    whole = least([resample, "warp", f"{folder}/image.mha", f"{folder}/field.mha", warped, "1"], threads, log)
    least([resample, "warp", f"{folder}/image.mha", f"{folder}/field.mha", warped, "5"], threads, log, times=1)
    with open(log) as said:
        return float(said.read()), whole, "the call; the program writes a compressed file", warped


def by_plastimatch(folder, _, threads):
    command = ["plastimatch", "convert", "--input", f"{folder}/image.mha", "--xf", f"{folder}/field.mha", "--interpolation", "linear",
               "--default-value", "0"]
    log, warped = f"{folder}/plastimatch.log", f"{folder}/plastimatch.mha"
    whole = least([*command, "--output-img", warped], threads, log)
    few = least([*command, "--output-img", f"{folder}/few.mha", "--dim", "2 2 2"], threads, log)
    return whole.seconds - few.seconds, whole, "the program, less itself for 8 voxels", warped


def by_transformix(folder, _, threads):
    log = f"{folder}/transformix.log"
    whole = least(["transformix", "-in", f"{folder}/image.mha", "-out", folder, "-tp", f"{folder}/transform.txt", "-threads",
                   str(threads)], threads, log)
    with open(log) as said:
        alone = float(re.search(r"Resampling took ([0-9.]+)", said.read())[1])
    return alone, whole, "as it says; writing the image included", f"{folder}/result.mha"


def main(out, folder, resample, t1, field_file):
    os.makedirs(folder, exist_ok=True)
    folder = os.path.abspath(folder)
    image, field = f"{folder}/image.mha", f"{folder}/field.mha"
    for source, target, kind in ((t1, image, "image"), (field_file, field, "field")):
        least([resample, "convert", source, target, kind], 1, f"{folder}/convert.log", times=1)
        unpack(target)
    transformix_parameters(f"{folder}/transform.txt", field, read_mha(field)[0])
    rows = []
    for threads in (1, 2):
        ours = None
        for program, measure in (("brainshift", by_brainshift), ("plastimatch", by_plastimatch), ("transformix", by_transformix)):
            alone, whole, about, warped = measure(folder, resample, threads)
            ours = read_mha(warped)[1].astype(float) if ours is None else ours
            rows.append({"program": program, "threads": threads, "seconds": alone, "whole_seconds": whole.seconds,
                         "peak_mb": whole.peak_mb, **apart(warped, ours), "note": about})
            timed.write_rows(out, rows)


if __name__ == "__main__":
    main(*sys.argv[1:])
