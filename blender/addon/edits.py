"""Operators that fit hair and change its shape, each a step that can be undone and adjusted."""

import json

import bpy
import numpy as np
import tress
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty

from . import colors, hair
from .hair_operator import ELEMENTS, SEED, HairOperator

#: The fit's report on an object, as the panel shows it.
REPORT = "tress_fit"


class TRESS_OT_fit(HairOperator, bpy.types.Operator):
    """Fit super-helices to the hair and say how near they are; nothing moves"""

    bl_idname = "tress.fit"
    bl_label = "Fit"

    elements: IntProperty(**ELEMENTS)
    color: BoolProperty(
        name="Show Error",
        description="Write the distance of each point to the fit as the attribute tress_error",
        default=True,
    )

    def run(self, _context, obj):
        polylines = hair.groom(obj)
        helices, report = hair.fitted(polylines, self.elements)
        obj[REPORT] = json.dumps({**report, "summary": tress.summarize(helices)})
        if self.color:
            again = tress.sample(helices, counts=polylines.counts)
            error = np.linalg.norm(again.positions - polylines.positions, axis=1)
            hair.set_numbers(obj.data, "tress_error", error)
        kept = sum(report["kept"].values())
        words = f"{report['strands']} strands fitted: rms {report['rms']:.3g}"
        return words + (f"; {kept} are no curves and stay as they are" if kept else "")


class TRESS_OT_ruffle(HairOperator, bpy.types.Operator):
    """Let strands of a wisp exchange pieces of curl: frizz that keeps the coils what they are"""

    bl_idname = "tress.ruffle"
    bl_label = "Ruffle"
    moves_hair = True

    probability: FloatProperty(
        name="Probability",
        description="Chance of a piece to be replaced",
        default=0.05,
        min=0.0,
        max=1.0,
        subtype="FACTOR",
    )
    root: FloatProperty(
        name="Keep Root",
        description="Share of the strand at the root that is never replaced",
        default=0.33,
        min=0.0,
        max=1.0,
        subtype="FACTOR",
    )
    blend: FloatProperty(name="Blend", default=1.0, min=0.0, max=1.0, subtype="FACTOR")
    clusters: IntProperty(
        name="Wisps",
        description="Strands exchange pieces within this many clusters; 0 is all with all",
        default=0,
        min=0,
    )
    seed: IntProperty(**SEED)
    elements: IntProperty(**ELEMENTS)

    def run(self, _context, obj):
        def edit(helices):
            groups = hair.wisps(helices, self.clusters, self.seed)
            keep = round(self.root * int(helices.counts.max(initial=0)))
            options = {"probability": self.probability, "keep": keep, "blend": self.blend}
            return tress.ruffle(helices, groups, seed=self.seed, **options)

        done = hair.with_edit(obj, self.elements, edit)
        return f"{done['replaced']} of {done['candidates']} pieces replaced"


class TRESS_OT_recoil(HairOperator, bpy.types.Operator):
    """Make coils tighter or looser, wider or narrower"""

    bl_idname = "tress.recoil"
    bl_label = "Recoil"
    moves_hair = True

    radius: FloatProperty(name="Radius", description="Factor", default=1.0, min=0.01, soft_max=3.0)
    frequency: FloatProperty(
        name="Frequency",
        description="Factor of the turns in a length of axis",
        default=1.0,
        min=0.01,
        soft_max=3.0,
    )
    keep: EnumProperty(
        name="Keep",
        items=[
            ("centerline", "Centerline", "Strands wind about the lines that they wound about"),
            ("length", "Length", "Strands are as long as they were; turns follow"),
            ("turns", "Turns", "Strands turn as often as they did; lengths follow"),
        ],
        default="centerline",
    )
    elements: IntProperty(**ELEMENTS)

    def run(self, _context, obj):
        options = {"radius": self.radius, "frequency": self.frequency, "keep": self.keep}
        hair.with_edit(obj, self.elements, lambda helices: (tress.recoil(helices, **options), None))


class TRESS_OT_blend(HairOperator, bpy.types.Operator):
    """Blend the active hair with another selected one of as many strands, or with its original"""

    bl_idname = "tress.blend"
    bl_label = "Blend"
    moves_hair = True

    amount: FloatProperty(name="Amount", default=0.5, soft_min=0.0, soft_max=1.0, subtype="FACTOR")
    space: EnumProperty(
        name="Space",
        items=[
            ("curvature", "Curvature", "A coil between two coils is a coil"),
            ("darboux", "Darboux", "World rotation; opposite bends cancel"),
            ("position", "Position", "Points; opposite bends cancel"),
        ],
    )
    elements: IntProperty(**ELEMENTS)

    def run(self, context, obj):
        others = [other for other in context.selected_objects if other != obj]
        others = [other for other in others if other.type == "CURVES"]
        a = hair.groom(obj)
        if others:
            b = in_space_of(obj, others[0])
        elif (points := hair.original(obj)) is not None:
            b = hair.groom(obj, points)
        else:
            raise tress.TressError("select a second hair to blend with")
        if self.space == "position":
            blended = tress.blend(a, b, self.amount, space="position")
        else:
            # Strands of other counts correspond when both have as many elements.
            differ = not np.array_equal(a.counts, b.counts)
            elements = self.elements or (int(a.counts.max(initial=2)) - 1 if differ else 0)
            helices, others = (hair.fitted(groom, elements)[0] for groom in (a, b))
            mixed = tress.blend(helices, others, self.amount, space=self.space)
            blended = tress.sample(mixed, counts=a.counts)
        hair.keep_original(obj)
        hair.move(obj, blended.positions)


def in_space_of(obj, other):
    """The groom of another object in the space of this one."""
    matrix = np.array(obj.matrix_world.inverted_safe() @ other.matrix_world)
    points = hair.positions(other.data) @ matrix[:3, :3].T + matrix[:3, 3]
    return hair.groom(other, points)


class TRESS_OT_switchback(HairOperator, bpy.types.Operator):
    """Let coils change hands: wisp by wisp, from there on they wind the other way"""

    bl_idname = "tress.switchback"
    bl_label = "Switchbacks"
    moves_hair = True

    count: IntProperty(name="Number", description="Switchbacks a strand", default=1, min=1)
    scatter: BoolProperty(
        name="At Random",
        description="At random places with this number on average, instead of evenly spaced ones",
        default=False,
    )
    clusters: IntProperty(
        name="Wisps",
        description="Strands of a wisp change hands at the same places; 0 is all together",
        default=8,
        min=0,
    )
    seed: IntProperty(**SEED)
    elements: IntProperty(**ELEMENTS)

    def run(self, _context, obj):
        def edit(helices):
            groups = hair.wisps(helices, self.clusters, self.seed)
            if self.scatter:
                length = tress.summarize(helices)["length"]
                where = {"density": self.count / length["median"] if length else 0.0}
            else:
                where = {"shares": [(i + 1) / (self.count + 1) for i in range(self.count)]}
            return tress.insert_switchbacks(helices, groups, seed=self.seed, **where)

        done = hair.with_edit(obj, self.elements, edit)
        words = f"{len(done['placed'])} switchbacks on {done['strands']} strands"
        refused = done["no_room"] + done["no_coil"]
        return words + (f"; {refused} places have no room or no coil" if refused else "")


class TRESS_OT_restore(HairOperator, bpy.types.Operator):
    """Put the hair back to where it was before the first edit"""

    bl_idname = "tress.restore"
    bl_label = "Restore Original"
    moves_hair = True

    @classmethod
    def poll(cls, context):
        return super().poll(context) and hair.ORIGINAL in context.object.data.attributes

    def run(self, _context, obj):
        points = hair.original(obj)
        if points is None:
            raise tress.TressError(f"{hair.ORIGINAL} is no attribute of positions")
        hair.move(obj, points)
        colors.give_back_material(obj)


CLASSES = (
    TRESS_OT_fit,
    TRESS_OT_ruffle,
    TRESS_OT_recoil,
    TRESS_OT_blend,
    TRESS_OT_switchback,
    TRESS_OT_restore,
)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
    hair.forget_fits()
