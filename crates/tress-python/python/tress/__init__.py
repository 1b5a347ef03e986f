"""Editing coiled hair in curvature space.

A strand is held as a super-helix: a chain of circular helix arcs with constant material curvatures.
`fit` makes them of polylines, edits act on them, `sample` gives polylines back:

>>> import tress
>>> groom = tress.read("guides.obj")
>>> helices, report = tress.fit(groom, elements=90)
>>> ruffled, _ = tress.ruffle(helices, probability=0.1, seed=1)
>>> tress.write("ruffled.obj", tress.sample(ruffled, counts=groom.counts))

Many strands are two arrays: `positions`, (n, 3), and `offsets`, where strands begin. Lengths are in
the groom's own unit, curvatures in one over it, frames are matrices with the columns t, u, v.
Functions release the interpreter's lock and use all cores (RAYON_NUM_THREADS sets how many); the
same seed gives the same numbers on any number of them. What they refuse raises `TressError`.
"""

from ._tress import *  # noqa: F403
from ._tress import __version__ as __version__
