# SPDX-License-Identifier: Apache-2.0
"""Times `umbrix render` against Mitsuba 3 at equal samples, in turns, and prints medians and ratios as a table.

Usage: compare.py UMBRIX SETUP.json SCENE.glb... [--size 640x360] [--spp 16] [--bounces 0] [--threads 2] [--rounds 3]
Needs the packages mitsuba and numpy; SETUP.json is as for `umbrix render --setup`; point lights only.
"""
import argparse
import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time

import mitsuba as mi
import numpy as np

mi.set_variant("scalar_rgb")
HERE = os.path.dirname(os.path.abspath(__file__))
VARIANTS = ("scalar_rgb", "llvm_ad_rgb")


def plain_setup(path, scene, folder):
    """The camera and first light of a setup, with an intensity that both renderers are told."""
    entries = json.load(open(path))
    name = os.path.basename(scene)
    entry = next(e for e in entries if e.get("file") == name or e.get("name") == os.path.splitext(name)[0])
    position = entry["lights"][0]
    distance = np.linalg.norm(np.subtract(entry["camera"]["target"], position))
    camera = {**{"up": [0, 1, 0], "fov_y_degrees": 45}, **entry["camera"]}
    setup = {"camera": camera,
             "lights": [{"type": "point", "position": position, "intensity": float(2 * distance * distance)}]}
    out = os.path.join(folder, "setup.json")
    json.dump(setup, open(out, "w"))
    return out


def run_umbrix(a, scene, setup, out):
    command = [a.umbrix, "render", scene, "--setup", setup, "-o", out, "--float", "--overwrite", "-q", "--size", a.size,
               "--spp", str(a.spp), "--bounces", str(a.bounces), "-j", str(a.threads), "--no-mesh-lights"]
    cpu, start = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime, time.perf_counter()
    subprocess.run(command, check=True)
    return {"all": time.perf_counter() - start, "cpu": resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - cpu}


def run_mitsuba(a, scene, setup, variant, out):
    width, height = a.size.split("x")
    command = [sys.executable, os.path.join(HERE, "render.py"), scene, setup, variant, width, height, str(a.spp),
               str(a.bounces), str(a.threads), out]
    started = {**os.environ, "STARTED": repr(time.time())}
    done = subprocess.run(command, check=True, capture_output=True, text=True, env=started)
    return json.loads(done.stdout.splitlines()[-1])


def pixels(path):
    return np.array(mi.Bitmap(path).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, False))


def measure(a, scene, folder):
    setup = plain_setup(a.setup, scene, folder)
    ours, theirs = [], {variant: [] for variant in VARIANTS}
    for _ in range(a.rounds):
        ours.append(run_umbrix(a, scene, setup, os.path.join(folder, "umbrix.exr")))
        for variant in VARIANTS:
            theirs[variant].append(run_mitsuba(a, scene, setup, variant, os.path.join(folder, variant + ".exr")))
    median = statistics.median
    clock, cpu = median(t["all"] for t in ours), median(t["cpu"] for t in ours)
    row = f"| {os.path.splitext(os.path.basename(scene))[0]} | {clock:.2f} | {cpu:.2f} |"
    for variant in VARIANTS:
        for unit, mine in (("", clock), ("_cpu", cpu)):
            whole = median(t["load" + unit] + t["first" + unit] for t in theirs[variant])
            again = median(t["second" + unit] for t in theirs[variant])
            row += f" {whole / mine:.2f} / {again / mine:.2f} |"
        program = median(t["start"] + t["load"] + t["first"] for t in theirs[variant])
        row += f" {program / clock:.2f} |"
    mean = [pixels(os.path.join(folder, name + ".exr")).mean() for name in ("umbrix", *VARIANTS)]
    print(row + " " + " / ".join(f"{m:.4f}" for m in mean) + " |", flush=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("umbrix")
    parser.add_argument("setup")
    parser.add_argument("scenes", nargs="+")
    parser.add_argument("--size", default="640x360")
    for name, value in (("spp", 16), ("bounces", 0), ("threads", 2), ("rounds", 3)):
        parser.add_argument("--" + name, type=int, default=value)
    a = parser.parse_args()
    print(f"Mitsuba {mi.__version__}, {a.size}, {a.spp} samples a pixel, {a.bounces} bounces, {a.threads} threads")
    print("Ratios above 1: umbrix, as a whole program, took less than Mitsuba's loading and first render / second render,")
    print("or than its program up to there: start, loading and first render.")
    columns = "".join(f" {v}, clock | {v}, CPU | {v}, program |" for v in VARIANTS)
    print("| scene | umbrix s | CPU s |" + columns + " mean pixel |")
    print("|---|" + "---|" * (3 + 3 * len(VARIANTS)))
    with tempfile.TemporaryDirectory() as folder:
        for scene in a.scenes:
            measure(a, scene, folder)


main()
