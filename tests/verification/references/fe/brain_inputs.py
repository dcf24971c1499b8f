"""The inputs of brain.py: brain_surface.vtp, the brain of the Colin 27 head, and brain_load.csv, a craniotomy's displacements.

usage: fe/brain_inputs.py brainshift folder out   (the built program; needs mricron-data and python3-vtk9)
       fe/brain_inputs.py - folder out            (only the load again, from the surface in `out`)
"""
import os
import subprocess
import sys

import numpy as np

from . import tables, vtp

SCENE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../../pipelines/scenes/colin27.xml")
CENTRE, RADIUS, DEPTH = np.array([45.0, 15.0, 60.0]), 28.0, 8.0  # as the scene's simulated load
HELD_SHARE = 0.4  # of the surface, the part farthest from the centre
EDGE, PASS_BAND = 10.5, 0.02


def make_surface(program, folder, out):
    """Segment, smooth (the sulci of a coarse surface would be sharp folds), make the triangles larger, round to 0.01 mm."""
    import vtk

    subprocess.run([program, "run", SCENE, "--out", f"{folder}/run", "--until", "segment", "--set", "segment.edge_length=9"], check=True)
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(f"{folder}/run/segment/brain.vtp")
    smooth = vtk.vtkWindowedSincPolyDataFilter()
    smooth.SetInputConnection(reader.GetOutputPort())
    smooth.SetNumberOfIterations(100)
    smooth.SetPassBand(PASS_BAND)
    smooth.NormalizeCoordinatesOn()
    writer = vtk.vtkXMLPolyDataWriter()
    writer.SetInputConnection(smooth.GetOutputPort())
    writer.SetFileName(f"{folder}/smooth.vtp")
    writer.Write()
    subprocess.run([program, "segment", "--surface", f"{folder}/smooth.vtp", "--edge-length", str(EDGE), "--out", f"{folder}/coarse"],
                   check=True)
    vtp.write_surface(f"{out}/brain_surface.vtp", *vtp.read_surface(f"{folder}/coarse/brain.vtp"),
                      "Brain of the Colin 27 head (ch2bet of Debian's mricron-data), LPS mm; made by fe/brain_inputs.py")


def normals(points, triangles):
    """Outward normals of the triangles, as long as their areas."""
    corners = points[triangles]
    return np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2


def smooth_step(t):
    """The 3-4-5 polynomial."""
    return t ** 3 * (10 - 15 * t + 6 * t ** 2)


def make_load(points, triangles):
    """Rows x,y,z,ux,uy,uz and comment lines. A vertex that is a corner of no wholly prescribed triangle is left free: a
    solid does not feel what is prescribed at a point."""
    centre = points[np.argmin(np.linalg.norm(points - CENTRE, axis=1))]
    distance = np.linalg.norm(points - centre, axis=1)
    areas = normals(points, triangles)
    middles = np.linalg.norm(points[triangles].mean(1) - centre, axis=1)
    order = np.argsort(middles)[::-1]
    far = np.cumsum(np.linalg.norm(areas[order], axis=1))
    held_from = round(float(middles[order][np.searchsorted(far, HELD_SHARE * far[-1])]))
    inward = -areas[(distance[triangles] <= RADIUS).all(1)].sum(0)
    inward /= np.linalg.norm(inward)
    shift = DEPTH * smooth_step(np.clip(1 - distance / RADIUS, 0, 1))[:, None] * inward
    wanted = (distance < RADIUS) | (distance > held_from)
    whole = triangles[wanted[triangles].all(1)]
    kept = np.zeros(len(points), bool)
    kept[np.unique(whole)] = True
    moved, held = kept & (distance < RADIUS), kept & (distance > held_from)
    share = np.linalg.norm(areas[held[triangles].all(1)], axis=1).sum() / far[-1]
    about = ["Prescribed displacements of a brain's surface, for fe/brain.py; made by fe/brain_inputs.py; LPS, mm",
             f"centre: vertex {np.array2string(centre, precision=2, separator=', ')}; direction (mean inward normal) "
             f"{np.array2string(inward, precision=4, separator=', ')}",
             f"moved: {moved.sum()} vertices nearer than {RADIUS:g} mm to the centre, by {DEPTH:g} s(1 - d/{RADIUS:g}) along the "
             "direction, s(t) = 10 t^3 - 15 t^4 + 6 t^5",
             f"held: {held.sum()} vertices farther than {held_from} mm from the centre, {100 * share:.0f} % of the surface",
             "linear on each triangle with three such corners; everything else is free",
             f"left free: {(wanted & ~kept).sum()} vertices there without such a triangle"]
    return about, np.hstack([points, np.round(shift, 4)])[kept]


def main(program, folder, out):
    if program != "-":
        make_surface(program, folder, out)
    about, rows = make_load(*vtp.read_surface(f"{out}/brain_surface.vtp"))
    print("\n".join(about))
    tables.write_samples(f"{out}/brain_load.csv", about, rows[:, :3], rows[:, 3:])


if __name__ == "__main__":
    main(*sys.argv[1:])
