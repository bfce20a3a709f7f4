"""Draws the rate-distortion curves of a surface: gsp's map, MAPS smoothed, and decimation with Draco.

    python3 curve.py MESH PICTURE [--samples N]
"""

import argparse

import gsp
import matplotlib.pyplot as plt
import numpy as np


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("mesh")
    parser.add_argument("picture")
    parser.add_argument("--samples", type=int, default=200000)
    arguments = parser.parse_args()

    positions, faces = gsp.read(arguments.mesh)
    columns = gsp.curve(positions, faces, model=arguments.mesh, wavelet="butterfly-lifted", samples=arguments.samples)
    method = np.array(columns["method"])
    lossless = np.array(columns["coder"]) == "draco-lossless"
    curves = {}
    for name in dict.fromkeys(columns["method"]):
        rows = (method == name) & ~lossless & np.isfinite(columns["psnr_db"])
        order = np.argsort(columns["bytes"][rows])
        curves[name] = columns["bytes"][rows][order], columns["psnr_db"][rows][order]

    for name, (size, psnr) in curves.items():
        plt.semilogx(size, psnr, marker=".", label=name)
        if name != "gsp":
            try:
                print(f"BD-rate of gsp over {name}: {gsp.bd_rate(size, psnr, *curves['gsp']).rate.value:+.1f}%")
            except gsp.Error as error:
                print(f"BD-rate of gsp over {name}: none, {error}")
    plt.xlabel("bytes")
    plt.ylabel("PSNR [dB], peak: diagonal")
    plt.legend()
    plt.savefig(arguments.picture, dpi=150)


if __name__ == "__main__":
    main()
