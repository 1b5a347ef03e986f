"""Grooms from and to the files that tress knows."""

import os

import bpy
import numpy as np
import tress
from bpy.props import BoolProperty, FloatProperty, StringProperty
from bpy_extras.io_utils import ExportHelper, ImportHelper

from . import hair

READ = "*.obj;*.hair;*.data;*.bin;*.ply;*.tfx;*.npy;*.npz;*.usda;*.usdc;*.usd;*.abc;*.tress"
WRITTEN = "*.obj;*.hair;*.data;*.bin;*.ply;*.tfx;*.npy;*.npz;*.usda;*.usdc;*.abc;*.tress"


class TRESS_OT_import(bpy.types.Operator, ImportHelper):
    """Import a groom as hair curves"""

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
            groom = tress.read(self.filepath)
            if isinstance(groom, tress.HelixGroom):
                groom = tress.sample(groom)
        except (tress.TressError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        up = groom.up or ("z" if self.z_up else "y")
        groom = groom.in_space(groom.unit, up).turned_up("z")
        metres = context.scene.unit_settings.scale_length
        scale = self.scale if groom.unit is None else groom.unit / metres
        name = os.path.splitext(os.path.basename(self.filepath))[0]
        obj = hair.new_object(context, name, groom.with_positions(groom.positions * scale))
        for attribute, values in groom.strand_attributes.items():
            if values.ndim == 1 and (groom.counts > 0).all():
                hair.set_numbers(obj.data, attribute, values)
        empty = int(np.count_nonzero(groom.counts == 0))
        for other in context.selected_objects:
            other.select_set(False)
        obj.select_set(True)
        context.view_layer.objects.active = obj
        lost = f"; {empty} strands without points left out" if empty else ""
        self.report({"INFO"}, f"{len(groom) - empty} strands imported{lost}")
        return {"FINISHED"}


class TRESS_OT_export(bpy.types.Operator, ExportHelper):
    """Export the active hair curves, in the space of the world"""

    bl_idname = "tress.export_groom"
    bl_label = "Export Groom"

    filename_ext = ".npz"
    check_extension = None
    filter_glob: StringProperty(default=WRITTEN, options={"HIDDEN"})

    @classmethod
    def poll(cls, context):
        return hair.is_hair(context.object)

    def execute(self, context):
        obj = context.object
        matrix = np.array(obj.matrix_world)
        points = hair.positions(obj.data) @ matrix[:3, :3].T + matrix[:3, 3]
        try:
            groom = hair.groom(obj, points)
            if self.filepath.endswith(".tress"):
                groom, _report = tress.fit(groom)
            lost = tress.write(self.filepath, groom)
        except (tress.TressError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        words = f"; the format has no place for {', '.join(lost)}" if lost else ""
        self.report({"INFO"}, f"{len(groom)} strands exported{words}")
        return {"FINISHED"}


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
