#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Shows in ParaView the run of brainshift in whose folder this file lies. The folder may be moved.

  python3 open_in_paraview.py              a double-click; paraview must be on the PATH
  paraview --script=open_in_paraview.py    in the run's folder
  pvbatch open_in_paraview.py PICTURE.png  a picture, without a window

The warped brain coloured by displacement with contours in mm, and the measured displacements as arrows; the skull is
there to be switched on. Images are left to 3D Slicer, as ParaView does not read where NIfTI images lie.
"""
import os
import shutil
import sys
from pathlib import Path
from statistics import fmean


def contour_levels(largest):
    """About eight whole steps of 0.5, 1, 2 or 5 mm."""
    step = next((step for step in (0.5, 1, 2, 5) if largest <= 8 * step), 10)
    return [step * i for i in range(1, int(largest / step) + 1)] or [largest / 2]


def show(run, pv):
    """Shows what there is of the run; the view."""
    view = pv.GetActiveViewOrCreate("RenderView")
    view.OrientationAxesVisibility = 1
    brain_file, skull_file, load_file = (
        run / name for name in ("register/brain_intraop.vtp", "segment/skull.vtp", "solve/load.csv")
    )
    if skull_file.is_file():
        skull = pv.XMLPolyDataReader(registrationName="Skull", FileName=[str(skull_file)])
        pv.Show(skull, view, Opacity=0.2, Visibility=0)
    brain = show_brain(brain_file, view, pv) if brain_file.is_file() else None
    if load_file.is_file():
        rows = read_load(load_file)
        show_load(rows, view, pv)
        if brain:
            look_from([fmean(column) for column in zip(*rows)][:3], brain, view)
    return view


def show_brain(file, view, pv):
    """Coloured by the length of its displacement, with contours in mm; the brain."""
    brain = pv.XMLPolyDataReader(registrationName="Brain warped", FileName=[str(file)])
    display = pv.Show(brain, view)
    pv.ColorBy(display, ("POINTS", "displacement_mm"))
    largest = brain.PointData["displacement_mm"].GetRange()[1]
    colours = pv.GetColorTransferFunction("displacement_mm")
    colours.ApplyPreset("Viridis (matplotlib)", True)
    colours.RescaleTransferFunction(0, largest or 1)
    bar = pv.GetScalarBar(colours, view)
    bar.Title, bar.ComponentTitle, bar.Visibility = "Displacement (mm)", "", 1
    bar.AutomaticLabelFormat, bar.LabelFormat, bar.RangeLabelFormat = 0, "%.1f", "%.1f"
    bar.TitleFontSize = bar.LabelFontSize = 12
    if largest > 0:
        contours = pv.Contour(registrationName="Contours (mm)", Input=brain)
        contours.ContourBy = ["POINTS", "displacement_mm"]
        contours.Isosurfaces = contour_levels(largest)
        lines = pv.Show(contours, view, LineWidth=2)
        lines.ColorArrayName = ["POINTS", ""]
        lines.DiffuseColor = lines.AmbientColor = [0, 0, 0]
    return brain


def read_load(file):
    """The rows x, y, z, ux, uy, uz of a load.csv."""
    plain = [line for line in file.read_text(encoding="utf-8").splitlines() if line and not line.startswith("#")]
    return [[float(value) for value in line.split(",")[:6]] for line in plain[1:]]


def look_from(outside, brain, view):
    """At the whole, over the opening; the head is up."""
    box = brain.GetDataInformation().GetBounds()  # the view knows none before it is drawn
    centre = [(low + high) / 2 for low, high in zip(box[::2], box[1::2])]
    view.CameraFocalPoint = centre
    view.CameraPosition = [c + 10 * (o - c) for c, o in zip(centre, outside)]
    view.CameraViewUp = [0, 0, 1]
    view.ResetCamera()


def show_load(rows, view, pv):
    """Arrows from the measured places before to those after."""
    points = pv.ProgrammableSource(registrationName="Measured displacements")
    points.OutputDataSetType = "vtkPolyData"
    points.Script = f"""
import vtk
places, moved = vtk.vtkPoints(), vtk.vtkDoubleArray()
moved.SetName("measured")
moved.SetNumberOfComponents(3)
for row in {rows}:
    places.InsertNextPoint(row[:3])
    moved.InsertNextTuple(row[3:])
self.GetPolyDataOutput().SetPoints(places)
self.GetPolyDataOutput().GetPointData().AddArray(moved)
"""
    arrows = pv.Glyph(registrationName="Measured arrows", Input=points, GlyphType="Arrow")
    arrows.OrientationArray = arrows.ScaleArray = ["POINTS", "measured"]
    arrows.ScaleFactor, arrows.GlyphMode = 1.0, "All Points"
    display = pv.Show(arrows, view)
    display.ColorArrayName = ["POINTS", ""]
    display.DiffuseColor = display.AmbientColor = [0.9, 0.2, 0.1]


def main():
    # ParaView's window does not say where the script lies that it runs: it is started in the run's folder.
    script = Path(globals().get("__file__", "open_in_paraview.py")).resolve()
    picture = sys.argv[1:]
    if "__file__" in globals() and not picture and "BRAINSHIFT_IN_PARAVIEW" not in os.environ:
        program = shutil.which("paraview")
        if not program:
            sys.exit("paraview is not on the PATH")
        os.environ["BRAINSHIFT_IN_PARAVIEW"] = "1"
        os.chdir(script.parent)
        os.execv(program, [program, f"--script={script}"])
    from paraview import simple as pv

    view = show(script.parent, pv)
    if picture:
        pv.SaveScreenshot(os.path.abspath(picture[0]), view, ImageResolution=[1200, 900])
    else:
        pv.Render(view)


if __name__ == "__main__":
    main()
