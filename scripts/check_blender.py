# SPDX-FileCopyrightText: The Windfall authors
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Imports a moving glTF file into Blender and compares it with the table of the same frames; see check-blender."""

import csv
import sys

import bpy
import numpy

# Debian's Blender 3.4.1 asks for a name that Debian's numpy has no more.
if not hasattr(numpy, "bool"):
    numpy.bool = bool

path = sys.argv[-1]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.context.scene.render.fps = 24
bpy.ops.import_scene.gltf(filepath=path + ".glb")

with open(path + ".csv", newline="") as file:
    rows = list(csv.DictReader(file))
frames = sorted({int(row["frame"]) for row in rows})
first = frames[0]
leaves = {int(item.name[5:]): item for item in bpy.data.objects if item.name.startswith("leaf.")}
seen = {int(row["leaf"]) for row in rows if row["state"] != "dormant"}
assert set(leaves) == seen, f"{len(leaves)} objects for {len(seen)} leaves that are seen"


def action(item):
    data = item.animation_data
    return data.action or data.nla_tracks[0].strips[0].action


compared = 0
for slot, item in leaves.items():
    curves = {(curve.data_path, curve.array_index): curve for curve in action(item).fcurves}
    place = [curves["location", axis] for axis in range(3)]
    assert all(len(curve.keyframe_points) == len(frames) for curve in place), f"leaf {slot}: other keyframes"
    for row in (row for row in rows if int(row["leaf"]) == slot and row["state"] != "dormant"):
        found = [curve.evaluate(int(row["frame"]) - first) for curve in place]
        x, y, z = (float(row[name]) for name in ("x_m", "y_m", "z_m"))
        # Blender has z up.
        off = max(abs(a - b) for a, b in zip(found, (x, -z, y)))
        assert off < 1e-4, f"leaf {slot}, frame {row['frame']}: {found} is not {(x, -z, y)}"
        compared += 1
assert compared > 1000, f"only {compared} places were there to compare"
bones = sum(len(armature.bones) for armature in bpy.data.armatures)
assert len(bpy.data.armatures) == 2 and bones > 10, f"two trees of {bones} bones"
assert all(name in bpy.data.objects for name in ("Ground", "Water", "tree.1.fruit")), "ground, water and berries"
assert bpy.data.cameras and bpy.data.images, "a camera and pictures"
print(f"Blender {bpy.app.version_string}: {len(leaves)} leaves, {len(frames)} keyframes each, {compared} places equal, {bones} bones")
