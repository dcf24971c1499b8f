# SPDX-License-Identifier: GPL-3.0-or-later
"""The command-line module, called by a stand-in of 3D Slicer.  python3 module_test.py PROGRAM MODULE [Class]"""
import json
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from heads import make_head
from stand_in import Module

OUTPUTS = ("warped", "warpedlabels", "transform", "brain", "displacement", "error")
BEGINNINGS = {"transform": b"\x89HDF", "brain": b"<?xml"}


def setUpModule():
    global folder, scratch, head, module
    keep = tempfile.TemporaryDirectory()
    unittest.addModuleCleanup(keep.cleanup)
    folder = Path(keep.name)
    scratch = folder / "tmp"
    libraries = folder / "slicer_libraries"
    for made in (scratch, libraries):
        made.mkdir()
    # Slicer's libraries, which must not come under the program: of these it would not even start.
    for name in ("libvtkCommonCore-9.1.so.1", "libhdf5_serial.so.103", "libtinyxml2.so.9"):
        (libraries / name).touch()
    head = make_head(program, folder)
    module = Module(module_path, {"LD_LIBRARY_PATH": str(libraries), "TMPDIR": str(scratch)})


def call(**options):
    return module.start({**head, **{name: True for name in OUTPUTS}, "preset": "fast", **options})


def abandoned():
    return sorted(scratch.glob("brainshift_scratch_*"))


class Whole(unittest.TestCase):
    def test_loads_every_output_of_a_run(self):
        done = call(run=folder / "run").follow()
        self.assertEqual((done.process.returncode, done.errors()), (0, ""), done.output)
        loaded, returned = done.loaded()
        self.assertEqual(set(loaded), set(OUTPUTS))
        for name, data in loaded.items():
            self.assertTrue(data.startswith(BEGINNINGS.get(name, b"\x1f\x8b")), name)
        self.assertIn(b'Name="displacement_mm"', loaded["brain"])
        record = json.loads((folder / "run" / "run.json").read_text())
        measures = record["stages"]["solve"]["measures"]
        self.assertEqual(float(returned["largest_displacement_mm"]), measures["largest_displacement_mm"])
        self.assertEqual(float(returned["estimated_error_95_mm"]), measures["estimated_error_95_mm"])
        self.assertIn("the brain has 73 ml", returned["warning"])
        self.assertEqual(loaded["warped"], (folder / "run" / "register" / "warped.nii.gz").read_bytes())
        self.assertIn("by the names of its segments", done.output)

        fractions = [float(text) for text in done.progress]
        self.assertEqual(fractions, sorted(fractions))
        self.assertEqual((fractions[0], fractions[-1]), (0, 1))
        self.assertGreater(len(fractions), 10)
        stages = ["segment", "discretise", "solve", "register", "report"]
        self.assertEqual(list(dict.fromkeys(done.names)), stages)
        self.assertEqual(abandoned(), [])


class Stopped(unittest.TestCase):
    def test_loads_what_there_is_of_a_run_that_does_not_converge(self):
        kept = folder / "run of before"
        call(run=kept).follow()
        self.assertTrue((kept / "register" / "estimated_error.nii.gz").exists())
        done = call(max_steps=20, run=kept).follow()
        self.assertEqual(done.process.returncode, 0, done.errors())
        loaded, returned = done.loaded()
        self.assertEqual(set(loaded), set(OUTPUTS) - {"error"})
        self.assertIn("no --error", done.errors())
        self.assertIn("20 steps", returned["warning"])
        self.assertIn(returned["warning"].split(";")[0], done.errors())
        self.assertEqual(abandoned(), [])

    def test_a_kill_leaves_nothing_half_written_and_the_next_call_clears_up(self):
        killed = call().follow(until="solve")
        killed.cancel()
        written = {file.name for file in killed.scratch.iterdir()}
        self.assertEqual(written, {file.name for file in head.values()} | {"stderr"})
        self.assertEqual(killed.loaded(), ({}, {}))
        self.assertEqual(len(abandoned()), 1)
        asked = call().follow(until="segment")
        asked.cancel(signal.SIGTERM)
        self.assertEqual(asked.process.returncode, 128 + signal.SIGTERM)
        self.assertEqual(abandoned(), [])

    def test_two_calls_leave_each_other_alone(self):
        first = call().follow(until="segment")
        second = call().follow(until="segment")
        self.assertEqual(len(abandoned()), 2)
        for running in (first, second):
            running.cancel(signal.SIGTERM)
        self.assertEqual(abandoned(), [])


class Refused(unittest.TestCase):
    def refusal(self, chosen):
        done = module.start(chosen).follow()
        self.assertEqual(done.process.returncode, 2)
        self.assertEqual(done.errors().count("\n"), 1)
        return done.errors()

    def test_a_missing_input_is_named(self):
        for name in ("before", "after"):
            self.assertIn(f"points {name}", self.refusal({n: f for n, f in head.items() if n != name}))
        self.assertIn("--labels", self.refusal({n: f for n, f in head.items() if n != "labels"}))

    def test_a_value_that_is_not_allowed_is_told(self):
        self.assertIn("noise is 'much'", self.refusal({**head, "noise": "much"}))
        self.assertIn("edge_length is '0.1'", self.refusal({**head, "edge_length": 0.1}))

    def test_an_output_that_cannot_be_written_is_told_before_the_run(self):
        begun = time.monotonic()
        for words, said in ((["--warped", folder / "none" / "w.nii.gz"], f"no folder {folder / 'none'}"),
                            (["--displacement", ""], "--displacement is empty"),
                            (["--warped", head["t1"]], "must end in .nii.gz"),
                            (["--returnparameterfile", head["t1"]], "is --t1, too")):
            inputs = [word for name, file in head.items() for word in ("--" + name, file)]
            done = subprocess.run([program, "slicer", *inputs, *words], capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1))
            self.assertIn(said, done.stderr)
            self.assertNotIn("<filter-start>", done.stdout)
        self.assertLess(time.monotonic() - begun, 20)


if __name__ == "__main__":
    program, module_path = (Path(word).resolve() for word in sys.argv[1:3])
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
