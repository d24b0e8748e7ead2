"""What the programs that read meshes share: faces of hexahedra, sets, how a check fails. Used by tests/readers.py."""

import os
import sys

# Debian's OpenFOAM finds its own files by this alone.
FOAM = {**os.environ, "WM_PROJECT_DIR": "/usr/share/openfoam", "FOAM_SIGFPE": "false"}
FACES = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))


def check(truth, message):
    if not truth:
        sys.exit(f"failed: {message}")


class Union:
    """Disjoint sets of the numbers below `count`."""

    def __init__(self, count):
        self.parent = list(range(count))

    def find(self, a):
        while self.parent[a] != a:
            self.parent[a] = self.parent[self.parent[a]]
            a = self.parent[a]
        return a

    def join(self, a, b):
        self.parent[self.find(a)] = self.find(b)

    def sets(self):
        return len({self.find(a) for a in range(len(self.parent))})


def sides(ring):
    return [frozenset((ring[i - 1], ring[i])) for i in range(len(ring))]


def gather(pairs):
    """Lists of the second values by the first."""
    lists = {}
    for key, value in pairs:
        lists.setdefault(key, []).append(value)
    return lists
