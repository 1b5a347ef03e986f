"""Editing coiled hair in curvature space."""

import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal, TypeAlias, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str

Floats: TypeAlias = NDArray[np.float64]
Path: TypeAlias = str | os.PathLike[str]
UnitName: TypeAlias = Literal["mm", "cm", "m", "in", "ft"]
UpAxis: TypeAlias = Literal["y", "z"]
Color: TypeAlias = tuple[int, int, int] | Sequence[int]
Progress: TypeAlias = Callable[[float], object]
Report: TypeAlias = dict[str, Any]
Pose: TypeAlias = Mapping[str, Any] | str

class TressError(ValueError): ...

class Groom:
    def __init__(
        self,
        positions: ArrayLike,
        offsets: ArrayLike | None = None,
        *,
        counts: ArrayLike | None = None,
        unit: float | UnitName | None = None,
        up: UpAxis | None = None,
        point_attributes: Mapping[str, ArrayLike] | None = None,
        strand_attributes: Mapping[str, ArrayLike] | None = None,
    ) -> None: ...
    @property
    def positions(self) -> Floats: ...
    @property
    def offsets(self) -> NDArray[np.uint32]: ...
    @property
    def counts(self) -> NDArray[np.int64]: ...
    @property
    def unit(self) -> float | None: ...
    @property
    def up(self) -> UpAxis | None: ...
    @property
    def point_attributes(self) -> dict[str, NDArray[Any]]: ...
    @property
    def strand_attributes(self) -> dict[str, NDArray[Any]]: ...
    def __len__(self) -> int: ...
    def __getitem__(self, strand: int) -> Floats: ...
    def with_positions(self, positions: ArrayLike) -> Groom: ...
    def with_attributes(
        self,
        *,
        point: Mapping[str, ArrayLike | None] | None = None,
        strand: Mapping[str, ArrayLike | None] | None = None,
    ) -> Groom: ...
    def in_space(self, unit: float | UnitName | None = None, up: UpAxis | None = None) -> Groom: ...
    def turned_up(self, up: UpAxis) -> Groom: ...
    def select(self, strands: ArrayLike) -> Groom: ...
    def joined(self, other: Groom) -> Groom: ...
    def strand_values(self, name: str) -> Floats: ...

class HelixGroom:
    def __init__(
        self,
        root_positions: ArrayLike,
        root_frames: ArrayLike,
        curvatures: ArrayLike,
        lengths: ArrayLike,
        offsets: ArrayLike | None = None,
        *,
        counts: ArrayLike | None = None,
        unit: float | UnitName | None = None,
        up: UpAxis | None = None,
        strand_attributes: Mapping[str, ArrayLike] | None = None,
        joint_attributes: Mapping[str, ArrayLike] | None = None,
        kept_strands: ArrayLike | None = None,
        kept: Groom | None = None,
    ) -> None: ...
    @property
    def curvatures(self) -> Floats: ...
    @property
    def lengths(self) -> Floats: ...
    @property
    def offsets(self) -> NDArray[np.uint32]: ...
    @property
    def counts(self) -> NDArray[np.int64]: ...
    @property
    def root_positions(self) -> Floats: ...
    @property
    def root_frames(self) -> Floats: ...
    @property
    def kept_strands(self) -> NDArray[np.uint32]: ...
    @property
    def kept(self) -> Groom: ...
    @property
    def unit(self) -> float | None: ...
    @property
    def up(self) -> UpAxis | None: ...
    @property
    def strand_attributes(self) -> dict[str, NDArray[Any]]: ...
    @property
    def joint_attributes(self) -> dict[str, NDArray[Any]]: ...
    def __len__(self) -> int: ...
    def joints(self, strand: int) -> tuple[Floats, Floats]: ...
    def with_elements(
        self, curvatures: ArrayLike | None = None, lengths: ArrayLike | None = None
    ) -> HelixGroom: ...
    def with_attributes(
        self,
        *,
        strand: Mapping[str, ArrayLike] | None = None,
        joint: Mapping[str, ArrayLike] | None = None,
    ) -> HelixGroom: ...
    def select(self, strands: ArrayLike) -> HelixGroom: ...
    def joined(self, other: HelixGroom) -> HelixGroom: ...

def read(path: Path) -> Groom | HelixGroom: ...
def read_mesh(
    path: Path,
) -> tuple[Floats, NDArray[np.uint32], Floats | None]: ...
def write(
    path: Path,
    groom: Groom | HelixGroom,
    *,
    usd_curves: Literal["linear", "catmull-rom"] = "linear",
) -> list[str]: ...
def write_unreal(
    path: Path,
    groom: Groom,
    *,
    most_points: int = 255,
    placement: Literal["curvature", "uniform"] = "curvature",
) -> Report: ...

class Animation:
    def __init__(self, path: Path) -> None: ...
    @property
    def start(self) -> float: ...
    @property
    def rate(self) -> float: ...
    def __len__(self) -> int: ...
    def __getitem__(self, frame: int) -> Groom: ...

def write_animation(
    path: Path,
    grooms: Sequence[Groom],
    *,
    start: float = 1.0,
    rate: float = 24.0,
    usd_curves: Literal["linear", "catmull-rom"] = "linear",
) -> list[str]: ...
def fit(
    groom: Groom,
    *,
    elements: int | None = None,
    tolerance: float | None = None,
    tolerance_of_radius: float | None = None,
    tangents: Literal["helix", "circle", "centripetal", "uniform"] = "helix",
    floating: Literal["points", "tangents"] = "points",
    refine: bool = True,
    steps: int = 8,
    prior: float = 1e-3,
    lengths: bool = True,
    root: bool = True,
    measure: bool = True,
    progress: Progress | None = None,
) -> tuple[HelixGroom, Report]: ...
def sample(
    helices: HelixGroom,
    *,
    points: int | None = None,
    counts: ArrayLike | None = None,
    spacing: float | None = None,
    per_turn: float | None = None,
) -> Groom: ...
def centerlines(groom: Groom, *, turns: ArrayLike | None = None) -> tuple[Groom, Floats]: ...
def groups(
    helices: HelixGroom,
    *,
    attribute: str | None = None,
    clusters: int | None = None,
    seed: int = 0,
) -> NDArray[np.uint32]: ...
def ruffle(
    helices: HelixGroom,
    groups: ArrayLike | None = None,
    *,
    probability: float = 0.05,
    keep: int = 30,
    blend: float = 1.0,
    seed: int = 0,
) -> tuple[HelixGroom, Report]: ...
@overload
def blend(
    a: HelixGroom,
    b: HelixGroom,
    amount: float = 0.5,
    *,
    space: Literal["curvature", "darboux"] = "curvature",
) -> HelixGroom: ...
@overload
def blend(a: Groom, b: Groom, amount: float = 0.5, *, space: Literal["position"]) -> Groom: ...
def recoil(
    helices: HelixGroom,
    *,
    radius: float = 1.0,
    frequency: float = 1.0,
    keep: Literal["length", "turns", "advance", "centerline"] = "length",
) -> HelixGroom: ...
def armature(
    helices: HelixGroom,
    *,
    clusters: int = 8,
    lengths: ArrayLike = (1 / 3, 2 / 3, 1),
    seed: int = 0,
    blend: float = 0.0,
) -> dict[str, Any]: ...
def sculpt(
    helices: HelixGroom,
    pose: Pose | None = None,
    *,
    strands: ArrayLike | None = None,
    at: ArrayLike | None = None,
    anchors: ArrayLike | None = None,
    weights: ArrayLike | None = None,
    stiffness: float | None = None,
    c: float | None = None,
    bend_weights: Sequence[float] = (0.1, 1, 1),
    tip_weight: float = 0.15,
    solver: Literal["lm", "adam"] = "lm",
    tolerance: float = 1e-6,
    max_iterations: int = 200,
    continuation: float = 0.25,
) -> tuple[HelixGroom, Report]: ...

class Sculptor:
    def __init__(
        self,
        helices: HelixGroom,
        *,
        stiffness: float | None = None,
        c: float | None = None,
        bend_weights: Sequence[float] = (0.1, 1, 1),
        tip_weight: float = 0.15,
        solver: Literal["lm", "adam"] = "lm",
        tolerance: float = 1e-6,
        max_iterations: int = 200,
        continuation: float = 0.25,
    ) -> None: ...
    @property
    def rest(self) -> HelixGroom: ...
    @property
    def pose(self) -> HelixGroom: ...
    def sculpt(
        self,
        pose: Pose | None = None,
        *,
        strands: ArrayLike | None = None,
        at: ArrayLike | None = None,
        anchors: ArrayLike | None = None,
        weights: ArrayLike | None = None,
    ) -> Report: ...
    def sample(self, counts: ArrayLike) -> Groom: ...

def grow(
    guides: Groom,
    roots: ArrayLike,
    *,
    preset: str | None = None,
    library: Groom | None = None,
    seed: int = 0,
    assignment: Any = None,
    loose: tuple[float, float] | None = None,
    wisp: Sequence[tuple[float, float]] | None = None,
    shorter: float | None = None,
    skip: Mapping[str, Any] | None = None,
    fade: tuple[float, float] | None = None,
    opening: float | None = None,
    locking: float | None = None,
    coils: Literal["Guide", "Own"] | None = None,
) -> tuple[Groom, Report]: ...
def grow_presets() -> list[str]: ...
def scatter(
    vertices: ArrayLike,
    triangles: ArrayLike,
    count: int,
    *,
    density: ArrayLike | None = None,
    seed: int = 0,
) -> Floats: ...
def insert_switchbacks(
    helices: HelixGroom,
    groups: ArrayLike | None = None,
    *,
    arc_lengths: ArrayLike | None = None,
    shares: ArrayLike | None = None,
    density: float | None = None,
    seed: int = 0,
    poisson_ratio: float = 0.4,
    share: float = 0.05,
    elements_per_turn: int = 24,
) -> tuple[HelixGroom, Report]: ...
def switchback(
    v: float,
    arc_lengths: ArrayLike,
    *,
    poisson_ratio: float = 0.4,
    rest_twist: float = 0.0,
    method: Literal["exact", "double", "ritz"] = "exact",
) -> Floats: ...

class HelicoidGroom:
    @property
    def root_positions(self) -> Floats: ...
    @property
    def root_frames(self) -> Floats: ...
    @property
    def parameters(self) -> Floats: ...
    @property
    def lengths(self) -> Floats: ...
    @property
    def offsets(self) -> NDArray[np.uint32]: ...
    @property
    def kept_strands(self) -> NDArray[np.uint32]: ...
    @property
    def unit(self) -> float | None: ...
    @property
    def up(self) -> UpAxis | None: ...
    @property
    def strand_attributes(self) -> dict[str, NDArray[Any]]: ...
    def __len__(self) -> int: ...

def fit_helicoids(
    groom: Groom | HelixGroom,
    *,
    method: Literal["Newton", "Simplex"] | None = None,
    pieces: Mapping[str, int] | None = None,
    roll: Literal["Bend", "Steady"] | None = None,
    tolerance: float | None = None,
    threshold: float | None = None,
    shortest: float | None = None,
    regularization: float | None = None,
) -> tuple[HelicoidGroom, Report]: ...
def sample_helicoids(
    hairs: HelicoidGroom, *, points: int | None = None, counts: ArrayLike | None = None
) -> Groom: ...
def to_helices(hairs: HelicoidGroom, *, per_piece: int = 20) -> HelixGroom: ...
def wisps(
    guides: HelicoidGroom,
    *,
    hairs: int = 256,
    radius: float = 0.05,
    fanning: float = 0.0,
    frizz: float = 0.0,
    profile: ArrayLike | None = None,
    waviness: Mapping[str, float] | None = None,
    points: int = 40,
    seed: int = 0,
) -> Groom: ...
def fill(
    guides: HelicoidGroom,
    roots: ArrayLike,
    *,
    normals: ArrayLike | None = None,
    guide_normals: ArrayLike | None = None,
    mixing: Literal["Bends", "Parameters"] | None = None,
    exponent: float | None = None,
    neighbors: int | None = None,
) -> tuple[HelicoidGroom, NDArray[np.int64]]: ...

class ProceduralGroom:
    def __init__(
        self,
        guides: ArrayLike,
        roots: ArrayLike,
        operators: Sequence[Mapping[str, Any]] | str | None = None,
        *,
        seed: int = 0,
        instancing: Mapping[str, Any] | str | None = None,
        widths: Sequence[float] | None = None,
    ) -> None: ...
    @staticmethod
    def read(path: Path) -> ProceduralGroom: ...
    def write(self, path: Path) -> None: ...
    def build(self) -> Groom: ...
    @property
    def operators(self) -> list[dict[str, Any]]: ...
    @property
    def seed(self) -> int: ...
    @property
    def guides(self) -> Groom: ...
    def with_operators(self, operators: Sequence[Mapping[str, Any]] | str) -> ProceduralGroom: ...

def fit_procedural(
    groom: Groom,
    operators: Sequence[Mapping[str, Any]] | str,
    *,
    guides: int | None = None,
    operator_guides: int | None = None,
    points: int | None = None,
    neighbors: int | None = None,
    own_weights: bool | None = None,
    alternations: int | None = None,
    seed: int | None = None,
    root_weight: float | None = None,
    smoothing: Mapping[str, Any] | None = None,
    guide: Mapping[str, Any] | None = None,
    parameters: Mapping[str, Any] | None = None,
    numbers: Mapping[str, Any] | None = None,
    flaws: Mapping[str, Any] | None = None,
    progress: Progress | None = None,
) -> tuple[ProceduralGroom, Report]: ...
def summarize(helices: HelixGroom) -> Report: ...
def compare(a: Groom, b: Groom) -> Report: ...
def analyze(groom: Groom | HelixGroom) -> dict[str, Any]: ...
def quantity(helices: HelixGroom, name: str) -> Floats: ...
def defects(groom: Groom) -> Report: ...
def render(
    groom: Groom,
    values: ArrayLike | None = None,
    *,
    view: Literal["front", "side", "back", "top", "three-quarter"] = "front",
    size: tuple[int, int] = (1200, 1200),
    hair: Color | None = None,
    melanin: float | None = None,
    redness: float = 0.1,
    width: float | None = None,
    background: Color | None = None,
    margin: float = 0.05,
    range: tuple[float, float] | None = None,
    title: str = "",
    unit: str = "",
    colors: Literal["viridis", "cividis", "blue-red", "purple-green", "cyclic"] = "viridis",
) -> NDArray[np.uint8]: ...
def png(pixels: ArrayLike) -> bytes: ...
