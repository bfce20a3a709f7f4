#!/usr/bin/env python3
"""lead.py CURVE.csv ANCHORS.json [KIND]: how far streams are ahead of the strongest decimate-then-Draco and of V-DMC.

CURVE.csv is that of `gsp sweep`; of its rows those of method gsp and the kind (displaced) count, one curve a replicate, linear
in the logarithm of the bytes. A lead is the mean over that of PSNR less the anchor's, from 1 KB, or the least size there is, to
where the curve is 10 dB under its remesh. ± is the 95% interval of the mean by chance, of Student's t over the replicates.
V-DMC: the least and the median lead of the replicates' mean curve over its points within the curve's sizes.
"""
import collections
import csv
import json
import math
import statistics
import sys

T95 = [12.71, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262]  # by degrees of freedom, from 1


def at(curve, x):
    """The curve's dB at x = log(bytes); its ends hold beyond them."""
    if x <= curve[0][0]:
        return curve[0][1]
    for (x0, y0), (x1, y1) in zip(curve, curve[1:]):
        if x <= x1:
            return y0 + (y1 - y0) * (x - x0) / (x1 - x0)
    return curve[-1][1]


def mean_between(curve, low, high):
    """The mean over [low, high], exact for a polyline."""
    knots = [low] + [x for x, _ in curve if low < x < high] + [high]
    area = sum((b - a) * (at(curve, a) + at(curve, b)) / 2 for a, b in zip(knots, knots[1:]))
    return area / (high - low)


def where(curve, level):
    """The first x at which the curve reaches the level; its last x where it never does."""
    for (x0, y0), (x1, y1) in zip(curve, curve[1:]):
        if y0 < level <= y1:
            return x0 + (x1 - x0) * (level - y0) / (y1 - y0)
    return curve[-1][0]


def with_interval(values):
    if len(values) < 2:
        return f"{values[0]:+.2f}"
    reach = T95[min(len(values) - 2, len(T95) - 1)] * statistics.stdev(values) / math.sqrt(len(values))
    return f"{statistics.mean(values):+.2f} ± {reach:.2f}"


def main():
    rows, anchors = sys.argv[1], json.load(open(sys.argv[2]))
    kind = sys.argv[3] if len(sys.argv) > 3 else "displaced"
    curves, ceilings = collections.defaultdict(lambda: collections.defaultdict(dict)), collections.defaultdict(dict)
    for row in csv.DictReader(open(rows)):
        if row["method"] != "gsp" or f"kind={kind}" not in row["options"].split():
            continue
        curves[row["model"]][row["replicate"]][math.log(float(row["bytes"]))] = float(row["psnr_db"])
        ceilings[row["model"]][row["replicate"]] = -20 * math.log10(float(row["remesh_error"]))
    print("| surface | replicates | remesh | 1,024 | 2,048 | 4,096 | 8,192 B | lead | range | V-DMC |\n|" + "---|" * 10)
    means = []
    for model, replicates in curves.items():
        anchor = sorted((math.log(p[0]), p[1]) for p in anchors["points"][model]["bytes_psnrdb_faces_bits"])
        leads, ends, all_curves = [], [], []
        for name, points in replicates.items():
            curve = sorted(points.items())
            low, high = max(math.log(1024), curve[0][0]), where(curve, ceilings[model][name] - 10)
            leads.append(mean_between(curve, low, high) - mean_between(anchor, low, high))
            ends.append(math.exp(high))
            all_curves.append(curve)

        def mean_at(x):
            return statistics.mean(at(curve, x) for curve in all_curves)

        first = max(curve[0][0] for curve in all_curves)
        last = min(curve[-1][0] for curve in all_curves)
        ahead = [mean_at(math.log(p[0])) - p[1] for p in anchors["vdmc"]["points"].get(model, [])
                 if first <= math.log(p[0]) <= last]
        against = f"{min(ahead):+.1f}, {statistics.median(ahead):+.1f} ({len(ahead)})" if ahead else ""
        sizes = " | ".join(f"{mean_at(math.log(b)):.1f}" for b in (1024, 2048, 4096, 8192))
        print(f"| {model} | {len(leads)} | {statistics.mean(ceilings[model].values()):.1f} dB | {sizes} | {with_interval(leads)} |"
              f" to {statistics.mean(ends):,.0f} B | {against} |")
        means.append(statistics.mean(leads))
    print(f"\nmean of the surfaces: {statistics.mean(means):+.2f} dB")


if __name__ == "__main__":
    main()
