#!/usr/bin/env python3
"""meshlab-stitch.py INPUT.obj OUTPUT.obj RATE: mends what MeshLab's iso-parametrization remesh tears.

MeshLab samples two base triangles at a time on a square grid of RATE vertices an edge and then merges vertices by distance, which joins
vertices of thin and small parts that are not the same. Here the grids are told apart again, face by face in their order,
and joined along those of their edges that share most vertices."""
import sys
from collections import Counter, defaultdict

source, target, rate = sys.argv[1], sys.argv[2], int(sys.argv[3])
positions, faces = [], []
for line in open(source):
    words = line.split()
    if words[:1] == ["v"]:
        positions.append(words[1:4])
    elif words[:1] == ["f"]:
        faces.append([int(w.split("/")[0]) - 1 for w in words[1:4]])
per_patch = 2 * (rate - 1) ** 2
if len(faces) % per_patch:
    sys.exit(f"{len(faces)} faces are no whole number of grids of {per_patch}")

parent = {}


def root(x):
    while parent.setdefault(x, x) != x:
        x = parent[x]
    return x


def grid_of(patch):
    return faces[patch * per_patch:(patch + 1) * per_patch]


def sides(grid):
    """The four edges of a grid as chains of vertices, corner to corner; none where vertices of it were merged."""
    count = Counter(v for f in grid for v in f)
    edges = {(f[k], f[k - 2]) for f in grid for k in range(3)}
    following = {a: b for a, b in edges if (b, a) not in edges}
    corners = [v for v in following if count[v] < 3]
    if len(count) != rate ** 2 or len(corners) != 4 or len(following) != 4 * (rate - 1):
        return None
    chains = []
    for corner in corners:
        chain = [corner]
        while len(chain) < rate:
            chain.append(following[chain[-1]])
        chains.append(chain)
    return chains


# All grids are made alike, so that one without merged vertices tells which corners of faces are one vertex in each.
patches = len(faces) // per_patch
whole = next((p for p in range(patches) if sides(grid_of(p))), None)
if whole is None:
    sys.exit("no grid is whole")
number = {}
pattern = [[number.setdefault(v, len(number)) for v in f] for f in grid_of(whole)]
merged = []  # by patch and vertex of the pattern: the vertex of the file
chains, users = [], defaultdict(list)
for patch in range(patches):
    here = {k: v for f, g in zip(pattern, grid_of(patch)) for k, v in zip(f, g)}
    merged.append(here)
    for chain in sides(pattern):
        for k in chain[1:-1]:
            users[here[k]].append(len(chains))
        chains.append((patch, chain))
joined = set()
candidates = Counter()
for of_vertex in users.values():
    for i in of_vertex:
        for j in of_vertex:
            if i < j and chains[i][0] != chains[j][0]:
                candidates[i, j] += 1
for (i, j), _ in sorted(candidates.items(), key=lambda item: (-item[1], item[0])):
    if i in joined or j in joined:
        continue
    joined |= {i, j}
    for a, b in zip(chains[i][1], reversed(chains[j][1])):
        parent[root((chains[i][0], a))] = root((chains[j][0], b))

index, lines = {}, []
for f, face in enumerate(faces):
    row = []
    for k in pattern[f % per_patch]:
        key = root((f // per_patch, k))
        if key not in index:
            index[key] = len(index) + 1
            lines.append("v " + " ".join(positions[merged[f // per_patch][k]]))
        row.append(index[key])
    face[:] = row
with open(target, "w") as out:
    out.write("\n".join(lines) + "\n")
    out.writelines("f %d %d %d\n" % tuple(face) for face in faces)
print(f"{len(chains) - len(joined)} of {len(chains)} edges of grids have no partner", file=sys.stderr)
