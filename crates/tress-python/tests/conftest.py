"""Grooms that the tests share."""

import hypothesis
import numpy as np
import pytest
import tress

# The same examples every time, however slow the machine.
hypothesis.settings.register_profile("tress", deadline=None, derandomize=True)
hypothesis.settings.load_profile("tress")


def coil_points(hand=1.0, radius=0.5, pitch=0.5, turns=10, per_turn=8, origin=(0.0, 0.0, 0.0)):
    """The points of a coil about the y axis; right-handed where `hand` is 1."""
    angle = np.arange(turns * per_turn + 1) * 2 * np.pi / per_turn
    coil = [radius * np.cos(angle), pitch * angle / (2 * np.pi), -hand * radius * np.sin(angle)]
    return np.stack(coil, axis=1) + origin


@pytest.fixture
def coils():
    """Four coils, two of either hand, and one strand of a single point."""
    strands = [coil_points(hand=hand, origin=(3.0 * i, 0, 0)) for i, hand in enumerate([1, -1] * 2)]
    strands.append(np.array([[9.0, 9.0, 9.0]]))
    return tress.Groom(
        np.concatenate(strands),
        counts=[len(strand) for strand in strands],
        unit="cm",
        up="y",
        strand_attributes={"wisp": np.array([0, 1, 0, 1, 1])},
    )


@pytest.fixture
def helices(coils):
    return tress.fit(coils, elements=60)[0]
