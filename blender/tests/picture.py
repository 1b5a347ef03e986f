"""The picture of docs/blender.md: `python blender/tests/picture.py OUT.png`, where bpy is.

The bundled patch, rendered by Cycles on the processor: as it comes, recoiled, coloured by the
radius of its coils, and sculpted by an armature, whose empties are drawn as small spheres.
"""

import pathlib
import sys
import tempfile

import bpy
import conftest
import numpy as np
from mathutils import Vector

ROOT = pathlib.Path(__file__).parents[2]
SIZE = (360, 480)
SAMPLES = 32


def clear():
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)


def hair():
    """The patch, its unit taken for a centimetre."""
    path = str(ROOT / "fixtures" / "patch.hair")
    bpy.ops.tress.import_groom(filepath=path, scale=0.01)
    obj = bpy.context.object
    radius = obj.data.attributes.get("radius") or obj.data.attributes.new(
        "radius", "FLOAT", "POINT"
    )
    radius.data.foreach_set("value", np.full(len(obj.data.points), 0.0006, np.float32))
    material = bpy.data.materials.get("Hair") or brown()
    obj.data.materials.append(material)
    return obj


def brown():
    material = bpy.data.materials.new("Hair")
    if material.node_tree is None:
        material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    shader = nodes.new("ShaderNodeBsdfHairPrincipled")
    shader.inputs["Melanin"].default_value = 0.75
    output = next(node for node in nodes if node.type == "OUTPUT_MATERIAL")
    shader.parametrization = "MELANIN"
    links.new(shader.outputs["BSDF"], output.inputs["Surface"])
    return material


def stage(obj):
    """Camera, light and world for the hair as it comes."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples = SAMPLES
    scene.cycles.device = "CPU"
    scene.view_settings.view_transform = "Standard"
    scene.render.resolution_x, scene.render.resolution_y = SIZE
    world = bpy.data.worlds.new("White")
    if world.node_tree is None:
        world.use_nodes = True
    background = next(node for node in world.node_tree.nodes if node.type == "BACKGROUND")
    background.inputs["Color"].default_value = (0.85, 0.83, 0.8, 1.0)
    scene.world = world
    points = np.array([obj.matrix_world @ Vector(corner) for corner in obj.bound_box])
    center, size = Vector((points.min(0) + points.max(0)) / 2), np.ptp(points, axis=0).max()
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.lens = 85
    camera.location = center + Vector((0.5 * size, -3.4 * size, 0.5 * size))
    camera.rotation_euler = (center - camera.location).to_track_quat("-Z", "Y").to_euler()
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    sun.data.energy = 4.0
    sun.rotation_euler = (0.8, 0.3, 0.6)
    for thing in (camera, sun):
        bpy.context.collection.objects.link(thing)
    scene.camera = camera


def render():
    """Pixels of the scene, (height, width, 4), the first row at the bottom."""
    with tempfile.TemporaryDirectory() as folder:
        bpy.context.scene.render.filepath = folder + "/picture.png"
        bpy.ops.render.render(write_still=True)
        image = bpy.data.images.load(folder + "/picture.png")
        pixels = np.empty(len(image.pixels), np.float32)
        image.pixels.foreach_get(pixels)
    return pixels.reshape(SIZE[1], SIZE[0], 4)


def show_joints(obj):
    """A sphere at each empty, which Cycles would not draw."""
    material = bpy.data.materials.new("Joint")
    material.diffuse_color = (0.9, 0.3, 0.1, 1.0)
    for empty in conftest.ADDON.rig.joints(obj):
        bpy.ops.mesh.primitive_uv_sphere_add(radius=0.007, location=empty.matrix_world.translation)
        bpy.context.object.data.materials.append(material)


def main(out):
    clear()
    obj = hair()
    stage(obj)
    pictures = [render()]
    bpy.ops.tress.recoil(radius=0.5)
    pictures.append(render())
    bpy.ops.tress.restore()
    bpy.ops.tress.color(quantity="radius")
    pictures.append(render())
    bpy.ops.tress.restore()
    bpy.ops.tress.armature_add(clusters=6, joints=2)
    for empty in conftest.ADDON.rig.joints(obj):
        if empty.tress_joint.at == 1.0:
            outwards = Vector(empty.matrix_world.translation) - obj.matrix_world.translation
            empty.location.z += 0.06
            empty.location.x += 0.12 if outwards.x > 0 else -0.12
    bpy.context.view_layer.update()
    show_joints(obj)
    pictures.append(render())
    sheet = np.concatenate(pictures, axis=1)
    image = bpy.data.images.new("sheet", sheet.shape[1], sheet.shape[0])
    image.pixels.foreach_set(sheet.ravel())
    image.filepath_raw, image.file_format = str(pathlib.Path(out).absolute()), "PNG"
    image.save()


if __name__ == "__main__":
    main(sys.argv[1])
