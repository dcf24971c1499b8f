"""Tetrahedra inside a closed triangulated surface by gmsh, whose triangles stay; their quadratic and refined forms.
What reads gmsh's files and adds the nodes of edges serves flat triangles, too."""
import subprocess

import numpy as np

from .evaluate import SIMPLEX_EDGES
from .meshes import Mesh


def fill(points, triangles, stem, growth=1.0):
    """Linear tetrahedra inside; inner edges are about `growth` times those of the surface near by."""
    write_msh(stem + "_surface.msh", points, triangles)
    name = stem.rsplit("/", 1)[-1]
    with open(stem + ".geo", "w") as geo:
        geo.write(f'Merge "{name}_surface.msh";\nSurface Loop(1) = {{1}};\nVolume(1) = {{1}};\n'
                  f"Mesh.MeshSizeFromPoints = 0;\nMesh.MeshSizeExtendFromBoundary = 1;\nMesh.MeshSizeFactor = {growth};\n"
                  "Mesh.Algorithm3D = 1;\nMesh.Optimize = 1;\nMesh.SaveAll = 1;\n")
    with open(stem + "_gmsh.log", "w") as log:
        subprocess.run(["gmsh", "-3", stem + ".geo", "-format", "msh22", "-nt", "1", "-o", stem + "_volume.msh"],
                       stdout=log, stderr=subprocess.STDOUT, check=True)
    return read_msh(stem + "_volume.msh")


def write_msh(path, points, triangles):
    with open(path, "w") as mesh:
        mesh.write(f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{len(points)}\n")
        mesh.writelines(f"{i + 1} {p[0]:.12g} {p[1]:.12g} {p[2]:.12g}\n" for i, p in enumerate(points))
        mesh.write(f"$EndNodes\n$Elements\n{len(triangles)}\n")
        mesh.writelines(f"{i + 1} 2 2 1 1 {t[0] + 1} {t[1] + 1} {t[2] + 1}\n" for i, t in enumerate(triangles))
        mesh.write("$EndElements\n")


def read_msh(path, corners=4):
    """The tetrahedra of a file of gmsh's, or (3 corners) its triangles in the plane."""
    with open(path) as file:
        lines = file.read().split("\n")
    start = lines.index("$Nodes") + 1
    table = np.array([line.split() for line in lines[start + 1:start + 1 + int(lines[start])]], float)
    start = lines.index("$Elements") + 1
    rows = [line.split() for line in lines[start + 1:start + 1 + int(lines[start])]]
    renumber = {int(a): i for i, a in enumerate(table[:, 0])}
    kind = {3: "2", 4: "4"}[corners]
    elements = np.array([[renumber[int(a)] for a in row[-corners:]] for row in rows if row[1] == kind])
    places = table[:, 1:corners]
    edges = places[elements[:, 1:]] - places[elements[:, :1]]
    wrong = np.linalg.det(edges) < 0
    elements[wrong] = elements[wrong][:, [0, 2, 1, 3][:corners]]
    used, elements = np.unique(elements, return_inverse=True)
    return Mesh(places[used], elements.reshape(-1, corners))


def quadratic(mesh):
    """10-node tetrahedra (6-node triangles) with straight edges, and the ends (first, second) of the edge of each added node."""
    pairs = np.sort(mesh.elements[:, SIMPLEX_EDGES[mesh.nodes.shape[1]]].reshape(-1, 2), axis=1)
    edges, which = np.unique(pairs, axis=0, return_inverse=True)
    nodes = np.vstack([mesh.nodes, mesh.nodes[edges].mean(1)])
    return Mesh(nodes, np.hstack([mesh.elements, len(mesh.nodes) + which.reshape(len(mesh.elements), -1)])), edges


def refined(mesh):
    """Each tetrahedron cut into eight; the surface stays where it is."""
    fine, _ = quadratic(mesh)
    a, b, c, d, ab, bc, ca, ad, bd, cd = fine.elements.T
    children = [(a, ab, ca, ad), (ab, b, bc, bd), (ca, bc, c, cd), (ad, bd, cd, d),
                (ab, bc, ca, bd), (ab, bd, ca, ad), (ca, bd, cd, ad), (ca, bc, cd, bd)]
    elements = np.vstack([np.column_stack(child) for child in children])
    corners = fine.nodes[elements]
    wrong = np.linalg.det(corners[:, 1:] - corners[:, :1]) < 0
    elements[wrong] = elements[wrong][:, [0, 2, 1, 3]]
    return Mesh(fine.nodes, elements)


def boundary_triangles(elements):
    """Faces of linear tetrahedra that belong to one only."""
    faces = np.sort(elements[:, [(0, 1, 2), (0, 1, 3), (0, 2, 3), (1, 2, 3)]].reshape(-1, 3), axis=1)
    unique, count = np.unique(faces, axis=0, return_counts=True)
    return unique[count == 1]


def volume(mesh):
    corners = mesh.nodes[mesh.elements[:, :4]]
    return np.linalg.det(corners[:, 1:] - corners[:, :1]).sum() / 6
