# SPDX-License-Identifier: GPL-3.0-or-later
"""What shows a run: the module Brain Shift and the two scripts of a run's folder, under plain Python with stubs in the
place of 3D Slicer's own modules. Where ParaView is installed, its script makes a picture.

  python3 show_test.py PROGRAM MODULES [Class]
"""
import os
import py_compile
import shutil
import subprocess
import sys
import tempfile
import types
import unittest
from importlib.machinery import SourceFileLoader
from importlib.util import find_spec, module_from_spec, spec_from_loader
from pathlib import Path
from unittest.mock import MagicMock, patch

from heads import make_head
from stub_scene import Nodes

PARAVIEW = shutil.which("pvbatch") and shutil.which("xvfb-run") and find_spec("paraview")
SKIPPED = 77  # for ctest


def setUpModule():
    global folder, run, head, logic, open_in_slicer
    keep = tempfile.TemporaryDirectory()
    unittest.addModuleCleanup(keep.cleanup)
    folder = Path(keep.name)
    head = make_head(program, folder)
    words = [modules / "BrainShift", "--preset", "fast", "--run", folder / "made"]
    words += [word for name, file in head.items() for word in (f"--{name}", file)]
    subprocess.run(words, check=True, capture_output=True)
    run = (folder / "made").rename(folder / "moved")
    (run / "inputs").mkdir()
    head["t1"].rename(run / "inputs" / "t1.nrrd")  # where the scripted module writes it
    sys.dont_write_bytecode = True
    sys.path.insert(0, str(modules))
    from BrainShiftLib import logic, open_in_slicer


class InSlicer(unittest.TestCase):
    def test_everything_that_the_run_has_is_shown(self):
        stub = Nodes()
        with patch.dict(sys.modules, {"vtk": MagicMock()}):
            nodes = open_in_slicer.show(run, stub.slicer)
        self.assertEqual(
            set(nodes), {"t1", "warped", "error", "labels", "transform", "brain", "before", "after"}
        )
        self.assertIn("t1.nrrd", stub.loaded)
        largest = open_in_slicer.largest_displacement(open_in_slicer.record_of(run))
        display = nodes["brain"].GetDisplayNode()
        self.assertEqual(display.SetActiveScalar.call_args[0][0], "displacement_mm")
        display.SetScalarRange.assert_called_with(0, largest)
        levels = nodes["transform"].GetDisplayNode().SetContourLevelsMmFromString.call_args[0][0]
        self.assertEqual(levels, open_in_slicer.contour_levels(largest))
        nodes["labels"].GetSegmentation().GetNthSegment(0).SetName.assert_called_with("tumour")
        before = [call[0][0] for call in nodes["before"].AddControlPoint.call_args_list]
        after = [call[0][0] for call in nodes["after"].AddControlPoint.call_args_list]
        self.assertEqual(len(before), len(after))
        x, y, z = self._first_point()
        self.assertAlmostEqual(before[0][0], -x, 4)  # Slicer's frame is RAS
        self.assertAlmostEqual(before[0][1], -y, 4)
        self.assertAlmostEqual(before[0][2], z, 4)
        self.assertNotEqual(before[0], after[0])

    @staticmethod
    def _first_point():
        rows = (line for line in (run / "solve" / "load.csv").read_text().splitlines() if line[0] not in "#x")
        return [float(value) for value in next(rows).split(",")[:3]]

    def test_contours_are_few_whole_steps(self):
        self.assertEqual(open_in_slicer.contour_levels(3.9), "0.5 1 1.5 2 2.5 3 3.5")
        self.assertEqual(open_in_slicer.contour_levels(8), "1 2 3 4 5 6 7 8")
        self.assertEqual(open_in_slicer.contour_levels(0.3), "0.15")

    def test_of_thousands_of_points_few_are_shown(self):
        rows = [((i, 0, 0), (i, 1, 0)) for i in range(4230)]
        stub = Nodes()
        with patch.dict(sys.modules, {"vtk": MagicMock()}), patch.object(
            open_in_slicer, "measured_points", return_value=rows
        ):
            nodes = open_in_slicer.show(run, stub.slicer)
        calls = (nodes[name].AddControlPoint.call_args_list for name in ("before", "after"))
        before, after = ([call[0] for call in those] for those in calls)
        self.assertEqual((len(before), len(after)), (300, 300))
        self.assertEqual((before[0], before[-1]), (([0, 0, 0], "1"), ([4229, 0, 0], "4230")))
        self.assertEqual([name for _, name in before], [name for _, name in after])
        steps = {b[0][0] - a[0][0] for a, b in zip(before, before[1:])}
        self.assertEqual(steps, {14, 15})
        stub.slicer.util.showStatusMessage.assert_called_with("300 of 4230 measured points are shown.")
        self.assertEqual(open_in_slicer.evenly_chosen("abc"), [(1, "a"), (2, "b"), (3, "c")])

    def test_the_script_of_the_run_is_the_one_of_the_module(self):
        for name in ("open_in_slicer.py", "open_in_paraview.py"):
            py_compile.compile(str(run / name), cfile=str(folder / "compiled"), doraise=True)
            self.assertTrue(os.access(run / name, os.X_OK))
            mode = (run / name).stat().st_mode
            self.assertEqual(mode & 0o111, (mode & 0o444) >> 2, "who may read it may start it")
        self.assertEqual((run / "open_in_slicer.py").read_text(), Path(open_in_slicer.__file__).read_text())

    def test_a_double_click_starts_slicer_or_says_what_is_missing(self):
        script = run / "open_in_slicer.py"
        slicer = folder / "Slicer"
        slicer.write_text('#!/bin/sh\necho "$@"\n')
        slicer.chmod(0o755)
        environment = {"PATH": "/nowhere", "SLICER": str(slicer)}
        started = subprocess.run([sys.executable, script], capture_output=True, text=True, env=environment)
        self.assertEqual(started.stdout, f"--python-script {script}\n")
        missing = subprocess.run([sys.executable, script], capture_output=True, text=True, env={"PATH": "/nowhere"})
        self.assertIn("SLICER", missing.stderr)
        self.assertEqual(missing.returncode, 1)


class Logic(unittest.TestCase):
    def test_the_program_is_found(self):
        self.assertEqual(logic.command_of("", modules), [str(modules / "BrainShift")])
        self.assertEqual(logic.command_of(str(program), modules), [str(program), "slicer"])
        with self.assertRaisesRegex(ValueError, "is no program"):
            logic.command_of(str(run / "run.json"), modules)
        with patch.dict(os.environ, PATH="/nowhere"), self.assertRaisesRegex(ValueError, "was not found"):
            logic.command_of("", folder)

    def test_lines_of_output_are_told_apart(self):
        line = "<filter-progress>0.25</filter-progress><filter-comment>solve: a &lt; b</filter-comment>\n"
        self.assertEqual(logic.read_line(line), (0.25, "solve: a < b", None))
        self.assertEqual(logic.read_line("solve: warning\n"), (None, None, "solve: warning"))

    def test_options_come_from_the_description(self):
        preset = logic.parameter(modules, "preset")
        self.assertEqual((preset["choices"], preset["default"]), (["fast", "balanced", "accurate"], "balanced"))
        self.assertIn("standard deviation", logic.parameter(modules, "noise")["description"])

    def test_the_quality_table_tells_figures_and_failures(self):
        record = open_in_slicer.record_of(run)
        rows = {what: value for what, value, _ in logic.quality_table(record)}
        self.assertEqual(rows["folded voxels"], "0")
        self.assertEqual(rows["largest displacement"], f"{open_in_slicer.largest_displacement(record):.3g}")
        record["stages"]["solve"]["failure"] = "not converged"
        self.assertIn(("solve", "not converged", ""), logic.quality_table(record))

    def test_in_paraview_one_looks_over_the_opening_wherever_the_head_lies(self):
        script = SourceFileLoader("open_in_paraview", str(run / "open_in_paraview.py"))
        module = module_from_spec(spec_from_loader(script.name, script))
        script.exec_module(module)
        brain, view = MagicMock(), MagicMock()
        brain.GetDataInformation().GetBounds.return_value = (10, 30, -100, -60, 0, 80)
        module.look_from([20, -80, 90], brain, view)
        self.assertEqual((view.CameraFocalPoint, view.CameraPosition), ([20, -80, 40], [20, -80, 540]))


class Panel(unittest.TestCase):
    """The widgets are stubs; the program is the real one."""

    def setUp(self):
        self.stub = Nodes()
        self.stub.slicer.util.launchConsoleProcess.side_effect = lambda words: subprocess.Popen(
            words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
        )
        self.stub.slicer.app.temporaryPath = str(folder / "temporary")
        Path(self.stub.slicer.app.temporaryPath).mkdir(exist_ok=True)
        base = types.SimpleNamespace(
            ScriptedLoadableModule=type("Base", (), {"__init__": lambda self, parent: None}),
            ScriptedLoadableModuleWidget=type("Widget", (), {"setup": lambda self: None, "layout": MagicMock()}),
        )
        stubs = {name: MagicMock() for name in ("ctk", "qt", "vtk")}
        widgets = {
            stubs["ctk"]: ("ctkPathLineEdit", "ctkSliderWidget"),
            stubs["qt"]: ("QCheckBox", "QComboBox", "QLineEdit", "QPushButton"),
            self.stub.slicer: ("qMRMLNodeComboBox", "qMRMLCheckableNodeComboBox", "qSlicerSimpleMarkupsWidget"),
        }
        for library, names in widgets.items():
            for name in names:
                getattr(library, name).side_effect = lambda *arguments: MagicMock()
        stubs |= {"slicer": self.stub.slicer, "slicer.ScriptedLoadableModule": base}
        self.enterContext(patch.dict(sys.modules, stubs))
        sys.modules.pop("BrainShiftPanel", None)
        import BrainShiftPanel

        self.panel = BrainShiftPanel.BrainShiftPanelWidget()
        self.panel.setup()
        self.panel.program.currentPath = str(modules / "BrainShift")
        self.panel.folder.currentPath = str(folder / self._testMethodName)
        self.panel.preset.currentText, self.panel.noise.text = "fast", ""
        files = {**head, "t1": run / "inputs" / "t1.nrrd"}
        self.nodes = {name: self.stub.node(name, file=file) for name, file in files.items()}
        self.nodes["labels"].IsA.side_effect = lambda kind: kind == "vtkMRMLSegmentationNode"
        for name, node in self.nodes.items():
            getattr(self.panel, name).currentNode.return_value = node

    def follow(self):
        self.panel.runner.reader.join()
        self.panel.on_timer()

    def apply(self):
        self.panel.on_apply()
        self.follow()

    def take_along(self, *nodes):
        self.panel.moved.checkedNodes.return_value = nodes
        self.panel.on_move()

    @staticmethod
    def temporary():
        return list((folder / "temporary").iterdir())

    def test_a_run_is_shown_when_it_has_ended(self):
        self.panel.on_apply()
        self.assertFalse(self.panel.apply.enabled)
        self.follow()
        self.assertTrue(self.panel.apply.enabled)
        self.stub.slicer.util.errorDisplay.assert_not_called()
        self.panel.progress.setValue.assert_called_with(1000)
        self.assertIs(self.panel.nodes["t1"], self.nodes["t1"])
        self.assertTrue(self.panel.overlay.enabled and self.panel.report.enabled)
        self.assertGreaterEqual(self.panel.table.setRowCount.call_args[0][0], 6)

        transform = self.panel.nodes["transform"]
        other, registration = self.stub.node("other"), self.stub.node("registration")
        registered, moved = self.stub.node("registered", registration), self.stub.node("moved", transform)
        self.take_along(other, registered, moved, self.panel.nodes["warped"])
        for node in (other, registration, moved):
            self.assertIs(node.under, transform)
        self.assertIs(registered.under, registration)
        self.assertIsNone(self.panel.nodes["warped"].under)
        self.panel.on_overlay(0.4)
        layers = self.stub.slicer.util.setSliceViewerLayers
        layers.assert_called_with(foreground=self.panel.nodes["error"], foregroundOpacity=0.4)
        self.panel.nodes["uncertainty"] = MagicMock()
        self.panel.on_overlay(0.5)
        layers.assert_called_with(foreground=self.panel.nodes["uncertainty"], foregroundOpacity=0.5)
        self.panel.on_contours(False)
        transform.GetDisplayNode().SetVisibility.assert_called_with(False)

    def test_a_cancelled_run_shows_nothing(self):
        self.panel.on_apply()
        self.panel.on_cancel()
        self.follow()
        self.assertEqual(self.panel.nodes, {})
        self.assertTrue(self.panel.apply.enabled)
        self.stub.slicer.util.errorDisplay.assert_not_called()

    def test_what_is_missing_or_refused_is_said(self):
        self.panel.after.currentNode.return_value = None
        self.panel.on_apply()
        self.stub.slicer.util.errorDisplay.assert_called_with("Choose points after.")
        self.panel.after.currentNode.return_value = self.nodes["after"]
        self.panel.noise.text = "much"
        self.panel.on_apply()
        self.follow()
        self.assertIn("without a result", self.stub.slicer.util.errorDisplay.call_args[0][0])
        self.assertEqual(self.panel.nodes, {})

    def test_a_second_apply_takes_the_place_of_the_first(self):
        scanner = self.stub.node("where the scanner stands")
        before = self.stub.node("before", scanner)
        registration = self.stub.node("registration", before)
        other, registered = self.stub.node("other"), self.stub.node("registered", registration)
        self.apply()
        first = self.panel.nodes["transform"]
        self.take_along(other, registered)
        self.assertEqual(self.stub.above(registered), [registration, before, scanner, first])
        self.apply()
        second = self.panel.nodes["transform"]
        self.assertIsNot(first, second)
        for _ in range(2):
            self.take_along(other, registered)
            self.assertEqual(self.stub.above(other), [second])
            self.assertEqual(self.stub.above(registered), [registration, before, scanner, second])

    def test_results_of_a_loaded_scene_are_known(self):
        self.apply()
        shift = self.panel.nodes["transform"]
        late, early = self.stub.node("moved with the result"), self.stub.node("registration")
        older = self.stub.result("Brain shift", late)
        registered = self.stub.node("registered", early)
        early.under = older
        doubled = self.stub.node("doubled", self.stub.result("Brain shift", older))
        warped = self.stub.result("T1 warped")
        self.take_along(registered, doubled, warped)
        self.assertEqual(self.stub.above(registered), [early, late, shift])
        self.assertEqual(self.stub.above(doubled), [late, shift])
        self.assertIsNone(warped.under)

    def test_what_stands_above_the_shift_stays_above_it(self):
        self.apply()
        shift, room = self.panel.nodes["transform"], self.stub.node("room")
        shift.under = room
        under_both, under_room = self.stub.node("under both", shift), self.stub.node("under the room", room)
        self.take_along(under_both, under_room)
        for node in (under_both, under_room):
            self.assertEqual(self.stub.above(node), [shift, room])

    def test_inputs_are_written_as_they_lay_before_any_shift(self):
        registration, tracked = self.stub.node("registration"), self.stub.node("tracked")
        shift = self.stub.result("Brain shift")
        registration.under = shift
        self.nodes["t1"].under = self.nodes["before"].under = registration
        self.nodes["labels"].under, self.nodes["after"].under = shift, tracked
        self.apply()
        own = {"t1": [registration], "labels": [], "before": [registration], "after": [tracked]}
        self.assertEqual(self.stub.exported, own)
        self.assertEqual(self.stub.above(self.nodes["t1"]), [registration, shift])
        self.assertEqual(self.stub.above(self.nodes["labels"]), [shift])

    def test_inputs_lie_where_they_lay_when_one_cannot_be_written(self):
        self.nodes["t1"].under = shift = self.stub.result("Brain shift")
        self.stub.slicer.util.exportNode.side_effect = OSError("no room")
        self.panel.folder.currentPath = ""
        self.panel.on_apply()
        self.stub.slicer.util.errorDisplay.assert_called_with("no room")
        self.assertIs(self.nodes["t1"].under, shift)
        self.assertEqual(self.temporary(), [])

    def test_what_a_shift_has_moved_is_no_input(self):
        self.nodes["after"].under = self.stub.result("Brain shift")
        self.panel.on_apply()
        self.assertIn("points after lie under", self.stub.slicer.util.errorDisplay.call_args[0][0])
        for name in ("labels", "t1"):
            self.nodes[name].SetAttribute("BrainShift.result", "1")
            self.panel.on_apply()
            self.assertIn(f"{name} is a result", self.stub.slicer.util.errorDisplay.call_args[0][0])
        self.assertIsNone(self.panel.runner)

    def test_a_temporary_run_goes_when_nothing_shows_it_any_more(self):
        self.panel.folder.currentPath = ""
        self.apply()
        (first,) = self.temporary()
        self.assertTrue((first / "report" / "index.html").is_file(), "it can still be opened")
        self.apply()
        (second,) = self.temporary()
        self.assertNotEqual(first, second)
        self.panel.noise.text = "much"
        self.apply()
        self.assertEqual(self.temporary(), [second], "what is shown stays")
        self.panel.cleanup()
        self.assertEqual(self.temporary(), [])
        self.stub.slicer.mrmlScene.RemoveObserver.assert_called_once_with(self.panel.observer)

    def test_a_run_that_is_left_unended_goes(self):
        self.panel.folder.currentPath = ""
        self.panel.on_apply()
        self.panel.cleanup()
        self.assertTrue(self.panel.runner.ended())
        self.assertEqual(self.temporary(), [])

    def test_results_are_saved_with_the_scene(self):
        user = self.nodes["t1"].storage = self.stub.node("storage")
        self.apply()
        removed = [call[0][0].file for call in self.stub.slicer.mrmlScene.RemoveNode.call_args_list]
        self.assertEqual({Path(file).name for file in removed}, set(self.stub.loaded))
        for node in self.stub.loaded.values():
            self.assertIsNone(node.GetStorageNode())
            node.StorableModified.assert_called_once_with()
        self.assertIs(self.nodes["t1"].storage, user)
        self.assertTrue((folder / self._testMethodName / "report" / "index.html").is_file())

    def test_a_t1_of_the_run_itself_is_saved_with_the_scene(self):
        self.panel.on_apply()
        self.panel.t1.currentNode.return_value = None  # removed while it ran
        self.follow()
        t1 = self.panel.nodes["t1"]
        self.assertIsNone(t1.GetStorageNode())
        self.take_along(t1)
        self.assertIs(t1.under, self.panel.nodes["transform"])

    def close_scene(self):
        event, observer = self.stub.slicer.mrmlScene.AddObserver.call_args[0]
        self.assertIs(event, self.stub.slicer.mrmlScene.EndCloseEvent)
        observer(self.stub.slicer.mrmlScene, "EndCloseEvent")

    def test_nothing_of_a_closed_scene_is_kept(self):
        self.panel.folder.currentPath = ""
        self.apply()
        self.close_scene()
        self.assertEqual((self.panel.nodes, self.panel.run, self.temporary()), ({}, None, []))
        self.assertFalse(self.panel.contours.enabled or self.panel.move.enabled)
        self.assertFalse(self.panel.overlay.enabled or self.panel.report.enabled)
        self.panel.table.setRowCount.assert_called_with(0)

    def test_the_run_of_a_closed_scene_is_not_shown_in_the_next(self):
        self.panel.folder.currentPath = ""
        self.panel.on_apply()
        self.close_scene()
        self.follow()
        self.assertEqual((self.panel.nodes, self.temporary()), ({}, []))
        self.assertTrue(self.panel.apply.enabled)
        self.stub.slicer.util.errorDisplay.assert_not_called()

    def test_a_run_that_does_not_converge_is_shown_with_its_warning(self):
        few = lambda command, inputs, run, options: arguments_of(command, inputs, run, {**options, "max_steps": 20})
        arguments_of = logic.arguments_of
        with patch.object(logic, "arguments_of", few):
            self.apply()
        self.stub.slicer.util.errorDisplay.assert_not_called()
        self.assertIn("20 steps", self.stub.slicer.util.warningDisplay.call_args[0][0])
        self.assertIn("transform", self.panel.nodes)
        failure = logic.failure_of(open_in_slicer.record_of(self.panel.run.path))
        self.assertIn(("solve", failure, ""), logic.quality_table(open_in_slicer.record_of(self.panel.run.path)))


@unittest.skipUnless(PARAVIEW, "ParaView is not installed")
class InParaView(unittest.TestCase):
    def test_the_script_makes_a_picture(self):
        # Without -noreset the server starts anew after ParaView's first look at it, and refuses the next.
        words = ["xvfb-run", "-a", "-s", "-screen 0 1280x1024x24 -noreset", "pvbatch"]
        picture = Path(os.environ.get("BRAINSHIFT_PICTURE", folder / "picture.png"))  # paraview.sh keeps it
        made = subprocess.run([*words, run / "open_in_paraview.py", picture], capture_output=True)
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertGreater(picture.stat().st_size, 20000)


if __name__ == "__main__":
    program, modules = (Path(word).resolve() for word in sys.argv[1:3])
    if sys.argv[3:] == ["InParaView"] and not PARAVIEW:
        sys.exit(SKIPPED)
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
