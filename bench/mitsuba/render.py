# SPDX-License-Identifier: Apache-2.0
"""Renders a .glb as `umbrix render` does, with Mitsuba 3: same triangles, camera, point lights and factors of materials.

Usage: render.py SCENE.glb SETUP.json VARIANT WIDTH HEIGHT SPP BOUNCES THREADS OUT.exr
Prints one line of JSON: the seconds that starting (if STARTED is when that was, in the environment), loading, the first and a second render took (the first may compile code), by
the clock and, as NAME_cpu, over all threads.
SETUP.json is one object with a camera (eye, target, up, fov_y_degrees) and point lights with an intensity.
"""
import json
import os
import struct
import sys
import time

import mitsuba as mi
import numpy as np

COMPONENTS = {5120: np.int8, 5121: np.uint8, 5122: np.int16, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


def read_glb(path):
    data = open(path, "rb").read()
    length = struct.unpack_from("<I", data, 12)[0]
    document = json.loads(data[20:20 + length])
    return document, data[20 + length + 8:]


def accessor(document, blob, number):
    a = document["accessors"][number]
    view = document["bufferViews"][a["bufferView"]]
    kind, width = np.dtype(COMPONENTS[a["componentType"]]), WIDTHS[a["type"]]
    start = view.get("byteOffset", 0) + a.get("byteOffset", 0)
    stride = view.get("byteStride", kind.itemsize * width)
    rows = np.ndarray((a["count"], width), kind, blob, start, (stride, kind.itemsize))
    if a.get("normalized"):
        return rows.astype(np.float64) / np.iinfo(kind).max
    return rows


def matrix_of(node):
    if "matrix" in node:
        return np.array(node["matrix"], np.float64).reshape(4, 4).T
    m = np.eye(4)
    x, y, z, w = node.get("rotation", (0, 0, 0, 1))
    m[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                 [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                 [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    m[:3, :3] *= node.get("scale", (1, 1, 1))
    m[:3, 3] = node.get("translation", (0, 0, 0))
    return m


def instances(document):
    stack = [(n, np.eye(4)) for n in document["scenes"][document.get("scene", 0)]["nodes"]]
    while stack:
        number, parent = stack.pop()
        node = document["nodes"][number]
        to_world = parent @ matrix_of(node)
        if "mesh" in node:
            yield document["meshes"][node["mesh"]], to_world
        stack += [(child, to_world) for child in node.get("children", ())]


def bsdf(material):
    pbr = material.get("pbrMetallicRoughness", {})
    return {"type": "twosided", "nested": {
        "type": "principled", "specular": 0.5,
        "base_color": {"type": "rgb", "value": pbr.get("baseColorFactor", (1, 1, 1, 1))[:3]},
        "metallic": pbr.get("metallicFactor", 1.0), "roughness": max(pbr.get("roughnessFactor", 1.0), 0.03)}}


def mesh(primitive, to_world, document, blob, number):
    position = accessor(document, blob, primitive["attributes"]["POSITION"]).astype(np.float64)
    position = position @ to_world[:3, :3].T + to_world[:3, 3]
    count = len(position)
    faces = (accessor(document, blob, primitive["indices"]).reshape(-1, 3) if "indices" in primitive
             else np.arange(count).reshape(-1, 3))
    normal = primitive["attributes"].get("NORMAL")
    properties = mi.Properties()
    materials = document.get("materials", [])
    chosen = materials[primitive["material"]] if "material" in primitive else {}
    properties["bsdf"] = mi.load_dict(bsdf(chosen))
    made = mi.Mesh(f"mesh{number}", count, len(faces), has_vertex_normals=normal is not None, props=properties)
    parameters = mi.traverse(made)
    parameters["vertex_positions"] = position.astype(np.float32).ravel()
    parameters["faces"] = faces.astype(np.uint32).ravel()
    if normal is not None:
        turned = accessor(document, blob, normal) @ np.linalg.inv(to_world[:3, :3])
        lengths = np.linalg.norm(turned, axis=1, keepdims=True)
        parameters["vertex_normals"] = (turned / np.maximum(lengths, 1e-30)).astype(np.float32).ravel()
    parameters.update()
    return made


def scene_of(path, setup, width, height, bounces):
    document, blob = read_glb(path)
    camera = setup["camera"]
    to_world = mi.ScalarTransform4f().look_at(origin=camera["eye"], target=camera["target"], up=camera["up"])
    scene = {"type": "scene",
             "integrator": {"type": "path", "max_depth": bounces + 2} if bounces > 0 else
                           {"type": "direct", "emitter_samples": 1, "bsdf_samples": 0},
             "sensor": {"type": "perspective", "fov": camera["fov_y_degrees"], "fov_axis": "y", "near_clip": 1e-3,
                        "far_clip": 1e7, "to_world": to_world,
                        "film": {"type": "hdrfilm", "width": width, "height": height, "rfilter": {"type": "box"}}}}
    for i, light in enumerate(setup["lights"]):
        scene[f"light{i}"] = {"type": "point", "position": light["position"],
                              "intensity": {"type": "rgb", "value": light["intensity"]}}
    number = 0
    for placed, matrix in instances(document):
        for primitive in placed["primitives"]:
            if primitive.get("mode", 4) == 4:
                scene[f"mesh{number}"] = mesh(primitive, matrix, document, blob, number)
                number += 1
    return mi.load_dict(scene)


def main():
    path, setup, variant, width, height, spp, bounces, threads, out = sys.argv[1:]
    mi.set_variant(variant)
    mi.set_log_level(mi.LogLevel.Error)
    import drjit as dr
    dr.set_thread_count(int(threads))
    times = {"start": time.time() - float(os.environ.get("STARTED", "nan"))}

    def timed(name, work):
        start, cpu = time.perf_counter(), time.process_time()
        result = work()
        times[name] = time.perf_counter() - start
        times[name + "_cpu"] = time.process_time() - cpu
        return result

    scene = timed("load", lambda: scene_of(path, json.load(open(setup)), int(width), int(height), int(bounces)))
    image = timed("first", lambda: np.array(mi.render(scene, spp=int(spp), seed=0)))
    image = timed("second", lambda: np.array(mi.render(scene, spp=int(spp), seed=1)))
    mi.util.write_bitmap(out, image)
    print(json.dumps(times))


main()
