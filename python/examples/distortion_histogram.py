"""Draws how much of a surface its map distorts how far.

    python3 distortion_histogram.py MESH|MAP.param.ply PICTURE
"""

import argparse

import gsp
import matplotlib.pyplot as plt
import numpy as np


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("surface", help="a surface, or a map that was saved")
    parser.add_argument("picture")
    arguments = parser.parse_args()

    if arguments.surface.endswith(".param.ply"):
        map = gsp.read_map(arguments.surface)
    else:
        map = gsp.parameterize(*gsp.read(arguments.surface))
    a, b, c = (map.positions[map.faces[:, k]] for k in range(3))
    area = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)
    values = gsp.face_distortion(map)["anisotropy"]
    known = values > 0

    summary = gsp.distortion(map).anisotropy
    print(f"anisotropy: mean {summary.mean:.3f}, median {summary.median:.3f}, 95% {summary.p95:.3f}")
    plt.hist(values[known], bins=60, range=(1.0, max(summary.p99, 1.01)), weights=area[known] / area.sum())
    plt.axvline(summary.mean, color="black", linewidth=1.0)
    plt.xlabel("anisotropy s1 / s2")
    plt.ylabel("share of the area")
    plt.savefig(arguments.picture, dpi=150)


if __name__ == "__main__":
    main()
