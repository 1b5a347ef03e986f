"""The operations, each held to something that is known."""

import threading
import time

import numpy as np
import pytest
import tress
from conftest import coil_points


def test_a_coil_is_found_and_comes_back(coils):
    helices, report = tress.fit(coils, elements=60)
    assert len(helices) == 5 and report["elements"] == 240
    assert report["kept"] == {"of a single point": 1}
    assert report["rms_of_radius"] < 0.01
    radii = tress.quantity(helices, "radius")
    assert np.allclose(radii[:4], 0.5, rtol=0.02) and np.isnan(radii[4])
    assert tress.quantity(helices, "handedness")[:4].tolist() == [1, -1, 1, -1]
    back = tress.sample(helices, counts=coils.counts)
    assert np.array_equal(back.counts, coils.counts) and back.unit == coils.unit
    assert np.abs(back.positions - coils.positions).max() < 0.05
    assert back.strand_attributes["wisp"].tolist() == [0, 1, 0, 1, 1]


def test_fewer_elements_within_a_tolerance(coils):
    near, close = (tress.fit(coils, tolerance=t)[1] for t in (0.01, 0.1))
    assert near["greatest"] <= 0.01 and close["greatest"] <= 0.1
    assert close["elements"] <= near["elements"]
    of_radius = tress.fit(coils, tolerance_of_radius=0.02)[1]
    assert of_radius["greatest_of_radius"] <= 0.021


def test_options_are_checked(coils, helices):
    with pytest.raises(TypeError, match="tolerence"):
        tress.fit(coils, tolerence=0.1)
    with pytest.raises(TypeError, match="one of"):
        tress.fit(coils, elements=3, tolerance=0.1)
    with pytest.raises(TypeError):
        tress.fit(coils, elements="many")
    with pytest.raises(TypeError):
        tress.fit(helices)
    with pytest.raises(TypeError, match="sideways"):
        tress.recoil(helices, keep="sideways")
    with pytest.raises(TypeError):
        tress.ruffle(helices, seed=-1.5)
    refused = [
        lambda: tress.fit(coils, elements=0),
        lambda: tress.fit(coils, tolerance=-1.0),
        lambda: tress.fit(coils, tolerance=float("nan")),
        lambda: tress.sample(helices, points=1),
        lambda: tress.sample(helices, spacing=0.0),
        lambda: tress.sample(helices, counts=[3]),
        lambda: tress.sample(helices, counts=[-3, 3, 3, 3, 3]),
        lambda: tress.ruffle(helices, probability=2.0),
        lambda: tress.ruffle(helices, [0]),
        lambda: tress.ruffle(helices, [0, 0, 0, 0, -1]),
        lambda: tress.groups(helices, attribute="none"),
        lambda: tress.groups(helices, clusters=9),
        lambda: tress.blend(helices, helices, float("inf")),
        lambda: tress.blend(helices, helices, space="time"),
        lambda: tress.recoil(helices, radius=0.0),
        lambda: tress.quantity(helices, "colour"),
        lambda: tress.armature(helices, lengths=[0.5, 0.2]),
    ]
    for call in refused:
        with pytest.raises(tress.TressError):
            call()


def test_numbers_of_numpy_are_numbers(coils):
    helices, _ = tress.fit(coils, elements=np.int64(30), prior=np.float32(1e-3))
    assert helices.counts.tolist() == [30, 30, 30, 30, 0]


def test_progress_is_told_and_may_refuse(coils):
    shares = []
    with_progress, _ = tress.fit(coils, elements=60, progress=shares.append)
    assert with_progress == tress.fit(coils, elements=60)[0]
    assert shares[-1] == 1.0 and shares == sorted(shares)

    def stop(_share):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        tress.fit(coils, elements=60, progress=stop)


def test_the_lock_is_released_while_it_works():
    strands = np.stack([coil_points(turns=40, origin=(i, 0, 0)) for i in range(300)])
    groom = tress.Groom(strands)
    ticks, done = [], threading.Event()

    def tick():
        while not done.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.001)

    thread = threading.Thread(target=tick)
    thread.start()
    start = time.perf_counter()
    tress.fit(groom)
    end = time.perf_counter()
    done.set()
    thread.join()
    during = [t for t in ticks if start + 0.1 * (end - start) < t < end - 0.1 * (end - start)]
    assert during, f"no other thread ran in {end - start} s"


def test_ruffling_swaps_elements_within_groups(helices):
    groups = tress.groups(helices, attribute="wisp")
    assert groups.tolist() == [0, 1, 0, 1, 1]
    ruffled, report = tress.ruffle(helices, groups, probability=0.5, keep=10, seed=7)
    assert report["candidates"] == 200 and 0 < report["replaced"] < 200
    again = tress.ruffle(helices, groups, probability=0.5, keep=10, seed=7)[0]
    assert ruffled == again
    k0 = ruffled.curvatures[:, 0]
    assert (k0[:60] > 0).all() and (k0[60:120] < 0).all(), "hands do not mix across groups"
    assert tress.groups(helices.select([0, 1]), clusters=2).tolist() in ([0, 1], [1, 0])


def test_blending_goes_from_one_to_the_other(coils, helices):
    wide = tress.recoil(helices, radius=2.0, keep="turns")
    assert np.allclose(tress.quantity(wide, "radius")[:4], 1.0, rtol=0.03)
    assert tress.blend(helices, wide, 0.0).curvatures.tolist() == helices.curvatures.tolist()
    middle = tress.blend(helices, wide)
    assert np.allclose(middle.curvatures, (helices.curvatures + wide.curvatures) / 2)
    darboux = tress.blend(helices, wide, 0.5, space="darboux")
    assert not np.allclose(darboux.curvatures, middle.curvatures, atol=1e-6)
    moved = coils.with_positions(coils.positions + 2.0)
    half = tress.blend(coils, moved, 0.25, space="position")
    assert np.allclose(half.positions, coils.positions + 0.5)
    with pytest.raises(TypeError):
        tress.blend(coils, moved, 0.25)
    with pytest.raises(tress.TressError):
        tress.blend(helices, helices.select([0]))


def test_recoiling_along_the_centerline(helices):
    tighter = tress.recoil(helices, radius=0.5, keep="centerline")
    tips = [tress.sample(h, points=50)[0][-1] for h in (helices, tighter)]
    assert np.linalg.norm(tips[1] - tips[0]) < 1.0
    radii = tress.quantity(tighter, "radius")[:4]
    assert np.allclose(radii, 0.25, rtol=0.1)


def test_a_point_goes_to_its_anchor(helices):
    tip = helices.joints(0)[0][-1]
    anchor = tip + [0.0, -1.0, 1.0]
    sculpted, report = tress.sculpt(helices, strands=[0], at=[1.0], anchors=[anchor])
    assert np.linalg.norm(sculpted.joints(0)[0][-1] - anchor) < 0.01
    assert report["moved"] == 1 and report["free"] == 4 and report["stops"] == {"converged": 1}
    assert report["energy_after"] < report["energy_before"]
    assert np.array_equal(sculpted.lengths, helices.lengths)
    assert np.array_equal(sculpted.curvatures[60:], helices.curvatures[60:])
    stiff, _ = tress.sculpt(helices, strands=[0], at=[1.0], anchors=[anchor], stiffness=1.0)
    assert np.linalg.norm(stiff.joints(0)[0][-1] - anchor) > 0.3


def test_anchors_without_a_meaning_are_refused(helices):
    anchor = {"strands": [0], "at": [1.0], "anchors": [[0.0, 1.0, 0.0]]}
    wrong = [
        anchor | {"strands": [5]},
        anchor | {"at": [1.5]},
        anchor | {"at": [0.5, 1.0]},
        anchor | {"anchors": [[0.0, np.nan, 0.0]]},
        anchor | {"weights": [-1.0]},
        anchor | {"stiffness": -1.0},
        anchor | {"bend_weights": (0.0, 1.0, 1.0)},
    ]
    for keywords in wrong:
        with pytest.raises(tress.TressError):
            tress.sculpt(helices, **keywords)
    for keywords in (
        {},
        {"strands": [0]},
        anchor | {"pose": {}},
        anchor | {"c": 1, "stiffness": 1},
    ):
        with pytest.raises(TypeError):
            tress.sculpt(helices, **keywords)


def test_a_pose_moves_a_cluster(helices):
    helices = helices.select([0, 1, 2, 3])
    pose = tress.armature(helices, clusters=2, lengths=[0.5, 1.0])
    assert len(pose["groups"]) == 2 and len(pose["groups"][0]["joints"]) == 2
    still, report = tress.sculpt(helices, pose)
    assert report["moved"] == 0 and still == helices
    pose["groups"][0]["joints"][1]["translate"] = np.array([0.0, -0.5, 0.5])
    moved, report = tress.sculpt(helices, pose)
    assert 0 < report["moved"] < 4 and report["greatest_anchor_distance"] < 0.05
    ron = "(anchors: [(strand: 0, at: 1.0, position: (0.2, 4.0, 0.0))])"
    by_text, _ = tress.sculpt(helices, ron)
    assert np.linalg.norm(by_text.joints(0)[0][-1] - [0.2, 4.0, 0.0]) < 0.01
    for wrong in ("(anchor: [])", {"anchor": []}, {"groups": [{}]}, "("):
        with pytest.raises(tress.TressError):
            tress.sculpt(helices, wrong)
    with pytest.raises(tress.TressError, match="another|for a groom"):
        tress.sculpt(helices.select([0, 1]), pose)


def test_a_sculptor_goes_on_from_its_last_pose(coils, helices):
    sculptor = tress.Sculptor(helices, stiffness=1e-3)
    tip = helices.joints(1)[0][-1]
    steps = []
    for drag in np.linspace(0.1, 1.0, 10):
        anchors = [tip + [drag, -drag, 0.0]]
        steps.append(sculptor.sculpt(strands=[1], at=[1.0], anchors=anchors)["iterations"])
    assert np.linalg.norm(sculptor.pose.joints(1)[0][-1] - anchors[0]) < 0.02
    assert sculptor.rest == helices
    dragged = sculptor.sample(coils.counts)
    assert np.array_equal(dragged.counts, coils.counts)
    assert np.linalg.norm(dragged[1][-1] - anchors[0]) < 0.02
    again = sculptor.sculpt(strands=[1], at=[1.0], anchors=anchors)["iterations"]
    assert again < sum(steps)
    sculptor.sculpt({})
    assert sculptor.pose == helices


def test_analyses_and_summaries(coils, helices):
    for groom in (coils, helices):
        analysis = tress.analyze(groom)
        strands = analysis["strands"]
        assert strands["hand"][:4].tolist() == [1, -1, 1, -1]
        assert np.allclose(strands["turns"][:4], 10, rtol=0.05)
        assert np.allclose(strands["coil_radius"][:4], 0.5, rtol=0.03)
        assert np.isnan(strands["coil_radius"][4]) and len(strands["length"]) == 5
        places = len(coils.positions) if groom is coils else 240 + 5
        assert all(len(values) == places for values in analysis["along"].values())
        assert analysis["along"]["beta"][40] > 0.9 if groom is coils else True
        assert len(analysis["switchbacks"]["strand"]) == 0
        spectrum = analysis["spectrum"]
        # The strongest frequency is that of the coil: a turn in hypot(2 pi R, pitch).
        strongest = spectrum["frequency"][np.argmax(spectrum["share"])]
        assert strongest == pytest.approx(1 / np.hypot(2 * np.pi * 0.5, 0.5), rel=0.1)
        assert analysis["summary"]["right_handed"] == 2
    summary = tress.summarize(helices)
    assert (summary["right_handed"], summary["left_handed"]) == (2, 2)
    assert summary["coil_radius"]["median"] == pytest.approx(0.5, rel=0.03)
    assert tress.summarize(helices.select([4]))["length"] is None
    assert len(tress.quantity(helices, "twist")) == 240 + 5
    found = tress.defects(coils)
    assert found["strands"] == {"of a single point": {"count": 1, "first": 4}}
    with pytest.raises(TypeError):
        tress.analyze(np.zeros((3, 3)))


def test_hair_grows_from_guides(coils):
    guides = coils.select([0, 1, 2, 3])
    square = [[0, 0, -3], [9, 0, -3], [9, 0, 3], [0, 0, 3]]
    triangles = [[0, 1, 2], [0, 2, 3]]
    roots = tress.scatter(square, triangles, 60, seed=3)
    assert roots.shape == (60, 3) and np.array_equal(roots[:, 1], np.zeros(60))
    one_side = tress.scatter(square, triangles, 60, density=[1, 0], seed=3)
    assert (one_side[:, 0] / 9 >= (one_side[:, 2] + 3) / 6 - 1e-9).all()
    grown, report = tress.grow(guides, roots, seed=1)
    assert report["hairs"] == 60 and len(grown) == 60 and grown.unit == coils.unit
    assert np.array_equal([strand[0] for strand in grown], roots)
    assert set(grown.strand_attributes["guide"]) <= {0, 1, 2, 3}
    assert grown == tress.grow(guides, roots, seed=1)[0]
    nearest, _ = tress.grow(guides, roots, assignment="Nearest", skip={"probability": 0.5})
    distance = np.linalg.norm(roots[:, None] - [strand[0] for strand in guides], axis=2)
    assert np.array_equal(nearest.strand_attributes["guide"], distance.argmin(axis=1))
    for preset in tress.grow_presets():
        assert len(tress.grow(guides, roots[:3], preset=preset, library=guides)[0]) == 3
    refused = [
        lambda: tress.grow(guides, roots, preset="mohawk"),
        lambda: tress.grow(guides, roots, shorter=2.0),
        lambda: tress.grow(tress.Groom([]), roots),
        lambda: tress.grow(guides, roots, assignment={"Noisy": 0}),
        lambda: tress.scatter(square, [[0, 1, 4]], 5),
        lambda: tress.scatter(square, [[0, 1, -1]], 5),
        lambda: tress.scatter(square, [0, 1, 2], 5),
        lambda: tress.scatter([], [], 5),
        lambda: tress.scatter(square, triangles, 5, density=[1, 2, 3]),
    ]
    for call in refused:
        with pytest.raises(tress.TressError):
            call()
    for wrong in ({"skipp": 1}, {"assignment": "Far"}, {"loose": 1}):
        with pytest.raises(TypeError):
            tress.grow(guides, roots, **wrong)


@pytest.mark.parametrize("extension", ["npz", "obj", "ply", "usda", "hair"])
def test_files_bring_back_what_they_hold(coils, tmp_path, extension):
    path = tmp_path / f"gr\u00f6\u00dfe mit leer.{extension}"
    lost = tress.write(path, coils)
    back = tress.read(path)
    assert isinstance(back, tress.Groom)
    assert np.allclose(back.positions, coils.positions, atol=1e-5)
    assert np.array_equal(back.offsets, coils.offsets)
    # What is not lost is there: positions to 32 bits in most formats, all else exactly.
    kept = (back.unit, back.up, "wisp" in back.strand_attributes)
    assert (lost == []) == (kept == (coils.unit, coils.up, True))
    assert (back == coils) == (extension == "npz")


def test_super_helices_are_kept_bit_for_bit(helices, tmp_path):
    path = str(tmp_path / "groom.tress")
    assert tress.write(path, helices) == []
    assert tress.read(path) == helices


def test_files_that_are_not_there_or_no_grooms(coils, helices, tmp_path):
    with pytest.raises(FileNotFoundError) as caught:
        tress.read(tmp_path / "none.npz")
    assert str(caught.value.filename).endswith("none.npz")
    (tmp_path / "bad.npz").write_bytes(b"PK no archive")
    (tmp_path / "bad.tress").write_bytes(b"\0" * 9)
    for name in ("bad.fbx", "bad"):
        (tmp_path / name).write_bytes(b"")
    for name in ("bad.npz", "bad.tress", "bad.fbx", "bad"):
        with pytest.raises(tress.TressError, match="bad"):
            tress.read(tmp_path / name)
    with pytest.raises(OSError):
        tress.write(tmp_path / "no folder" / "groom.npz", coils)
    for path, groom in [("groom.tress", coils), ("groom.npz", helices), ("groom.fbx", coils)]:
        with pytest.raises((tress.TressError, TypeError)):
            tress.write(tmp_path / path, groom)
    with pytest.raises(TypeError):
        tress.write(tmp_path / "groom.npz", np.zeros((3, 3)))
    with pytest.raises(tress.TressError):
        tress.write(tmp_path / "groom.usda", coils, usd_curves="bezier")
    assert not list(tmp_path.glob("groom*"))


def test_pictures_are_pixels(coils, helices):
    pixels = tress.render(coils, size=(160, 120), view="three-quarter", melanin=0.2)
    assert pixels.shape == (120, 160, 3) and pixels.dtype == np.uint8
    assert 10 < len(np.unique(pixels.reshape(-1, 3), axis=0))
    by_radius = tress.render(
        coils, tress.quantity(helices, "radius"), size=(160, 120), title="radius", unit="cm"
    )
    assert not np.array_equal(pixels, by_radius)
    by_point = tress.render(coils, coils.positions[:, 1], size=(160, 120), colors="cividis")
    assert not np.array_equal(by_radius, by_point)
    assert tress.png(pixels).startswith(b"\x89PNG")
    with pytest.raises(tress.TressError):
        tress.render(coils, [1.0, 2.0])
    with pytest.raises(tress.TressError):
        tress.render(coils, size=(0, 10))
    with pytest.raises(TypeError):
        tress.render(coils, view="below")
    with pytest.raises(tress.TressError):
        tress.png(pixels[:, :, :2])
    with pytest.raises(tress.TressError):
        tress.png(np.full((2, 2, 3), 256))


def test_everything_is_documented_and_typed():
    stubs = (tress.__path__[0] + "/__init__.pyi",)
    with open(stubs[0]) as file:
        text = file.read()
    for name in tress._tress.__all__:
        thing = getattr(tress, name)
        if callable(thing):
            assert thing.__doc__ and len(thing.__doc__) > 30, f"{name} has no document"
            assert f"def {name}(" in text or f"class {name}" in text, f"{name} has no stub"
        if isinstance(thing, type) and not issubclass(thing, Exception):
            for member in (m for m in vars(thing) if not m.startswith("_")):
                assert f"def {member}(" in text, f"{name}.{member} has no stub"
                assert vars(thing)[member].__doc__, f"{name}.{member} has no document"


def test_switchbacks_change_hands_and_keep_lengths(helices):
    helices = helices.select([0, 1, 2, 3])
    changed, report = tress.insert_switchbacks(helices, shares=[0.5])
    assert report["strands"] == 4 and len(report["placed"]) == 4
    assert np.add.reduceat(changed.lengths, changed.offsets[:-1]) == pytest.approx(
        np.add.reduceat(helices.lengths, helices.offsets[:-1])
    )
    found = tress.analyze(changed)["switchbacks"]
    assert found["strand"].tolist() == [0, 1, 2, 3]
    assert (found["before"] * found["behind"] == -1).all()
    again, _ = tress.insert_switchbacks(helices, [0, 0, 1, 1], density=0.05, seed=4)
    assert again == tress.insert_switchbacks(helices, [0, 0, 1, 1], density=0.05, seed=4)[0]
    for wrong in ({"shares": [1.5]}, {"density": -1.0}, {"shares": [0.5], "share": 0.9}):
        with pytest.raises(tress.TressError):
            tress.insert_switchbacks(helices, **wrong)
    with pytest.raises(tress.TressError):
        tress.insert_switchbacks(helices, [0], shares=[0.5])
    for wrong in ({}, {"shares": [0.5], "density": 1.0}, {"shares": [0.5], "poisson": 0.4}):
        with pytest.raises(TypeError):
            tress.insert_switchbacks(helices, **wrong)


def test_a_switchback_in_equilibrium():
    curvatures = tress.switchback(0.5, [-80.0, 0.0, 80.0])
    # Twist k0 is odd about the middle, where nothing is left of half of the bending.
    assert curvatures[0, 0] == pytest.approx(-curvatures[2, 0], abs=1e-9)
    assert curvatures[1, 0] == pytest.approx(0.0, abs=1e-9)
    assert curvatures[1, 2] == pytest.approx(0.4976314802, abs=1e-8)
    with pytest.raises(tress.TressError):
        tress.switchback(1.5, [0.0])
    near = np.abs(tress.switchback(0.5, [-80.0, 0.0, 80.0], method="ritz") - curvatures)
    assert near[[0, 2]].max() < 0.01 < near[1].max(), "the approximation is off in the middle"
    # Two at once: the coil behind them is the one before.
    double = tress.switchback(0.6, [-200.0, 200.0], rest_twist=0.2, method="double")
    assert double[0, 0] == pytest.approx(double[1, 0], abs=1e-6)
    with pytest.raises(tress.TressError, match="triple"):
        tress.switchback(0.5, [0.0], method="triple")


def test_helicoids_are_fitted_sampled_and_filled_in():
    arc = np.linspace(0, 2, 40)
    strand = np.stack([np.sin(arc), 1 - np.cos(arc), 0.1 * arc], axis=1)
    guides = tress.Groom(
        np.stack([strand, strand * 1.2 + [3, 0, 0], strand + [0, 0, 3]]), unit="cm"
    )
    hairs, report = tress.fit_helicoids(guides, pieces={"Equal": 3}, roll="Steady")
    assert len(hairs) == 3 and report["pieces"] == [3, 3, 3] and hairs.unit == 0.01
    assert max(report["rms"]) < 0.02
    assert hairs.parameters.shape == (9, 4) and hairs.lengths.shape == (9,)
    assert hairs.root_frames.shape == (3, 3, 3) and hairs.offsets.tolist() == [0, 3, 6, 9]
    back = tress.sample_helicoids(hairs, counts=guides.counts)
    assert np.abs(back.positions - guides.positions).max() < 0.1
    helices = tress.to_helices(hairs, per_piece=30)
    assert helices.counts.tolist() == [90] * 3 and helices.unit == 0.01
    along = tress.sample(helices, points=40), tress.sample_helicoids(hairs, points=40)
    assert np.abs(along[0].positions - along[1].positions).max() < 1e-3
    of_helices, _ = tress.fit_helicoids(helices, pieces={"Equal": 3}, roll="Steady")
    assert len(of_helices) == 3
    spread = tress.wisps(hairs, hairs=5, radius=0.1, points=12, seed=2)
    assert spread.counts.tolist() == [12] * 15
    assert spread.strand_attributes["group"].tolist() == [0] * 5 + [1] * 5 + [2] * 5
    roots = spread.positions[::12].reshape(3, 5, 3)
    from_root = np.linalg.norm(roots - roots[:, :1], axis=2).ravel()
    assert from_root[::5].max() == 0.0 and 0.0 < from_root.max() <= 0.1
    wavy = {"amplitude": 0.05, "frequency": 12.0}
    assert tress.wisps(hairs, hairs=5, points=12, waviness=wavy) != spread
    roots = np.array([[1.0, 0, 0], [0, 0, 1.0]])
    filled, replaced = tress.fill(hairs, roots, exponent=2.0)
    assert len(filled) == 2 and replaced.tolist() == []
    new = tress.sample_helicoids(filled, points=20)
    assert np.allclose([hair[0] for hair in new], roots)
    for call in (
        lambda: tress.fit_helicoids(guides, tolerance=-1.0),
        lambda: tress.sample_helicoids(hairs, points=1),
        lambda: tress.to_helices(hairs, per_piece=0),
        lambda: tress.wisps(hairs, radius=-1.0),
        lambda: tress.fill(hairs, [[np.nan, 0, 0]]),
        lambda: tress.fill(hairs, roots, exponent=-1.0),
    ):
        with pytest.raises(tress.TressError):
            call()
    for call in (
        lambda: tress.sample_helicoids(hairs),
        lambda: tress.fit_helicoids(guides, tolerence=1.0),
        lambda: tress.fill(hairs, roots, normals=roots),
        lambda: tress.wisps(hairs, waviness={"amplitud": 1.0}),
        lambda: tress.fit_helicoids(roots),
    ):
        with pytest.raises(TypeError):
            call()


def test_a_procedural_groom_is_built_the_same_every_time(tmp_path):
    guides = np.zeros((2, 20, 3))
    guides[:, :, 1] = -np.linspace(0, 3, 20)
    guides[1, :, 0] = 1.0
    roots = np.random.default_rng(0).random((50, 3)) * [1, 0, 1]
    operators = [{"Clump": {"profile": 1.5}}, {"Frizz": {"frequency": 0.5, "amplitude": 0.1}}]
    groom = tress.ProceduralGroom(guides, roots, operators, seed=3)
    strands = groom.build()
    assert len(strands) == 50 and strands == groom.build()
    assert [next(iter(operator)) for operator in groom.operators] == ["Clump", "Frizz"]
    path = tmp_path / "groom.ron"
    groom.write(path)
    again = tress.ProceduralGroom.read(path)
    assert again.build() == strands and again.seed == 3
    plain = groom.with_operators([]).build()
    assert not np.allclose(plain.positions, strands.positions)
    assert np.array_equal(groom.guides.positions.reshape(2, 20, 3), guides)
    by_text = tress.ProceduralGroom(guides, roots, "[Clump(profile: 1.5)]", seed=3)
    assert "1.5" in repr(by_text.operators)
    tapered = tress.ProceduralGroom(guides, roots, widths=[0.3, 0.1]).build()
    width = tapered.point_attributes["width"].reshape(50, 20)
    assert np.allclose(width, np.linspace(0.3, 0.1, 20))
    for wrong in ([{"Clmp": {}}], [{"Clump": {"profil": 1}}], "[Clump(]"):
        with pytest.raises(tress.TressError):
            tress.ProceduralGroom(guides, roots, wrong)
    with pytest.raises(tress.TressError):
        tress.ProceduralGroom(np.zeros((0, 20, 3)), roots)
    with pytest.raises((tress.TressError, OSError)):
        tress.ProceduralGroom.read(tmp_path / "none.ron")


def test_operators_are_found_for_strands_that_have_none():
    rng = np.random.default_rng(1)
    guides = np.zeros((6, 24, 3))
    guides[:, :, 1] = -np.linspace(0, 3, 24)
    guides[:, :, 0] += np.arange(6)[:, None]
    roots = rng.random((240, 3)) * [5, 0, 1]
    made = tress.ProceduralGroom(guides, roots, [{"Clump": {"profile": 1.5}}], seed=3)
    target, shares = made.build(), []
    options = {"guides": 12, "points": 24, "seed": 2, "guide": {"steps": 2}}
    options |= {"parameters": {"rounds": 1, "steps": 3}, "numbers": {"steps": 3}}
    start = [{"Clump": {"profile": 1.0}}]
    found, report = tress.fit_procedural(target, start, progress=shares.append, **options)
    assert report["strands"] == 240 and report["left_out"] == 0
    assert len(found.build()) == 240 and [*found.operators[0]] == ["Clump"]
    stages = [stage for stage, _loss in report["losses"]]
    assert len(set(stages)) > 1 and np.isfinite([loss for _stage, loss in report["losses"]]).all()
    assert shares[-1] == 1.0 and shares == sorted(shares)
    assert tress.fit_procedural(target, start, **options)[0].build() == found.build()
    with pytest.raises(tress.TressError):
        tress.fit_procedural(target, start, guides=1000)
    with pytest.raises(tress.TressError):
        tress.fit_procedural(target, [{"Perm": {}}])
    with pytest.raises(TypeError):
        tress.fit_procedural(target, start, guide={"step": 2})


def test_centerlines_are_what_coils_wind_about(coils):
    lines, turns = tress.centerlines(coils)
    assert np.array_equal(lines.offsets, coils.offsets)
    assert turns[:4] == pytest.approx(10, abs=0.3) and np.isnan(turns[4])
    for i in range(4):
        assert np.hypot(lines[i][:, 0] - 3.0 * i, lines[i][:, 2]).max() < 0.05
    assert np.array_equal(lines[4], coils[4])
    same, known = tress.centerlines(coils, turns=[10, 10, 0, 10, 0])
    assert np.array_equal(same[2], coils[2]) and known[0] == 10
    with pytest.raises(tress.TressError, match="expected 5"):
        tress.centerlines(coils, turns=[10])


def test_meshes_are_read(tmp_path):
    square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"
    (tmp_path / "square.obj").write_text(square)
    vertices, triangles, density = tress.read_mesh(tmp_path / "square.obj")
    assert vertices.shape == (4, 3) and triangles.tolist() == [[0, 1, 2], [0, 2, 3]]
    assert density is None
    assert tress.scatter(vertices, triangles, 10).shape == (10, 3)
    with pytest.raises(FileNotFoundError):
        tress.read_mesh(tmp_path / "none.ply")
    with pytest.raises(tress.TressError):
        tress.read_mesh(tmp_path / "none.abc")


def test_grooms_are_compared(coils):
    same = tress.compare(coils, coils)
    assert same["nearest"]["greatest"] == 0.0 and same["by_index"]["frechet"]["rms"] == 0.0
    moved = tress.compare(coils, coils.with_positions(coils.positions + [0, 0.01, 0]))
    assert moved["by_index"]["distances"]["rms"] == pytest.approx(0.01, rel=1e-6)
    assert moved["distributions"]["coil_radius"] == pytest.approx(0.0, abs=1e-9)
    assert tress.compare(coils, tress.Groom([]))["nearest"] is None


@pytest.mark.parametrize("extension", ["abc", "usdc", "usd"])
def test_frames_go_out_and_come_in(coils, tmp_path, extension):
    path = tmp_path / f"wind.{extension}"
    frames = [coils.with_positions(coils.positions + [0, 0, step]) for step in range(3)]
    tress.write_animation(path, frames, start=10.0, rate=25.0)
    animation = tress.Animation(path)
    assert (len(animation), animation.start, animation.rate) == (3, 10.0, 25.0)
    for found, groom in zip(animation, frames, strict=True):
        assert np.allclose(found.positions, groom.positions, atol=1e-5)
    assert np.allclose(animation[-1].positions, frames[2].positions, atol=1e-5)
    with pytest.raises(IndexError):
        animation[3]
    with pytest.raises(tress.TressError, match="no frame"):
        tress.write_animation(path, [])
    with pytest.raises(tress.TressError):
        tress.write_animation(tmp_path / "wind.obj", frames)
    with pytest.raises(FileNotFoundError):
        tress.Animation(tmp_path / "none.abc")


def test_unreal_gets_no_more_points_than_it_takes(tmp_path):
    strand = coil_points(turns=40, per_turn=20)
    groom = tress.Groom(strand, counts=[len(strand)], unit="cm", up="y")
    report = tress.write_unreal(tmp_path / "coil.abc", groom)
    assert report["resampled"] == 1 and report["most_points"] == 801
    uniform = tress.write_unreal(tmp_path / "even.abc", groom, placement="uniform")
    assert report["errors"][0] < uniform["errors"][0] < 0.5
    assert tress.read(tmp_path / "coil.abc").counts.tolist() == [255]
    with pytest.raises(tress.TressError):
        tress.write_unreal(tmp_path / "coil.abc", groom, placement="sparse")
