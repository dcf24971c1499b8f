# SPDX-License-Identifier: GPL-3.0-or-later
"""The files that brainshift solve reads, and the solution that it writes."""
import array
import base64
import struct
import xml.etree.ElementTree as tree
import zlib

TYPES = {"hexahedron": (12, 8), "tetrahedron": (10, 4), "quadrilateral": (9, 4), "triangle": (5, 3)}


CODES = {"Float64": "d", "Int64": "q", "Int32": "i", "UInt8": "B"}


def data_array(name, rows, kind="Float64"):
    """rows: tuples of one length, or numbers. Binary, as VTK reads no NaN in text."""
    width = len(rows[0]) if isinstance(rows[0], (tuple, list)) else 1
    values = array.array(CODES[kind], [v for row in rows for v in row] if width > 1 else rows).tobytes()
    text = base64.b64encode(struct.pack("<I", len(values)) + values).decode()
    return f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{width}" format="binary">{text}</DataArray>'


def write_grid(file, points, kind, connectivity, point_data, cell_data):
    """kind: a name of TYPES, or "vertex", one cell a point."""
    number, corners = TYPES.get(kind, (1, 1))
    cells = len(connectivity)
    parts = ['<?xml version="1.0"?><VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">',
             f'<UnstructuredGrid><Piece NumberOfPoints="{len(points)}" NumberOfCells="{cells}"><Points>',
             data_array("Points", points), "</Points><Cells>",
             data_array("connectivity", [a for cell in connectivity for a in cell], "Int64"),
             data_array("offsets", [corners * (i + 1) for i in range(cells)], "Int64"),
             data_array("types", [number] * cells, "UInt8"), "</Cells><PointData>",
             *(data_array(name, rows, "UInt8" if name == "on_surface" else "Float64")
               for name, rows in point_data.items()),
             "</PointData><CellData>",
             *(data_array(name, rows, "Int32" if name == "label" else "Float64") for name, rows in cell_data.items()),
             "</CellData></Piece></UnstructuredGrid></VTKFile>\n"]
    file.write_text("\n".join(parts))


def write_surface(file, points, triangles):
    parts = ['<?xml version="1.0"?><VTKFile type="PolyData" version="0.1" byte_order="LittleEndian"><PolyData>',
             f'<Piece NumberOfPoints="{len(points)}" NumberOfPolys="{len(triangles)}"><Points>',
             data_array("Points", points), "</Points><Polys>",
             data_array("connectivity", [a for t in triangles for a in t], "Int64"),
             data_array("offsets", [3 * (i + 1) for i in range(len(triangles))], "Int64"),
             "</Polys></Piece></PolyData></VTKFile>\n"]
    file.write_text("\n".join(parts))


def decoded(text, size):
    return base64.b64decode(text[:4 * ((size + 2) // 3)])[:size]


def unpacked(text):
    """Bytes of an array: appended base64 of zlib blocks, as VTK writes them."""
    blocks = struct.unpack("<I", decoded(text, 4))[0]
    header = 4 * (3 + blocks)
    sizes = struct.unpack_from(f"<{blocks}I", decoded(text, header), 12)
    packed = decoded(text[4 * ((header + 2) // 3):], sum(sizes))
    plain, start = b"", 0
    for size in sizes:
        plain += zlib.decompress(packed[start:start + size])
        start += size
    return plain


def read_solution(file):
    """Point arrays of solution.vtu, as rows of tuples or numbers, by name."""
    root = tree.parse(file).getroot()
    appended = root.find("AppendedData").text.strip()[1:]
    found = {}
    for element in root.find(".//PointData"):
        values = array.array({"Float64": "d", "Float32": "f"}[element.get("type")])
        values.frombytes(unpacked(appended[int(element.get("offset")):]))
        width = int(element.get("NumberOfComponents") or 1)
        found[element.get("Name")] = ([tuple(values[i:i + width]) for i in range(0, len(values), width)]
                                      if width > 1 else list(values))
    return found
