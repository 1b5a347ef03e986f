"""An armature of empties that moves hair while they are dragged.

At rest every cluster of strands has a chain of empties along it, children of the hair, each the
child of the one nearer the root. When one moves, its matrix in the hair's space against the one it
had at rest says where the points of its strands should go; a warm-started sculptor bends the
strands there, never stretching them.

All that is needed lives in the file: the rest positions and the clusters as attributes of the hair,
the rest matrices on the empties. Sculptors are made of them when they are needed and survive
neither undo nor loading, which is why they may be lost at any time.
"""

import bpy
import numpy as np
import tress
from bpy.app.handlers import persistent
from mathutils import Matrix

from . import hair

CLUSTER = "tress_cluster"

#: A stamp on the hair that changes with every new rest.
STAMP = "tress_rest_stamp"
STIFFNESS = "tress_stiffness"

#: A matrix this near the one at rest is at rest: matrices of 32 bits, multiplied a few times.
AT_REST = 1e-5

_sculptors = {}
_busy = False


class TressJoint(bpy.types.PropertyGroup):
    """What makes an empty a joint of an armature."""

    hair: bpy.props.PointerProperty(type=bpy.types.Object, name="Hair")
    cluster: bpy.props.IntProperty(name="Cluster")
    at: bpy.props.FloatProperty(name="Place", description="In parts of the strands' lengths")
    rest: bpy.props.FloatVectorProperty(size=16, subtype="MATRIX", name="Matrix at Rest")


class Drag:
    """A sculptor for the hair of one object, and what it needs at every step."""

    def __init__(self, obj):
        points = hair.vectors(obj.data, hair.REST)
        attribute = obj.data.attributes.get(CLUSTER)
        if points is None or attribute is None:
            raise tress.TressError("the hair has no armature")
        clusters = np.empty(len(obj.data.curves), np.int32)
        attribute.data.foreach_get("value", clusters)
        rest = hair.groom(obj, points)
        helices, _report = hair.fitted(rest)
        helices = helices.with_attributes(strand={CLUSTER: clusters})
        self.rest = rest
        self.sculptor = tress.Sculptor(helices, stiffness=obj.get(STIFFNESS, 1e-4))
        self.stamp = obj.get(STAMP)

    def points(self, pose):
        """Where a pose puts the points; the sculptor's report beside them."""
        report = self.sculptor.sculpt(pose)
        if report["moved"] == 0:
            return self.rest.positions, report
        return self.sculptor.sample(self.rest.counts).positions, report


def joints(obj):
    """The empties of the armature of an object, cluster by cluster, from root to tip."""
    found = [o for o in obj.children_recursive if o.tress_joint.hair == obj]
    return sorted(found, key=lambda o: (o.tress_joint.cluster, o.tress_joint.at))


def pose(obj, empties):
    """The pose that empties are in: for each where it was at rest and how it has moved.

    A joint takes a point `x` to `center + translate + R A S A^T (x - center)`, with the rotation R,
    the scale S and the axes A it has at rest.
    """
    into = obj.matrix_world.inverted_safe()
    groups = {}
    for empty in empties:
        joint = empty.tress_joint
        rest = Matrix([joint.rest[row] for row in range(4)])
        moved = {"at": round(joint.at, 6), "center": tuple(rest.translation)}
        matrix = into @ empty.matrix_world
        if AT_REST < np.abs(np.array(matrix) - np.array(rest)).max():
            axes = rest.to_3x3()
            location, rotation, scale = matrix.decompose()
            moved["axes"] = [tuple(axes.col[i]) for i in range(3)]
            turn = (rotation.to_matrix() @ axes.transposed()).to_euler("XYZ")
            moved["translate"] = tuple(location - rest.translation)
            moved["rotate"] = tuple(np.degrees(turn))
            moved["scale"] = tuple(scale)
        groups.setdefault(joint.cluster, []).append(moved)
    return {
        "groups": [
            {"select": {"Attribute": {"name": CLUSTER, "value": float(cluster)}}, "joints": chain}
            for cluster, chain in groups.items()
        ]
    }


def drag(obj):
    """Moves the hair of an object to where its empties are; the sculptor's report, or None."""
    empties = joints(obj)
    if not empties:
        return None
    key = obj.data.session_uid
    known = _sculptors.get(key)
    if known is None or known.stamp != obj.get(STAMP):
        known = _sculptors[key] = Drag(obj)
    points, report = known.points(pose(obj, empties))
    hair.move(obj, points)
    return report


def forget(obj=None):
    """Lets sculptors go: that of one object, or all."""
    if obj is None:
        _sculptors.clear()
    else:
        _sculptors.pop(obj.data.session_uid, None)


@persistent
def after_update(_scene, depsgraph):
    """Moves hair whose empties have moved, by hand or by animation."""
    global _busy
    if _busy or not depsgraph.id_type_updated("OBJECT"):
        return
    moved = {}
    for update in depsgraph.updates:
        if update.is_updated_transform and isinstance(update.id, bpy.types.Object):
            obj = update.id.original
            if obj.type == "EMPTY" and obj.tress_joint.hair is not None:
                moved[obj.tress_joint.hair.name] = obj.tress_joint.hair
    _busy = True
    try:
        for obj in moved.values():
            if hair.is_hair(obj):
                drag(obj)
    except tress.TressError as error:
        print(f"Tress: {obj.name}: {error}")
    finally:
        _busy = False


@persistent
def before_load(*_arguments):
    """Another file, other hair."""
    forget()
    hair.forget_fits()


def register():
    bpy.utils.register_class(TressJoint)
    bpy.types.Object.tress_joint = bpy.props.PointerProperty(type=TressJoint)
    for handlers in (bpy.app.handlers.depsgraph_update_post, bpy.app.handlers.frame_change_post):
        handlers.append(after_update)
    bpy.app.handlers.load_pre.append(before_load)


def unregister():
    bpy.app.handlers.load_pre.remove(before_load)
    for handlers in (bpy.app.handlers.depsgraph_update_post, bpy.app.handlers.frame_change_post):
        handlers.remove(after_update)
    del bpy.types.Object.tress_joint
    bpy.utils.unregister_class(TressJoint)
    forget()
