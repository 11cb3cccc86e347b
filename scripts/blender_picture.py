# SPDX-FileCopyrightText: The Windfall authors
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Draws a frame of `evening` three times, with the same exposure, side by side into docs/blender.jpg: by `windfall render` as the preset has
it and without haze and glare, which stages do not hold, and by Blender.

Usage, where check-blender has been: target/blender/bin/python scripts/blender_picture.py PROGRAM
"""

import math
import os
import subprocess
import sys
import tempfile
from pathlib import Path

program = sys.argv[1]
ROOT = Path(__file__).parents[1]
# Found before Blender is loaded, which asks for it then.
folder = tempfile.TemporaryDirectory()
os.environ["BLENDER_USER_RESOURCES"] = folder.name
sys.path.append(str(ROOT / "app"))
# Nothing compiled is left among the sources.
sys.dont_write_bytecode = True

import bpy
import numpy as np

import blender as addon

SIZE = (640, 360)
FPS, FRAME = 24, 60
# About what the automatic exposure of the preset comes to.
EV100 = 13.0
SAMPLES = 12
# Changes to the scene file, by the text that they replace.
BY_HAND = {"exposure: Auto(compensation_ev: 0.3)": f"exposure: Manual(ev100: {EV100})"}
CLEAR = {"haze: (visibility_m: 900.0, depth_m: 30.0)": "haze: (visibility_m: 100000.0, depth_m: 5.0)", "glare: (strength: 0.04)": "glare: (strength: 0.0)"}
# Candelas per square metre of a radiance of 1 in the stage.
CANDELAS = 32000.0


def edited(changes, path):
    """Writes the preset with changes."""
    text = (ROOT / "core/scenes/evening.ron").read_text()
    for old, new in changes.items():
        assert old in text, f"the preset has no '{old}'"
        text = text.replace(old, new)
    Path(path).write_text(text)
    return path


def ours(scene, path):
    """Draws the last of frames 0 to FRAME."""
    options = ["--size", "{}x{}".format(*SIZE), "--frames", str(FRAME + 1), "--fps", str(FPS)]
    subprocess.run([program, "render", scene, *options, "--out", path], check=True)


def blenders(scene, stage, path):
    subprocess.run([program, "export", scene, "--frames", f"{FRAME}..{FRAME}", "--fps", str(FPS), "--out", stage], check=True)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    addon.import_stage(bpy.context, stage, FRAME, FRAME, FPS)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising = SAMPLES, True
    # Light shines through many cut-out leaves in a row.
    scene.cycles.transparent_max_bounces = 64
    scene.render.resolution_x, scene.render.resolution_y = SIZE
    # White is a luminance of 1.2 · 2^EV100 cd/m² (saturation of ISO 12232 at ISO 100), which Blender's exposure, in stops, has to make 1.
    scene.view_settings.exposure = math.log2(CANDELAS / (1.2 * 2.0**EV100))
    scene.view_settings.view_transform, scene.view_settings.look = "AgX", "None"
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True)


def beside(names, path):
    """Joins pictures with gaps."""
    pixels = []
    for name in names:
        image = bpy.data.images.load(name)
        # As they are encoded, not decoded and encoded again.
        image.colorspace_settings.name = "Non-Color"
        pixels += [np.array(image.pixels).reshape(SIZE[1], SIZE[0], 4), np.ones((SIZE[1], 8, 4))]
    joined = np.concatenate(pixels[:-1], 1)
    image = bpy.data.images.new("joined", joined.shape[1], joined.shape[0])
    image.pixels = joined.ravel()
    image.file_format = "JPEG"
    image.save(filepath=path, quality=80)


with folder:
    inside = lambda name: os.path.join(folder.name, name)
    preset = edited(BY_HAND, inside("evening.ron"))
    pictures = [inside(f"{name}.png") for name in ("preset", "clear", "blender")]
    ours(preset, pictures[0])
    ours(edited(BY_HAND | CLEAR, inside("clear.ron")), pictures[1])
    blenders(preset, inside("stage.usda"), pictures[2])
    beside(pictures, str(ROOT / "docs/blender.jpg"))
