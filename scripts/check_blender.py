# SPDX-FileCopyrightText: The Windfall authors
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Opens exports of `windfall export` in Blender and compares them with the table of the same frames; see check-blender."""

import csv
import json
import re
import shutil
import struct
import sys
from pathlib import Path

import bpy
import numpy as np
from mathutils import Vector
from mathutils.kdtree import KDTree

# Blender's reader of USD multiplies the strength of suns by this, but of no other light.
SUN_FACTOR = 4.0
# Intensity of a light in the stage for each klx.
INTENSITY_PER_KLX = 1.0 / 32.0
# Allowed differences: places in single precision, and orientations of instances, of which Blender reads those in half precision.
PLACE_M = 1e-5
TURN_DEG = 0.1
# Largest angle between the sun and the brightest place of the sky around it, of which a pixel is 3 degrees wide.
SKY_DEG = 10.0


def clear(fps):
    """An empty scene with a world, without which the sky would be left out."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.world = bpy.data.worlds.new("World")
    scene.render.fps = fps
    return scene


def z_up(y_up):
    """Vectors, a row each, in the axes of Blender."""
    x, y, z = np.asarray(y_up, float).T
    return np.stack([x, -z, y], 1)


class Table:
    """Leaves that are seen in each frame of a table: places, upper sides and tips, in slot order."""

    def __init__(self, path):
        frames = {}
        with open(path, newline="") as file:
            for row in csv.DictReader(file):
                rows = frames.setdefault(int(row["frame"]), [])
                if row["state"] != "dormant":
                    rows.append(row)
        self.frames = {frame: self._columns(rows) for frame, rows in frames.items()}
        self.slots = {frame: [int(row["leaf"]) for row in rows] for frame, rows in frames.items()}

    @staticmethod
    def _columns(rows):
        columns = lambda *names: np.array([[float(row[name]) for name in names] for row in rows])
        x, y, z, w = columns("qx", "qy", "qz", "qw").T
        upper = np.stack([2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)], 1)
        tip = np.stack([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)], 1)
        return z_up(columns("x_m", "y_m", "z_m")), z_up(upper), z_up(tip)


def compare(found, expected):
    """Compares matrices with places, upper sides and tips in the same order; greatest distance and angle."""
    places, *axes = expected
    assert len(found) == len(places), f"{len(found)} leaves, not {len(places)}"
    matrices = np.array([matrix for matrix, _, _ in found])
    off = np.abs(matrices[:, :3, 3] - places).max()
    assert off < PLACE_M, f"a leaf is {off} m off"
    angle = 0.0
    for at, axis in enumerate(axes):
        turned = np.array([(matrix.to_3x3() @ local[at]).normalized() for matrix, *local in found])
        # By the chord, since the cosine of a small angle is lost in rounding.
        chord = np.linalg.norm(turned - axis, axis=1).max()
        angle = max(angle, float(np.degrees(2.0 * np.arcsin(min(0.5 * chord, 1.0)))))
    assert angle < TURN_DEG, f"a leaf is turned by {angle} degrees"
    return off, angle


def usd_leaves():
    """Matrices of the instances of the stage's leaves with the local directions of their upper sides and tips."""
    graph = bpy.context.evaluated_depsgraph_get()
    return [
        (instance.matrix_world.copy(), Vector((0, 1, 0)), Vector((0, 0, 1)))
        for instance in graph.object_instances
        if instance.is_instance and instance.parent.name == "Leaves"
    ]


def open_stage(path, fps):
    scene = clear(fps)
    bpy.ops.wm.usd_import(filepath=str(path))
    return scene


def check_leaves(scene, table, frames):
    """Compares frames of a stage; the number of leaves, the greatest distance and angle."""
    count, worst, turned = 0, 0.0, 0.0
    for frame in frames:
        scene.frame_set(frame)
        off, angle = compare(usd_leaves(), table.frames[frame])
        count, worst, turned = count + len(table.slots[frame]), max(worst, off), max(turned, angle)
    return count, worst, turned


def corners(item):
    """Corners of a mesh as it is deformed now."""
    mesh = item.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    places = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", places)
    return places.reshape(-1, 3)


def check_trees(scene, frames):
    """Has an action of each armature move bark and berries; numbers of bones and corners, and how far they go."""
    skins = [item for item in bpy.data.objects if item.type == "MESH" and any(part.type == "ARMATURE" for part in item.modifiers)]
    assert len(skins) == 3, f"{len(skins)} skins, not those of two trees and of berries"
    before = []
    for frame in frames:
        scene.frame_set(frame)
        after, before = before, [corners(item) for item in skins]
    moved = [float(np.linalg.norm(a - b, axis=1).max()) for a, b in zip(after, before)]
    assert all(1e-4 < far < 1.0 for far in moved), f"bark and berries move by {moved} m"
    for armature in (item for item in bpy.data.objects if item.type == "ARMATURE"):
        assert armature.animation_data and armature.animation_data.action, f"{armature.name} has no action"
    return sum(len(armature.bones) for armature in bpy.data.armatures), sum(map(len, before)), max(moved)


def check_camera(scene, path):
    """Compares the eye of the camera with its keys in the scene, by frame."""
    camera = next(item for item in bpy.data.objects if item.type == "CAMERA")
    for frame, eye in path.items():
        scene.frame_set(frame)
        off = np.abs(np.array(camera.matrix_world.translation) - z_up([eye])[0]).max()
        assert off < PLACE_M, f"frame {frame}: the eye is {off} m off"


def check_particles(scene, path, name, population, frames):
    """Compares places and velocities of particles with their table; their number and the greatest distance."""
    rows = {frame: [] for frame in frames}
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            if row["population"] == population and int(row["frame"]) in rows:
                rows[int(row["frame"])].append([float(row[key]) for key in ("x_m", "y_m", "z_m", "vx_m_s", "vy_m_s", "vz_m_s")])
    count, worst = 0, 0.0
    for frame, expected in rows.items():
        scene.frame_set(frame)
        item = bpy.data.objects[name].evaluated_get(bpy.context.evaluated_depsgraph_get())
        attributes = item.data.attributes
        expected = np.array(expected)
        assert len(item.data.points) == len(expected), f"{len(item.data.points)} particles, not {len(expected)}"
        # In the axes of the file, as the object turns them.
        for attribute, columns in (("position", expected[:, :3]), ("velocity", expected[:, 3:])):
            found = np.array([entry.vector for entry in attributes[attribute].data])
            off = np.abs(found - columns).max()
            assert off < PLACE_M, f"frame {frame}: {attribute} is {off} off"
            worst = max(worst, off)
        count += len(expected)
    return count, worst


def said_lights(path):
    """What a stage says of its sun and its sky: intensity times colour."""
    text = path.with_name(path.stem + "_layers").joinpath("stage.usda").read_text()
    found = {}
    for name in ("Sun", "Sky"):
        light = text.split(f'Light "{name}"')[1].split("\n}")[0]
        assert "inputs:exposure" not in light, f"{name} has an exposure, which Blender ignores of skies"
        color = re.search(r"inputs:color = \((.*)\)", light)
        color = [float(part) for part in color[1].split(",")] if color else [1.0] * 3
        found[name] = float(re.search(r"inputs:intensity = (\S+)", light)[1]) * np.array(color)
    return found


def check_lights(said, glb):
    """Compares the strength of sun and sky with what the stage says, and that of the sun with the lux of the glTF file."""
    # Weights of luminance in linear sRGB.
    luminance = lambda color: float(np.dot(color, (0.2126, 0.7152, 0.0722)))
    sun = next(light for light in bpy.data.lights if light.type == "SUN")
    sun_strength = sun.energy * 2.0**sun.exposure * np.array(sun.color) / SUN_FACTOR
    background = next(node for node in bpy.context.scene.world.node_tree.nodes if node.type == "BACKGROUND")
    picture = background.inputs["Color"].links[0].from_node
    assert picture.type == "TEX_ENVIRONMENT" and tuple(picture.image.size) == (256, 128), "the sky is a picture"
    sky_strength = background.inputs["Strength"].default_value * np.ones(3)
    for name, strength in (("Sun", sun_strength), ("Sky", sky_strength)):
        assert np.allclose(strength, said[name], rtol=1e-4), f"{name}: {strength} is not {said[name]}"
    klx = glb["extensions"]["KHR_lights_punctual"]["lights"][0]["intensity"] / 1000.0
    assert abs(luminance(sun_strength) / (INTENSITY_PER_KLX * klx) - 1.0) < 1e-3, f"{klx} klx are not {sun_strength}"
    return klx, luminance(sun_strength), luminance(sky_strength)


def check_sky(scene, folder, to_sun):
    """Draws the world all around, and compares where it is brightest with the direction of the sun. The angle between them in degrees."""
    camera = bpy.data.objects.new("Around", bpy.data.cameras.new("Around"))
    camera.data.type, camera.data.panorama_type = "PANO", "EQUIRECTANGULAR"
    # Upright, towards +y, where nothing else is.
    camera.rotation_euler, camera.location = (np.pi / 2, 0.0, 0.0), (0.0, 0.0, 1000.0)
    scene.collection.objects.link(camera)
    before, scene.camera = scene.camera, camera
    width, height = 128, 64
    draw(scene, (width, height), 4, folder / "around.exr")
    pixels = np.array(bpy.data.images.load(scene.render.filepath).pixels).reshape(height, width, 4)[:, :, :3].sum(2)
    scene.camera = before
    bpy.data.objects.remove(camera)
    # Above the ground; rows begin at the bottom.
    pixels[: height // 2] = 0.0
    row, column = np.unravel_index(pixels.argmax(), pixels.shape)
    up, right = np.pi * ((row + 0.5) / height - 0.5), 2 * np.pi * ((column + 0.5) / width - 0.5)
    brightest = Vector((np.cos(up) * np.sin(right), np.cos(up) * np.cos(right), np.sin(up)))
    off = float(np.degrees(brightest.angle(to_sun)))
    assert off < SKY_DEG, f"the sky is brightest {off:.0f} degrees from the sun"
    return off


def direction_to_sun():
    """Direction to the sun of an imported stage."""
    sun = next(item for item in bpy.data.objects if item.type == "LIGHT" and item.data.type == "SUN")
    return sun.matrix_world.to_3x3() @ Vector((0, 0, 1))


def draw(scene, size, samples, path):
    """Draws a picture with Cycles."""
    scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", samples, False
    scene.render.resolution_x, scene.render.resolution_y = size
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)


def check_sunlight(folder):
    """Draws a white ground under a sun that stands above it, which shows that a strength is a light on the surface and not SUN_FACTOR times that."""
    scene = clear(24)
    scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.0
    bpy.ops.mesh.primitive_plane_add(size=100.0)
    white = bpy.data.materials.new("White")
    nodes = white.node_tree.nodes
    surface, output = nodes.new("ShaderNodeBsdfDiffuse"), next(node for node in nodes if node.type == "OUTPUT_MATERIAL")
    surface.inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
    white.node_tree.links.new(surface.outputs["BSDF"], output.inputs["Surface"])
    bpy.context.object.data.materials.append(white)
    bpy.ops.object.light_add(type="SUN", location=(0.0, 0.0, 5.0))
    bpy.context.object.data.energy = 2.0
    bpy.ops.object.camera_add(location=(0.0, 0.0, 5.0))
    scene.camera = bpy.context.object
    draw(scene, (8, 8), 16, folder / "white.exr")
    pixels = np.array(bpy.data.images.load(scene.render.filepath).pixels).reshape(-1, 4)[:, :3]
    assert np.allclose(pixels, 2.0 / np.pi, rtol=0.01), f"white ground under a sun of 2 is {pixels.mean()}, not 2 / pi"
    return float(pixels.mean() * np.pi)


def json_of(path):
    """The description in a binary glTF file."""
    data = path.read_bytes()
    return json.loads(data[20 : 20 + struct.unpack_from("<I", data, 12)[0]])


# The reader of glTF turns meshes too, so that the upper side is up in them.
GLTF_AXES = (Vector((0, 0, 1)), Vector((0, -1, 0)))


def open_gltf(path, fps):
    scene = clear(fps)
    bpy.ops.import_scene.gltf(filepath=str(path))
    return scene


def check_clip(scene, table):
    """Compares every frame of animated nodes; numbers of objects and places, greatest distance and angle."""
    leaves = {int(item.name[5:]): item for item in bpy.data.objects if item.name.startswith("leaf.")}
    seen = {slot for slots in table.slots.values() for slot in slots}
    assert set(leaves) == seen, f"{len(leaves)} objects for {len(seen)} leaves that are seen"
    first = min(table.frames)
    count, worst, turned = 0, 0.0, 0.0
    for frame, slots in table.slots.items():
        scene.frame_set(frame - first)
        off, angle = compare([(leaves[slot].matrix_world, *GLTF_AXES) for slot in slots], table.frames[frame])
        count, worst, turned = count + len(slots), max(worst, off), max(turned, angle)
    bones = sum(len(armature.bones) for armature in bpy.data.armatures)
    assert len(bpy.data.armatures) == 2 and bones > 10, f"two trees of {bones} bones"
    assert all(name in bpy.data.objects for name in ("Ground", "Water", "tree.1.fruit")), "ground, water and berries"
    assert bpy.data.cameras and bpy.data.images, "a camera and pictures"
    return len(leaves), count, worst, turned


def check_still(table, frame):
    """Compares a frame of instances, which come in another order; number, greatest distance and angle."""
    leaves = [item for item in bpy.data.objects if item.type == "MESH" and item.data.name.startswith("leaf_")]
    places, *axes = table.frames[frame]
    assert len(leaves) == len(places), f"{len(leaves)} instances, not {len(places)}"
    tree = KDTree(len(places))
    for at, place in enumerate(places):
        tree.insert(place, at)
    tree.balance()
    order = [tree.find(item.matrix_world.translation)[1] for item in leaves]
    assert len(set(order)) == len(order), "several instances at a place"
    off, angle = compare([(item.matrix_world, *GLTF_AXES) for item in leaves], [column[order] for column in (places, *axes)])
    return len(leaves), off, angle


def must_fail(what, check, *arguments):
    """A check that lets pass what is broken on purpose is no check."""
    try:
        check(*arguments)
    except AssertionError as error:
        print(f"broken on purpose: {what}: {error}")
    else:
        sys.exit(f"{what} is not reported")


def broken_copy(path):
    """A stage on its side, with the sky as bright as it were without its factor, and trees that stand still."""
    copy = path.with_name("broken.usda")
    layers, own = path.with_name(path.stem + "_layers"), copy.with_name("broken_layers")
    shutil.copytree(layers, own)
    copy.write_text(path.read_text().replace(layers.name, own.name).replace('upAxis = "Y"', 'upAxis = "Z"'))
    stage = (own / "stage.usda").read_text()
    head, sky = stage.split('DomeLight "Sky"')
    sky = re.sub(r"inputs:intensity = (\S+)", lambda found: f"inputs:intensity = {float(found[1]) / INTENSITY_PER_KLX}", sky, count=1)
    (own / "stage.usda").write_text(head + 'DomeLight "Sky"' + re.sub(r"rel skel:animationSource.*\n", "", sky))
    return copy


def main(folder):
    report = lambda what, count, off, angle: print(f"{what}: {count} leaves, at most {off:.1e} m off, turned by at most {angle:.3f} degrees")
    print(f"Blender {bpy.app.version_string}")
    short, table = folder / "short.usda", Table(folder / "short.csv")
    glb = json_of(folder / "still.glb")
    frames = sorted(table.frames)
    scene = open_stage(short, 30)
    assert (scene.frame_start, scene.frame_end) == (frames[0], frames[-1]), "the range of frames"
    report("USD, one layer, every third frame", *check_leaves(scene, table, frames[::3]))
    bones, vertices, moved = check_trees(scene, (frames[0], frames[-1]))
    print(f"USD, trees: {bones} bones, {vertices} corners of bark and berries, which move by up to {moved:.3f} m")
    # The keys of its scene.
    camera = {0: (0.0, 1.6, 9.0), 30: (1.0, 1.8, 8.0)}
    check_camera(scene, camera)
    particles = (scene, folder / "short_particles.csv", "hot_sparks", "hot sparks", frames[::10])
    print("USD, particles: {} places and velocities, at most {:.1e} off".format(*check_particles(*particles)))
    said = said_lights(short)
    klx, sun, sky = check_lights(said, glb)
    print(f"USD, lights: a sun of {klx:.2f} klx has a strength of {sun:.4f} (times {SUN_FACTOR:g} in Blender), the picture of the sky one of {sky:.4f}")
    to_sun = direction_to_sun()
    print(f"USD, sky: brightest {check_sky(scene, folder, to_sun):.1f} degrees from the sun")
    must_fail("a sky that is turned around", check_sky, scene, folder, Vector((-to_sun.x, -to_sun.y, to_sun.z)))

    print(f"Cycles: a sun of strength 2 lights a surface with {check_sunlight(folder):.4f}")

    long_table = Table(folder / "long.csv")
    long_frames = sorted(long_table.frames)
    clips = len(list((folder / "long_layers").glob("frames_*.usda")))
    assert clips > 1, "a long stage has value clips"
    report(f"USD, {clips} value clips, every fourth frame and the last", *check_leaves(open_stage(folder / "long.usda", 30), long_table, [*long_frames[::4], long_frames[-1]]))

    clip_table = Table(folder / "clip.csv")
    scene = open_gltf(folder / "clip.glb", 24)
    objects, *measured = check_clip(scene, clip_table)
    report(f"glTF, {objects} animated nodes, {len(clip_table.frames)} frames", *measured)
    flipped = Table(folder / "clip.csv")
    for places, upper, _ in flipped.frames.values():
        upper *= -1
    must_fail("leaves upside down in glTF", check_clip, scene, flipped)
    open_gltf(folder / "still.glb", 24)
    assert "EXT_mesh_gpu_instancing" in glb["extensionsRequired"], "instances"
    report("glTF, one frame of instances", *check_still(clip_table, 24))
    must_fail("another frame of instances", check_still, clip_table, 25)

    scene = open_stage(broken_copy(short), 30)
    must_fail("a stage on its side", check_leaves, scene, table, frames[-1:])
    must_fail("a camera on its side", check_camera, scene, camera)
    must_fail("particles of another population", check_particles, scene, *particles[1:3], "comets", frames[::10])
    must_fail("a sky without its factor", check_lights, said, glb)
    must_fail("trees that stand still", check_trees, scene, (frames[0], frames[-1]))


if __name__ == "__main__":
    main(Path(sys.argv[-1]))
