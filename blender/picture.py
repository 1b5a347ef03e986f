"""The pictures of docs/blender.md: `python blender/picture.py FOLDER`, where bpy and tress are.

A groom of the project, imported, coloured by coil radius, and the same groom ruffled, rendered by
Cycles on the processor, without a window.
"""

import math
import pathlib
import sys

import bpy
import numpy as np

ROOT = pathlib.Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "blender" / "tests"))
import conftest  # noqa: E402, F401  registers the add-on

SIZE, SAMPLES = (640, 640), 24


def hair():
    """The bundled patch, its width that of hair, coloured by coil radius."""
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    path = ROOT / "fixtures" / "patch.hair"
    assert bpy.ops.tress.import_groom(filepath=str(path), scale=0.1) == {"FINISHED"}
    obj = bpy.context.object
    radius = obj.data.attributes.get("radius") or obj.data.attributes.new(
        "radius", "FLOAT", "POINT"
    )
    radius.data.foreach_set("value", np.full(len(obj.data.points), 0.0011, np.float32))
    return obj


def stage(obj):
    """A camera that sees all of the hair, and light."""
    points = np.empty(len(obj.data.points) * 3, np.float32)
    obj.data.position_data.foreach_get("vector", points)
    points = points.reshape(-1, 3)
    low, high = points.min(axis=0), points.max(axis=0)
    center, size = (low + high) / 2, float(np.linalg.norm(high - low))
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.type = "ORTHO"
    camera.data.ortho_scale = 0.84 * size
    camera.location = center + np.array([0.35, -1.0, 0.25]) * 2 * size
    towards = center - np.array(camera.location)
    camera.rotation_euler = (
        math.atan2(math.hypot(towards[0], towards[1]), -towards[2]),
        0.0,
        math.atan2(-towards[0], towards[1]),
    )
    lamp = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    lamp.data.energy = 3.5
    lamp.rotation_euler = (0.7, 0.35, 0.2)
    scene = bpy.context.scene
    for added in (camera, lamp):
        scene.collection.objects.link(added)
    scene.camera = camera
    world = scene.world or bpy.data.worlds.new("world")
    scene.world = world
    if world.node_tree is None:
        world.use_nodes = True
    world.node_tree.nodes["Background"].inputs[0].default_value = (0.9, 0.92, 0.95, 1)
    world.node_tree.nodes["Background"].inputs[1].default_value = 0.6
    scene.render.engine = "CYCLES"
    scene.cycles.device, scene.cycles.samples = "CPU", SAMPLES
    scene.cycles.use_denoising = False
    scene.render.resolution_x, scene.render.resolution_y = SIZE
    scene.render.film_transparent = False
    scene.view_settings.view_transform = "Standard"


def render(path):
    bpy.context.scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)


def main(folder):
    obj = hair()
    stage(obj)
    bpy.ops.tress.color(quantity="radius")
    render(folder / "blender-radius.png")
    bpy.ops.tress.ruffle(probability=0.04, root=0.3, clusters=12, seed=1)
    bpy.ops.tress.color(quantity="radius")
    render(folder / "blender-ruffled.png")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]))
