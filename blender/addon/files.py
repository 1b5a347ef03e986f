"""Grooms from and to the files that tress knows, animated ones included."""

import os

import bpy
import numpy as np
import tress
from bpy.props import BoolProperty, FloatProperty, StringProperty
from bpy_extras.io_utils import ExportHelper, ImportHelper

from . import cache, columns, hair

READ = "*.obj;*.hair;*.data;*.bin;*.ply;*.tfx;*.npy;*.npz;*.usda;*.usdc;*.usd;*.abc;*.tress"
WRITTEN = "*.obj;*.hair;*.data;*.bin;*.ply;*.tfx;*.npy;*.npz;*.usda;*.usdc;*.abc;*.tress"


class TRESS_OT_import(bpy.types.Operator, ImportHelper):
    """Import a groom as hair curves; the frames of an animated file are played back"""

    bl_idname = "tress.import_groom"
    bl_label = "Import Groom"
    bl_options = {"REGISTER", "UNDO"}

    filter_glob: StringProperty(default=READ, options={"HIDDEN"})
    scale: FloatProperty(
        name="Scale",
        description="Factor, where the file does not say what unit it is in",
        default=1.0,
        min=1e-6,
    )
    z_up: BoolProperty(
        name="Z Up",
        description="Take Z for up where the file does not say; else Y is turned to Z",
        default=False,
    )

    def execute(self, context):
        try:
            frames = opened(self.filepath)
            first = frames[0]
        except (tress.TressError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        groom, scale = cache.in_scene(first, context.scene, self.scale, self.z_up)
        name = os.path.splitext(os.path.basename(self.filepath))[0]
        obj = hair.new_object(context, name, groom)
        columns.to_curves(obj.data, groom, scale)
        words = f"{len(groom)} strands imported"
        if 1 < len(frames):
            obj.tress_cache.path = self.filepath
            obj.tress_cache.start = round(frames.start)
            obj.tress_cache.scale, obj.tress_cache.z_up = self.scale, self.z_up
            cache.before_frame(context.scene)
            words += f", {len(frames)} frames"
        for other in context.selected_objects:
            other.select_set(False)
        obj.select_set(True)
        context.view_layer.objects.active = obj
        empty = len(first) - len(groom)
        lost = f"; {empty} strands without points left out" if empty else ""
        self.report({"INFO"}, words + lost)
        return {"FINISHED"}


def opened(path):
    """The grooms of a file, one a frame; super-helices are sampled."""
    if path.endswith(".tress"):
        return [tress.sample(tress.read(path))]
    return tress.Animation(path)


class TRESS_OT_export(bpy.types.Operator, ExportHelper):
    """Export the active hair curves, in the space of the world"""

    bl_idname = "tress.export_groom"
    bl_label = "Export Groom"

    filename_ext = ".npz"
    check_extension = None
    filter_glob: StringProperty(default=WRITTEN, options={"HIDDEN"})

    animation: BoolProperty(
        name="Animation",
        description="All frames of the scene, to an .abc or .usdc file",
        default=False,
    )

    @classmethod
    def poll(cls, context):
        return hair.is_hair(context.object)

    def execute(self, context):
        obj, scene = context.object, context.scene
        now = scene.frame_current
        try:
            if self.animation:
                grooms = []
                for frame in range(scene.frame_start, scene.frame_end + 1):
                    scene.frame_set(frame)
                    grooms.append(evaluated(context, obj))
                rate = scene.render.fps / scene.render.fps_base
                options = {"start": scene.frame_start, "rate": rate}
                lost = tress.write_animation(self.filepath, grooms, **options)
                words = f"{len(grooms[0])} strands exported, {len(grooms)} frames"
            else:
                groom = evaluated(context, obj)
                words = f"{len(groom)} strands exported"
                if self.filepath.endswith(".tress"):
                    groom, _report = tress.fit(groom)
                lost = tress.write(self.filepath, groom)
        except (tress.TressError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        finally:
            if self.animation:
                scene.frame_set(now)
        words += f"; the format has no place for {', '.join(lost)}" if lost else ""
        self.report({"INFO"}, words)
        return {"FINISHED"}


def evaluated(context, obj):
    """The groom of an object on the scene's frame, modifiers applied, in the space of the world."""
    seen = obj.evaluated_get(context.evaluated_depsgraph_get())
    curves = seen.data if len(seen.data.curves) else obj.data
    matrix = np.array(seen.matrix_world)
    points = hair.positions(curves) @ matrix[:3, :3].T + matrix[:3, 3]
    unit = context.scene.unit_settings.scale_length
    groom = tress.Groom(points, hair.offsets(curves), unit=unit, up="z")
    of_points, of_strands = columns.of_curves(curves, abs(np.linalg.det(matrix[:3, :3])) ** (1 / 3))
    return groom.with_attributes(point=of_points, strand=of_strands)


def import_entry(menu, _context):
    menu.layout.operator(TRESS_OT_import.bl_idname, text="Groom (Tress)")


def export_entry(menu, _context):
    menu.layout.operator(TRESS_OT_export.bl_idname, text="Groom (Tress)")


def register():
    bpy.utils.register_class(TRESS_OT_import)
    bpy.utils.register_class(TRESS_OT_export)
    bpy.types.TOPBAR_MT_file_import.append(import_entry)
    bpy.types.TOPBAR_MT_file_export.append(export_entry)


def unregister():
    bpy.types.TOPBAR_MT_file_export.remove(export_entry)
    bpy.types.TOPBAR_MT_file_import.remove(import_entry)
    bpy.utils.unregister_class(TRESS_OT_export)
    bpy.utils.unregister_class(TRESS_OT_import)
