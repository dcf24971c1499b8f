# SPDX-License-Identifier: GPL-3.0-or-later
"""The module Brain Shift of 3D Slicer: widgets alone. What is behind them stands in BrainShiftLib."""
import tempfile
from pathlib import Path

import ctk
import qt
import slicer
from BrainShiftLib import logic, open_in_slicer
from slicer.ScriptedLoadableModule import ScriptedLoadableModule, ScriptedLoadableModuleWidget

MODULES = Path(__file__).parent


class BrainShiftPanel(ScriptedLoadableModule):
    def __init__(self, parent):
        ScriptedLoadableModule.__init__(self, parent)
        parent.title = "Brain Shift"
        parent.categories = ["Registration"]
        parent.contributors = ["the brainshift developers"]
        parent.helpText = (
            "Choose the T1 and its segmentation, place the same points of the cortex before and after, and press "
            "Apply: by mechanics the whole brain moves as they did. Research software, not a medical device."
        )


class BrainShiftPanelWidget(ScriptedLoadableModuleWidget):
    def setup(self):
        ScriptedLoadableModuleWidget.setup(self)
        self.runner = None
        self.nodes = {}
        self.run = None
        self._set_up_inputs()
        self._set_up_run()
        self._set_up_results()
        self.layout.addStretch(1)
        self.timer = qt.QTimer()
        self.timer.setInterval(200)
        self.timer.timeout.connect(self.on_timer)

    def _section(self, title):
        box = ctk.ctkCollapsibleButton()
        box.text = title
        self.layout.addWidget(box)
        return qt.QFormLayout(box)

    @staticmethod
    def _add_rows(form, rows):
        for name, widget in rows:
            form.addRow(name, widget)

    def _node_selector(self, types):
        selector = slicer.qMRMLNodeComboBox()
        selector.nodeTypes = types
        selector.addEnabled = selector.removeEnabled = False
        selector.noneEnabled = True
        selector.setMRMLScene(slicer.mrmlScene)
        return selector

    def _point_list(self, colour):
        points = slicer.qSlicerSimpleMarkupsWidget()
        points.setMRMLScene(slicer.mrmlScene)
        points.defaultNodeColor = qt.QColor(*colour)
        points.enterPlaceModeOnNodeChange = False
        points.tableWidget().setFixedHeight(110)
        return points

    def _set_up_inputs(self):
        form = self._section("Input")
        self.t1 = self._node_selector(["vtkMRMLScalarVolumeNode"])
        self.labels = self._node_selector(["vtkMRMLSegmentationNode", "vtkMRMLLabelMapVolumeNode"])
        self.before = self._point_list((50, 100, 255))
        self.after = self._point_list((255, 80, 50))
        points = [("Points before:", self.before), ("The same after:", self.after)]
        self._add_rows(form, [("T1:", self.t1), ("Segmentation:", self.labels), *points])

    def _set_up_run(self):
        form = self._section("Run")
        self.program = ctk.ctkPathLineEdit()
        self.program.filters = ctk.ctkPathLineEdit.Files
        self.program.settingKey = "BrainShift/Program"
        self.program.toolTip = "brainshift; empty: the one beside this module, or on the PATH"
        self.folder = ctk.ctkPathLineEdit()
        self.folder.filters = ctk.ctkPathLineEdit.Dirs
        self.folder.toolTip = "keeps the run; empty: a temporary folder"
        self.preset = qt.QComboBox()
        preset = logic.parameter(MODULES, "preset")
        self.preset.addItems(preset["choices"])
        self.preset.currentText = preset["default"]
        self.preset.toolTip = preset["description"]
        self.noise = qt.QLineEdit()
        self.noise.toolTip = logic.parameter(MODULES, "noise")["description"]
        self.apply = qt.QPushButton("Apply")
        self.cancel = qt.QPushButton("Cancel")
        self.cancel.enabled = False
        self.progress = qt.QProgressBar()
        self.progress.setRange(0, 1000)
        self.log = qt.QPlainTextEdit()
        self.log.readOnly = True
        self._add_rows(form, [("Program:", self.program), ("Run folder:", self.folder)])
        self._add_rows(form, [("Preset:", self.preset), ("Noise (mm):", self.noise)])
        for widget in (self.apply, self.cancel, self.progress, self.log):
            form.addRow(widget)
        self.apply.clicked.connect(self.on_apply)
        self.cancel.clicked.connect(self.on_cancel)

    def _set_up_results(self):
        form = self._section("Result")
        self.table = qt.QTableWidget(0, 3)
        self.table.setHorizontalHeaderLabels(["", "value", "unit"])
        self.table.horizontalHeader().setSectionResizeMode(qt.QHeaderView.ResizeToContents)
        self.contours = qt.QCheckBox("Contours of displacement (mm)")
        self.contours.checked = True
        self.overlay = ctk.ctkSliderWidget()
        self.overlay.maximum, self.overlay.singleStep = 1.0, 0.05
        self.moved = slicer.qMRMLCheckableNodeComboBox()
        kinds = ("Volume", "Segmentation", "Model", "Markups")
        self.moved.nodeTypes = [f"vtkMRML{kind}Node" for kind in kinds]
        self.moved.addEnabled = self.moved.removeEnabled = False
        self.moved.setMRMLScene(slicer.mrmlScene)
        self.move = qt.QPushButton("Take these along")
        self.report = qt.QPushButton("Open the report")
        form.addRow(self.table)
        form.addRow(self.contours)
        form.addRow("Uncertainty, or estimated error:", self.overlay)
        form.addRow("Other data:", self.moved)
        form.addRow(self.move)
        form.addRow(self.report)
        self.contours.toggled.connect(self.on_contours)
        self.overlay.valueChanged.connect(self.on_overlay)
        self.move.clicked.connect(self.on_move)
        self.report.clicked.connect(self.on_report)
        self._enable_results()

    def _enable_results(self):
        self.contours.enabled = self.move.enabled = "transform" in self.nodes
        self.overlay.enabled = open_in_slicer.overlay_of(self.nodes) is not None
        self.report.enabled = self.run is not None and "report" in open_in_slicer.files_of(self.run)

    def chosen(self):
        return {
            "t1": self.t1.currentNode(),
            "labels": self.labels.currentNode(),
            "before": self.before.currentNode(),
            "after": self.after.currentNode(),
        }

    def _export(self, nodes):
        """Writes the nodes, with the transforms above them, into the run's folder; {flag: file}."""
        inputs = self.run / "inputs"
        inputs.mkdir(parents=True, exist_ok=True)
        labels = "labels.seg.nrrd" if nodes["labels"].IsA("vtkMRMLSegmentationNode") else "labels.nrrd"
        names = {"t1": "t1.nrrd", "labels": labels, "before": "before.mrk.json", "after": "after.mrk.json"}
        for flag, name in names.items():
            if not slicer.util.exportNode(nodes[flag], str(inputs / name), world=True):
                raise ValueError(f"{inputs / name} could not be written")
        return {flag: inputs / name for flag, name in names.items()}

    def on_apply(self):
        nodes = self.chosen()
        missing = logic.missing_input(nodes)
        if missing:
            slicer.util.errorDisplay(missing)
            return
        try:
            command = logic.command_of(self.program.currentPath, MODULES)
            temporary = self.folder.currentPath or tempfile.mkdtemp(dir=slicer.app.temporaryPath)
            self.run = Path(temporary).resolve()
            options = {"preset": self.preset.currentText, "noise": self.noise.text}
            arguments = logic.arguments_of(command, self._export(nodes), self.run, options)
        except (OSError, ValueError) as fault:
            slicer.util.errorDisplay(str(fault))
            return
        self.log.clear()
        # In the environment that Slicer was started in: its libraries are not the program's.
        self.runner = logic.Runner(slicer.util.launchConsoleProcess(arguments))
        self.apply.enabled, self.cancel.enabled = False, True
        self.timer.start()

    def on_cancel(self):
        self.runner.cancel()

    def on_timer(self):
        ended = self.runner.ended()  # asked first: lines that come later are then all there
        for line in self.runner.new_lines():
            fraction, comment, text = logic.read_line(line)
            if fraction is not None:
                self.progress.setValue(round(1000 * fraction))
            if comment:
                self.progress.setFormat(comment)
            if text:
                self.log.appendPlainText(text)
        if ended:
            self.timer.stop()
            self.apply.enabled, self.cancel.enabled = True, False
            self._finish()

    def _finish(self):
        if self.runner.cancelled:
            self.log.appendPlainText("Cancelled.")
            return
        if self.runner.process.returncode != 0:
            slicer.util.errorDisplay("brainshift ended without a result.", detailedText=self.log.toPlainText())
            return
        record = open_in_slicer.record_of(self.run)
        self.nodes = open_in_slicer.show(self.run, slicer, t1=self.t1.currentNode())
        rows = logic.quality_table(record)
        self.table.setRowCount(len(rows))
        for i, row in enumerate(rows):
            for j, text in enumerate(row):
                self.table.setItem(i, j, qt.QTableWidgetItem(text))
        self._enable_results()

    def on_contours(self, checked):
        self.nodes["transform"].GetDisplayNode().SetVisibility(checked)

    def on_overlay(self, value):
        shown = self.nodes[open_in_slicer.overlay_of(self.nodes)]
        slicer.util.setSliceViewerLayers(foreground=shown, foregroundOpacity=value)

    def on_move(self):
        shift = self.nodes["transform"]
        for node in self.moved.checkedNodes():
            if node in self.nodes.values() and node is not self.nodes.get("t1"):
                continue
            while (above := node.GetParentTransformNode()) is not None and above is not shift:
                node = above  # a registration of the node's own comes before the shift
            if above is None:
                node.SetAndObserveTransformNodeID(shift.GetID())

    def on_report(self):
        qt.QDesktopServices.openUrl(qt.QUrl.fromLocalFile(str(open_in_slicer.files_of(self.run)["report"])))

    def cleanup(self):
        if self.runner and not self.runner.ended():
            self.runner.cancel()
