"""Grooms through Blender's own importers and exporters, and back.

With TRESS_GROOM naming a file, that groom makes the journey instead of a small one.
"""

import os

import bpy
import numpy as np
import pytest
import test_extension as hair
import tress


@pytest.fixture(scope="module")
def groom():
    """Coils of several lengths, in metres, with Z up as Blender has it."""
    path = os.environ.get("TRESS_GROOM")
    if path:
        return tress.read(path).turned_up("z")
    strands = [
        hair.coil(1 if i % 2 else -1, turns=3.0 + i, points=30 + 7 * i) + [0.3 * i, 1.0, 0.5]
        for i in range(12)
    ]
    counts = [len(strand) for strand in strands]
    width = np.full(sum(counts), 0.002)
    return tress.Groom(
        np.concatenate(strands), counts=counts, unit=1.0, up="z", point_attributes={"width": width}
    )


def imported(path):
    """The points in the world, and the offsets, that Blender's importer makes of a file."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    if path.endswith(".abc"):
        bpy.ops.wm.alembic_import(filepath=path, as_background_job=False)
    else:
        bpy.ops.wm.usd_import(filepath=path)
    (obj,) = [obj for obj in bpy.data.objects if obj.type == "CURVES"]
    values = np.empty(len(obj.data.points) * 3, np.float32)
    obj.data.position_data.foreach_get("vector", values)
    offsets = np.empty(len(obj.data.curves) + 1, np.int32)
    obj.data.curve_offset_data.foreach_get("value", offsets)
    matrix = np.array(obj.matrix_world)
    return values.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3], offsets


def off(points, groom):
    """How far points are from a groom's, over its size."""
    size = np.abs(groom.positions).max()
    return np.linalg.norm(points - groom.positions, axis=1).max() / size


@pytest.mark.parametrize("extension", ["abc", "usdc"])
def test_a_groom_comes_back_from_blender(groom, tmp_path, extension):
    there, back = str(tmp_path / f"there.{extension}"), str(tmp_path / f"back.{extension}")
    tress.write(there, groom)
    points, offsets = imported(there)
    assert np.array_equal(offsets, groom.offsets), "counts and order are kept"
    assert off(points, groom) < 1e-6
    if extension == "abc":
        bpy.ops.wm.alembic_export(filepath=back, as_background_job=False)
    else:
        bpy.ops.wm.usd_export(filepath=back)
    again = tress.read(back)
    # Blender's archives do not say that Y is up in them.
    again = again.in_space(again.unit, again.up or "y").turned_up("z")
    assert np.array_equal(again.offsets, groom.offsets)
    assert off(again.positions, groom) < 1e-6
    print(f"{extension}: off by {off(again.positions, groom):.1e} of its size")


@pytest.mark.parametrize("extension", ["abc", "usdc"])
def test_blender_sees_every_frame(groom, tmp_path, extension):
    path = str(tmp_path / f"wind.{extension}")
    grooms = [groom.with_positions(groom.positions + [0.01 * i, 0, 0]) for i in range(3)]
    tress.write_animation(path, grooms, start=1.0, rate=24.0)
    imported(path)
    scene = bpy.context.scene
    for frame, expected in zip((1, 2, 3), grooms, strict=True):
        scene.frame_set(frame)
        (obj,) = [obj for obj in bpy.data.objects if obj.type == "CURVES"]
        seen = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
        values = np.empty(len(seen.data.points) * 3, np.float32)
        seen.data.position_data.foreach_get("vector", values)
        matrix = np.array(seen.matrix_world)
        points = values.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3]
        assert off(points, expected) < 1e-6
