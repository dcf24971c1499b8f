#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The Python module on a small phantom: the program's numbers, frames, memory, faults, interruption.

  PYTHONPATH=BUILD/python python3 module_test.py [Class]     exit 77 where nibabel is missing
"""
import os
import signal
import subprocess
import sys
import tempfile
import textwrap
import threading
import time
import unittest
from pathlib import Path

try:
    import nibabel
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

import brainshift

OBLIQUE = nibabel.affines.from_matvec(
    nibabel.eulerangles.euler2mat(0.3, -0.2, 0.5) @ np.diag([-1.2, 1.5, 2.0]), [10, -20, 30])  # left-handed, too


class WithFolder(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)


class Frames(WithFolder):
    """nibabel places voxels in RAS, ITK, which reads our files, in LPS."""

    def image(self, dtype):
        values = np.random.default_rng(1).integers(0, 200, (7, 6, 5)).astype(dtype)
        image = nibabel.Nifti1Image(values, OBLIQUE)
        nibabel.save(image, self.folder / "image.nii.gz")
        return nibabel.load(self.folder / "image.nii.gz")

    def test_an_image_of_nibabel_is_the_one_that_itk_reads(self):
        ours, itk = brainshift.from_nibabel(self.image(np.float32)), brainshift.read_image(self.folder / "image.nii.gz")
        np.testing.assert_allclose(ours.affine, itk.affine, atol=1e-5)
        np.testing.assert_array_equal(ours.voxels, itk.voxels)

    def test_a_voxel_lies_where_nibabel_says_with_x_and_y_turned(self):
        image = self.image(np.int16)
        ours = brainshift.from_nibabel(image, labels=True)
        ras = nibabel.affines.apply_affine(image.affine, [1, 2, 3])
        np.testing.assert_allclose(brainshift.flip_ras_lps((ours.affine @ [1, 2, 3, 1])[:3]), ras, atol=1e-6)

    def test_there_and_back_keeps_place_and_values(self):
        image = self.image(np.float32)
        back = brainshift.to_nibabel(brainshift.from_nibabel(image))
        np.testing.assert_allclose(back.affine, image.affine, atol=1e-6)
        np.testing.assert_array_equal(back.get_fdata(), image.get_fdata())

    def test_a_field_is_written_as_itk_reads_it(self):
        u = np.random.default_rng(2).normal(size=(4, 5, 6, 3)).astype(np.float32)
        nibabel.save(brainshift.to_nibabel(brainshift.VectorImage(u, OBLIQUE)), self.folder / "u.nii.gz")
        read = brainshift.read_field(self.folder / "u.nii.gz")
        np.testing.assert_array_equal(read.voxels, u)
        np.testing.assert_allclose(read.affine, OBLIQUE, atol=1e-5)

    def test_scaled_values_and_the_scanners_slope(self):
        values = np.arange(60, dtype=np.int16).reshape(3, 4, 5)
        image = nibabel.Nifti1Image(values, OBLIQUE)
        image.header.set_slope_inter(0.5, 3)
        nibabel.save(image, self.folder / "scaled.nii")
        ours = brainshift.from_nibabel(nibabel.load(self.folder / "scaled.nii"))
        np.testing.assert_allclose(ours.voxels, nibabel.load(self.folder / "scaled.nii").get_fdata())


class NumPy(unittest.TestCase):
    @unittest.skipIf(brainshift._core.knows_numpy_2, "the module was built with pybind11 2.12 or later")
    def test_of_another_layout_is_refused(self):
        claims = "import numpy; numpy.__version__ = '2.0.1'; import brainshift"
        ended = subprocess.run([sys.executable, "-c", claims], capture_output=True, text=True, check=False)
        self.assertIn("ImportError: brainshift was built with a pybind11 older than 2.12", ended.stderr)


class Memory(unittest.TestCase):
    def test_arrays_are_views_and_outlive_their_owner(self):
        image = brainshift.ScalarImage(np.zeros((3, 4, 5)), np.eye(4))
        view = image.voxels
        view[1, 2, 3] = 7
        self.assertEqual(image.voxels[1, 2, 3], 7)
        self.assertTrue(np.shares_memory(view, image.voxels))
        self.assertTrue(np.shares_memory(np.asanyarray(brainshift.to_nibabel(image).dataobj), view))
        del image
        self.assertEqual(view[1, 2, 3], 7)

    def test_any_order_and_type_of_numbers_comes_in(self):
        values = np.arange(24.0).reshape(2, 3, 4)
        for given in (values, np.asfortranarray(values), values[::-1][::-1], values.astype(">i4")):
            np.testing.assert_array_equal(brainshift.LabelMap(given, np.eye(4)).voxels, values)


class Faults(WithFolder):
    def refused(self, words, kind, call, *arguments, **named):
        with self.assertRaises(kind) as caught:
            call(*arguments, **named)
        self.assertIn(words, str(caught.exception))

    def test_the_inputs_fault_is_a_value_error_with_the_programs_sentence(self):
        eye, ones = np.eye(4), np.ones((4, 4, 4))
        sheared = eye + np.eye(4, k=1) * [[1], [0], [0], [0]]
        self.refused("right angles", ValueError, brainshift.ScalarImage, ones, sheared)
        self.refused("0 0 0 1", ValueError, brainshift.ScalarImage, ones, eye + np.eye(4, k=-1) * [[0], [0], [0], [5]])
        self.refused("complex", ValueError, brainshift.ScalarImage, ones * 1j, eye)
        self.refused("from 1 on", ValueError, brainshift.set_threads, -3)
        self.refused("whole numbers", ValueError, brainshift.LabelMap, ones * 1.5, eye)
        self.refused("whole numbers", ValueError, brainshift.LabelMap, -ones, eye)
        self.refused("not finite", ValueError, brainshift.ScalarImage, ones * np.nan, eye)
        self.refused("three dimensions", ValueError, brainshift.ScalarImage, np.ones((4, 4)), eye)
        self.refused("no row of vertices", ValueError, brainshift.Surface, np.eye(3), [[0, 1, 3]])
        for corner in (1.7, 2**32 + 1):
            self.refused("whole numbers", ValueError, brainshift.Surface, np.eye(3), np.array([[0, corner, 2]]))
        self.refused("as many rows", ValueError, brainshift.Load, np.ones((3, 3)), np.ones((2, 3)))
        self.refused("label 2 counts as brain", ValueError, brainshift.segment, brainshift.LabelMap(ones, eye))
        self.refused("no-scene.xml", ValueError, brainshift.run, self.folder / "no-scene.xml", self.folder / "out")
        self.refused("edge_length is '0'", ValueError, brainshift.segment, brainshift.LabelMap(ones, eye), edge_length=0)
        self.refused("there is no option 'edge'; there are: edge_length", TypeError, brainshift.segment,
                     brainshift.LabelMap(ones, eye), edge=3)

    def test_a_disk_that_takes_nothing_is_a_runtime_error(self):
        image = brainshift.ScalarImage(np.ones((3, 3, 3)), np.eye(4))
        self.refused("could not be written", RuntimeError, brainshift.write_image, self.folder / "none/x.nii", image)


class Chain(WithFolder):
    """A phantom of 48 voxels."""

    def setUp(self):
        super().setUp()
        self.head = self.folder / "head"
        brainshift.write_phantom(self.head, size=48, spacing=4)

    def test_the_stages_in_memory_are_the_run_of_the_program(self):
        run = self.folder / "run"
        record = brainshift.run(self.head / "scene.xml", run, until="register", set={
            "segment.edge_length": 9, "discretise.nodes": 1000, "discretise.tissue_boundary_factor": 1,
            "discretise.craniotomy_factor": 1})
        t1 = brainshift.read_image(self.head / "t1.nii.gz")  # as the program reads them: the last bits count
        labels = brainshift.read_label_map(self.head / "labels.nii.gz")
        head = brainshift.segment(labels, edge_length=9)
        body = brainshift.discretise(head.brain, labels, nodes=1000)
        load = brainshift.read_load(self.head / "craniotomy.csv")
        materials = {1: "brain", 2: "ventricle", 3: "tumour"}
        with self.assertRaisesRegex(TypeError, "key 1.0; a whole number"):
            brainshift.solve(body, {1.0: "brain"}, load, labels, head.skull, head.brain)
        moved = brainshift.solve(body, materials, load, labels, head.skull, head.brain)
        warped = brainshift.register(moved, head.brain, t1, labels)
        self.assertEqual(len(body.nodes), record["stages"]["solve"]["sizes"]["nodes"])
        np.testing.assert_array_equal(warped.forward.voxels,
                                      brainshift.read_field(run / "register/preop_to_intraop.nii.gz").voxels)
        np.testing.assert_array_equal(warped.warped_labels.voxels,
                                      brainshift.read_label_map(run / "register/warped_labels.nii.gz").voxels)
        self.assertEqual(body.cells.shape, (len(body.inside_fraction), 8))
        self.assertEqual(len(moved.estimated_error), len(body.nodes))
        again = brainshift.warp(t1, warped.resampling)
        np.testing.assert_array_equal(again.voxels, warped.warped.voxels)
        there = brainshift.warp_points(warped.forward, load.positions)
        self.assertLess(np.abs(there - load.positions - load.displacement).max(), 0.5)

    def test_a_study_of_materials_is_each_of_them_alone(self):
        labels = brainshift.read_label_map(self.head / "labels.nii.gz")
        head = brainshift.segment(labels, edge_length=9)
        body = brainshift.discretise(head.brain, labels, nodes=600)
        load = brainshift.read_load(self.head / "craniotomy.csv")
        usual = {1: "brain", 2: "ventricle", 3: "tumour"}
        study = [usual, {**usual, 1: {"youngs_modulus": 1500, "poisson_ratio": 0.45}}]
        moved = brainshift.solve_each(body, study, load, labels, head.skull, head.brain, precision="double")
        for displacement, materials in zip(moved, study):
            alone = brainshift.solve(body, materials, load, labels, head.skull, head.brain, precision="double")
            np.testing.assert_allclose(displacement, alone.displacement, rtol=0, atol=1e-7)
        self.assertGreater(np.abs(moved[0] - moved[1]).max(), 0.01)
        with self.assertRaisesRegex(ValueError, "constants 1 have no material for label 3"):
            brainshift.solve_each(body, [usual, {1: "brain", 2: "ventricle"}], load, labels)

    def test_files_are_taken_along(self):
        run = self.folder / "run"
        brainshift.run(self.head / "scene.xml", run, until="register",
                       set={"segment.edge_length": 9, "discretise.nodes": 600})
        said = brainshift.warp_files(run, [self.head / "landmarks.mrk.json"], self.folder / "moved")
        self.assertIn("points, moved by up to", said[0])
        self.assertTrue((self.folder / "moved/warped_landmarks.mrk.json").exists())

    def test_what_the_program_warns_of_is_a_warning(self):
        labels = brainshift.read_label_map(self.head / "labels.nii.gz")
        head = brainshift.segment(labels, edge_length=9)
        body = brainshift.discretise(head.brain, labels, nodes=600)
        load = brainshift.read_load(self.head / "craniotomy.csv")
        twice = [np.concatenate([rows, rows[:1] + by]) for rows, by in
                 ((load.positions, [[0.1, 0, 0]]), (load.displacement, [[0, 30, 0]]))]
        wrong = brainshift.Load(*twice, np.full_like(twice[0], 0.5))
        with self.assertWarnsRegex(UserWarning, "standard deviations from what the other points say"):
            brainshift.solve(body, {1: "brain", 2: "ventricle", 3: "tumour"}, wrong, labels, head.skull, head.brain)
        few = brainshift.Load(load.positions[:3], load.displacement[:3])
        with self.assertWarnsRegex(UserWarning, "measured at 3 places"):
            brainshift.solve_each(body, [{1: "brain", 2: "ventricle", 3: "tumour"}], few, labels, head.skull)

    def test_what_does_not_converge_is_told_with_what_there_is(self):
        with self.assertRaises(brainshift.NotConverged) as caught:
            brainshift.run(self.head / "scene.xml", self.folder / "run", until="solve",
                           set={"segment.edge_length": 9, "discretise.nodes": 600, "solve.max_steps": 40,
                                "solve.start": "rest"})
        self.assertIn("not converged after 40 steps", str(caught.exception))
        self.assertIn("solve", caught.exception.result["stages"])

    def test_other_threads_run_while_it_computes_and_it_tells_how_far_it_is(self):
        counted, told, done = [0], [], threading.Event()

        def count():
            while not done.is_set():
                counted[0] += 1
                time.sleep(0.001)

        other = threading.Thread(target=count)
        other.start()
        brainshift.segment(brainshift.read_label_map(self.head / "labels.nii.gz"),
                           progress=lambda fraction, what: told.append(fraction))
        done.set()
        other.join()
        self.assertGreater(counted[0], 10)
        self.assertEqual((told[0], told[-1]), (0, 1))

    def test_a_fault_of_the_listener_ends_the_call(self):
        def listener(fraction, what):
            raise KeyError("mine")

        with self.assertRaises(KeyError):
            brainshift.segment(brainshift.read_label_map(self.head / "labels.nii.gz"), progress=listener)

    def test_control_c_ends_a_run_and_leaves_nothing_half_written(self):
        script = textwrap.dedent(f"""
            import brainshift
            brainshift.run({str(self.head / "scene.xml")!r}, {str(self.folder / "run")!r},
                           set={{"discretise.nodes": 12000, "solve.start": "rest", "solve.tolerance": 1e-6}},
                           progress=lambda fraction, what: print(what, flush=True))
            """)
        child = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        for line in child.stdout:
            if line.startswith("solve: step"):
                break
        pressed = time.monotonic()
        child.send_signal(signal.SIGINT)
        _, said = child.communicate(timeout=120)
        self.assertIn("KeyboardInterrupt", said)
        self.assertLess(time.monotonic() - pressed, 20)
        left = [str(path) for path in (self.folder / "run").rglob("*") if path.name.endswith((".partial", ".old"))]
        self.assertEqual(left, [])
        self.assertFalse((self.folder / "run/solve").exists())
        self.assertTrue((self.folder / "run/discretise/nodes.vtu").exists())


if __name__ == "__main__":
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    unittest.main()
