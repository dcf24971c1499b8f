#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The warped T1 as a DICOM series, read by others: a phantom's T1 becomes a made-up MR series, a run warps it, and of the
series that comes out pydicom looks at the header and the values, dciodvfy at the standard's rules, and a local Orthanc
takes it in and gives it back. Those that are not there are named and skipped; exit 1 where one finds a fault.

usage: dicom.py BRAINSHIFT [FOLDER]
  Debian: python3-nibabel python3-pydicom dicom3tools orthanc dcmtk
"""
import importlib.util
import json
import shutil
import socket
import subprocess
import sys
import tempfile
import time
import urllib.request
from pathlib import Path

for needed in ("nibabel", "pydicom"):
    if importlib.util.find_spec(needed) is None:
        print(f"skipped: {needed} cannot be imported (Debian: python3-{needed})")
        sys.exit(77)

import nibabel  # noqa: E402
import numpy as np  # noqa: E402
import pydicom  # noqa: E402
from head import TO_RAS, quietly  # noqa: E402

MR = "1.2.840.10008.5.1.4.1.1.4"
ORTHANC = shutil.which("Orthanc") or shutil.which("/usr/sbin/Orthanc")


def write_series(image, folder):
    """An MR series, 12 of 16 bits a pixel, with a private element that must not go along."""
    folder.mkdir(parents=True)
    values = np.asarray(image.dataobj).astype(np.uint16)
    affine = np.diag([*TO_RAS, 1]) @ image.affine
    spacing = np.linalg.norm(affine[:3, :3], axis=0)
    axes = affine[:3, :3] / spacing
    assert np.linalg.det(axes) > 0 and values.max() < 4096
    study, series, frame = (pydicom.uid.generate_uid() for _ in range(3))
    for k in range(values.shape[2]):
        meta = pydicom.dataset.FileMetaDataset()
        meta.MediaStorageSOPClassUID, meta.MediaStorageSOPInstanceUID = MR, pydicom.uid.generate_uid()
        meta.TransferSyntaxUID = pydicom.uid.ExplicitVRLittleEndian
        s = pydicom.dataset.FileDataset(None, {}, file_meta=meta, preamble=b"\0" * 128)
        s.is_little_endian, s.is_implicit_VR = True, False
        s.SpecificCharacterSet = "ISO_IR 192"
        s.SOPClassUID, s.SOPInstanceUID, s.Modality = MR, meta.MediaStorageSOPInstanceUID, "MR"
        s.StudyInstanceUID, s.SeriesInstanceUID, s.FrameOfReferenceUID = study, series, frame
        s.ImageType, s.StudyDate, s.StudyTime, s.StudyID = ["ORIGINAL", "PRIMARY", "OTHER"], "20260102", "030405", "1"
        s.PatientName, s.PatientID, s.PatientBirthDate, s.PatientSex = "Kügelgen^Ada", "P1", "19700101", "F"
        s.AccessionNumber, s.ReferringPhysicianName, s.Manufacturer, s.SeriesNumber = "A1", "", "scanner", 3
        s.ScanningSequence, s.SequenceVariant, s.ScanOptions, s.MRAcquisitionType = "GR", "SP", "", "3D"
        s.RepetitionTime, s.EchoTime, s.EchoTrainLength, s.PatientPosition = 9.5, 4.6, 1, "HFS"
        s.PositionReferenceIndicator, s.SliceThickness, s.InstanceNumber = "", spacing[2], values.shape[2] - k
        s.WindowCenter, s.WindowWidth = 400, 800
        s.private_block(0x0029, "SOME SCANNER", create=True).add_new(1, "LO", "a secret")
        place = affine[:3, 3] + k * spacing[2] * axes[:, 2]
        s.ImagePositionPatient = ["%.9g" % x for x in place]
        s.ImageOrientationPatient = ["%.12g" % x for x in axes[:, :2].T.ravel()]
        s.PixelSpacing = [spacing[1], spacing[0]]
        s.Columns, s.Rows = values.shape[:2]
        s.SamplesPerPixel, s.PhotometricInterpretation, s.PixelRepresentation = 1, "MONOCHROME2", 0
        s.BitsAllocated, s.BitsStored, s.HighBit = 16, 12, 11
        s.PixelData = values[:, :, k].T.tobytes()
        s.save_as(folder / f"{k}.dcm", write_like_original=False)


def by_pydicom(source, made, warped):
    before = [pydicom.dcmread(file) for file in sorted(source.iterdir())]
    after = [pydicom.dcmread(file) for file in sorted(made.iterdir())]
    first = before[0]
    for name in ("PatientName", "PatientID", "StudyInstanceUID", "FrameOfReferenceUID", "EchoTime", "WindowWidth"):
        assert all(s[name].value == first[name].value for s in after), name
    for name in ("SeriesInstanceUID", "SOPInstanceUID"):
        assert not {s[name].value for s in before} & {s[name].value for s in after}, name
    assert len({s.SeriesInstanceUID for s in after}) == 1 and len({s.SOPInstanceUID for s in after}) == len(after)
    for s in after:
        assert s.ImageType[:2] == ["DERIVED", "SECONDARY"] and "NOT FOR DIAGNOSIS" in s.SeriesDescription, "what it is"
        assert "brainshift" in s.DerivationDescription and "a secret" not in str(s), "private elements"
        assert {i.ReferencedSOPInstanceUID for i in s.SourceImageSequence} == {b.SOPInstanceUID for b in before}, "sources"
    places = [np.array(sorted(tuple(map(float, s.ImagePositionPatient)) for s in series)) for series in (before, after)]
    assert np.allclose(*places, atol=1e-4), "places of the slices"
    values = np.stack([s.pixel_array.T * float(s.get("RescaleSlope", 1)) + float(s.get("RescaleIntercept", 0)) for s in after], axis=-1)
    apart = np.abs(values - np.asarray(warped.dataobj)).max()
    step = float(after[0].get("RescaleSlope", 1))
    assert apart <= 0.5001 * step, f"values {apart} apart"
    yield f"{len(after)} slices, values {apart:.3g} apart at most, in steps of {step:g}"


def by_dciodvfy(source, made, warped):
    faults = set()
    for file in sorted(made.iterdir()):
        done = subprocess.run(["dciodvfy", file], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")
        assert "MRImage" in done.stdout, f"dciodvfy does not say what it read: {done.stdout}"
        faults |= {line for line in done.stdout.splitlines() if line.startswith("Error")}
    assert not faults, "\n".join(sorted(faults))
    yield "no error"


class Orthanc:
    """A server of its own, in a scratch folder, on free ports."""

    def __enter__(self):
        self.folder = tempfile.TemporaryDirectory()
        with socket.socket() as web, socket.socket() as dicom:
            for each in (web, dicom):
                each.bind(("127.0.0.1", 0))
            self.web, self.dicom = web.getsockname()[1], dicom.getsockname()[1]
        config = Path(self.folder.name) / "orthanc.json"
        config.write_text(json.dumps({
            "StorageDirectory": self.folder.name, "IndexDirectory": self.folder.name, "HttpPort": self.web,
            "DicomPort": self.dicom, "RemoteAccessAllowed": False, "DicomAlwaysAllowStore": True, "Plugins": []}))
        self.process = subprocess.Popen([ORTHANC, config], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        for _ in range(100):
            try:
                self.get("/system")
                return self
            except OSError:
                time.sleep(0.2)
        raise RuntimeError("Orthanc does not answer")

    def get(self, path, data=None):
        with urllib.request.urlopen(urllib.request.Request(f"http://127.0.0.1:{self.web}{path}", data=data)) as answer:
            return answer.read()

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait()
        self.folder.cleanup()


def by_orthanc(source, made, warped):
    """Sent by DICOM where storescu is there, else by the server's own address; given back by that."""
    with Orthanc() as server:
        for file in source.iterdir():
            server.get("/instances", file.read_bytes())
        if shutil.which("storescu"):
            quietly("storescu", "127.0.0.1", server.dicom, "+sd", made)
        else:
            for file in made.iterdir():
                server.get("/instances", file.read_bytes())
        assert len(json.loads(server.get("/patients"))) == len(json.loads(server.get("/studies"))) == 1
        assert len(json.loads(server.get("/series"))) == 2
        back = {}
        for name in json.loads(server.get("/instances")):
            file = pydicom.dcmread(pydicom.filebase.DicomBytesIO(server.get(f"/instances/{name}/file")))
            back[file.SOPInstanceUID] = file.PixelData
        sent = [pydicom.dcmread(file) for file in made.iterdir()]
        assert all(back[s.SOPInstanceUID] == s.PixelData for s in sent)
        yield f"{len(sent)} slices given back with the same pixels, one patient, one study, two series"


def main(program, folder):
    quietly(program, "phantom", "--size", 48, "--spacing", 4, "--out", folder / "head")
    source = folder / "source"
    write_series(nibabel.load(folder / "head/t1.nii.gz"), source)
    quietly(program, "run", folder / "head/scene.xml", "--out", folder / "run", "--until", "register", "--set",
            "discretise.nodes=1500", "--set", f"image.t1={source}")
    quietly(program, "warp", folder / "run", source, "--out", folder)
    made = folder / "run/register/warped_dicom"
    for file in made.iterdir():  # the same image by the other way has the same names and bytes
        assert file.read_bytes() == (folder / "warped_source" / file.name).read_bytes(), file
    warped = nibabel.load(folder / "run/register/warped.nii.gz")
    failed = False
    for name, check, there in [("pydicom", by_pydicom, True), ("dciodvfy", by_dciodvfy, shutil.which("dciodvfy")),
                               ("Orthanc", by_orthanc, ORTHANC)]:
        if not there:
            print(f"{name:12} skipped: it is not installed")
            continue
        try:
            for what in check(source, made, warped):
                print(f"{name:12} {what}")
        except AssertionError as fault:
            failed = True
            print(f"{name:12} FAULT: {fault}")
    return 1 if failed else 0


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    with tempfile.TemporaryDirectory() as scratch:
        place = Path(sys.argv[2] if len(sys.argv) == 3 else scratch).resolve()
        place.mkdir(parents=True, exist_ok=True)
        sys.exit(main(Path(sys.argv[1]).resolve(), place))
