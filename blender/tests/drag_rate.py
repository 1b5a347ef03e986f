"""How fast hair follows a dragged empty: `python blender/tests/drag_rate.py`, where bpy is.

2,000 strands of 60 points in 8 wisps of 3 joints; one empty at a tip goes around a circle, a step a
frame, and each frame is one update of the view layer, as each movement of the mouse is. What is
not in the figure is the drawing, for which a window would be needed.
"""

import time

import bpy
import conftest
import numpy as np
import test_extension as hair

STRANDS, POINTS, FRAMES = 2000, 60, 240

for obj in list(bpy.data.objects):
    bpy.data.objects.remove(obj)
obj = hair.make_hair(count=STRANDS, points=POINTS, turns=6.0)
start = time.perf_counter()
bpy.ops.tress.armature_add(clusters=8, joints=3)
print(f"# armature of {STRANDS} strands: {time.perf_counter() - start:.2f} s, fit included")
empties = conftest.ADDON.rig.joints(obj)


def drag(empties, label):
    places = [empty.location.copy() for empty in empties]
    seconds, work = [], []
    for frame in range(FRAMES):
        angle = 4 * np.pi * frame / FRAMES
        start, busy = time.perf_counter(), time.process_time()
        for empty, place in zip(empties, places, strict=True):
            empty.location = place
            empty.location.x += 0.15 * np.sin(angle)
            empty.location.y += 0.15 * (1 - np.cos(angle))
        bpy.context.view_layer.update()
        seconds.append(time.perf_counter() - start)
        work.append(time.process_time() - busy)
    p50, p99 = np.quantile(seconds, [0.5, 0.99]) * 1e3
    print(f"METRIC:blender_drag_{label}_rate:{1e3 / p50:.1f}:frames a second")
    print(f"METRIC:blender_drag_{label}_p50_ms:{p50:.2f}:ms")
    print(f"METRIC:blender_drag_{label}_p99_ms:{p99:.2f}:ms")
    # What all cores together worked: the figure to compare where others use the machine too.
    print(f"METRIC:blender_drag_{label}_work_ms:{np.median(work) * 1e3:.2f}:ms")


tips = [empty for empty in empties if empty.tress_joint.at == 1.0]
drag(tips[:1], "wisp")
drag(tips, "all")
