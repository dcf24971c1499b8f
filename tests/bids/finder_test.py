#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a BIDS folder holds and what it lacks."""
import pathlib
import sys
import unittest

sys.dont_write_bytecode = True
from folder import Folder  # noqa: E402
from cohort.finder import Finder  # noqa: E402

POINTS = "derivatives/plan/sub-01/anat/sub-01_desc-cortex_points.csv"
T1W, DSEG = "sub-01/anat/sub-01_T1w.nii.gz", "derivatives/plan/sub-01/anat/sub-01_dseg.nii.gz"
TABLE = "derivatives/plan/dseg.tsv"


class FinderTest(Folder):
    def find(self, participant="01", sessions=(), **options):
        folders = sorted((self.root / "derivatives").glob("*"))
        return Finder(self.root, folders, **options).cases(participant, sessions)

    def one(self, **options):
        cases, faults = self.find(**options)
        self.assertEqual(faults, {})
        self.assertEqual(len(cases), 1)
        return cases[0]

    def relative(self, file):
        return str(pathlib.Path(file).relative_to(self.root))

    def test_takes_the_label_map_with_the_inherited_table_and_the_load(self):
        self.make("sub-01/anat/sub-01_T1w.nii.gz", "sub-01/anat/sub-01_T2w.nii.gz", POINTS,
                  "derivatives/plan/sub-01/anat/sub-01_dseg.nii.gz", "derivatives/plan/dseg.tsv",
                  "derivatives/plan/desc-aseg_dseg.tsv")
        case = self.one()
        self.assertEqual(self.relative(case.t1), "sub-01/anat/sub-01_T1w.nii.gz")
        self.assertEqual(self.relative(case.labels), "derivatives/plan/sub-01/anat/sub-01_dseg.nii.gz")
        self.assertEqual(self.relative(case.labels_are), "derivatives/plan/dseg.tsv")
        self.assertEqual([self.relative(file) for file in case.points], [POINTS])

    def test_prefers_the_map_that_knows_the_ventricles_and_no_map_of_another_space(self):
        maps = [f"derivatives/fmriprep/sub-01/anat/sub-01_{name}dseg.nii.gz"
                for name in ("", "desc-aseg_", "desc-aparcaseg_", "space-MNI_desc-aparcaseg_")]
        self.make("sub-01/anat/sub-01_T1w.nii.gz", POINTS, *maps)
        self.assertEqual((self.relative(self.one().labels), self.one().labels_are), (maps[2], "freesurfer"))

    def test_takes_freesurfer_where_there_is_no_map_and_a_mask_where_there_is_neither(self):
        mask = "derivatives/plan/sub-01/anat/sub-01_desc-brain_mask.nii.gz"
        self.make("sub-01/anat/sub-01_T1w.nii.gz", POINTS, mask)
        self.assertEqual(self.relative(self.one().brain_mask), mask)
        self.make("derivatives/freesurfer/sub-01/mri/aseg.mgz", "derivatives/freesurfer/sub-01/mri/aparc+aseg.mgz")
        case = self.one()
        self.assertEqual(self.relative(case.labels), "derivatives/freesurfer/sub-01/mri/aparc+aseg.mgz")
        self.assertEqual((case.labels_are, case.brain_mask), ("freesurfer", ""))

    def test_takes_markups_before_and_after_and_the_map_of_the_tumour(self):
        stem = "derivatives/plan/sub-01/sub-01_desc-"
        tumour = "derivatives/plan/sub-01/anat/sub-01_label-tumor_mask.nii.gz"
        self.make(T1W, DSEG, TABLE, tumour,
                  stem + "before_points.mrk.json", stem + "after_points.mrk.json")
        case = self.one()
        self.assertEqual([self.relative(file) for file in case.points],
                         [stem + "before_points.mrk.json", stem + "after_points.mrk.json"])
        self.assertEqual(self.relative(case.tumour), tumour)
        (self.root / (stem + "after_points.mrk.json")).unlink()
        self.assertIn("half a load", self.find()[1]["sub-01"])

    def test_names_what_is_missing(self):
        self.make(POINTS)
        self.assertIn("no T1w image", self.find()[1]["sub-01"])
        self.make("sub-01/anat/sub-01_T1w.nii.gz")
        self.assertIn("no labels", self.find()[1]["sub-01"])
        self.make(DSEG)
        self.assertIn("no table of its numbers", self.find()[1]["sub-01"])
        self.make("derivatives/freesurfer/sub-01/mri/aseg.mgz")
        self.assertEqual(self.one().labels_are, "freesurfer")
        self.make(TABLE)
        (self.root / POINTS).unlink()
        self.assertIn("no load", self.find()[1]["sub-01"])

    def test_asks_which_of_two_images_and_takes_the_answer(self):
        images = [f"sub-01/anat/sub-01_acq-{name}_T1w.nii.gz" for name in ("flash", "mprage")]
        self.make(*images, POINTS, DSEG, TABLE)
        self.assertIn("--pick T1w:", self.find()[1]["sub-01"])
        self.assertEqual(self.relative(self.one(pick={"T1w": {"acq": "mprage"}}).t1), images[1])

    def test_an_empty_value_picks_the_file_without_the_entity(self):
        self.make(T1W, "sub-01/anat/sub-01_ce-gadolinium_T1w.nii.gz", DSEG, TABLE, POINTS)
        self.assertIn("--pick T1w", self.find()[1]["sub-01"])
        self.assertEqual(self.relative(self.one(pick={"T1w": {"ce": ""}}).t1), T1W)

    def test_which_brain_mask_says_nothing_of_the_tumours(self):
        stem = "derivatives/plan/sub-01/anat/sub-01_"
        tumour = stem + "label-tumor_mask.nii.gz"
        self.make(T1W, POINTS, tumour, *(stem + f"rec-{rec}_desc-brain_mask.nii.gz" for rec in "ab"))
        case = self.one(pick={"mask": {"rec": "a"}})
        self.assertEqual(self.relative(case.brain_mask), stem + "rec-a_desc-brain_mask.nii.gz")
        self.assertEqual(self.relative(case.tumour), tumour)
        self.make(stem + "acq-flair_label-tumor_mask.nii.gz")
        self.assertIn("would both do", self.find(pick={"mask": {"rec": "a"}})[1]["sub-01"])

    def test_says_that_a_link_has_no_content(self):
        self.make("sub-01/anat/x", POINTS)
        (self.root / "sub-01/anat/sub-01_T1w.nii.gz").symlink_to("gone")
        self.assertIn("datalad get", self.find()[1]["sub-01"])

    def test_takes_no_points_of_another_space(self):
        self.make(T1W, DSEG, TABLE, POINTS.replace("desc", "space-MNI152NLin2009cAsym_desc"))
        self.assertIn("no load", self.find()[1]["sub-01"])

    def test_names_a_file_that_lies_in_the_folder_of_another(self):
        self.make(T1W, DSEG, TABLE, POINTS.replace("sub-01_", "sub-02_"))
        self.assertIn("is by its name of sub-02", self.find()[1]["sub-01"])
        self.make("sub-03/ses-a/anat/sub-03_ses-b_T1w.nii.gz")
        self.assertIn("is by its name of ses-b", self.find("03")[1]["sub-03_ses-a"])

    def test_passes_over_folders_that_are_no_participants(self):
        self.make(T1W, "sub-01_old/anat/sub-01_T1w.nii.gz")
        finder = Finder(self.root, [])
        self.assertEqual((finder.participants(), finder.strays()), (["01"], [self.root / "sub-01_old"]))

    def test_sessions_that_are_asked_for_are_not_those_of_none(self):
        self.make(T1W, DSEG, TABLE, POINTS)
        self.assertEqual(self.find(sessions=("post",)), ([], {}))

    def test_knows_by_its_sidecar_that_an_image_is_stripped(self):
        self.make(T1W, DSEG, TABLE, POINTS)
        self.assertFalse(self.one().skull_stripped)
        self.make("sub-01/anat/sub-01_T1w.json", text='{"SkullStripped": true}')
        self.assertTrue(self.one().skull_stripped)

    def session(self, name, *kinds):
        files = {"T1w": f"sub-01/ses-{name}/anat/sub-01_ses-{name}_T1w.nii.gz",
                 "dseg": f"derivatives/plan/sub-01/ses-{name}/anat/sub-01_ses-{name}_dseg.nii.gz",
                 "points": f"derivatives/plan/sub-01/ses-{name}/sub-01_ses-{name}_desc-cortex_points.csv"}
        self.make(TABLE, *(files[kind] for kind in kinds))

    def test_each_session_has_its_own_files(self):
        self.session("a", "T1w", "dseg", "points")
        self.session("b", "T1w", "dseg")
        cases, faults = self.find()
        self.assertEqual([case.name for case in cases], ["sub-01_ses-a"])
        self.assertIn("no load", faults["sub-01_ses-b"])
        self.assertEqual(self.find(sessions=("a",))[1], {})

    def test_a_load_without_a_session_is_not_given_to_two(self):
        self.session("a", "T1w", "dseg")
        self.make(POINTS)
        self.assertEqual([case.name for case in self.find()[0]], ["sub-01_ses-a"])
        self.session("b", "T1w", "dseg")
        self.assertEqual(sorted(self.find()[1]), ["sub-01_ses-a", "sub-01_ses-b"])

    def test_labels_without_a_session_are_not_given_to_two_images(self):
        self.session("a", "T1w", "points")
        freesurfer, plain = "derivatives/freesurfer/sub-01/mri/aseg.mgz", "derivatives/plan/sub-01/sub-01_dseg.nii.gz"
        self.make(freesurfer)
        self.assertEqual(self.relative(self.one().labels), freesurfer)
        self.session("b", "T1w", "points")
        self.make(plain)
        for fault in self.find()[1].values():
            self.assertIn("no labels", fault)
        self.assertEqual([self.relative(case.labels) for case in self.find(preop_session="a")[0]], [plain])

    def test_an_image_without_a_session_has_the_labels_without_one(self):
        self.session("a", "points")
        self.session("b", "points")
        self.make("sub-01/anat/sub-01_T1w.nii.gz", "derivatives/freesurfer/sub-01/mri/aseg.mgz")
        self.assertEqual([case.labels_are for case in self.find()[0]], ["freesurfer", "freesurfer"])

    def test_the_image_may_be_of_another_session_than_the_load(self):
        self.session("preop", "T1w", "dseg")
        self.session("intraop", "points")
        case = self.one(preop_session="preop")
        self.assertEqual((case.name, self.relative(case.t1)),
                         ("sub-01_ses-intraop", "sub-01/ses-preop/anat/sub-01_ses-preop_T1w.nii.gz"))


if __name__ == "__main__":
    unittest.main()
