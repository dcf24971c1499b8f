#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""brainshift-bids and brainshift-sweep as their users run them, on three phantoms.

  app_test.py PROGRAM     ends with 77 where Snakemake is not installed
"""
import array
import csv
import gzip
import html
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
import make_cohort  # noqa: E402

APP = pathlib.Path(__file__).resolve().parents[2] / "pipelines/bids"
PROGRAM = os.path.abspath(sys.argv.pop(1))
FAST = ("--set", "discretise.nodes=200", "--set", "segment.edge_length=12", "--quiet", "--brainshift", PROGRAM)
NOT_ALL, UNUSABLE, NO_SNAKEMAKE = 4, 2, 77


def call(tool, *words):
    return subprocess.run([APP / tool, *map(str, words)], capture_output=True, text=True, check=False)


def tumour_map(labels):
    """Of a phantom's labels, which are of 16 bits, those of the tumour as 1."""
    plain = gzip.decompress(labels.read_bytes())
    voxels = array.array("h", plain[352:])
    return gzip.compress(plain[:352] + array.array("h", [int(label == 3) for label in voxels]).tobytes())


class AppTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.root = pathlib.Path(temporary.name)
        cls.bids, cls.out = cls.root / "bids", cls.root / "out"
        make_cohort.main(PROGRAM, str(cls.bids), 3, 1)
        cls.first = call("brainshift-bids", cls.bids, cls.out, "participant", *FAST)

    def inode(self, name, stage):
        return (self.out / "work" / name / "run" / stage / "stage.json").stat().st_ino

    def test_the_broken_participant_is_named_and_the_others_are_done(self):
        self.assertEqual(self.first.returncode, NOT_ALL, self.first.stderr)
        self.assertEqual(self.first.stdout,
                         f"2 of 3 done, 2 of them with warnings: see {self.out / 'group_measures.tsv'}\n")
        self.assertIn("sub-00003: no T1w image", self.first.stderr)
        self.assertIn("no T1w image", (self.out / "sub-00003.html").read_text())
        page = (self.out / "group.html").read_text()
        self.assertLess(page.index("sub-00003"), page.index("sub-00001"))
        record = json.loads((self.out / "work/sub-00001/run/run.json").read_text())
        notes = [note for stage in record["stages"].values() for note in stage.get("notes", [])]
        warnings = [note for note in notes if note.startswith("warning: ")]
        self.assertIn(html.escape(warnings[0].removeprefix("warning: ")), page)
        with open(self.out / "group_measures.tsv", newline="", encoding="utf-8") as stream:
            table = list(csv.DictReader(stream, delimiter="\t"))
        self.assertEqual([row["status"] for row in table], ["done", "done", "no result"])
        self.assertEqual((table[0]["warnings"], "warning: " + table[0]["first_warning"]),
                         (str(len(warnings)), warnings[0]))

    def test_derivatives_have_the_names_of_bids_and_the_bytes_of_a_single_run(self):
        stem = str(self.out / "sub-00001/anat/sub-00001_")
        single = self.root / "single"
        subprocess.run([PROGRAM, "--quiet", "run", self.out / "work/sub-00001/scene.xml", "--out", single, *FAST[:4]],
                       check=True)
        for ending, made in (("space-intraop_desc-brainshift_T1w.nii.gz", "warped.nii.gz"),
                             ("space-intraop_dseg.nii.gz", "warped_labels.nii.gz"),
                             ("from-preop_to-intraop_mode-image_xfm.h5", "from-preop_to-intraop_mode-image_xfm.h5"),
                             ("from-preop_to-intraop_mode-points_xfm.h5", "from-preop_to-intraop_mode-points_xfm.h5"),
                             ("desc-jacobian_map.nii.gz", "jacobian.nii.gz")):
            derivative = pathlib.Path(stem + ending)
            self.assertEqual(derivative.read_bytes(), (single / "register" / made).read_bytes(), ending)
        self.assertIn("3\ttumour\n", pathlib.Path(stem + "space-intraop_dseg.tsv").read_text())
        about = json.loads((self.out / "dataset_description.json").read_text())
        self.assertEqual((about["DatasetType"], about["DatasetLinks"]), ("derivative", {"raw": self.bids.as_uri()}))
        sources = json.loads(pathlib.Path(stem + "space-intraop_dseg.json").read_text())["Sources"]
        self.assertEqual(sources[0], "bids:raw:sub-00001/anat/sub-00001_T1w.nii.gz")
        self.assertIn("bids:raw:derivatives/planning/sub-00001/anat/sub-00001_dseg.nii.gz", sources)

    def test_the_same_command_makes_again_what_changed_and_nothing_else(self):
        load = self.bids / "derivatives/planning/sub-00001/anat/sub-00001_desc-cortex_points.csv"
        load.write_text(make_cohort.scaled(load.read_text(), 0.9))
        os.utime(load, (1, 1))  # older than everything, as a copy that keeps times
        (self.out / "sub-00002/anat/sub-00002_desc-jacobian_map.nii.gz").unlink()
        stages = (("sub-00001", "segment"), ("sub-00001", "solve"), ("sub-00002", "solve"))
        before = [self.inode(*stage) for stage in stages]
        again = call("brainshift-bids", self.bids, self.out, "participant", "--participant-label", "sub-00001", "00002",
                     *FAST)
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual(again.stdout, f"2 of 2 done, 2 of them with warnings: see the pages in {self.out}\n")
        after = [self.inode(*stage) for stage in stages]
        self.assertEqual([one == other for one, other in zip(before, after)], [True, False, True])
        self.assertTrue((self.out / "sub-00002/anat/sub-00002_desc-jacobian_map.nii.gz").exists())

    def test_the_group_names_the_file_that_is_gone_since_a_run(self):
        extra, out = self.root / "extra", self.root / "with_tumour"
        tumour = extra / "sub-00002/anat/sub-00002_label-tumor_mask.nii.gz"
        tumour.parent.mkdir(parents=True)
        planning = self.bids / "derivatives/planning"
        tumour.write_bytes(tumour_map(planning / "sub-00002/anat/sub-00002_dseg.nii.gz"))
        landmarks = self.root / "landmarks.mrk.json"  # of an option: it is no participant's, and none misses it
        point = {"label": "tumour", "position": [9.6, 7.9, 54.9]}
        landmarks.write_text(json.dumps({"markups": [{"coordinateSystem": "LPS", "controlPoints": [point]}]}))
        folders = ("--derivatives", planning, extra)
        done = call("brainshift-bids", self.bids, out, "participant", "--participant-label", "00002", "--one-job",
                    *folders, *FAST, "--set", f"landmarks.file={landmarks}")
        self.assertEqual(done.returncode, 0, done.stderr)
        record = json.loads((out / "work/sub-00002/run/run.json").read_text())
        self.assertLessEqual({"image.tumour", "landmarks.file"}, {given["role"] for given in record["inputs"]})
        group = ("brainshift-bids", self.bids, out, "group", "--one-job", *folders, "--brainshift", PROGRAM)
        self.assertNotIn("sub-00002:", call(*group).stderr)
        tumour.unlink()
        self.assertIn(f"sub-00002: it was computed with {tumour}, which is no longer", call(*group).stderr)
        made = {file: file.read_bytes() for file in [out / "sub-00002.html", *out.glob("sub-00002/anat/*")]}
        self.assertGreater(len(made), 9)
        for elsewhere in (("-w", self.root / "another_work"), ("--derivatives", extra)):  # knows of no run, of no labels
            self.assertIn("an earlier run are left", call(*group, *elsewhere).stderr)
            self.assertEqual(made, {file: file.read_bytes() for file in made})

    def test_a_sweep_with_another_program_in_a_stage(self):
        command = f"{PROGRAM} -q discretise --surface {{in}}/segment/brain.vtp --labels {{in}}/segment/labels.nii.gz " \
                  "--nodes 150 --out {out}"
        scene = self.out / "work/sub-00002/scene.xml"
        table = self.root / "sweep.tsv"
        table.write_text(f"scene\ttissues.1.youngs_modulus\n{scene}\t2000\n{scene}\t-5\n")
        done = call("brainshift-sweep", table, self.root / "sweep", "--one-job", *FAST, "--set",
                    f"discretise.command={command}")
        self.assertEqual(done.returncode, NOT_ALL, done.stderr)
        self.assertIn("2: --set: tissues.1 youngs_modulus is '-5'", done.stderr)
        self.assertEqual(done.stdout,
                         f"1 of 2 done, 1 of them with warnings: see {self.root / 'sweep/measures.tsv'}\n")
        rows = [line.split("\t") for line in (self.root / "sweep/measures.tsv").read_text().splitlines()]
        row = dict(zip(rows[0], rows[1]))
        self.assertEqual((row["tissues.1.youngs_modulus"], row["status"]), ("2000", "done"))
        self.assertGreater(int(row["warnings"]), 0)
        self.assertNotEqual(row["first_warning"], "n/a")
        self.assertLess(float(row["largest_shift_mm"]), 20)
        self.assertTrue((self.root / "sweep" / "work" / "1/run/discretise/command.log").exists())

    def test_samples_that_jobs_of_their_own_solved_are_those_of_one_run(self):
        scene, single = self.out / "work/sub-00001/scene.xml", self.root / "with_samples"
        uncertain = ("--set", "uncertainty.samples=3")
        subprocess.run([PROGRAM, "--quiet", "run", scene, "--out", single, "--until", "solve", *FAST[:4], *uncertain],
                       check=True)
        table, out = self.root / "samples.tsv", self.root / "shared"
        table.write_text(f"scene\n{scene}\n")
        done = call("brainshift-sweep", table, out, "--share-samples", "2", *FAST, *uncertain)
        self.assertEqual(done.returncode, 0, done.stderr)
        case = out / "work/1"
        begin = float((case / "marks/solve").read_text().split()[0])
        samples = list((case / "run/samples").iterdir())
        self.assertEqual(len(samples), 4, "three, and the model itself")
        self.assertLess(max(file.stat().st_mtime for file in samples), begin)
        for file in ("uncertainty.vtu", "samples.csv"):
            self.assertEqual((case / "run/solve" / file).read_bytes(), (single / "solve" / file).read_bytes(), file)
        self.assertFalse((case / "shares").exists())

    def test_a_dry_run_names_the_rules_and_runs_none(self):
        dry = call("brainshift-bids", self.bids, self.root / "dry", "participant", "--dry-run", *FAST)
        self.assertIn("rule solve:", dry.stdout)
        self.assertEqual(list((self.root / "dry").glob("work/*/run")), [])

    def test_what_cannot_be_run_is_said_in_a_sentence(self):
        for words, said in (((self.root / "none", self.out, "group"), "there is no such folder"),
                            ((self.bids, self.out, "group", "--participant-label", "77"), "no participant sub-77"),
                            ((self.bids, self.out, "group", "--participant-label", "00001"), "level group is of all"),
                            ((self.bids, self.out, "group", "--pick", "T1w"), "SUFFIX:ENTITY-VALUE is wanted"),
                            ((self.bids, self.out, "group", "--brainshift", "/none"), "there is no program /none")):
            done = call("brainshift-bids", *words)
            self.assertEqual(done.returncode, UNUSABLE)
            self.assertIn(said, done.stderr)
            self.assertEqual(len(done.stderr.splitlines()), 1)
        self.assertIn("cannot be read", call("brainshift-sweep", self.bad_table(), self.out, *FAST).stderr)

    def bad_table(self):
        table = self.root / "bad.csv"
        table.write_text("scene,solve.tolerance\nnone.xml,0.1\n")
        return table


if __name__ == "__main__":
    if not shutil.which("snakemake"):
        print("Snakemake is not installed")
        sys.exit(NO_SNAKEMAKE)
    unittest.main()
