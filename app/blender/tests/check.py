# SPDX-FileCopyrightText: The Windfall authors
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Installs the add-on into a Blender without windows, as its zip file, and imports scenes with it; see scripts/check-blender."""

import os
import subprocess
import sys
import time
import zipfile
from pathlib import Path
from types import MethodType, SimpleNamespace

program, folder = sys.argv[1:]
folder = Path(folder) / "add-on"
folder.mkdir()
# Blender asks where the user's files are when it is loaded.
os.environ["BLENDER_USER_RESOURCES"] = str(folder / "user")
ROOT = Path(__file__).parents[3]
sys.path.append(str(ROOT / "scripts"))

import bpy
# Found once Blender is loaded.
import addon_utils
import check_blender

SCENE = ["flight-lab", "--seed", "5", "--frames", "10..30", "--fps", "30", "--backend", "cpu"]


def install():
    """Installs and enables the add-on; its module."""
    archive = folder / "windfall.zip"
    with zipfile.ZipFile(archive, "w") as file:
        for name in ("blender_manifest.toml", "__init__.py", "program.py"):
            file.write(ROOT / "app/blender" / name, name)
    addon_utils.enable("bl_pkg")
    bpy.ops.extensions.package_install_files(filepath=str(archive), repo="user_default", enable_on_install=True)
    return sys.modules["bl_ext.user_default.windfall"]


def error_of(**options):
    """The error that an import ends with; what it has written must be gone."""
    parent = folder / "failed"
    parent.mkdir(exist_ok=True)
    try:
        bpy.ops.import_scene.windfall(folder=str(parent), **options)
    except RuntimeError as error:
        assert not list(parent.iterdir()), f"{list(parent.iterdir())} are left"
        assert len(bpy.data.objects) == 0, "nothing is imported"
        return str(error).strip().removeprefix("Error: ")
    raise AssertionError(f"{options} is no error")


def check_errors(preferences):
    preferences.program = str(folder / "no-such-program")
    line = error_of(scene="storm")
    assert "there is no program" in line and "no-such-program" in line, line
    preferences.program = program
    said = subprocess.run([program, "export", "no-such-scene", "--frames", "0..1", "--out", "none.usda"], capture_output=True, text=True)
    said = said.stderr.strip().splitlines()[-1].removeprefix("error: ")
    assert error_of(scene="no-such-scene", last=1) == said, "the line of the program"
    assert "comes before" in error_of(scene="storm", first=5, last=4)
    print(f"add-on: a missing program: {line}")
    print(f"add-on: a wrong scene: {said[:60]}...")


def check_preset():
    """Imports a preset into an empty scene and compares it with the table of the same frames."""
    parent = folder / "kept"
    parent.mkdir()
    # Not the factory settings, which have no add-on.
    bpy.ops.wm.read_homefile(use_empty=True)
    outcome = bpy.ops.import_scene.windfall(scene=SCENE[0], seed=5, first=10, last=30, fps=30.0, backend="cpu", folder=str(parent))
    assert outcome == {"FINISHED"}, outcome
    scene = bpy.context.scene
    assert (scene.frame_start, scene.frame_end, scene.frame_current) == (10, 30, 10), "the range of frames"
    assert (scene.render.fps, scene.render.fps_base) == (30, 1.0), "the rate of frames"
    assert scene.camera and scene.camera.name == "Camera", "the camera of the scene"
    csv = folder / "preset.csv"
    subprocess.run([program, "export", *SCENE, "--out", str(csv)], check=True, capture_output=True)
    table = check_blender.Table(csv)
    count, off, angle = check_blender.check_leaves(scene, table, table.frames)
    assert count > 100, f"only {count} leaves were there to compare"
    (stage,) = parent.glob("*/*.usda")
    said = check_blender.said_lights(stage)
    sun = next(light for light in bpy.data.lights if light.type == "SUN")
    strength = sun.energy * check_blender.np.array(sun.color)
    assert check_blender.np.allclose(strength, said["Sun"], rtol=1e-4), f"a sun of {strength}, not {said['Sun']}"
    leaves = [material for material in bpy.data.materials if material.name.startswith("leaf_")]
    through = [node for material in leaves for node in material.node_tree.nodes if node.type == "BSDF_TRANSLUCENT" and node.outputs[0].is_linked]
    assert leaves and len(through) == len(leaves), f"light goes through {len(through)} of {len(leaves)} kinds of leaves"
    # Frames that the table does not have must not pass.
    wrong = check_blender.Table(csv)
    wrong.frames = {frame: table.frames[min(frame + 5, 30)] for frame in table.frames}
    check_blender.must_fail("frames of other moments", check_blender.check_leaves, scene, wrong, [12])
    print(f"add-on: preset {SCENE[0]}: {count} leaves in {len(table.frames)} frames, at most {off:.1e} m off, turned by at most {angle:.3f} degrees, a sun of {sun.energy:.4f}")


def check_cancel(module):
    """Cancels an export that has begun."""
    parent = folder / "cancelled"
    parent.mkdir()
    export = module.Export(program, "storm", [("--frames", "0..100000"), ("--leaves", 2000), ("--backend", "cpu")], parent)
    end = time.monotonic() + 120.0
    while export.is_running() and (export.progress() is None or export.progress()[1] == 0) and time.monotonic() < end:
        time.sleep(0.05)
    assert export.is_running(), f"the export goes on: {export.error()}"
    what, done, count = export.progress()
    assert 0 < done < count, f"progress: {what} {done} of {count}"
    # The operator's own methods, with what a window would give them.
    texts = []
    context = SimpleNamespace(
        workspace=SimpleNamespace(status_text_set=texts.append), window_manager=SimpleNamespace(event_timer_remove=lambda _: None)
    )
    operator = SimpleNamespace(_export=export, _timer=None, report=lambda *_: None)
    for name in ("cancel", "_end_modal"):
        setattr(operator, name, MethodType(getattr(module.ImportWindfall, name), operator))
    press = lambda key: module.ImportWindfall.modal(operator, context, SimpleNamespace(type=key))
    assert press("TIMER") == {"PASS_THROUGH"} and f" of {count} (Esc cancels)" in texts[0], texts
    assert press("ESC") == {"CANCELLED"} and texts[-1] is None, texts
    assert not export.is_running(), "the program goes on"
    assert not list(parent.iterdir()), f"{list(parent.iterdir())} are left"
    print(f"add-on: cancelled at {what} {done} of {count}: the program has ended, and nothing is left")


bpy.ops.wm.read_factory_settings(use_empty=True)
module = install()
check_errors(bpy.context.preferences.addons[module.__name__].preferences)
check_preset()
check_cancel(module)
