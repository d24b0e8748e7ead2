"""What can go wrong: one class for each kind, all of them a `PolycubeError`."""

from __future__ import annotations


class PolycubeError(Exception):
    """Anything that the library refuses or fails to do. Says what is wrong, where, and what to do about it."""

    kind: str
    """The kind, one for each class: "mesh", "polycube", "mismatch", "option", ..."""
    message: str
    """What is wrong, in plain words."""
    element: str | None
    """What `elements` are: "vertex", "edge" (its two vertices), "face" (of the boundary), "cell", "facet",
    "polycube_edge" or "line" (of a file, counted from 1); None where no element is concerned."""
    elements: tuple[int, ...]
    """The element concerned: one number, or the two vertices of an edge."""
    place: tuple[float, float, float] | None
    """The middle of the element, in the units of the polycube, where there is one."""
    remedy: str
    """What to do about it; empty where nothing can be advised."""

    def __init__(
        self,
        text: str = "",
        kind: str = "internal",
        message: str | None = None,
        element: str | None = None,
        elements: tuple[int, ...] = (),
        place: tuple[float, float, float] | None = None,
        remedy: str = "",
    ) -> None:
        # All arguments go on, so that the error can be pickled and sent to another process.
        super().__init__(text, kind, message, element, elements, place, remedy)
        self.kind = kind
        self.message = text if message is None else message
        self.element = element
        self.elements = elements
        self.place = place
        self.remedy = remedy

    def __str__(self) -> str:
        return str(self.args[0])

    def __repr__(self) -> str:
        return f"{type(self).__name__}({str(self)!r})"


class FileError(PolycubeError, OSError):
    """A file cannot be read, created, written or renamed."""


class ParseError(PolycubeError, ValueError):
    """A file does not follow its format."""


class Unsupported(PolycubeError, ValueError):
    """The format or the kind of cells is not supported."""


class InvalidMesh(PolycubeError, ValueError):
    """The mesh cannot be used: empty, not finite, open, non-manifold, badly oriented, or arrays of wrong shape."""


class InvalidPolycube(PolycubeError, ValueError):
    """The mesh is not a polycube. `polycube.check` lists everything that is wrong with it."""


class Mismatch(PolycubeError, ValueError):
    """Shape, polycube and labels do not have the same vertices and cells."""


class InvalidOption(PolycubeError, ValueError):
    """An option is out of its range or contradicts another."""


class Infeasible(PolycubeError, ValueError):
    """No integer polycube satisfies the constraints."""


class Cancelled(PolycubeError):
    """The caller cancelled."""


class InternalError(PolycubeError, RuntimeError):
    """A fault of this library; please report it."""
