"""The panel in the sidebar of the 3D viewport."""

import json

import bpy

from . import cache, edits, hair, rig


class TRESS_PT_panel(bpy.types.Panel):
    """What Tress does to the active hair"""

    bl_label = "Tress"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Tress"

    def draw(self, context):
        layout, obj = self.layout, context.object
        if obj is None or obj.type != "CURVES":
            layout.label(text="Select hair curves", icon="INFO")
            layout.operator("tress.import_groom", icon="IMPORT")
            return
        if not hair.is_hair(obj):
            layout.label(text="Leave for Object Mode", icon="INFO")
        if cache.is_played(obj):
            layout.label(text=f"Frames of {obj.tress_cache.path}", icon="FILE_CACHE")
            layout.operator("tress.cache_stop", icon="X")
        layout.operator("tress.fit", icon="CURVES")
        draw_report(layout, obj)
        column = layout.column(align=True)
        column.label(text="Edit")
        column.operator("tress.ruffle")
        column.operator("tress.recoil")
        column.operator("tress.blend")
        column.operator("tress.switchback")
        column.operator("tress.restore", icon="LOOP_BACK")
        column = layout.column(align=True)
        column.label(text="Sculpt")
        if rig.joints(obj):
            column.operator("tress.armature_update", icon="FILE_REFRESH")
            column.operator("tress.armature_remove", text="Apply", icon="CHECKMARK").apply = True
            column.operator("tress.armature_remove", text="Discard", icon="X").apply = False
        else:
            column.operator("tress.armature_add", icon="EMPTY_AXIS")
        layout.operator("tress.grow", icon="OUTLINER_OB_CURVES")
        layout.operator("tress.color", icon="COLOR")


def draw_report(layout, obj):
    """What the last fit came to, in a few lines."""
    text = obj.get(edits.REPORT)
    if text is None:
        return
    report = json.loads(text)
    summary = report["summary"]
    box = layout.box().column(align=True)
    box.label(text=f"{report['strands']} strands, {report['elements']} elements")
    of_radius = 100 * report["rms_of_radius"]
    box.label(text=f"Distance: rms {report['rms']:.3g}, greatest {report['greatest']:.3g}")
    if of_radius:
        box.label(text=f"rms {of_radius:.2g} % of the coil radius")
    for reason, count in report["kept"].items():
        box.label(text=f"{count} strands {reason} as they are", icon="ERROR")
    if summary["coil_radius"]:
        radius, turns = summary["coil_radius"]["median"], summary["turns"]["median"]
        box.label(text=f"Coils: radius {radius:.3g}, {turns:.3g} turns")
    right, left = summary["right_handed"], summary["left_handed"]
    box.label(text=f"Hands: {right} right, {left} left")


def register():
    bpy.utils.register_class(TRESS_PT_panel)


def unregister():
    bpy.utils.unregister_class(TRESS_PT_panel)
