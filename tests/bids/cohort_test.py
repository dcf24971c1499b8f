#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The plan, marks and limits; files and names; the table and which rows lie far from the others."""
import csv
import hashlib
import json
import os
import pathlib
import sys
import unittest
from unittest import mock

sys.dont_write_bytecode = True
from folder import Folder  # noqa: E402
from cohort import dataset, derivatives, files, group, limits, marks, measures, names, pages, plan, program  # noqa: E402


class DatasetTest(Folder):
    def test_another_dataset_keeps_its_description(self):
        with self.assertRaisesRegex(program.Unusable, "folder of the images"):
            dataset.refuse_others(self.root, self.root)
        out = self.root / "out"
        dataset.refuse_others(out, self.root)
        dataset.write(out, {}, "brainshift 1.0")
        dataset.refuse_others(out, self.root)
        for text in ('{"GeneratedBy": [{"Name": "fMRIPrep"}]}', '{"Name": "raw"}', "[]", "no JSON"):
            (out / "dataset_description.json").write_text(text)
            with self.assertRaisesRegex(program.Unusable, "another dataset"):
                dataset.refuse_others(out, self.root)


class PlanTest(Folder):
    def test_a_case_is_newer_only_where_something_changed(self):
        self.make("t1.nii.gz", text="one")
        case = plan.Case("sub-01", "", ["--t1", "a b"], ["discretise.nodes=300"], [str(self.root / "t1.nii.gz")])
        plan.write_case(self.root, case, "1.0")
        file = self.root / "sub-01/case.sh"
        first = file.stat().st_ino
        plan.write_case(self.root, case, "1.0")
        self.assertEqual(file.stat().st_ino, first)
        self.make("t1.nii.gz", text="another")
        plan.write_case(self.root, case, "1.0")
        self.assertNotEqual(file.stat().st_ino, first)
        self.assertIn("files=(--t1 'a b')", file.read_text())

    def why_outdated(self, case_files, used):
        """The scene names t1, tumour and load; used: of the run, what each file held."""
        names = {name: self.root / name for name in {"t1", "tumour", "load", *case_files, *used}}
        scene = self.root / "scene.xml"
        scene.write_text(f'<scene><image t1="{names["t1"]}" tumour="{names["tumour"]}" smooth="1"/>'
                         f'<load file="{names["load"]}"/></scene>')
        record = {"inputs": [{"path": str(names[name]), "sha256": hashlib.sha256(held.encode()).hexdigest()}
                             for name, held in used.items()]}
        case = plan.Case("sub-01", "", [], [], [str(names[name]) for name in case_files])
        return plan.why_outdated(record, case, scene)

    def test_a_run_is_outdated_where_a_file_holds_something_else_or_is_new(self):
        used = {"t1": "one", "tumour": "two", "load": "three"}
        for name, held in used.items():
            self.make(name, text=held)
        self.assertEqual(self.why_outdated(list(used), used), "")
        self.make("cuts", text="four")
        self.assertIn("have changed", self.why_outdated([*used, "cuts"], used))
        self.make("t1", text="another")
        self.assertIn("its files have changed", self.why_outdated(list(used), used))

    def test_a_run_is_outdated_where_a_file_is_gone_and_the_file_is_named(self):
        used = {"t1": "one", "tumour": "two", "load": "three"}
        self.make("t1", text="one")
        self.make("load", text="three")
        self.assertIn(f"it was computed with {self.root / 'tumour'}, which", self.why_outdated(["t1", "load"], used))
        self.make("renamed", text="two")
        self.assertEqual(self.why_outdated(["t1", "load", "renamed"], used), "", "by another name, of the same content")

    def test_a_run_with_files_of_options_is_not_outdated(self):
        self.make("t1", text="one")
        self.make("load", text="three")
        self.make("tumour", text="the participant's own, which an option replaced")
        used = {"t1": "one", "load": "three", "given": "two", "landmarks": "four"}
        self.assertEqual(self.why_outdated(["t1", "tumour", "load"], used), "")
        self.assertEqual(self.why_outdated(["t1", "load"], used), "", "nobody used what is gone")

    def test_a_file_that_an_option_names_counts_as_the_scenes_own(self):
        self.make("load.csv", "t1/slice.dcm", "discretise/nodes.vtu", text="one")
        (self.root / "scene.xml").write_text('<scene><image t1="t1"/><stage name="discretise" command="x"/></scene>')
        scene = self.root / "scene.xml"
        self.assertEqual(plan.scene_inputs(scene), [str(scene), str(self.root / "t1")])
        options = ["load.craniotomy.file=load.csv", "solve.max_steps=", "report.x=discretise"]
        named = plan.option_inputs(options, self.root)
        self.assertEqual(named, [str(self.root / "load.csv")])
        case = plan.Case("row", "", [], [], [str(self.root / "t1")])
        plan.write_case(self.root, case, "1.0")
        first = (self.root / "row/case.sh").read_text()
        self.make("t1/slice.dcm", text="another")
        plan.write_case(self.root, case, "1.0")
        self.assertNotEqual((self.root / "row/case.sh").read_text(), first)
        self.assertEqual(plan.why_outdated({"inputs": []}, case, scene), "", "a folder's own sum is the run's matter")

    def test_an_image_whose_compression_is_damaged_has_no_grid(self):
        file = self.root / "a.nii.gz"
        file.write_bytes(b"\x1f\x8b\x08\0\0\0\0\0\0\3" + 40 * b"\xff")
        self.assertEqual(plan.grid(str(file)), ())

    def test_what_failed_or_is_gone_is_run_again_with_all_after_it(self):
        stages = ("segment", "discretise", "solve")
        self.make("run/segment/stage.json", "run/discretise/stage.json", "run/solve/stage.json")
        self.make(*(f"marks/{stage}" for stage in stages), text="1.0\n2.0\n0\n\n")
        marks.drop(self.root, stages)
        self.assertEqual(marks.fault(self.root, stages), "")
        (self.root / "run/discretise/stage.json").unlink()
        marks.drop(self.root, stages)
        self.assertEqual([marks.read(self.root, stage) is None for stage in stages], [False, True, True])
        self.assertIn("interrupted after segment", marks.fault(self.root, stages))
        self.make("marks/solve", text="1.0\n2.0\n2\nsolve: the load is empty\n")
        self.assertEqual(marks.fault(self.root, stages), "solve: the load is empty")

    def test_what_was_computed_before_a_change_is_no_result(self):
        self.make("case.sh", "marks/report")
        (self.root / "marks/report").write_text("1\n2\n0\n\n")
        os.utime(self.root / "case.sh", (1000, 1000))
        self.assertEqual(marks.fault(self.root, ("report",)), "")
        os.utime(self.root / "case.sh")
        os.utime(self.root / "marks/report", (2000, 2000))
        self.assertIn("have changed", marks.fault(self.root, ("report",)))

    def test_a_mark_that_the_disk_cut_off_is_none(self):
        self.make("marks/solve", text="1.0\n2.")
        self.assertIsNone(marks.read(self.root, "solve"))


class LimitsTest(Folder):
    def place(self, groups, **values):
        for name, value in values.items():
            self.make(name.replace("__", "/").replace("_dot_", "."), text=value)
        self.make("own", text=groups)
        return {"own": self.root / "own", "mount": self.root / "mount"}

    def test_the_least_of_the_groups_above_counts(self):
        where = self.place("0::/queue/job\n", mount__queue__job__memory_dot_max="max\n",
                           mount__queue__memory_dot_max=f"{8 * 2**30}\n", mount__queue__job__cpu_dot_max="250000 100000\n",
                           mount__cpu_dot_max="max 100000\n")
        self.assertEqual(limits.memory_limit_mb(**where), 8192)
        self.assertEqual(limits.processor_quota(**where), 2.5)

    def test_of_the_first_version_too(self):
        where = self.place("5:memory:/docker/1\n4:cpu,cpuacct:/docker/1\n",
                           mount__memory__memory_dot_limit_in_bytes=f"{2**30}\n",
                           mount__cpu__cpu_dot_cfs_quota_us="300000\n", mount__cpu__cpu_dot_cfs_period_us="100000\n")
        self.assertEqual(limits.memory_limit_mb(**where), 1024)
        self.assertEqual(limits.processor_quota(**where), 3)

    def test_without_a_limit_the_machine_counts(self):
        where = self.place("0::/\n")
        self.assertEqual(limits.memory_limit_mb(**where), float("inf"))
        self.assertEqual(limits.processor_quota(**where), float("inf"))
        self.assertGreaterEqual(limits.processors(), 1)
        self.assertGreater(limits.free_memory_mb(), 0)


class MarksTest(Folder):
    def test_of_a_dry_run_are_what_they_were(self):
        self.make("sub-01/marks/solve", text="1\n2\n3\nwhy\n")
        case = self.root / "sub-01/case.sh"
        self.make("sub-01/case.sh", text="options=()")
        os.utime(case, (1000, 1000))
        with marks.kept([self.root / "sub-01", self.root / "sub-02"]):
            marks.drop(self.root / "sub-01", ["solve", "register"])
            self.assertIsNone(marks.read(self.root / "sub-01", "solve"))
            case.write_text("options=(--set discretise.nodes=6000)")
        self.assertEqual(marks.read(self.root / "sub-01", "solve").sentence, "why")
        self.assertEqual((case.read_text(), case.stat().st_mtime), ("options=()", 1000))

    def test_only_a_run_that_ended_has_failed(self):
        self.assertFalse(marks.has_failed(self.root, ("report",)), "not run yet")
        self.make("case.sh", "marks/report")
        (self.root / "marks/report").write_text("1\n2\n2\nsolve: the load is empty\n")
        os.utime(self.root / "case.sh", (1000, 1000))
        self.assertTrue(marks.has_failed(self.root, ("report",)))
        (self.root / "marks/report").write_text("1\n2\n0\n\n")
        self.assertFalse(marks.has_failed(self.root, ("report",)))


class FilesTest(Folder):
    def test_a_name_that_is_not_utf_8_keeps_its_bytes(self):
        name = os.fsdecode(b"M\xfcller.nii.gz")
        files.replace_text(self.root / "case.sh", name)
        self.assertEqual((self.root / "case.sh").read_bytes(), b"M\xfcller.nii.gz")

    def test_two_calls_may_write_the_same_file_at_the_same_time(self):
        target = self.root / "dataset_description.json"
        with files.replaced(target) as one:
            one.write_text("one")
            with mock.patch("os.getpid", return_value=1), files.replaced(target) as other:
                other.write_text("other")
            self.assertEqual(target.read_text(), "other")
        self.assertEqual(target.read_text(), "one")
        self.assertEqual(list(self.root.iterdir()), [target])

    def test_a_file_that_cannot_be_written_whole_leaves_the_old_one_and_is_named(self):
        target = self.root / "table.tsv"
        files.replace_text(target, "old")
        with self.assertRaises(OSError) as fault, files.replaced(target):
            raise OSError(28, "No space left on device")
        self.assertEqual((target.read_text(), fault.exception.filename), ("old", str(target)))
        self.assertEqual(list(self.root.iterdir()), [target])


class GroupTest(Folder):
    def rows(self):
        rows = [{"name": f"sub-{i:02d}", "status": "done", "largest_shift_mm": 8 + 0.1 * (i % 5), "folded_voxels": 0,
                 "seconds": 1.0, "warnings": 0} for i in range(20)]
        rows[7]["largest_shift_mm"] = 19.0
        rows[12]["folded_voxels"] = 3
        rows[15] |= {"warnings": 2, "first_warning": "the points move <out>"}
        rows.append({"name": "sub-99", "status": "no result", "sentence": "no <T1w> image"})
        return rows

    def test_far_rows_are_found_and_come_behind_those_without_a_result_or_with_warnings(self):
        rows = self.rows()
        far = measures.far_columns(rows)
        self.assertEqual([list(places) for places in far if places], [["largest_shift_mm"], ["folded_voxels"]])
        order = [rows[i]["name"] for i in measures.doubtful_first(rows, far)]
        self.assertEqual((order[:2], set(order[2:4])), (["sub-99", "sub-15"], {"sub-07", "sub-12"}))

    def test_the_page_and_the_table_hold_every_row(self):
        rows = [{column: row.get(column) for column in (*row, *measures.COLUMNS, *measures.COSTS)}
                for row in self.rows()]
        text = pages.group_page(rows, measures.far_columns(rows), "t.tsv")
        self.assertEqual(text.count("<tr"), len(rows) + 1)
        self.assertIn("no &lt;T1w&gt; image", text)
        self.assertIn("20 of 21 done, 1 of them with warnings", text)
        self.assertEqual(text.count("<tr class=warned>"), 1)
        self.assertIn('<td>2</td><td class="words">the points move &lt;out&gt;</td>', text)
        table = measures.as_table(rows, ("name", "largest_shift_mm"))
        self.assertEqual(table.splitlines()[-1], "sub-99\tn/a")
        self.assertEqual(table.splitlines()[8], "sub-07\t19")

    def test_the_last_line_says_how_many_have_warnings_where_some_have(self):
        self.assertEqual(program.closing(7, 9, 0, "out", "t.tsv"), "7 of 9 done: out")
        self.assertEqual(program.closing(7, 9, 2, "out", "t.tsv"), "7 of 9 done, 2 of them with warnings: see t.tsv")

    def test_the_warnings_of_all_stages_stand_in_the_table_which_its_sidecar_describes(self):
        clean = {"segment": {"notes": ["the numbers are FreeSurfer's"]}, "discretise": {}}
        warned = {"segment": {"notes": [*clean["segment"]["notes"], "warning: the T1 is another's"]}, "discretise": {},
                  "solve": {"notes": ["warning: the points move out of the head"]}}
        done = {name: measures.row_of({"stages": stages}) for name, stages in (("sub-01", warned), ("sub-02", clean))}
        group.write(self.root, done, {"sub-03": "no T1w image"})
        with open(self.root / group.TABLE, newline="", encoding="utf-8") as stream:
            rows = list(csv.DictReader(stream, delimiter="\t"))
        self.assertEqual([(row["warnings"], row["first_warning"]) for row in rows],
                         [("2", "the T1 is another's"), ("0", "n/a"), ("n/a", "n/a")])
        self.assertEqual(set(json.loads((self.root / "group_measures.json").read_text())), set(rows[0]))


class NamesTest(unittest.TestCase):
    def test_a_case_is_named_by_participant_and_session(self):
        self.assertEqual(names.case_parts(names.case_name("01", "a")), ("01", "a"))
        self.assertEqual(names.case_parts("sub-01"), ("01", ""))

    def test_entities_suffix_and_extension(self):
        name = names.parse("sub-01_ses-a_desc-before_points.mrk.json")
        self.assertEqual(name, ({"sub": "01", "ses": "a", "desc": "before"}, "points", ".mrk.json"))
        self.assertIsNone(names.parse("sub-01_thing_T1w.nii.gz"))

    def test_the_table_of_labels_is_in_the_order_of_their_numbers(self):
        table = derivatives.label_table({"12": "falx", "2": "ventricles"})
        self.assertEqual(table, "index\tname\n2\tventricles\n12\tfalx\n")

    def test_sources_are_named_by_the_deepest_folder_that_holds_them(self):
        bids, elsewhere = pathlib.Path("/data/study"), pathlib.Path("/scratch/labels")
        known = dataset.links(bids, [bids / "derivatives/plan", elsewhere])
        self.assertEqual(known, {"raw": bids, "derivatives1": elsewhere})
        for file, uri in (("/data/study/derivatives/plan/sub-01/a.csv", "bids:raw:derivatives/plan/sub-01/a.csv"),
                          ("/scratch/labels/sub-01/b.nii.gz", "bids:derivatives1:sub-01/b.nii.gz"),
                          ("/data/study2/c d.csv", "file:///data/study2/c%20d.csv")):
            self.assertEqual(dataset.uri(file, known), uri)


if __name__ == "__main__":
    unittest.main()
