"""Compares the settings of a sweep: bytes at equal PSNR, over the first setting, mean of the models.

    python3 compare_sweep.py STORE PICTURE
"""

import argparse

import gsp
import matplotlib.pyplot as plt
import numpy as np


def curves_of(points):
    """(model, label) -> bytes, PSNR: of the first replicate, the points that are no exact match."""
    curves = {}
    for i in np.flatnonzero((points["replicate"] == 0) & np.isfinite(points["psnr_db"])):
        sizes, psnr = curves.setdefault((points["model"][i], points["label"][i]), ([], []))
        sizes.append(points["bytes"][i])
        psnr.append(points["psnr_db"][i])
    return curves


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("store")
    parser.add_argument("picture")
    arguments = parser.parse_args()

    curves = curves_of(gsp.read_store(arguments.store))
    models = list(dict.fromkeys(model for model, _ in curves))
    labels = list(dict.fromkeys(label for _, label in curves))
    means = []
    for label in labels[1:]:
        ratios = []
        for model in models:
            if (model, label) not in curves or (model, labels[0]) not in curves:
                continue
            try:
                rate = gsp.bd_rate(*curves[model, labels[0]], *curves[model, label]).rate.value
                ratios.append(1.0 + rate / 100.0)
            except gsp.Error as error:
                print(f"{model}, {label}: {error}")
        mean = 100.0 * (np.exp(np.mean(np.log(ratios))) - 1.0) if ratios else np.nan
        means.append(mean)
        print(f"{label}: {mean:+.1f}% bytes over {labels[0]}, mean of {len(ratios)} models")
    plt.barh(labels[1:], means)
    plt.xlabel(f"bytes over {labels[0]} [%]")
    plt.tight_layout()
    plt.savefig(arguments.picture, dpi=150)


if __name__ == "__main__":
    main()
