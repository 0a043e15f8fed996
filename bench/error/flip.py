#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Adds FLIP to a report of umbrix-bench error.

LDR-FLIP (Andersson et al. 2020, "FLIP: A Difference Evaluator for Alternating Images") between the pictures that
--keep-images wrote and their references, at 67 pixels per degree: of each number of samples the mean and the 99th
percentile over pixels, as median and quartiles over the seeds. Needs the packages flip-evaluator and numpy.

usage: flip.py IMAGES error.json     (rewrites error.json)
"""
import json
import os
import sys

try:
    import flip_evaluator
    import numpy
except ImportError as error:
    sys.exit(f"flip.py: {error}; try: pip install flip-evaluator numpy")


def estimate(values):
    low, middle, high = numpy.quantile(values, [0.25, 0.5, 0.75])
    return {name: float(f"{x:.5g}") for name, x in (("value", middle), ("low", low), ("high", high))}


def add_flip(folder, images):
    reference = f"{folder}/{images['scene']}-reference.png"
    for point in images["points"]:
        means, percentiles = [], []
        for seed in range(1, images["seeds"] + 1):
            test = f"{folder}/{images['scene']}-{point['samples']}-{seed}.png"
            errors, mean, _ = flip_evaluator.evaluate(reference, test, "LDR", applyMagma=False)
            means.append(mean)
            percentiles.append(numpy.quantile(errors, 0.99))
        point["flip"] = estimate(means)
        point["flip_99"] = estimate(percentiles)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    folder, path = sys.argv[1:]
    with open(path) as file:
        report = json.load(file)
    for images in report["images"]:
        add_flip(folder, images)
    with open(path + ".part", "w") as file:
        json.dump(report, file, indent=1)
        file.write("\n")
    os.replace(path + ".part", path)


main()
