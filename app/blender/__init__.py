# SPDX-FileCopyrightText: The Windfall authors
# SPDX-License-Identifier: MIT OR Apache-2.0
"""File > Import > Windfall scene: has the program export a stretch of a scene as a USD stage, and imports that."""

import math
import os

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty

from .program import Export

# Blender's importer multiplies the strength of suns by this, but a sun of strength E lights a surface with E.
SUN_FACTOR = 4.0
# Light that leaves let through, as a share of what they reflect: about the mean of maples (0.53), birches (0.82) and beeches (0.55) in Windfall's
# own pictures.
TRANSMITTED = 0.6
# Time between two looks at the program.
TICK_S = 0.1


class WindfallPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    program: StringProperty(
        name="Program",
        description="The windfall program: a path, or a name that is found on the system's path",
        subtype="FILE_PATH",
        default="windfall",
    )

    def draw(self, _context):
        self.layout.prop(self, "program")


class ImportWindfall(bpy.types.Operator):
    """Simulate a stretch of a Windfall scene and import leaves, trees, ground, camera and light"""

    bl_idname = "import_scene.windfall"
    bl_label = "Import Windfall scene"
    bl_options = {"REGISTER", "UNDO"}

    filepath: StringProperty(subtype="FILE_PATH", options={"HIDDEN", "SKIP_SAVE"})
    filter_glob: StringProperty(default="*.ron", options={"HIDDEN"})
    scene: StringProperty(name="Preset", description="Preset, or path of a scene, that is imported if no file is chosen", default="autumn-park")
    first: IntProperty(name="First frame", description="Frame 0 shows the scene as it begins", default=0, min=0)
    last: IntProperty(name="Last frame", default=120, min=0)
    fps: FloatProperty(name="Frames per second", default=24.0, min=1.0, max=1000.0, precision=3)
    seed: IntProperty(name="Seed", description="Seed of everything random; -1 is the scene's own", default=-1, min=-1)
    leaves: IntProperty(name="Leaves", description="Number of leaves; 0 is the scene's own", default=0, min=0)
    backend: EnumProperty(
        name="Backend",
        items=[
            ("auto", "Automatic", "The graphics adapter if there is one, else the processor"),
            ("cpu", "Processor", "Threads of the processor"),
            ("wgpu", "Graphics adapter", "A graphics adapter, real or software"),
        ],
    )
    allow_outside: BoolProperty(name="Files outside", description="Let the scene name files outside its own folder")
    folder: StringProperty(
        name="Folder",
        description="Where the stage is kept, since Blender reads leaves from it frame by frame. Without one it lies beside the saved "
        "file, or else in Blender's temporary folder, which is gone at its end",
        subtype="DIR_PATH",
    )

    _export = None
    _timer = None

    def invoke(self, context, _event):
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context):
        if self.last < self.first:
            self.report({"ERROR"}, f"the last frame, {self.last}, comes before the first, {self.first}")
            return {"CANCELLED"}
        preferences = context.preferences.addons[__package__].preferences
        try:
            self._export = Export(bpy.path.abspath(preferences.program), self._scene(), self._options(), self._parent())
        except OSError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        # Without windows there are no events to wait for.
        if bpy.app.background:
            self._export.wait()
            return self._finish(context)
        self._timer = context.window_manager.event_timer_add(TICK_S, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC":
            self.cancel(context)
            self.report({"INFO"}, "the import of the Windfall scene is cancelled")
            return {"CANCELLED"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        if self._export.is_running():
            found = self._export.progress()
            done = "{} {} of {}".format(*found) if found else "working"
            context.workspace.status_text_set(f"Windfall: {done} (Esc cancels)")
            return {"PASS_THROUGH"}
        self._end_modal(context)
        return self._finish(context)

    def cancel(self, context):
        """Ends the program. Blender calls this too: when it quits, and when no file is chosen, before there is a program."""
        if self._export:
            self._end_modal(context)
            self._export.cancel()

    def _end_modal(self, context):
        context.window_manager.event_timer_remove(self._timer)
        context.workspace.status_text_set(None)

    def _scene(self):
        scene = self.filepath if os.path.isfile(self.filepath) else bpy.path.abspath(self.scene)
        return os.path.abspath(scene) if scene.endswith(".ron") else scene

    def _options(self):
        options = [("--frames", f"{self.first}..{self.last}"), ("--fps", f"{self.fps:g}")]
        if self.seed >= 0:
            options.append(("--seed", self.seed))
        if self.leaves > 0:
            options.append(("--leaves", self.leaves))
        if self.backend != "auto":
            options.append(("--backend", self.backend))
        if self.allow_outside:
            options.append(("--allow-outside",))
        return options

    def _parent(self):
        """Folder of the folder of the stage."""
        return bpy.path.abspath(self.folder or ("//" if bpy.data.is_saved else bpy.app.tempdir))

    def _finish(self, context):
        if error := self._export.error():
            self._export.discard()
            self.report({"ERROR"}, error)
            return {"CANCELLED"}
        import_stage(context, str(self._export.stage), self.first, self.last, self.fps)
        if not (self.folder or bpy.data.is_saved):
            self.report({"WARNING"}, f"leaves are read from {self._export.folder}, which is gone when Blender ends; save the file first, or choose a folder")
        return {"FINISHED"}


def import_stage(context, path, first, last, fps):
    """Imports a stage as the scene means it: with its rate, range, camera, sky, the strength of its sun, and leaves that shine against the light."""
    scene = context.scene
    # The sky becomes the world's background, and is left out where there is no world.
    if scene.world is None:
        scene.world = bpy.data.worlds.new("World")
    scene.render.fps = math.ceil(fps)
    scene.render.fps_base = scene.render.fps / fps
    objects, materials = set(bpy.data.objects), set(bpy.data.materials)
    bpy.ops.wm.usd_import(filepath=path, create_collection=True)
    for material in set(bpy.data.materials) - materials:
        if material.name.startswith("leaf_"):
            let_light_through(material)
    for item in set(bpy.data.objects) - objects:
        if item.type == "LIGHT":
            item.data.energy /= SUN_FACTOR
        if item.type == "CAMERA":
            scene.camera = item
    scene.frame_start, scene.frame_end = first, last
    scene.frame_set(first)


def let_light_through(material):
    """Adds light from behind to a leaf, which preview surfaces of USD have no word for."""
    nodes, links = material.node_tree.nodes, material.node_tree.links
    surface = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    output = next(node for node in nodes if node.type == "OUTPUT_MATERIAL")
    color, alpha = (surface.inputs[name].links[0].from_socket for name in ("Base Color", "Alpha"))
    # Nothing where the picture is cut out.
    share, dimmed = nodes.new("ShaderNodeMath"), nodes.new("ShaderNodeVectorMath")
    share.operation, dimmed.operation = "MULTIPLY", "SCALE"
    share.inputs[1].default_value = TRANSMITTED
    through, both = nodes.new("ShaderNodeBsdfTranslucent"), nodes.new("ShaderNodeAddShader")
    links.new(alpha, share.inputs[0])
    links.new(color, dimmed.inputs["Vector"])
    links.new(share.outputs["Value"], dimmed.inputs["Scale"])
    links.new(dimmed.outputs["Vector"], through.inputs["Color"])
    links.new(surface.outputs["BSDF"], both.inputs[0])
    links.new(through.outputs["BSDF"], both.inputs[1])
    links.new(both.outputs["Shader"], output.inputs["Surface"])


def menu(self, _context):
    self.layout.operator(ImportWindfall.bl_idname, text="Windfall scene (.ron or preset)")


CLASSES = (WindfallPreferences, ImportWindfall)


def register():
    for kind in CLASSES:
        bpy.utils.register_class(kind)
    bpy.types.TOPBAR_MT_file_import.append(menu)


def unregister():
    bpy.types.TOPBAR_MT_file_import.remove(menu)
    for kind in reversed(CLASSES):
        bpy.utils.unregister_class(kind)
