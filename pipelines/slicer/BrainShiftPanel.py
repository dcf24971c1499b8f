# SPDX-License-Identifier: GPL-3.0-or-later
"""The module Brain Shift of 3D Slicer: its widgets and its nodes. What knows nothing of Slicer is in BrainShiftLib."""
from contextlib import contextmanager
from pathlib import Path

import ctk
import qt
import slicer
from BrainShiftLib import logic, open_in_slicer
from slicer.ScriptedLoadableModule import ScriptedLoadableModule, ScriptedLoadableModuleWidget

MODULES = Path(__file__).parent
RESULT = "BrainShift.result"  # an attribute: it is saved with the scene, and a copy of a node has it, too


def is_result(node):
    return node.GetAttribute(RESULT) == "1"


def part_from_files(node):
    """Takes away the storage node of what was loaded: its file is removed, or overwritten by the next run there.

    Slicer then saves the node with the scene, and asks where; without StorableModified it may take it for saved.
    """
    storage = node.GetStorageNode()
    if storage:
        node.SetAndObserveStorageNodeID(None)
        slicer.mrmlScene.RemoveNode(storage)
        node.StorableModified()


def transforms_above(node):
    chain = []
    while (node := node.GetParentTransformNode()) is not None:
        chain.append(node)
    return chain


def own_transforms(node):
    """The transforms above a node that are no results of this module: its registrations, the nearest first."""
    return [transform for transform in transforms_above(node) if not is_result(transform)]


def hang(chain):
    """Puts each of the nodes under the next; None is the world."""
    for node, above in zip(chain, chain[1:]):
        if node.GetParentTransformNode() is not above:
            node.SetAndObserveTransformNodeID(above.GetID() if above else None)


def take_along(node, shift):
    """Puts the node under the shift, in the place of an earlier one. Its own registrations come first."""
    above_shift = transforms_above(shift)  # these come after it, and under it they would make a circle
    hang([node, *(own for own in own_transforms(node) if own not in above_shift), shift])


@contextmanager
def out_of_results(node):
    """The node under its own registrations alone; afterwards it lies where it lay."""
    own = [node, *own_transforms(node)]
    places = [(member, member.GetParentTransformNode()) for member in own]
    try:
        hang([*own, None])
        yield node
    finally:
        for place in places:
            hang(place)


def refused_input(nodes):
    """The sentence about the first input that an earlier run has shifted; else empty."""
    for name in ("t1", "labels"):
        if is_result(nodes[name]):
            return f"{nodes[name].GetName()} is a result of an earlier Apply: choose what was there before the shift."
    if any(is_result(transform) for transform in transforms_above(nodes["after"])):
        return "The points after lie under the result of an earlier Apply: take them out of it, as they were measured."
    return ""


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
        self.run = None  # whose result is shown
        self.coming = None  # the one that is computed
        self._set_up_inputs()
        self._set_up_run()
        self._set_up_results()
        self.layout.addStretch(1)
        self.timer = qt.QTimer()
        self.timer.setInterval(200)
        self.timer.timeout.connect(self.on_timer)
        self.observer = slicer.mrmlScene.AddObserver(slicer.mrmlScene.EndCloseEvent, self.on_scene_closed)

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
        self.report.enabled = self.run is not None and "report" in open_in_slicer.files_of(self.run.path)

    def chosen(self):
        return {
            "t1": self.t1.currentNode(),
            "labels": self.labels.currentNode(),
            "before": self.before.currentNode(),
            "after": self.after.currentNode(),
        }

    def _export(self, nodes):
        """Writes the nodes, as they lay before any shift, into the run's folder; {flag: file}."""
        inputs = self.coming.path / "inputs"
        inputs.mkdir(parents=True, exist_ok=True)
        labels = "labels.seg.nrrd" if nodes["labels"].IsA("vtkMRMLSegmentationNode") else "labels.nrrd"
        names = {"t1": "t1.nrrd", "labels": labels, "before": "before.mrk.json", "after": "after.mrk.json"}
        for flag, name in names.items():
            with out_of_results(nodes[flag]) as node:
                # The properties are given, as the default of Slicer keeps the file format of the call before.
                if not slicer.util.exportNode(node, str(inputs / name), {}, world=True):
                    raise ValueError(f"{inputs / name} could not be written")
        return {flag: inputs / name for flag, name in names.items()}

    def on_apply(self):
        nodes = self.chosen()
        refusal = logic.missing_input(nodes) or refused_input(nodes)
        if refusal:
            slicer.util.errorDisplay(refusal)
            return
        self.log.clear()
        try:
            command = logic.command_of(self.program.currentPath, MODULES)
            self.coming = logic.RunFolder(self.folder.currentPath, slicer.app.temporaryPath)
            options = {"preset": self.preset.currentText, "noise": self.noise.text}
            arguments = logic.arguments_of(command, self._export(nodes), self.coming.path, options)
            # In the environment that Slicer was started in: its libraries are not the program's.
            self.runner = logic.Runner(slicer.util.launchConsoleProcess(arguments))
        except (OSError, ValueError) as fault:
            self._drop_coming()
            slicer.util.errorDisplay(str(fault))
            return
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
            self._drop_coming()
            self.log.appendPlainText("Cancelled.")
            return
        if self.runner.process.returncode != 0:
            self._drop_coming()
            slicer.util.errorDisplay("brainshift ended without a result.", detailedText=self.log.toPlainText())
            return
        self._drop_shown()
        self.run, self.coming = self.coming, None
        self._show()

    def _show(self):
        t1 = self.t1.currentNode()
        record = open_in_slicer.record_of(self.run.path)
        self.nodes = open_in_slicer.show(self.run.path, slicer, t1=t1)
        for what, node in self.nodes.items():
            if node is not t1:
                part_from_files(node)
            if what != "t1":
                node.SetAttribute(RESULT, "1")
        rows = logic.quality_table(record)
        self.table.setRowCount(len(rows))
        for i, row in enumerate(rows):
            for j, text in enumerate(row):
                self.table.setItem(i, j, qt.QTableWidgetItem(text))
        self._enable_results()
        self.contours.checked, self.overlay.value = True, 0  # as show() has it
        failure = logic.failure_of(record)
        if failure:
            slicer.util.warningDisplay(f"{failure}; what is shown is what there is.")

    def _drop_coming(self):
        if self.coming:
            self.coming.drop()
            self.coming = None

    def _drop_shown(self):
        if self.run:
            self.run.drop()
            self.run = None

    def on_scene_closed(self, caller, event):
        """Nothing of the closed scene is kept, nor does the result of its run come into the next."""
        if self.coming:
            self.runner.cancel()
        self._drop_shown()
        self.nodes = {}
        self.table.setRowCount(0)
        self._enable_results()

    def on_contours(self, checked):
        self.nodes["transform"].GetDisplayNode().SetVisibility(checked)

    def on_overlay(self, value):
        shown = self.nodes[open_in_slicer.overlay_of(self.nodes)]
        slicer.util.setSliceViewerLayers(foreground=shown, foregroundOpacity=value)

    def on_move(self):
        shift = self.nodes["transform"]
        for node in self.moved.checkedNodes():
            if not is_result(node):
                take_along(node, shift)

    def on_report(self):
        qt.QDesktopServices.openUrl(qt.QUrl.fromLocalFile(str(open_in_slicer.files_of(self.run.path)["report"])))

    def cleanup(self):
        slicer.mrmlScene.RemoveObserver(self.observer)
        self.timer.stop()
        if self.coming:
            self.runner.cancel()
            self.runner.reader.join(5)  # seconds: the folder can go when nothing writes into it
        self._drop_coming()
        self._drop_shown()
