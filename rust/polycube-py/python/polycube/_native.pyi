"""The Rust core as a Python module. Docstrings are in the module itself: `help(polycube)`."""

import os
from collections.abc import Callable, Sequence
from types import GenericAlias
from typing import Any, Final, Generic, Literal, Protocol, TypedDict, TypeVar, final

import numpy as np
import numpy.typing as npt

__all__ = [
    "EXAMPLES",
    "Counts",
    "Hexes",
    "Job",
    "Layout",
    "Made",
    "Mesh",
    "Quads",
    "Remeshed",
    "Simplified",
    "SingularEdge",
    "Structure",
    "TradeOff",
    "Violation",
    "__version__",
    "_panic",
    "_restore",
    "check",
    "check_shape",
    "example",
    "make",
    "read",
    "read_labels",
    "read_pair",
    "remesh",
    "simplify",
    "structure",
]

__version__: Final[str]
EXAMPLES: Final[tuple[str, ...]]

_Path = str | os.PathLike[str]
_Kind = Literal["triangles", "quads", "tetrahedra", "hexahedra"]
_Strategy = Literal["best", "paper", "naive"]
_Objective = Literal["blocks_padded", "blocks", "surface_patches"]
_Axes = Literal["keep", "best"]
_Solver = Literal["exact", "linear"]
# Stage and fraction done. What it returns is not looked at; what it raises stops the work and is raised by the call.
_Progress = Callable[[str, float], object]
_Fields = dict[str, npt.ArrayLike]
_T_co = TypeVar("_T_co", covariant=True)
# What is there unless surface_only=True or strategy="naive" left it out, and None then: for type checkers `X | Any`, as
# in the standard library's stubs, so that nobody must ask for what is there.
_Hexes = Hexes | Any
_Polycube = Mesh | Any
_Counts = Counts | Any

class _Flag(Protocol):
    """Anything with `is_set`, such as `threading.Event`."""

    def is_set(self) -> bool: ...

class _Symmetry(TypedDict):
    axis: int
    at: float

class _Guides(TypedDict, total=False):
    fixed: Sequence[int]
    fixed_faces: Sequence[int]
    fixed_labels: Sequence[int]
    together: Sequence[Sequence[int]]
    apart: Sequence[Sequence[int]]
    symmetry: Sequence[_Symmetry]

@final
class Mesh:
    def __new__(cls, points: npt.ArrayLike, cells: npt.ArrayLike, kind: str | None = None) -> Mesh: ...
    def _repr_png_(self) -> bytes | None: ...
    @property
    def points(self) -> npt.NDArray[np.float64]: ...
    @property
    def cells(self) -> npt.NDArray[np.uint32]: ...
    @property
    def kind(self) -> _Kind: ...
    @property
    def is_volume(self) -> bool: ...
    def __len__(self) -> int: ...
    def boundary(self) -> npt.NDArray[np.uint32]: ...
    def write(self, path: _Path, fields: _Fields | None = None) -> None: ...

@final
class Counts:
    @property
    def surface_patches(self) -> int: ...
    @property
    def blocks(self) -> int: ...
    @property
    def blocks_padded(self) -> int: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...

@final
class TradeOff:
    @property
    def count(self) -> int: ...
    @property
    def displacement(self) -> float: ...

@final
class Violation:
    @property
    def kind(self) -> str: ...
    @property
    def mesh(self) -> Literal["polycube", "shape"]: ...
    @property
    def message(self) -> str: ...
    @property
    def element(self) -> Literal["vertex", "edge", "face", "cell"] | None: ...
    @property
    def elements(self) -> tuple[int, ...]: ...
    @property
    def place(self) -> tuple[float, float, float] | None: ...
    @property
    def remedy(self) -> str: ...

@final
class Structure:
    @property
    def faces(self) -> npt.NDArray[np.uint32]: ...
    @property
    def label(self) -> npt.NDArray[np.int8]: ...
    @property
    def facet(self) -> npt.NDArray[np.uint32]: ...
    @property
    def patch_id(self) -> npt.NDArray[np.uint32]: ...
    @property
    def block_id(self) -> npt.NDArray[np.uint32]: ...
    @property
    def corners(self) -> npt.NDArray[np.uint32]: ...
    @property
    def corner_valence(self) -> npt.NDArray[np.uint32]: ...
    @property
    def corner_levels(self) -> npt.NDArray[np.uint32]: ...
    @property
    def edges(self) -> list[npt.NDArray[np.uint32]]: ...
    @property
    def edge_facets(self) -> npt.NDArray[np.uint32]: ...
    @property
    def facet_label(self) -> npt.NDArray[np.int8]: ...
    @property
    def facet_level(self) -> npt.NDArray[np.uint32]: ...
    @property
    def level_axis(self) -> npt.NDArray[np.uint8]: ...
    @property
    def levels(self) -> npt.NDArray[np.float64]: ...
    @property
    def counts(self) -> Counts: ...
    @property
    def components(self) -> int: ...
    @property
    def genus(self) -> int: ...
    @property
    def deviation(self) -> tuple[float, float]: ...

@final
class Simplified:
    def _repr_png_(self) -> bytes | None: ...
    @property
    def polycube(self) -> _Polycube: ...
    @property
    def valid(self) -> bool: ...
    @property
    def scale(self) -> float: ...
    @property
    def labels(self) -> npt.NDArray[np.int8]: ...
    @property
    def levels(self) -> npt.NDArray[np.int64]: ...
    @property
    def structure(self) -> Structure: ...
    @property
    def counts_before(self) -> Counts: ...
    @property
    def counts_after(self) -> _Counts: ...
    @property
    def front(self) -> list[TradeOff]: ...
    @property
    def notes(self) -> list[str]: ...
    @property
    def report(self) -> dict[str, Any]: ...
    def at(
        self, simplicity: float, *, progress: _Progress | None = None, cancel: _Flag | None = None
    ) -> Simplified: ...
    def rescaled(
        self, scale: float, *, progress: _Progress | None = None, cancel: _Flag | None = None
    ) -> Simplified: ...

@final
class Quads:
    def _repr_png_(self) -> bytes | None: ...
    @property
    def mesh(self) -> Mesh: ...
    @property
    def points(self) -> npt.NDArray[np.float64]: ...
    @property
    def cells(self) -> npt.NDArray[np.uint32]: ...
    @property
    def polycube_points(self) -> npt.NDArray[np.float64]: ...
    @property
    def label(self) -> npt.NDArray[np.int8]: ...
    @property
    def patch_id(self) -> npt.NDArray[np.uint32]: ...
    @property
    def block_id(self) -> npt.NDArray[np.uint32]: ...
    @property
    def scaled_jacobian(self) -> npt.NDArray[np.float64]: ...
    @property
    def feature_edges(self) -> npt.NDArray[np.uint32]: ...
    def __len__(self) -> int: ...
    @property
    def uv(self) -> npt.NDArray[np.float64]: ...
    def write(self, path: _Path, uv: bool = False) -> None: ...

@final
class Hexes:
    def _repr_png_(self) -> bytes | None: ...
    @property
    def mesh(self) -> Mesh: ...
    @property
    def points(self) -> npt.NDArray[np.float64]: ...
    @property
    def cells(self) -> npt.NDArray[np.uint32]: ...
    @property
    def polycube_points(self) -> npt.NDArray[np.float64]: ...
    @property
    def label(self) -> npt.NDArray[np.int8]: ...
    @property
    def block_id(self) -> npt.NDArray[np.uint32]: ...
    @property
    def scaled_jacobian(self) -> npt.NDArray[np.float64]: ...
    @property
    def edge_ratio(self) -> npt.NDArray[np.float64]: ...
    @property
    def determinant(self) -> npt.NDArray[np.float64]: ...
    @property
    def non_orthogonality(self) -> npt.NDArray[np.float64]: ...
    @property
    def skewness(self) -> npt.NDArray[np.float64]: ...
    def __len__(self) -> int: ...
    def write(self, path: _Path, points: npt.ArrayLike | None = None, groups: _Path | None = None) -> None: ...

@final
class SingularEdge:
    @property
    def points(self) -> npt.NDArray[np.float64]: ...
    @property
    def valence(self) -> int: ...

@final
class Layout:
    @property
    def patches(self) -> Mesh: ...
    @property
    def patch_label(self) -> npt.NDArray[np.int8]: ...
    @property
    def blocks(self) -> Mesh | None: ...
    @property
    def singular_edges(self) -> list[SingularEdge]: ...

@final
class Made:
    def _repr_png_(self) -> bytes | None: ...
    @property
    def shape(self) -> Mesh: ...
    @property
    def polycube(self) -> Mesh: ...
    @property
    def labels(self) -> npt.NDArray[np.int8]: ...
    @property
    def good(self) -> bool: ...
    @property
    def report(self) -> dict[str, Any]: ...

@final
class Remeshed:
    def _repr_png_(self) -> bytes | None: ...
    @property
    def made(self) -> Made | None: ...
    @property
    def simplified(self) -> Simplified: ...
    @property
    def quads(self) -> Quads: ...
    @property
    def hexes(self) -> _Hexes: ...
    @property
    def layout(self) -> Layout: ...
    @property
    def good(self) -> bool: ...
    @property
    def notes(self) -> list[str]: ...
    @property
    def report(self) -> dict[str, Any]: ...

@final
class Job(Generic[_T_co]):
    def __class_getitem__(cls, item: Any) -> GenericAlias: ...
    @staticmethod
    def make(
        shape: Mesh,
        *,
        detail: float | None = None,
        corners: int | None = None,
        axes: _Axes | None = None,
        labels: npt.ArrayLike | None = None,
        no_repair: bool = False,
    ) -> Job[Made]: ...
    @staticmethod
    def simplify(
        polycube: Mesh,
        shape: Mesh | None = None,
        *,
        labels: npt.ArrayLike | None = None,
        strategy: _Strategy = "best",
        scale: float | None = None,
        edge_length: float | None = None,
        objective: _Objective | None = None,
        simplicity: float = 1.0,
        max_displacement: float | None = None,
        max_distortion: float | None = None,
        locked_faces: npt.ArrayLike | None = None,
        guides: _Guides | None = None,
        steps: int = 400,
        proof_nodes: int = 200,
        time_limit: float | None = None,
        lambda_min: float = 0.0,
        solver: _Solver = "exact",
        angle_tolerance: float = 30.0,
        level_tolerance: float = 0.05,
        no_repair: bool = False,
    ) -> Job[Simplified]: ...
    @staticmethod
    def remesh(
        shape: Mesh,
        polycube: Mesh | None = None,
        *,
        detail: float | None = None,
        corners: int | None = None,
        axes: _Axes | None = None,
        labels: npt.ArrayLike | None = None,
        hexes: int | None = None,
        edge_length: float | None = None,
        scale: float | None = None,
        padding: int = 1,
        surface_only: bool = False,
        max_hausdorff: float = 0.5,
        strategy: _Strategy = "best",
        objective: _Objective | None = None,
        simplicity: float | None = None,
        max_displacement: float | None = None,
        max_distortion: float | None = None,
        locked_faces: npt.ArrayLike | None = None,
        guides: _Guides | None = None,
        steps: int = 400,
        proof_nodes: int = 200,
        time_limit: float | None = None,
        lambda_min: float = 0.0,
        solver: _Solver = "exact",
        angle_tolerance: float = 30.0,
        level_tolerance: float = 0.05,
        no_repair: bool = False,
    ) -> Job[Remeshed]: ...
    @property
    def progress(self) -> tuple[str, float]: ...
    @property
    def done(self) -> bool: ...
    def cancel(self) -> None: ...
    def wait(self, timeout: float | None = None) -> bool: ...
    def result(self) -> _T_co: ...

def _panic() -> None: ...
def _restore(class_: str, version: str, parts: tuple[object, ...], rest: bytes) -> object: ...
def read(path: _Path) -> Mesh: ...
def read_pair(shape: _Path, polycube: _Path) -> tuple[Mesh, Mesh]: ...
def read_labels(
    path: _Path, polycube: Mesh, source: _Path | None = None, order: str | None = None
) -> npt.NDArray[np.int8]: ...
def example(name: str = "cube-spikes", *, seed: int = 1, kind: str = "tetrahedra") -> tuple[Mesh, Mesh]: ...
def check(
    polycube: Mesh,
    labels: npt.ArrayLike | None = None,
    *,
    shape: Mesh | None = None,
    angle_tolerance: float = 30.0,
    level_tolerance: float = 0.05,
) -> list[Violation]: ...
def check_shape(shape: Mesh) -> list[Violation]: ...
def structure(
    polycube: Mesh,
    labels: npt.ArrayLike | None = None,
    *,
    angle_tolerance: float = 30.0,
    level_tolerance: float = 0.05,
) -> Structure: ...
def make(
    shape: Mesh,
    *,
    detail: float | None = None,
    corners: int | None = None,
    axes: _Axes | None = None,
    labels: npt.ArrayLike | None = None,
    no_repair: bool = False,
    progress: _Progress | None = None,
    cancel: _Flag | None = None,
) -> Made: ...
def simplify(
    polycube: Mesh,
    shape: Mesh | None = None,
    *,
    labels: npt.ArrayLike | None = None,
    strategy: _Strategy = "best",
    scale: float | None = None,
    edge_length: float | None = None,
    objective: _Objective | None = None,
    simplicity: float = 1.0,
    max_displacement: float | None = None,
    max_distortion: float | None = None,
    locked_faces: npt.ArrayLike | None = None,
    guides: _Guides | None = None,
    steps: int = 400,
    proof_nodes: int = 200,
    time_limit: float | None = None,
    lambda_min: float = 0.0,
    solver: _Solver = "exact",
    angle_tolerance: float = 30.0,
    level_tolerance: float = 0.05,
    no_repair: bool = False,
    progress: _Progress | None = None,
    cancel: _Flag | None = None,
) -> Simplified: ...
def remesh(
    shape: Mesh,
    polycube: Mesh | None = None,
    *,
    detail: float | None = None,
    corners: int | None = None,
    axes: _Axes | None = None,
    labels: npt.ArrayLike | None = None,
    hexes: int | None = None,
    edge_length: float | None = None,
    scale: float | None = None,
    padding: int = 1,
    surface_only: bool = False,
    max_hausdorff: float = 0.5,
    strategy: _Strategy = "best",
    objective: _Objective | None = None,
    simplicity: float | None = None,
    max_displacement: float | None = None,
    max_distortion: float | None = None,
    locked_faces: npt.ArrayLike | None = None,
    guides: _Guides | None = None,
    steps: int = 400,
    proof_nodes: int = 200,
    time_limit: float | None = None,
    lambda_min: float = 0.0,
    solver: _Solver = "exact",
    angle_tolerance: float = 30.0,
    level_tolerance: float = 0.05,
    no_repair: bool = False,
    progress: _Progress | None = None,
    cancel: _Flag | None = None,
) -> Remeshed: ...
