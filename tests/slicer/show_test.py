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


class Nodes:
    """A stub of slicer whose loaders take files that are there alone."""

    def __init__(self):
        self.slicer, self.loaded = MagicMock(), {}
        for kind in ("Volume", "Segmentation", "Transform", "Model"):
            getattr(self.slicer.util, f"load{kind}").side_effect = self._loader(kind)
        self.points = []
        self.slicer.mrmlScene.AddNewNodeByClass.side_effect = self._add

    def _loader(self, kind):
        def load(file, properties=None):
            assert Path(file).is_file(), file
            node = MagicMock(name=kind)
            node.GetSegmentation().GetNumberOfSegments.return_value = 2
            node.GetSegmentation().GetNthSegment(0).GetLabelValue.return_value = 3
            self.loaded[Path(file).name] = node
            return node

        return load

    def _add(self, kind, name):
        assert kind == "vtkMRMLMarkupsFiducialNode"
        node = MagicMock(name=name)
        self.points.append(node)
        return node


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
        self.stub.slicer.util.exportNode.side_effect = lambda node, file, world: bool(
            shutil.copy(node.file, file)
        )
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
        self.nodes = {name: MagicMock(file=file) for name, file in files.items()}
        self.nodes["labels"].IsA.side_effect = lambda kind: kind == "vtkMRMLSegmentationNode"
        for name, node in self.nodes.items():
            getattr(self.panel, name).currentNode.return_value = node

    def follow(self):
        self.panel.runner.reader.join()
        self.panel.on_timer()

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
        other, registered, registration, moved = MagicMock(), MagicMock(), MagicMock(), MagicMock()
        for node, parent in ((other, None), (registered, registration), (registration, None), (moved, transform)):
            node.GetParentTransformNode.return_value = parent
        self.panel.moved.checkedNodes.return_value = [other, registered, moved, self.panel.nodes["warped"]]
        self.panel.on_move()
        for node in (other, registration):
            node.SetAndObserveTransformNodeID.assert_called_once_with(transform.GetID())
        for node in (registered, moved):
            node.SetAndObserveTransformNodeID.assert_not_called()
        self.panel.nodes["warped"].SetAndObserveTransformNodeID.assert_not_called()
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
