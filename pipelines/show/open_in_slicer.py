#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Shows in 3D Slicer the run of brainshift in whose folder this file lies. The folder may be moved.

  python3 open_in_slicer.py                    a double-click; Slicer must be on the PATH, or $SLICER name it
  Slicer --python-script open_in_slicer.py

The module Brain Shift shows its runs by show(), too.
"""
import csv
import hashlib
import json
import os
import shutil
import sys
from pathlib import Path

FILES = {
    "warped": "register/warped.nii.gz",
    "labels": "register/warped_labels.nii.gz",
    "transform": "register/from-preop_to-intraop_mode-image_xfm.h5",
    "brain": "register/brain_intraop.vtp",
    "error": "register/estimated_error.nii.gz",
    "uncertainty": "register/uncertainty.nii.gz",
    "load": "solve/load.csv",
    "report": "report/index.html",
}
OVERLAYS = {"uncertainty": "Uncertainty (mm)", "error": "Estimated error (mm)"}
MOST_POINTS = 300  # markups are made for points that were placed by hand, not for the thousands of a surface
COLOURS = "vtkMRMLColorTableNodeFileViridis.txt"


def record_of(run):
    """run.json, or an empty record."""
    file = Path(run) / "run.json"
    return json.loads(file.read_text(encoding="utf-8")) if file.is_file() else {}


def files_of(run):
    """The files of the run's last state, by what they are; t1 is where it was, or in the folder's inputs/."""
    run, record = Path(run), record_of(run)
    outdated = {name for name, stage in record.get("stages", {}).items() if stage.get("status") == "outdated"}
    found = {what: run / name for what, name in FILES.items()
             if (run / name).is_file() and name.partition("/")[0] not in outdated}
    for given in record.get("inputs", []):
        places = (run / "inputs" / Path(given["path"]).name, Path(given["path"]))
        for place in places if given["role"] == "image.t1" else ():
            if is_the_same(place, given):
                found.setdefault("t1", place)
    return found


def is_the_same(place, given):
    """Whether a file still is the one that came in; of a folder, whether it is there."""
    try:
        if place.is_file() and "sha256" in given:
            return hashlib.sha256(place.read_bytes()).hexdigest() == given["sha256"]
        return place.exists()
    except OSError:  # in a folder that may not be entered
        return False


def measured_points(file):
    """[(before, after)] of a load.csv, in Slicer's frame, RAS."""
    with open(file, newline="", encoding="utf-8") as lines:
        rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    points = []
    for row in rows:
        x, y, z, ux, uy, uz = (float(row[name]) for name in ("x", "y", "z", "ux", "uy", "uz"))
        points.append(((-x, -y, z), (-x - ux, -y - uy, z + uz)))
    return points


def evenly_chosen(points, most=MOST_POINTS):
    """[(row, point)], rows counted from 1: all of the points, or as many as `most`, from the first to the last."""
    if len(points) <= most:
        return list(enumerate(points, 1))
    return [(row + 1, points[row]) for row in (i * (len(points) - 1) // (most - 1) for i in range(most))]


def largest_displacement(record):
    """Of the nodes, or of the voxels where another program solved; mm."""
    for stage in ("solve", "register"):
        measures = record.get("stages", {}).get(stage, {}).get("measures", {})
        if "largest_displacement_mm" in measures:
            return measures["largest_displacement_mm"]
    return 1.0


def contour_levels(largest):
    """About eight whole steps of 0.5, 1, 2 or 5 mm."""
    step = next((step for step in (0.5, 1, 2, 5) if largest <= 8 * step), 10)
    return " ".join(f"{step * i:g}" for i in range(1, int(largest / step) + 1)) or f"{largest / 2:.3g}"


def _show_brain(slicer, node, largest):
    import vtk

    display = node.GetDisplayNode()
    display.SetActiveScalar("displacement_mm", vtk.vtkAssignAttribute.POINT_DATA)
    display.SetAndObserveColorNodeID(COLOURS)
    display.SetScalarRangeFlag(slicer.vtkMRMLDisplayNode.UseManualScalarRange)
    display.SetScalarRange(0, largest)
    display.SetScalarVisibility(True)
    _add_colour_bar(slicer, node, "Displacement (mm)")


def _add_colour_bar(slicer, node, title):
    legend = slicer.modules.colors.logic().AddDefaultColorLegendDisplayNode(node)
    legend.SetTitleText(title)
    legend.SetLabelFormat("%.2f")


def _show_contours(slicer, transform, levels):
    transform.CreateDefaultDisplayNodes()
    display = transform.GetDisplayNode()
    display.SetVisualizationMode(slicer.vtkMRMLTransformDisplayNode.VIS_MODE_CONTOUR)
    display.SetContourLevelsMmFromString(levels)
    display.SetVisibility(True)
    display.SetVisibility2D(True)
    display.SetVisibility3D(False)


def _show_overlay(slicer, node, title):
    """As an overlay that is clear where there is none."""
    display = node.GetDisplayNode()
    display.SetAndObserveColorNodeID(COLOURS)
    display.SetThreshold(1e-6, 1e6)
    display.SetApplyThreshold(True)
    _add_colour_bar(slicer, node, title)


def _name_segments(node, names):
    segments = node.GetSegmentation()
    for i in range(segments.GetNumberOfSegments()):
        segment = segments.GetNthSegment(i)
        segment.SetName(names.get(str(segment.GetLabelValue()), segment.GetName()))


def _add_points(slicer, name, colour, places):
    node = slicer.mrmlScene.AddNewNodeByClass("vtkMRMLMarkupsFiducialNode", name)
    for row, place in places:
        node.AddControlPoint(list(place), str(row))
    node.CreateDefaultDisplayNodes()
    node.GetDisplayNode().SetSelectedColor(*colour)
    node.GetDisplayNode().SetPointLabelsVisibility(False)
    node.SetLocked(True)
    return node


def overlay_of(nodes):
    """What of the nodes is laid over the image: the uncertainty, else the estimated error, else None."""
    return next((what for what in OVERLAYS if what in nodes), None)


def show(run, slicer, t1=None):
    """Loads what the run has and shows it; t1: the node of the T1 where it is loaded already. {what: node}."""
    record, files = record_of(run), files_of(run)
    largest = largest_displacement(record)
    nodes = {"t1": t1} if t1 else {}
    for what, name in (("t1", "T1 before"), ("warped", "T1 warped"), ("error", "Estimated error"),
                       ("uncertainty", "Uncertainty")):
        if what in files and what not in nodes:
            nodes[what] = slicer.util.loadVolume(str(files[what]), {"name": name, "show": False})
    if "labels" in files:
        nodes["labels"] = slicer.util.loadSegmentation(str(files["labels"]), {"name": "Segmentation warped"})
        _name_segments(nodes["labels"], record.get("label_names", {}))
        nodes["labels"].GetDisplayNode().SetVisibility(False)
    if "transform" in files:
        nodes["transform"] = slicer.util.loadTransform(str(files["transform"]))
        nodes["transform"].SetName("Brain shift")
        _show_contours(slicer, nodes["transform"], contour_levels(largest))
    if "brain" in files:
        nodes["brain"] = slicer.util.loadModel(str(files["brain"]))
        nodes["brain"].SetName("Brain warped")
        _show_brain(slicer, nodes["brain"], largest)
    if "load" in files:
        points = measured_points(files["load"])
        chosen = evenly_chosen(points)
        before, after = ([(row, pair[i]) for row, pair in chosen] for i in (0, 1))
        nodes["before"] = _add_points(slicer, "Measured before", (0.2, 0.4, 1.0), before)
        nodes["after"] = _add_points(slicer, "Measured after", (1.0, 0.3, 0.2), after)
        if len(chosen) < len(points):
            slicer.util.showStatusMessage(f"{len(chosen)} of {len(points)} measured points are shown.")
    for what in OVERLAYS:
        if what in nodes:
            _show_overlay(slicer, nodes[what], OVERLAYS[what])
    if "warped" in nodes:
        slicer.util.setSliceViewerLayers(
            background=nodes["warped"], foreground=nodes.get(overlay_of(nodes)), foregroundOpacity=0.0, fit=True
        )
    slicer.util.resetThreeDViews()
    return nodes


def main():
    here = Path(__file__).resolve()
    try:
        import slicer
    except ImportError:
        program = os.environ.get("SLICER") or shutil.which("Slicer")
        if not program:
            sys.exit("3D Slicer is not on the PATH; name its program by the environment variable SLICER")
        os.execv(program, [program, "--python-script", str(here)])
    show(here.parent, slicer)


if __name__ == "__main__":
    main()
