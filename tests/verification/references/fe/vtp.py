"""Points and triangles of a VTK PolyData file (.vtp): text, inline base64 or appended base64, zlib or not."""
import base64
import struct
import xml.etree.ElementTree as tree
import zlib

import numpy as np

TYPES = {"Float32": np.float32, "Float64": np.float64, "Int32": np.int32, "Int64": np.int64, "UInt8": np.uint8}


def read_surface(path):
    """(points (n, 3), triangles (m, 3))."""
    root = tree.parse(path).getroot()
    piece = root.find(".//Piece")
    points = array(root, piece.find("Points/DataArray")).reshape(-1, 3).astype(float)
    cells = {a.get("Name"): array(root, a) for a in piece.findall("Polys/DataArray")}
    if (np.diff(cells["offsets"], prepend=0) != 3).any():
        raise ValueError(f"{path}: has polygons other than triangles")
    return points, cells["connectivity"].reshape(-1, 3).astype(int)


def array(root, element):
    kind = TYPES[element.get("type")]
    if element.get("format") == "ascii":
        return np.array((element.text or "").split(), dtype=kind)
    if element.get("format") == "binary":
        text = element.text.strip()
    else:
        appended = root.find("AppendedData")
        if appended.get("encoding") != "base64":
            raise ValueError("appended raw data is not read: write base64")
        text = appended.text.strip()[1:][int(element.get("offset")):]
    word = "<Q" if root.get("header_type") == "UInt64" else "<I"
    return np.frombuffer(unpacked(text, word, root.get("compressor")), dtype=kind)


def unpacked(text, word, compressor):
    size = struct.calcsize(word)

    def numbers(count, skipped=0):
        return [struct.unpack_from(word, decoded(text, (skipped + count) * size), (skipped + i) * size)[0] for i in range(count)]

    if not compressor:
        length = numbers(1)[0]
        return decoded(text, size + length)[size:size + length]
    blocks = numbers(1)[0]
    sizes = numbers(blocks, 3) if blocks else []
    head = encoded_length((3 + blocks) * size)
    packed, out, start = decoded(text[head:], sum(sizes)), b"", 0
    for length in sizes:
        out += zlib.decompress(packed[start:start + length])
        start += length
    return out


def encoded_length(size):
    return 4 * ((size + 2) // 3)


def decoded(text, size):
    """The first `size` bytes of base64 text."""
    return base64.b64decode(text[:encoded_length(size)])[:size]


def write_surface(path, points, triangles, about):
    """As text, coordinates to 0.01."""
    rows = "\n".join(f"{x:.2f} {y:.2f} {z:.2f}" for x, y, z in points + 0.0)
    faces = "\n".join(f"{a} {b} {c}" for a, b, c in triangles)
    ends = " ".join(str(3 * i + 3) for i in range(len(triangles)))
    with open(path, "w") as file:
        file.write(f'<?xml version="1.0"?>\n<!-- {about} -->\n<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian">\n<PolyData>\n'
                   f'<Piece NumberOfPoints="{len(points)}" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" '
                   f'NumberOfPolys="{len(triangles)}">\n'
                   f'<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">\n{rows}\n</DataArray></Points>\n'
                   f'<Polys>\n<DataArray type="Int64" Name="connectivity" format="ascii">\n{faces}\n</DataArray>\n'
                   f'<DataArray type="Int64" Name="offsets" format="ascii">\n{ends}\n</DataArray>\n</Polys>\n'
                   "</Piece>\n</PolyData>\n</VTKFile>\n")
