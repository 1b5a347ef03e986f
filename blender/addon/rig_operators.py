"""Operators that put an armature of empties on hair and take it off again."""

import secrets

import bpy
import tress
from bpy.props import BoolProperty, FloatProperty, IntProperty
from mathutils import Matrix, Vector

from . import hair, rig
from .hair_operator import HairOperator


class TRESS_OT_armature_add(HairOperator, bpy.types.Operator):
    """Put a chain of empties on each wisp: move, turn or scale them and the hair follows"""

    bl_idname = "tress.armature_add"
    bl_label = "Add Armature"

    clusters: IntProperty(name="Wisps", description="Clusters of strands", default=8, min=1)
    joints: IntProperty(name="Joints", description="Empties a wisp", default=3, min=1, max=12)
    stiffness: FloatProperty(
        name="Stiffness",
        description="What bending costs: 0 follows the empties exactly, 1 hardly bends",
        default=1e-4,
        min=0.0,
        soft_max=1.0,
        precision=5,
    )

    @classmethod
    def poll(cls, context):
        return super().poll(context) and not rig.joints(context.object)

    def run(self, context, obj):
        polylines = hair.groom(obj)
        helices, _report = hair.fitted(polylines)
        if not len(helices):
            raise tress.TressError("the hair has no strands")
        clusters = min(self.clusters, len(helices))
        lengths = [(i + 1) / self.joints for i in range(self.joints)]
        pose = tress.armature(helices, clusters=clusters, lengths=lengths)
        groups = tress.groups(helices, clusters=clusters)
        hair.keep_original(obj)
        hair.set_vectors(obj.data, hair.REST, polylines.positions)
        hair.set_numbers(obj.data, rig.CLUSTER, groups.astype("int32"))
        obj[rig.STAMP] = secrets.token_hex(8)
        obj[rig.STIFFNESS] = self.stiffness
        collection = bpy.data.collections.new(f"{obj.name} Armature")
        context.collection.children.link(collection)
        for group in pose["groups"]:
            add_chain(obj, group, collection)
        context.view_layer.update()
        return f"{len(pose['groups'])} wisps of {self.joints} joints"


def add_chain(obj, group, collection):
    """The empties of one cluster, each the child of the one nearer the root."""
    parent, before = obj, Matrix()
    size = joint_size(group)
    for number, joint in enumerate(group["joints"]):
        axes = Matrix([Vector(axis) for axis in joint["axes"]]).transposed()
        rest = Matrix.Translation(joint["center"]) @ axes.to_4x4()
        name = f"{obj.name} {group['select']['Cluster']}.{number}"
        empty = bpy.data.objects.new(name, None)
        empty.empty_display_type = "SPHERE" if number + 1 < len(group["joints"]) else "CUBE"
        empty.empty_display_size = size
        empty.show_in_front = True
        empty.parent = parent
        empty.matrix_basis = before.inverted() @ rest
        empty.tress_joint.hair = obj
        empty.tress_joint.cluster = group["select"]["Cluster"]
        empty.tress_joint.at = joint["at"]
        empty.tress_joint.rest = [value for row in rest.transposed() for value in row]
        collection.objects.link(empty)
        parent, before = empty, rest


def joint_size(group):
    """A radius at which joints are seen beside the hair: a tenth of the chain's length."""
    centers = [Vector(joint["center"]) for joint in group["joints"]]
    reach = max(((center - centers[0]).length for center in centers), default=0.0)
    return 0.1 * reach or 0.05


class TRESS_OT_armature_update(HairOperator, bpy.types.Operator):
    """Move the hair to where its empties are, after undo or when something else moved them"""

    bl_idname = "tress.armature_update"
    bl_label = "Update from Armature"

    @classmethod
    def poll(cls, context):
        return super().poll(context) and bool(rig.joints(context.object))

    def run(self, _context, obj):
        rig.forget(obj)
        report = rig.drag(obj)
        distance = report["greatest_anchor_distance"]
        return f"{report['moved']} strands moved; anchors missed by {distance:.3g} at most"


class TRESS_OT_armature_remove(HairOperator, bpy.types.Operator):
    """Take the armature off; the hair stays where it was sculpted to, or goes back to rest"""

    bl_idname = "tress.armature_remove"
    bl_label = "Remove Armature"

    apply: BoolProperty(name="Apply", description="Keep the sculpted shape", default=True)

    @classmethod
    def poll(cls, context):
        return super().poll(context) and bool(rig.joints(context.object))

    def run(self, _context, obj):
        points = hair.vectors(obj.data, hair.REST)
        if not self.apply and points is not None:
            hair.move(obj, points)
        collections = set()
        for empty in rig.joints(obj):
            collections.update(empty.users_collection)
            bpy.data.objects.remove(empty)
        for collection in collections:
            if not collection.all_objects and collection.name.startswith(obj.name):
                bpy.data.collections.remove(collection)
        for name in (hair.REST, rig.CLUSTER):
            if name in obj.data.attributes:
                obj.data.attributes.remove(obj.data.attributes[name])
        for name in (rig.STAMP, rig.STIFFNESS):
            obj.pop(name, None)
        rig.forget(obj)


CLASSES = (TRESS_OT_armature_add, TRESS_OT_armature_update, TRESS_OT_armature_remove)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
