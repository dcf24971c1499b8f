#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whole commands on damaged files: those that a library reads (ITK, VTK, GDCM, HDF5), which libFuzzer does not watch.

  python3 tests/fuzz/commands.py PROGRAM SECONDS [--seed N] [--failed DIR]

A small phantom is run once. Then one of its files, in one of the formats that the program reads, is damaged and a
command is run on it. Whatever the file holds, the command must end within 10 s of processor time and 2 GB with one of
its own exit codes, and, where it refuses, with one line that names the file. Files that break this are kept in DIR.
Needs numpy and nibabel.
"""
import argparse
import gzip
import os
import random
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path

try:
    import nibabel
    import numpy
except ImportError:
    print("not tried: it needs Python's nibabel and numpy (python3-nibabel)")
    sys.exit(77)

MOST_SECONDS = 10  # of processor time: the machine may be busy
MOST_WAITING = 60
MOST_KILOBYTES = 2 << 20
CODES = (0, 2, 3)  # done, refused, not converged
FEWEST_REFUSED = 0.2  # of the damaged files: fewer have hardly been damaged
EXTREMES = [struct.pack(kind, value) for kind, value in
            [("<i", 0), ("<i", -1), ("<i", 2**31 - 1), ("<q", 2**40), ("<h", -32768), ("<f", float("nan")),
             ("<f", 1e38), ("<d", float("inf")), ("<d", 1e308), ("<d", -1e-300)]]
# Of 3D Slicer's segmentations, in the header of a .seg.nrrd.
SEGMENTS = b"".join(f"Segment{i}_Name:={name}\nSegment{i}_LabelValue:={i + 1}\nSegment{i}_Layer:=0\n".encode()
                    for i, name in enumerate(("brain", "ventricles", "tumor", "csf", "skull", "scalp")))
NUMBERS = [b"0", b"-1", b"nan", b"inf", b"1e308", b"2147483648", b"99999999999999999999", b"0.3", b"x", b""]


def run(command, **more):
    return subprocess.run([str(part) for part in command], capture_output=True, text=True, errors="replace", **more)


def phantom(program, folder):
    """A finished run of a small head, in `folder`/run."""
    for arguments in (["phantom", "--size", 40, "--spacing", 6, "--out", "head"],
                      ["run", "head/scene.xml", "--quiet", "--out", "run", "--until", "register",
                       "--set=discretise.nodes=150", "--set=solve.tolerance=0.5", "--set=segment.edge_length=14"]):
        done = run([program, *arguments], cwd=folder)
        if done.returncode not in (0, 3):
            sys.exit(f"{arguments[0]}: {done.stderr}")


def other_formats(folder):
    """The phantom's T1 and labels as .nii, .mgz, .nrrd and .mha; its surface as .vtk, .ply, .stl, .obj and .gii."""
    for name in ("t1", "labels"):
        image = nibabel.load(folder / f"head/{name}.nii.gz")
        values = numpy.asanyarray(image.dataobj).astype("<f4" if name == "t1" else "<u2")
        nibabel.save(nibabel.Nifti1Image(values, image.affine), folder / f"{name}.nii")
        nibabel.save(nibabel.MGHImage(values.astype("f4" if name == "t1" else "i2"), image.affine),
                     folder / f"{name}.mgz")
        spacing = image.header.get_zooms()[:3]
        kind, meta = ("float", "MET_FLOAT") if name == "t1" else ("ushort", "MET_USHORT")
        sizes = " ".join(map(str, values.shape))
        body = values.tobytes(order="F")
        directions = " ".join("({})".format(",".join(str(s if i == j else 0) for j in range(3)))
                              for i, s in enumerate(spacing))
        (folder / f"{name}.nrrd").write_bytes(
            f"NRRD0004\ntype: {kind}\ndimension: 3\nspace: left-posterior-superior\nsizes: {sizes}\n"
            f"space directions: {directions}\nkinds: domain domain domain\nendian: little\nencoding: raw\n"
            f"space origin: (0,0,0)\n".encode() + (SEGMENTS if name == "labels" else b"") + b"\n" + body)
        (folder / f"{name}.mha").write_bytes(
            f"ObjectType = Image\nNDims = 3\nBinaryData = True\nCompressedData = False\nOffset = 0 0 0\n"
            f"ElementSpacing = {' '.join(map(str, spacing))}\nDimSize = {sizes}\nElementType = {meta}\n"
            f"ElementDataFile = LOCAL\n".encode() + body)


def surfaces(folder):
    """Three triangles' worth of every format that is text, as whoever draws by hand writes it, and GIFTI."""
    points = [(0, 0, 0), (30, 0, 0), (0, 30, 0), (0, 0, 30)]
    faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    rows = "\n".join(" ".join(map(str, p)) for p in points)
    triangles = "\n".join("3 " + " ".join(map(str, f)) for f in faces)
    (folder / "s.vtk").write_text(f"# vtk DataFile Version 3.0\ns\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n{rows}\n"
                                  f"POLYGONS 4 16\n{triangles}\n")
    (folder / "s.ply").write_text("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                                  "property float z\nelement face 4\nproperty list uchar int vertex_indices\n"
                                  f"end_header\n{rows}\n{triangles}\n")
    (folder / "s.obj").write_text("".join("v {} {} {}\n".format(*p) for p in points) +
                                  "".join("f {} {} {}\n".format(*(i + 1 for i in f)) for f in faces))
    facets = "".join("facet normal 0 0 1\nouter loop\n" + "".join("vertex {} {} {}\n".format(*points[i]) for i in f) +
                     "endloop\nendfacet\n" for f in faces)
    (folder / "s.stl").write_text(f"solid s\n{facets}endsolid s\n")
    arrays = [nibabel.gifti.GiftiDataArray(numpy.array(values, kind), intent) for values, kind, intent in
              ((points, "f4", "NIFTI_INTENT_POINTSET"), (faces, "i4", "NIFTI_INTENT_TRIANGLE"))]
    nibabel.save(nibabel.gifti.GiftiImage(darrays=arrays), folder / "s.gii")


def tracts(folder):
    """Two tracts of every kind, in the brain's middle."""
    points = [numpy.array([[0, 0, z], [1, 2, z], [2, 3, z + 1]], "f4") for z in (0, 4)]
    made = nibabel.streamlines.Tractogram(points, affine_to_rasmm=numpy.eye(4))
    nibabel.streamlines.save(made, str(folder / "t.tck"))
    head = {"voxel_sizes": (2, 2, 2), "dimensions": (40, 40, 40), "voxel_to_rasmm": numpy.diag([2, 2, 2, 1]),
            "voxel_order": "RAS"}
    nibabel.streamlines.save(made, str(folder / "t.trk"), header=head)


def dicom_element(group, number, kind, value):
    if isinstance(value, str):
        value = value.encode()
    value += (b"\0" if kind == "UI" else b" ") * (len(value) % 2)
    size = struct.pack("<2xI" if kind == "OW" else "<H", len(value))
    return struct.pack("<HH", group, number) + kind.encode() + size + value


def dicom_series(folder):
    """The phantom's T1, a slice a file, in explicit little endian."""
    image = nibabel.load(folder / "head/t1.nii.gz")
    values = numpy.asarray(image.dataobj).astype("<u2")
    step = image.header.get_zooms()[0]
    (folder / "series").mkdir()
    for k in range(values.shape[2]):
        kind, mine = "1.2.840.10008.5.1.4.1.1.4", f"1.2.3.5.{k + 1}"
        meta = b"".join((dicom_element(2, 2, "UI", kind), dicom_element(2, 3, "UI", mine),
                         dicom_element(2, 16, "UI", "1.2.840.10008.1.2.1")))
        numbers = ((2, 1), (16, values.shape[1]), (17, values.shape[0]), (0x100, 16), (0x101, 16), (0x102, 15), (0x103, 0))
        shape = {number: dicom_element(0x28, number, "US", struct.pack("<H", value)) for number, value in numbers}
        shape[4] = dicom_element(0x28, 4, "CS", "MONOCHROME2")
        shape[0x30] = dicom_element(0x28, 0x30, "DS", f"{step:g}\\{step:g}")
        body = b"".join((dicom_element(8, 0x16, "UI", kind), dicom_element(8, 0x18, "UI", mine),
                         dicom_element(8, 0x60, "CS", "MR"), dicom_element(0x20, 0xe, "UI", "1.2.3.4"),
                         dicom_element(0x20, 0x32, "DS", f"0\\0\\{k * step:g}"),
                         dicom_element(0x20, 0x37, "DS", "1\\0\\0\\0\\1\\0"),
                         *(shape[number] for number in sorted(shape)),
                         dicom_element(0x7fe0, 16, "OW", values[:, :, k].tobytes(order="F"))))
        (folder / f"series/{k:03}.dcm").write_bytes(
            b"\0" * 128 + b"DICM" + dicom_element(2, 0, "UL", struct.pack("<I", len(meta))) + meta + body)


def scenes(folder):
    """The phantom's scene beside its folder, and one with another program's transform as its load: damaged.h5."""
    text = (folder / "head/scene.xml").read_text()
    load = '<field file="../damaged.h5" moves="points" where="../run/segment/brain.vtp"/>'
    (folder / "scene.xml").write_text(re.sub(r'"([\w.]+\.(nii\.gz|csv|json))"', r'"head/\1"', text))
    (folder / "head/field.xml").write_text(text.replace('<craniotomy file="craniotomy.csv"/>', load))


def targets(folder):
    """What is damaged, and the command that reads it; {} is the damaged file. Of a slice the whole series is read."""
    labels = ["segment", "--quiet", "--labels", "{}", "--brain-labels", 1, 2, 3, "--edge-length", 14, "--out", "out"]
    image = ["segment", "--quiet", "--t1", "{}", "--labels", folder / "head/labels.nii.gz", "--brain-labels", 1, 2, 3,
             "--edge-length", 14, "--out", "out"]
    surface = ["discretise", "--quiet", "--surface", "{}", "--nodes", 150, "--out", "out"]
    warp = ["warp", folder / "run", "{}", "--out", "out"]
    solve = ["solve", "--quiet", "--nodes", folder / "run/discretise/nodes.vtu", "--cells",
             folder / "run/discretise/cells.vtu", "--labels", folder / "head/labels.nii.gz", "--load",
             folder / "head/craniotomy.csv", "--material=1:brain", "--material=2:brain", "--material=3:brain",
             "--tolerance", 0.5, "--out", "out"]
    found = [(folder / f"labels{ending}", labels) for ending in (".nii", ".mgz", ".nrrd", ".mha")]
    found += [(folder / f"t1{ending}", image) for ending in (".nii", ".mgz")]
    # These two and the series lie elsewhere: with them go labels of the same frame.
    elsewhere = [folder / "labels.mha" if part == folder / "head/labels.nii.gz" else part for part in image]
    found += [(folder / f"t1{ending}", elsewhere) for ending in (".nrrd", ".mha")]
    found += [(folder / f"s{ending}", warp) for ending in (".vtk", ".ply", ".obj", ".stl", ".gii")]
    found += [(folder / f"s{ending}", surface) for ending in (".ply", ".obj", ".stl")]
    found += [(folder / f"t{ending}", warp) for ending in (".tck", ".trk")]
    found.append((folder / "labels.seg.nrrd", labels))
    found += [(folder / "series/002.dcm", [folder / "broken" if part == "{}" else part for part in elsewhere])] * 3
    found += [(next((folder / "run/register").glob("*mode-points_xfm.h5")), ["scene", "--check", folder / "head/field.xml"])] * 3
    found += [(folder / "head/labels.nii.gz", labels), (folder / "head/t1.nii.gz", warp),
              (folder / "run/segment/brain.vtp", surface), (folder / "run/segment/brain.vtp", warp),
              (folder / "run/solve/solution.vtu", warp)]
    for option, file in (("--nodes", "nodes.vtu"), ("--cells", "cells.vtu")):
        command = list(solve)
        command[command.index(option) + 1] = "{}"
        found.append((folder / "run/discretise" / file, command))
    found.append((folder / "scene.xml", ["scene", "--check", "{}"]))
    return found


def damaged(data, chance):
    """The bytes with one to four faults: cut off, bits, numbers, pieces that are missing, doubled or swapped."""
    data = bytearray(data)
    for _ in range(chance.choice((1, 1, 1, 2, 4))):
        size = max(1, len(data))
        at = chance.randrange(min(size, chance.choice((64, 512, size))))  # most faults that matter are in headers
        piece = slice(at, at + chance.choice((1, 4, 8, 64, 1024)))
        kind = chance.randrange(7)
        if kind == 0:
            del data[at:]
        elif kind == 1 and data:
            data[at] ^= 1 << chance.randrange(8)
        elif kind == 2:
            value = chance.choice(EXTREMES)
            data[at:at + len(value)] = value
        elif kind == 3:
            del data[piece]
        elif kind == 4:
            data[at:at] = data[piece]
        elif kind == 5:
            other = chance.randrange(size)
            data[piece], data[other:other + 8] = data[other:other + 8], data[piece]
        else:
            end = at
            while end < len(data) and data[end:end + 1] in b"+-.0123456789eE":
                end += 1
            data[at:end] = chance.choice(NUMBERS)
    return bytes(data)


def damage(file, chance):
    data = file.read_bytes()
    if file.suffix in (".gz", ".mgz") and chance.random() < 0.7:
        inner = gzip.decompress(data) if data[:2] == b"\x1f\x8b" else data
        return gzip.compress(damaged(inner, chance), 1)
    return damaged(data, chance)


def fault_of(process, said, waited, usage, file):
    """What of a command's end is wrong; empty: nothing."""
    seconds = usage.ru_utime + usage.ru_stime
    if seconds > MOST_SECONDS or waited > MOST_WAITING:
        return f"took {seconds:.0f} s of processor time, {waited:.0f} s in all"
    if os.WIFSIGNALED(process):
        return f"killed by {signal.Signals(os.WTERMSIG(process)).name}"
    code = os.WEXITSTATUS(process)
    if code not in CODES:
        return f"exit code {code}"
    if usage.ru_maxrss > MOST_KILOBYTES:
        return f"took {usage.ru_maxrss / 1e6:.1f} GB"
    if code == 2:
        lines = said.splitlines()
        if len(lines) != 1 or not lines[0].startswith("brainshift: "):
            return f"{len(lines)} lines where one sentence was expected"
        if file.name not in lines[0] and not (file.suffix == ".dcm" and "broken" in lines[0]):
            return "the sentence does not name the file"
    return ""


def attempt(program, command, file, folder):
    """Runs the command on the file: its fault and what it said."""
    shutil.rmtree(folder / "out", ignore_errors=True)
    arguments = [str(program)] + [str(file) if part == "{}" else str(part) for part in command]
    begin = time.monotonic()
    with open(folder / "said", "w+", errors="replace") as said:
        process = subprocess.Popen(arguments, cwd=folder, stdout=subprocess.DEVNULL, stderr=said)
        while True:
            found, status, usage = os.wait4(process.pid, os.WNOHANG)
            waited = time.monotonic() - begin
            if found:
                break
            if waited > MOST_WAITING:
                process.kill()
            time.sleep(0.005)
        process.returncode = status
        said.seek(0)
        text = said.read()
    return fault_of(status, text, waited, usage, file), text, arguments


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("seconds", type=float)
    parser.add_argument("--seed", type=int, default=random.randrange(10**6))
    parser.add_argument("--failed", type=Path, default=Path("failed"), metavar="DIR")
    options = parser.parse_args()
    os.environ.update(OMP_NUM_THREADS="1", OMP_WAIT_POLICY="passive")
    chance = random.Random(options.seed)
    print(f"seed {options.seed}")
    runs = faults = refused = 0
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        phantom(options.program.resolve(), folder)
        other_formats(folder)
        surfaces(folder)
        shutil.copy(folder / "labels.nrrd", folder / "labels.seg.nrrd")
        tracts(folder)
        dicom_series(folder)
        scenes(folder)
        all_targets = targets(folder)
        end = time.monotonic() + options.seconds
        while time.monotonic() < end:
            original, command = chance.choice(all_targets)
            file = folder / ("damaged" + "".join(original.suffixes))
            if original.suffix == ".dcm":
                shutil.rmtree(folder / "broken", ignore_errors=True)
                shutil.copytree(original.parent, folder / "broken")
                file = folder / "broken" / original.name
            file.write_bytes(damage(original, chance))
            fault, said, arguments = attempt(options.program.resolve(), command, file, folder)
            runs += 1
            refused += bool(said)
            if fault:
                faults += 1
                options.failed.mkdir(exist_ok=True)
                kept = options.failed / f"{options.seed}-{runs}{''.join(file.suffixes)}"
                shutil.copy(file, kept)
                print(f"FAULT: {fault}: {kept}\n  {' '.join(arguments)}\n  " + said[:600].replace("\n", "\n  "))
    print(f"{runs} damaged files, {refused} of them refused or noted, {faults} faults")
    return 1 if faults or runs == 0 or refused < FEWEST_REFUSED * runs else 0


if __name__ == "__main__":
    sys.exit(main())
