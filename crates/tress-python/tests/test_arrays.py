"""What arrays come to: shapes, types, strides, offsets that do not match."""

import copy
import gc
import pickle

import numpy as np
import pytest
import tress
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

POINTS = arrays.arrays(
    st.sampled_from([np.float64, np.float32, np.float16, np.int32, np.uint8, ">f8"]),
    st.tuples(st.integers(0, 12), st.just(3)),
    elements={"min_value": 0, "max_value": 100},
)


@given(POINTS, st.data())
def test_what_goes_in_comes_out(points, data):
    ends = data.draw(st.lists(st.integers(0, len(points)), max_size=5))
    offsets = sorted([0, *ends, len(points)])
    groom = tress.Groom(points, offsets)
    assert np.array_equal(groom.positions, points.astype(np.float64))
    assert groom.offsets.tolist() == offsets
    assert groom.counts.tolist() == np.diff(offsets).tolist()
    assert groom == tress.Groom(points, counts=np.diff(offsets))
    assert np.array_equal(np.concatenate([points[:0], *groom]), points)


@given(st.integers(-2, 2).filter(bool), st.booleans())
def test_strides_do_not_matter(step, columns_first):
    points = np.random.default_rng(0).random((40, 6))
    if columns_first:
        points = np.asfortranarray(points)
    view = points[::step, 1:4]
    groom = tress.Groom(view, counts=[len(view)])
    assert np.array_equal(groom.positions, view)


def test_three_axes_are_strands_of_equal_counts():
    points = np.arange(24.0).reshape(2, 4, 3)
    groom = tress.Groom(points)
    assert groom.counts.tolist() == [4, 4]
    assert np.array_equal(groom[1], points[1]) and np.array_equal(groom[-1], points[1])
    with pytest.raises(IndexError):
        groom[2]


def test_nothing_is_a_groom():
    for groom in [tress.Groom([]), tress.Groom(np.empty((0, 3)), [0]), tress.Groom([], counts=[])]:
        assert len(groom) == 0 and groom.positions.shape == (0, 3)
        helices, report = tress.fit(groom)
        assert len(helices) == 0 and report["strands"] == 0
        assert helices.curvatures.shape == (0, 3) and helices.lengths.shape == (0,)


def test_points_that_are_not_finite_are_kept_as_they_are():
    points = np.array([[0, 0, 0], [0, np.nan, 0], [0, 0, np.inf], [0, 0, 0], [1, 0, 0], [1, 1, 0]])
    groom = tress.Groom(points, counts=[3, 3])
    helices, report = tress.fit(groom)
    assert helices.kept_strands.tolist() == [0]
    assert sum(report["kept"].values()) == 1
    back = tress.sample(helices, counts=groom.counts)
    assert np.array_equal(back[0], points[:3], equal_nan=True)


@pytest.mark.parametrize(
    ("points", "offsets", "words"),
    [
        (np.zeros((4, 3)), [0, 3], "end at 3"),
        (np.zeros((4, 3)), [0, 3, 2, 4], "falls"),
        (np.zeros((4, 3)), [1, 4], "start at 1"),
        (np.zeros((4, 3)), [], "start"),
        (np.zeros((4, 3)), [0, -1, 4], "-1"),
        (np.zeros((4, 3)), [0, 2**32], "4294967296"),
        (np.zeros((4, 3)), [[0, 4]], "shape"),
        (np.zeros((4, 2)), [0, 4], "shape"),
        (np.zeros(12), [0, 4], "shape"),
        (np.zeros((2, 2, 3)), [0, 4], "shape"),
    ],
)
def test_offsets_and_shapes_that_do_not_match_are_refused(points, offsets, words):
    with pytest.raises(tress.TressError, match=words):
        tress.Groom(points, offsets)


@pytest.mark.parametrize(
    ("arguments", "keywords"),
    [
        ((np.zeros((1, 3), complex), [0, 1]), {}),
        ((np.zeros((1, 3), bool), [0, 1]), {}),
        ((np.zeros((1, 3), object), [0, 1]), {}),
        ((np.array([["a", "b", "c"]]), [0, 1]), {}),
        ((np.zeros((1, 3)), [0.0, 1.0]), {}),
        ((np.zeros((1, 3)),), {}),
        ((np.zeros((1, 3)), [0, 1]), {"counts": [1]}),
        ((np.zeros((1, 3)), [0, 1]), {"colour": 1}),
    ],
)
def test_wrong_types_are_type_errors(arguments, keywords):
    with pytest.raises(TypeError):
        tress.Groom(*arguments, **keywords)


def test_counts_that_are_negative_or_too_few_are_refused():
    for counts in ([-1, 2], [0], [1, 1]):
        with pytest.raises(tress.TressError):
            tress.Groom(np.zeros((1, 3)), counts=counts)


def test_attributes_keep_their_kind_and_must_have_their_rows(coils):
    assert coils.strand_attributes["wisp"].dtype == np.int64
    n = len(coils.positions)
    more = coils.with_attributes(
        point={"color": np.ones((n, 3), np.float32), "width": np.arange(n, dtype=float)},
        strand={"wisp": None},
    )
    assert more.point_attributes["color"].shape == (n, 3)
    assert more.strand_attributes == {}
    assert more.strand_values("width")[0] == np.arange(81).mean()
    for wrong in (np.ones(n - 1), np.ones((n, 1, 1)), np.ones((n, 0))):
        with pytest.raises(tress.TressError):
            coils.with_attributes(point={"wrong": wrong})
    with pytest.raises(KeyError):
        coils.strand_values("none")


def test_units_and_axes(coils):
    assert (coils.unit, coils.up) == (0.01, "y")
    turned = coils.turned_up("z")
    x, y, z = coils.positions.T
    assert turned.up == "z" and np.array_equal(turned.positions, np.stack([x, -z, y], axis=1))
    assert coils.in_space(0.5).unit == 0.5 and coils.in_space().unit is None
    for wrong in ("furlong", 0.0, -1.0, float("nan")):
        with pytest.raises(tress.TressError):
            coils.in_space(wrong)
    with pytest.raises(tress.TressError):
        coils.turned_up("x")


def test_views_are_read_only_and_outlive_their_groom(helices):
    groom = tress.Groom(np.ones((5, 3)), [0, 5], point_attributes={"width": np.arange(5.0)})
    views = [groom.positions, groom[0], groom.offsets, groom.point_attributes["width"]]
    views += [helices.curvatures, helices.lengths, helices.offsets]
    copies = [view.copy() for view in views]
    for view in views:
        assert not view.flags.writeable and not view.flags.owndata
        with pytest.raises(ValueError):
            view[0] = 7
        with pytest.raises(ValueError):
            view.flags.writeable = True
    del groom
    gc.collect()
    assert all(np.array_equal(view, before) for view, before in zip(views, copies, strict=True))
    assert helices.curvatures.base is not None


def test_grooms_are_pickled_and_copied(coils, helices):
    assert pickle.loads(pickle.dumps(coils)) == coils == copy.deepcopy(coils)
    twin = pickle.loads(pickle.dumps(helices))
    assert twin == helices and twin.kept_strands.tolist() == [4]


def test_helices_are_made_of_arrays(helices):
    again = tress.HelixGroom(
        helices.root_positions,
        helices.root_frames,
        helices.curvatures,
        helices.lengths,
        helices.offsets,
        unit=helices.unit,
        up=helices.up,
        strand_attributes=helices.strand_attributes,
        kept_strands=helices.kept_strands,
        kept=helices.kept,
    )
    assert again == helices
    # Frames are rotations whose first column is the tangent.
    frames = helices.root_frames[:4]
    assert np.allclose(frames @ frames.transpose(0, 2, 1), np.eye(3))
    positions, along = helices.joints(0)
    assert np.array_equal(positions[0], helices.root_positions[0])
    assert np.array_equal(along[0], frames[0]) and len(positions) == 61
    with pytest.raises(tress.TressError):
        tress.HelixGroom(np.zeros((2, 3)), np.eye(3)[None], [], [], counts=[0, 0])
    with pytest.raises(tress.TressError):
        tress.HelixGroom(np.zeros((1, 3)), np.eye(3)[None], np.zeros((2, 3)), [1.0], counts=[2])
    with pytest.raises(tress.TressError):
        tress.HelixGroom(np.zeros((1, 3)), np.eye(3)[None], [], [], counts=[0], kept_strands=[0])


def test_selecting_and_joining(coils, helices):
    picked = coils.select([3, 0])
    assert np.array_equal(picked[1], coils[0])
    assert coils.select([0, 1]).joined(coils.select([2, 3, 4])) == coils
    assert helices.select([0]).joined(helices.select([1, 2, 3, 4])) == helices
    for wrong in ([5], [-1]):
        with pytest.raises(tress.TressError):
            coils.select(wrong)
    for wrong in ([1, 0], [0, 0], [5]):
        with pytest.raises(tress.TressError):
            helices.select(wrong)
    with pytest.raises(tress.TressError, match="unit"):
        coils.joined(coils.in_space("mm"))
