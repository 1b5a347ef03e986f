"""Animated files played back on hair: each frame's positions, read as the scene gets there.

What a file says of a frame is put into the curves before Blender evaluates the frame, so that
modifiers, surfaces and renders see it. Files stay where they are; hair whose file is gone, or whose
frame has other strands, stays as it is, and the console says so.
"""

import bpy
import numpy as np
import tress
from bpy.app.handlers import persistent

from . import hair

_opened = {}


class TressCache(bpy.types.PropertyGroup):
    """The file that the frames of hair come from."""

    path: bpy.props.StringProperty(subtype="FILE_PATH", name="File")
    start: bpy.props.IntProperty(name="Start", description="The scene's frame of the first one")
    scale: bpy.props.FloatProperty(default=1.0)
    z_up: bpy.props.BoolProperty()


def in_scene(groom, scene, scale, z_up):
    """A groom in the scene's unit with Z up, and the factor of its lengths; empty strands left out.

    `scale` and `z_up` are for what the file does not say.
    """
    up = groom.up or ("z" if z_up else "y")
    groom = groom.in_space(groom.unit, up).turned_up("z")
    metres = scene.unit_settings.scale_length
    scale = scale if groom.unit is None else groom.unit / metres
    groom = groom.select(np.flatnonzero(groom.counts))
    return groom.with_positions(groom.positions * scale), scale


def animation(path):
    """The animation in a file, opened once."""
    path = bpy.path.abspath(path)
    if path not in _opened:
        _opened[path] = tress.Animation(path)
    return _opened[path]


def play(obj, scene):
    """Puts the points of hair where the file has them on the scene's frame."""
    cache = obj.tress_cache
    frames = animation(cache.path)
    place = min(max(scene.frame_current - cache.start, 0), len(frames) - 1)
    groom, _scale = in_scene(frames[place], scene, cache.scale, cache.z_up)
    if not np.array_equal(groom.offsets, hair.offsets(obj.data)):
        raise tress.TressError(f"frame {place + 1} of {cache.path} has other strands")
    hair.move(obj, groom.positions)


def is_played(obj):
    """Whether an object's points come from a file."""
    return obj is not None and bool(obj.tress_cache.path)


@persistent
def before_frame(scene, _depsgraph=None):
    """Another frame: hair that comes from files goes there."""
    for obj in scene.objects:
        if obj.type == "CURVES" and is_played(obj) and hair.REST not in obj.data.attributes:
            try:
                play(obj, scene)
            except (tress.TressError, OSError) as error:
                print(f"Tress: {obj.name}: {error}")


@persistent
def before_load(*_arguments):
    """Another scene, other files."""
    _opened.clear()


class TRESS_OT_cache_stop(bpy.types.Operator):
    """Let go of the file that the frames come from; the hair stays as it is now"""

    bl_idname = "tress.cache_stop"
    bl_label = "Stop Playing"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return is_played(context.object)

    def execute(self, context):
        context.object.tress_cache.path = ""
        return {"FINISHED"}


CLASSES = (TressCache, TRESS_OT_cache_stop)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.Object.tress_cache = bpy.props.PointerProperty(type=TressCache)
    bpy.app.handlers.frame_change_pre.append(before_frame)
    bpy.app.handlers.load_pre.append(before_load)


def unregister():
    bpy.app.handlers.load_pre.remove(before_load)
    bpy.app.handlers.frame_change_pre.remove(before_frame)
    del bpy.types.Object.tress_cache
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
    before_load()
