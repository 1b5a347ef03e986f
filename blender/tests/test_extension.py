"""Every operator, run without a window on hair whose curl is known."""

import json
import pathlib
import subprocess
import sys

import bpy
import numpy as np
import pytest
import tress

COUNT, POINTS = 40, 81


def coil(hand, radius=0.05, turns=10.0, points=POINTS):
    """A coil that hangs down from the origin; right-handed where `hand` is 1."""
    angle = np.linspace(0, 2 * np.pi * turns, points)
    height = -np.linspace(0, 1, points)
    strand = [radius * np.cos(angle), -hand * radius * np.sin(angle), height]
    return np.stack(strand, axis=1) - [radius, 0, 0]


def make_hair(name="hair", count=COUNT, **shape):
    """An active, selected curves object of coils in a square, right- and left-handed in turn."""
    side = int(np.ceil(np.sqrt(count)))
    curves = bpy.data.hair_curves.new(name)
    points = shape.get("points", POINTS)
    curves.add_curves([points] * count)
    roots = [[0.2 * (i % side), 0.2 * (i // side), 0] for i in range(count)]
    strands = [coil(1 if i % 2 == 0 else -1, **shape) + root for i, root in enumerate(roots)]
    curves.position_data.foreach_set("vector", np.concatenate(strands).astype(np.float32).ravel())
    obj = bpy.data.objects.new(name, curves)
    bpy.context.collection.objects.link(obj)
    activate(obj)
    return obj


def activate(*objects):
    for obj in bpy.context.selected_objects:
        obj.select_set(False)
    for obj in objects:
        obj.select_set(True)
    bpy.context.view_layer.objects.active = objects[0]
    bpy.context.view_layer.update()


def positions(obj):
    values = np.empty(len(obj.data.points) * 3, np.float32)
    obj.data.position_data.foreach_get("vector", values)
    return values.reshape(-1, 3)


def lengths(obj):
    points = positions(obj).reshape(-1, POINTS, 3)
    return np.linalg.norm(np.diff(points, axis=1), axis=2).sum(axis=1)


def numbers(obj, name):
    attribute = obj.data.attributes[name]
    values = np.empty(len(attribute.data), np.float32)
    attribute.data.foreach_get("value", values)
    return values


def test_fit_reports_and_moves_nothing(scene):
    obj = make_hair()
    before = positions(obj)
    assert bpy.ops.tress.fit() == {"FINISHED"}
    assert np.array_equal(positions(obj), before)
    report = json.loads(obj["tress_fit"])
    assert report["strands"] == COUNT and report["rms_of_radius"] < 0.01
    summary = report["summary"]
    assert (summary["right_handed"], summary["left_handed"]) == (COUNT // 2, COUNT // 2)
    assert summary["coil_radius"]["median"] == pytest.approx(0.05, rel=0.03)
    assert numbers(obj, "tress_error").max() < 0.005


def test_ruffle_moves_beyond_the_root_and_restore_brings_back(scene):
    obj = make_hair()
    before = positions(obj)
    assert bpy.ops.tress.ruffle(probability=0.5, root=0.5, clusters=4, seed=3) == {"FINISHED"}
    moved = np.linalg.norm(positions(obj) - before, axis=1).reshape(COUNT, POINTS)
    assert moved[:, : POINTS // 2 - 1].max() < 0.005 and moved[:, -1].max() > 0.01
    first = positions(obj)
    assert bpy.ops.tress.restore() == {"FINISHED"}
    assert np.array_equal(positions(obj), before)
    bpy.ops.tress.ruffle(probability=0.5, root=0.5, clusters=4, seed=3)
    assert np.array_equal(positions(obj), first), "the same seed gives the same hair"


def test_recoil_changes_radii_along_the_same_lines(scene):
    obj = make_hair()
    before = positions(obj).reshape(COUNT, POINTS, 3).mean(axis=1)
    assert bpy.ops.tress.recoil(radius=0.5) == {"FINISHED"}
    assert np.linalg.norm(positions(obj).reshape(COUNT, POINTS, 3).mean(axis=1) - before) < 0.5
    bpy.ops.tress.color(quantity="radius", material=False)
    assert np.median(numbers(obj, "tress_radius")) == pytest.approx(0.025, rel=0.1)


def test_blend_between_two_objects_and_with_the_original(scene, addon):
    wide = make_hair("wide", radius=0.08)
    wide.location.x = 5.0
    obj = make_hair()
    before = positions(obj)
    activate(obj, wide)
    assert bpy.ops.tress.blend(amount=0.0) == {"FINISHED"}
    assert np.abs(positions(obj) - before).max() < 0.005
    assert bpy.ops.tress.blend(amount=0.5, space="position") == {"FINISHED"}
    # Half way to an object that stands 5 away.
    assert positions(obj)[0, 0] == pytest.approx(2.5, abs=0.01)
    activate(obj)
    assert bpy.ops.tress.blend(amount=1.0, space="position") == {"FINISHED"}
    assert np.abs(positions(obj) - before).max() < 1e-6
    few = make_hair("few", count=3)
    activate(obj, few)
    with pytest.raises(RuntimeError, match="strands must correspond"):
        bpy.ops.tress.blend()
    activate(few)
    with pytest.raises(RuntimeError, match="second hair"):
        bpy.ops.tress.blend()


@pytest.mark.parametrize("quantity", ["radius", "frequency", "beta", "turns", "length", "twist"])
def test_colors_are_written_as_attributes(scene, quantity):
    obj = make_hair()
    assert bpy.ops.tress.color(quantity=quantity) == {"FINISHED"}
    values = numbers(obj, f"tress_{quantity}")
    assert len(values) == COUNT * POINTS and np.isfinite(values).all()
    color = obj.data.attributes["tress_color"]
    assert (color.data_type, color.domain) == ("FLOAT_COLOR", "POINT")
    assert obj.data.materials[0].name.startswith("Tress Colors")
    expected = {"radius": 0.05, "frequency": 10.0, "turns": 10.0}.get(quantity)
    if expected:
        assert np.median(values) == pytest.approx(expected, rel=0.05)
    if quantity in ("beta", "twist"):
        assert values[40] > 0 > values[POINTS + 40]


def test_the_hair_gets_its_own_material_back(scene):
    obj = make_hair(count=4)
    own = bpy.data.materials.new("Own")
    obj.data.materials.append(own)
    bpy.ops.tress.color()
    assert obj.data.materials[0] != own
    bpy.ops.tress.color(quantity="beta")
    bpy.ops.tress.recoil(radius=2.0)
    bpy.ops.tress.restore()
    assert obj.data.materials[0] == own


def test_switchbacks_change_the_hand_of_wisps(scene):
    obj = make_hair()
    before = positions(obj)
    assert bpy.ops.tress.switchback(count=1, clusters=4) == {"FINISHED"}
    bpy.ops.tress.color(quantity="handedness", material=False)
    bpy.ops.tress.color(quantity="beta", material=False)
    beta = numbers(obj, "tress_beta").reshape(COUNT, POINTS)
    assert (beta[:, 15] * beta[:, 65] < 0).all()
    root = before.reshape(COUNT, POINTS, 3)[:, 0]
    assert np.abs(positions(obj).reshape(COUNT, POINTS, 3)[:, 0] - root).max() < 1e-6
    assert bpy.ops.tress.restore() == {"FINISHED"}
    assert bpy.ops.tress.switchback(count=2, scatter=True, seed=5) == {"FINISHED"}


def test_hair_grows_from_guides_on_a_mesh(scene):
    guides = make_hair("guides", count=9)
    guides.location.z = 0.5
    bpy.ops.mesh.primitive_plane_add(size=2.0, location=(0.2, 0.2, 0.5))
    plane = bpy.context.object
    activate(guides, plane)
    assert bpy.ops.tress.grow(count=200, seed=2) == {"FINISHED"}
    grown = bpy.context.object
    assert grown.name.startswith("guides Grown") and len(grown.data.curves) == 200
    offsets = np.empty(201, np.int32)
    grown.data.curve_offset_data.foreach_get("value", offsets)
    roots = positions(grown)[offsets[:-1]]
    assert np.abs(roots[:, 2]).max() < 1e-6, "roots are on the plane, in the space of the guides"
    assert np.isfinite(positions(grown)).all()
    activate(guides, plane)
    plane.modifiers.new("finer", "SUBSURF").subdivision_type = "SIMPLE"
    plane.modifiers["finer"].levels = 6
    bpy.ops.tress.grow(count=50, reach=0.15, preset=tress.grow_presets()[0])
    near = bpy.context.object
    offsets = np.empty(51, np.int32)
    near.data.curve_offset_data.foreach_get("value", offsets)
    own = positions(guides).reshape(9, POINTS, 3)[:, 0]
    apart = np.linalg.norm(positions(near)[offsets[:-1]][:, None] - own[None], axis=2)
    assert apart.min(axis=1).max() < 0.25
    activate(guides)
    with pytest.raises(RuntimeError, match="select a mesh"):
        bpy.ops.tress.grow()


def test_a_dragged_empty_moves_its_wisp_and_keeps_lengths(scene, addon):
    obj = make_hair()
    obj.rotation_euler = (0.3, 0.2, 0.1)
    obj.location = (1, 2, 3)
    bpy.context.view_layer.update()
    before, length = positions(obj), lengths(obj)
    assert bpy.ops.tress.armature_add(clusters=4, joints=2) == {"FINISHED"}
    empties = addon.rig.joints(obj)
    assert len(empties) == 8
    assert np.array_equal(positions(obj), before), "an armature at rest moves nothing"
    tip = next(e for e in empties if e.tress_joint.at == 1.0)
    tip.location.z += 0.1
    tip.location.x += 0.1
    bpy.context.view_layer.update()
    moved = np.linalg.norm(positions(obj) - before, axis=1).reshape(COUNT, POINTS)
    clusters = np.empty(COUNT, np.int32)
    obj.data.attributes["tress_cluster"].data.foreach_get("value", clusters)
    own = clusters == tip.tress_joint.cluster
    assert moved[own, -1] == pytest.approx(np.hypot(0.1, 0.1), abs=0.01)
    assert moved[own, 0].max() < 1e-4 and moved[~own].max() < 0.005
    assert np.abs(lengths(obj) / length - 1).max() < 0.01
    for edit in (bpy.ops.tress.recoil, bpy.ops.tress.ruffle, bpy.ops.tress.restore):
        assert not edit.poll(), "an armature would move the hair back"
    # The joint nearer the root takes the tip's along, as bones do.
    root = tip.parent
    assert root in empties
    root.location.x += 0.05
    bpy.context.view_layer.update()
    assert moved[own, -1].max() < np.linalg.norm(positions(obj) - before, axis=1).max()
    sculpted = positions(obj)
    bpy.ops.tress.armature_update()
    assert np.abs(positions(obj) - sculpted).max() < 0.01
    assert bpy.ops.tress.armature_remove(apply=True) == {"FINISHED"}
    assert not addon.rig.joints(obj) and "tress_rest" not in obj.data.attributes
    assert not [c for c in bpy.data.collections if "Armature" in c.name]
    assert np.abs(positions(obj) - sculpted).max() < 0.01
    bpy.ops.tress.restore()
    assert np.array_equal(positions(obj), before)


def test_turning_and_scaling_an_empty(scene, addon):
    obj = make_hair(count=4)
    bpy.ops.tress.armature_add(clusters=1, joints=1, stiffness=0.0)
    (empty,) = addon.rig.joints(obj)
    before = positions(obj).reshape(4, POINTS, 3)[:, -1]
    center = before.mean(axis=0)
    empty.rotation_mode = "XYZ"
    turn = empty.matrix_basis.copy()
    from mathutils import Matrix

    empty.matrix_basis = (
        Matrix.Translation(center)
        @ Matrix.Rotation(np.pi / 2, 4, "Z")
        @ Matrix.Translation(-center.astype(float))
        @ turn
    )
    bpy.context.view_layer.update()
    after = positions(obj).reshape(4, POINTS, 3)[:, -1]
    offset = before - center
    expected = center + np.stack([-offset[:, 1], offset[:, 0], offset[:, 2]], axis=1)
    assert np.abs(after - expected).max() < 0.01
    bpy.ops.tress.armature_remove(apply=False)
    assert np.abs(positions(obj).reshape(4, POINTS, 3)[:, -1] - before).max() < 1e-6


def test_an_armature_survives_saving_and_loading(scene, addon, tmp_path):
    obj = make_hair(count=6)
    bpy.ops.tress.armature_add(clusters=2, joints=2)
    path = str(tmp_path / "rig.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    obj = bpy.data.objects["hair"]
    before = positions(obj)
    empties = addon.rig.joints(obj)
    assert len(empties) == 4
    empties[-1].location.x += 0.1
    bpy.context.view_layer.update()
    assert np.abs(positions(obj) - before).max() > 0.05


def test_animated_empties_move_the_hair(scene, addon):
    obj = make_hair(count=4)
    bpy.ops.tress.armature_add(clusters=1, joints=1)
    (empty,) = addon.rig.joints(obj)
    empty.keyframe_insert("location", frame=1)
    empty.location.x += 0.2
    empty.keyframe_insert("location", frame=11)
    scene.frame_set(1)
    tips = []
    for frame in (1, 6, 11):
        scene.frame_set(frame)
        tips.append(positions(obj).reshape(4, POINTS, 3)[:, -1, 0].mean())
    assert tips[2] - tips[0] == pytest.approx(0.2, abs=0.01)
    assert tips[1] - tips[0] == pytest.approx(0.1, abs=0.01)


def test_undo_takes_an_edit_back(scene):
    make_hair()
    bpy.ops.ed.undo_push(message="hair")
    before = positions(bpy.data.objects["hair"])
    bpy.ops.tress.recoil(radius=0.5)
    bpy.ops.ed.undo_push(message="recoil")
    assert np.abs(positions(bpy.data.objects["hair"]) - before).max() > 0.01
    if not bpy.ops.ed.undo.poll():
        pytest.skip("this Blender has no undo without a window")
    bpy.ops.ed.undo()
    assert np.array_equal(positions(bpy.data.objects["hair"]), before)


def test_files_go_out_and_come_in(scene, tmp_path):
    obj = make_hair()
    before = positions(obj)
    for name in ("hair gr\u00f6\u00dfe.npz", "hair.usda", "hair.tress"):
        path = str(tmp_path / name)
        assert bpy.ops.tress.export_groom(filepath=path) == {"FINISHED"}
        assert bpy.ops.tress.import_groom(filepath=path) == {"FINISHED"}
        back = bpy.context.object
        assert back != obj and len(back.data.curves) == COUNT
        if not name.endswith(".tress"):
            assert np.abs(positions(back) - before).max() < 1e-5
        activate(obj)
    with pytest.raises(RuntimeError, match="none.npz"):
        bpy.ops.tress.import_groom(filepath=str(tmp_path / "none.npz"))


def wind(path, frames=3, **options):
    """Writes an animated file of two coils that move by 0.1 a frame along x."""
    points = np.stack([coil(1), coil(-1) + [1, 0, 0]])
    grooms = [tress.Groom(points + [0.1 * i, 0, 0], unit=1.0, up="z") for i in range(frames)]
    tress.write_animation(path, grooms, **options)
    return points.reshape(-1, 3)


@pytest.mark.parametrize("extension", ["abc", "usdc"])
def test_frames_of_a_file_are_played_and_written(scene, addon, tmp_path, extension):
    path = str(tmp_path / f"wind.{extension}")
    first = wind(path, start=5.0, rate=24.0)
    scene.frame_set(1)
    assert bpy.ops.tress.import_groom(filepath=path) == {"FINISHED"}
    obj = bpy.context.object
    for frame, moved in [(1, 0.0), (5, 0.0), (6, 0.1), (7, 0.2), (20, 0.2), (6, 0.1)]:
        scene.frame_set(frame)
        assert np.abs(positions(obj) - first - [moved, 0, 0]).max() < 1e-5
    assert not bpy.ops.tress.recoil.poll(), "the file would move the hair back"
    scene.frame_start, scene.frame_end = 5, 7
    obj.location.y = 2.0
    out = str(tmp_path / f"out.{extension}")
    assert bpy.ops.tress.export_groom(filepath=out, animation=True) == {"FINISHED"}
    assert scene.frame_current == 6
    frames = tress.Animation(out)
    assert (len(frames), frames.start) == (3, 5.0)
    for i, groom in enumerate(frames):
        groom = groom.turned_up("z")
        assert np.abs(groom.positions - first - [0.1 * i, 2, 0]).max() < 1e-5
    assert bpy.ops.tress.cache_stop() == {"FINISHED"}
    scene.frame_set(5)
    assert np.abs(positions(obj) - first - [0.1, 0, 0]).max() < 1e-5
    assert bpy.ops.tress.recoil.poll()
    with pytest.raises(RuntimeError, match="one groom"):
        bpy.ops.tress.export_groom(filepath=str(tmp_path / "out.obj"), animation=True)


def test_frames_with_other_strands_and_files_that_are_gone_move_nothing(scene, tmp_path, capsys):
    path = tmp_path / "wind.abc"
    points = np.stack([coil(1), coil(-1) + [1, 0, 0]])
    grooms = [tress.Groom(points, up="z"), tress.Groom(points[:1] + [1, 0, 0], up="z")]
    tress.write_animation(path, grooms)
    assert bpy.ops.tress.import_groom(filepath=str(path)) == {"FINISHED"}
    obj = bpy.context.object
    before = positions(obj)
    scene.frame_set(2)
    assert np.array_equal(positions(obj), before)
    assert "frame 2" in capsys.readouterr().out
    obj.tress_cache.path = str(tmp_path / "gone.abc")
    scene.frame_set(1)
    assert np.array_equal(positions(obj), before) and "gone.abc" in capsys.readouterr().out


def test_attributes_go_out_and_come_in(scene, tmp_path):
    obj = make_hair(count=3, points=20)
    curves = obj.data
    n = len(curves.points)
    of_points = np.linspace(0.0, 1.0, n, dtype=np.float32)
    of_points[7] = np.nan
    curves.attributes.new("glow", "FLOAT", "POINT").data.foreach_set("value", of_points)
    wisps = np.array([4, -1, 4], np.int32)
    curves.attributes.new("wisp", "INT", "CURVE").data.foreach_set("value", wisps)
    tint = np.tile(np.float32([0.1, 0.2, 0.3, 1.0]), n)
    curves.attributes.new("tint", "FLOAT_COLOR", "POINT").data.foreach_set("color", tint)
    radius = curves.attributes.get("radius") or curves.attributes.new("radius", "FLOAT", "POINT")
    radius.data.foreach_set("value", np.full(n, 0.25, np.float32))
    obj.scale = (2.0, 2.0, 2.0)
    bpy.context.view_layer.update()
    for name in ("all.npz", "all.usdc", "all.abc"):
        path = str(tmp_path / name)
        assert bpy.ops.tress.export_groom(filepath=path) == {"FINISHED"}
        groom = tress.read(path)
        assert groom.strand_attributes["wisp"].tolist() == wisps.tolist()
        assert np.array_equal(groom.point_attributes["glow"], of_points, equal_nan=True)
        assert groom.point_attributes["width"] == pytest.approx(1.0)
        assert bpy.ops.tress.import_groom(filepath=path) == {"FINISHED"}
        back = bpy.context.object
        assert np.array_equal(numbers(back, "glow"), of_points, equal_nan=True)
        assert numbers(back, "wisp").tolist() == wisps.tolist()
        assert numbers(back, "radius") == pytest.approx(0.5)
        assert back.data.attributes["tint"].data_type == "FLOAT_COLOR"
        assert bpy.ops.tress.color() == {"FINISHED"}, "a number that is none is no trouble"
        activate(obj)


def test_modifiers_are_applied_on_the_way_out(scene, tmp_path):
    obj = make_hair(count=2, points=20)
    before = positions(obj)
    group = bpy.data.node_groups.new("lift", "GeometryNodeTree")
    group.interface.new_socket("Geometry", in_out="INPUT", socket_type="NodeSocketGeometry")
    group.interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
    begin, end = group.nodes.new("NodeGroupInput"), group.nodes.new("NodeGroupOutput")
    lift = group.nodes.new("GeometryNodeSetPosition")
    lift.inputs["Offset"].default_value = (0, 0, 3)
    group.links.new(begin.outputs[0], lift.inputs[0])
    group.links.new(lift.outputs[0], end.inputs[0])
    obj.modifiers.new("lift", "NODES").node_group = group
    path = str(tmp_path / "lifted.npz")
    assert bpy.ops.tress.export_groom(filepath=path) == {"FINISHED"}
    assert np.abs(tress.read(path).positions - before - [0, 0, 3]).max() < 1e-5
    assert np.array_equal(positions(obj), before)


def test_strands_that_are_no_curves_stay(scene):
    curves = bpy.data.hair_curves.new("odd")
    curves.add_curves([1, 4, 2, 20])
    points = np.concatenate(
        [np.zeros((1, 3)), np.full((4, 3), np.nan), np.eye(3)[:2], coil(1, points=20)]
    )
    curves.position_data.foreach_set("vector", points.astype(np.float32).ravel())
    obj = bpy.data.objects.new("odd", curves)
    bpy.context.collection.objects.link(obj)
    activate(obj)
    before = positions(obj)
    assert bpy.ops.tress.fit() == {"FINISHED"}
    assert sum(json.loads(obj["tress_fit"])["kept"].values()) == 2
    assert bpy.ops.tress.recoil(radius=2.0, keep="length") == {"FINISHED"}
    after = positions(obj)
    assert np.array_equal(after[:5], before[:5], equal_nan=True)
    assert np.abs(after[7:] - before[7:]).max() > 0.01
    assert bpy.ops.tress.color(quantity="radius") == {"FINISHED"}


def test_hair_without_strands_is_no_trouble(scene):
    obj = bpy.data.objects.new("bald", bpy.data.hair_curves.new("bald"))
    bpy.context.collection.objects.link(obj)
    activate(obj)
    for operator in (bpy.ops.tress.fit, bpy.ops.tress.ruffle, bpy.ops.tress.recoil):
        assert operator() == {"FINISHED"}
    assert bpy.ops.tress.color() == {"FINISHED"}
    with pytest.raises(RuntimeError, match="no strands"):
        bpy.ops.tress.armature_add()


def test_operators_want_hair(scene):
    bpy.ops.object.empty_add()
    for operator in ("fit", "ruffle", "recoil", "blend", "restore", "color", "armature_add"):
        assert not getattr(bpy.ops.tress, operator).poll()


def test_the_panel_draws(scene, addon):
    assert addon.panel.TRESS_PT_panel.is_registered
    obj = make_hair(count=4)
    bpy.ops.tress.fit()

    class Layout:
        """Takes whatever a panel asks of a layout."""

        def __init__(self):
            self.words = []

        def operator(self, name, **_keywords):
            module, _, function = name.partition(".")
            assert hasattr(getattr(bpy.ops, module), function)
            getattr(getattr(bpy.ops, module), function).get_rna_type()
            self.words.append(name)
            return type("Properties", (), {})()

        def label(self, text="", **_keywords):
            self.words.append(text)

        def column(self, **_keywords):
            return self

        box = column

    panel = type("Panel", (), {"layout": Layout()})()
    addon.panel.TRESS_PT_panel.draw(panel, bpy.context)
    assert "4 strands, 320 elements" in panel.layout.words
    bpy.ops.tress.armature_add()
    addon.panel.TRESS_PT_panel.draw(panel, bpy.context)
    assert "tress.armature_remove" in panel.layout.words
    activate(obj)
    assert isinstance(tress.__version__, str)


def test_a_wheel_of_another_platform_is_said_to_be_one(tmp_path):
    (tmp_path / "tress").mkdir()
    (tmp_path / "tress" / "__init__.py").write_text("from ._tress import *")
    addon = pathlib.Path(__file__).parents[1] / "addon"
    (tmp_path / "the_addon").symlink_to(addon)
    code = f"import sys; sys.path.insert(0, {str(tmp_path)!r}); import the_addon"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert run.returncode == 1 and "is not for" in run.stderr and "Python 3" in run.stderr
