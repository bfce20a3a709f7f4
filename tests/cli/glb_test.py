"""glb_test.py MESH.sr.ply MESH.glb LEVELS.glb LEVELS.json: the binary glTF files are well formed (glTF 2.0) and hold the
positions of the PLY in single precision, bit for bit. A reader of its own, by the two specifications alone."""
import json
import re
import struct
import sys


def read_ply(path):
    header, body = open(path, "rb").read().split(b"end_header\n", 1)
    # x, y, z come first; vertices of a displaced mesh have a further number.
    elements = re.search(rb"element vertex (\d+)\n((?:property double \w+\n)+)element face (\d+)\nproperty list uchar int",
                         header)
    vertices, stride, faces = int(elements[1]), 8 * elements[2].count(b"\n"), int(elements[3])
    positions = [struct.unpack_from("<3d", body, stride * v) for v in range(vertices)]
    triangles = [struct.unpack_from("<3i", body, stride * vertices + 13 * f + 1) for f in range(faces)]
    return positions, triangles


def read_glb(path):
    data = open(path, "rb").read()
    magic, version, length = struct.unpack_from("<4sII", data)
    assert (magic, version, length) == (b"glTF", 2, len(data))
    json_length, json_type = struct.unpack_from("<I4s", data, 12)
    assert json_type == b"JSON" and json_length % 4 == 0
    document = json.loads(data[20:20 + json_length])
    binary_length, binary_type = struct.unpack_from("<I4s", data, 20 + json_length)
    binary = data[28 + json_length:]
    assert binary_type == b"BIN\0" and binary_length == len(binary) and binary_length % 4 == 0
    assert document["asset"]["version"] == "2.0" and document["buffers"][0]["byteLength"] == len(binary)
    assert "uri" not in document["buffers"][0]
    return document, binary


def values(document, binary, number):
    accessor = document["accessors"][number]
    view = document["bufferViews"][accessor["bufferView"]]
    width, letter = {"VEC3": 3, "SCALAR": 1}[accessor["type"]], {5126: "f", 5125: "I"}[accessor["componentType"]]
    stride = view.get("byteStride", 4 * width)
    assert view["byteOffset"] % 4 == 0 and view["byteOffset"] + view["byteLength"] <= len(binary)
    assert (accessor["count"] - 1) * stride + 4 * width <= view["byteLength"]
    return [struct.unpack_from(f"<{width}{letter}", binary, view["byteOffset"] + stride * i)
            for i in range(accessor["count"])]


def level_of(document, binary, node):
    (primitive,) = document["meshes"][document["nodes"][node]["mesh"]]["primitives"]
    assert primitive.get("mode", 4) == 4
    accessor = document["accessors"][primitive["attributes"]["POSITION"]]
    positions = values(document, binary, primitive["attributes"]["POSITION"])
    for k in range(3):
        assert accessor["min"][k] == min(p[k] for p in positions) and accessor["max"][k] == max(p[k] for p in positions)
    if "NORMAL" in primitive["attributes"]:
        normals = values(document, binary, primitive["attributes"]["NORMAL"])
        assert len(normals) == len(positions) and all(abs(sum(x * x for x in n) - 1) < 1e-5 for n in normals)
    indices = [i[0] for i in values(document, binary, primitive["indices"])]
    assert max(indices) < len(positions)
    return positions, list(zip(indices[0::3], indices[1::3], indices[2::3])), "NORMAL" in primitive["attributes"]


def single(p):
    return struct.unpack("<3f", struct.pack("<3f", *p))


def main(ply, glb, levels_glb, report):
    positions, triangles = read_ply(ply)
    document, binary = read_glb(glb)
    assert document["scenes"][document["scene"]]["nodes"] == [0] and len(document["nodes"]) == 1
    assert "extensionsUsed" not in document
    found = level_of(document, binary, 0)
    assert found[0] == [single(p) for p in positions] and found[1] == triangles
    assert found[2] == (json.load(open(report))["crease_edges"] == 0)

    document, binary = read_glb(levels_glb)
    level = json.load(open(report))["level"]
    assert json.load(open(report))["levels"] == level + 1 == len(document["nodes"])
    assert document["scenes"][0]["nodes"] == [0] and document["extensionsUsed"] == ["MSFT_lod"]
    order = [0] + document["nodes"][0]["extensions"]["MSFT_lod"]["ids"]
    coverage = document["nodes"][0]["extras"]["MSFT_screencoverage"]
    assert sorted(order) == list(range(level + 1)) and len(coverage) == level + 1
    assert coverage == sorted(coverage, reverse=True) and coverage[-1] == 0
    for node in order:
        found = level_of(document, binary, node)
        assert found[1] == triangles and found[0] == [single(p) for p in positions[:len(found[0])]]
        assert len(found[0]) == 1 + max(max(t) for t in triangles)
        # The next coarser level: four faces are one.
        triangles = [(triangles[f][0], triangles[f + 1][1], triangles[f + 2][2]) for f in range(0, len(triangles), 4)]


main(*sys.argv[1:])
