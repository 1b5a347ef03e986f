"""Hair grown from guides on a mesh."""

import bpy
import numpy as np
import tress
from bpy.props import EnumProperty, FloatProperty, IntProperty
from mathutils.kdtree import KDTree

from . import hair
from .hair_operator import SEED, HairOperator

#: The presets of `tress.grow`, for a menu.
PRESETS = [("default", "Default", "")]
PRESETS += [(name, name.replace("-", " ").title(), "") for name in tress.grow_presets()]


class TRESS_OT_grow(HairOperator, bpy.types.Operator):
    """Grow hair on the selected mesh, or the guides' surface, that falls into the guides' coils"""

    bl_idname = "tress.grow"
    bl_label = "Grow from Guides"

    count: IntProperty(name="Hairs", default=1000, min=1, soft_max=100_000)
    reach: FloatProperty(
        name="Reach",
        description="How far from a guide's root hair grows; 0 is all over the mesh",
        default=0.0,
        min=0.0,
        subtype="DISTANCE",
    )
    preset: EnumProperty(name="Preset", items=PRESETS)
    seed: IntProperty(**SEED)

    def run(self, context, obj):
        guides = hair.groom(obj)
        if not len(guides):
            raise tress.TressError("the guides have no strands")
        mesh = surface(context, obj)
        if mesh is None:
            raise tress.TressError("select a mesh to grow hair on")
        vertices, triangles = triangulated(context, mesh, obj)
        density = near(vertices, guides, self.reach) if self.reach else None
        roots = tress.scatter(vertices, triangles, self.count, density=density, seed=self.seed)
        options = {} if self.preset == "default" else {"preset": self.preset}
        grown, report = tress.grow(guides, roots, seed=self.seed, **options)
        new = hair.new_object(context, f"{obj.name} Grown", grown, like=obj)
        hair.set_numbers(new.data, "tress_guide", grown.strand_attributes["guide"])
        for other in context.selected_objects:
            other.select_set(False)
        new.select_set(True)
        context.view_layer.objects.active = new
        return f"{report['hairs']} hairs grown from {report['guides']} guides"


def surface(context, obj):
    """The mesh to grow on: another one selected, or what the guides stand on."""
    selected = [other for other in context.selected_objects if other.type == "MESH"]
    return selected[0] if selected else obj.data.surface


def triangulated(context, mesh_object, obj):
    """Vertices of a mesh, modifiers applied, in the space of another object; and its triangles."""
    evaluated = mesh_object.evaluated_get(context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    mesh.calc_loop_triangles()
    vertices = np.empty(len(mesh.vertices) * 3, np.float32)
    mesh.vertices.foreach_get("co", vertices)
    triangles = np.empty(len(mesh.loop_triangles) * 3, np.int32)
    mesh.loop_triangles.foreach_get("vertices", triangles)
    evaluated.to_mesh_clear()
    matrix = np.array(obj.matrix_world.inverted_safe() @ mesh_object.matrix_world)
    vertices = vertices.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3]
    return vertices, triangles.reshape(-1, 3)


def near(vertices, guides, reach):
    """1 for vertices that have a guide's root within reach, 0 for others."""
    roots = guides.positions[guides.offsets[:-1][guides.counts > 0]]
    tree = KDTree(len(roots))
    for index, root in enumerate(roots):
        tree.insert(root, index)
    tree.balance()
    return np.array([float(tree.find(vertex)[2] <= reach) for vertex in vertices])


def register():
    bpy.utils.register_class(TRESS_OT_grow)


def unregister():
    bpy.utils.unregister_class(TRESS_OT_grow)
