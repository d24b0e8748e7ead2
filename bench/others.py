"""What we solve, solved by others: the integer problems of alignments, the linear systems of morphs.

The library's tests write both, as they occur, to a folder (`for_bench` in `align/paper` and in `map`).
"""

import importlib.util
import json
import subprocess

from report import milliseconds

# Seconds for one integer problem.
PATIENCE = 20.0
# Of a cost or of the largest coordinate: what answers may differ by.
SAME_COST, SAME_PLACE = 1e-6, 1e-7


def alignments(report, release, highs, folder):
    """All integer problems of Algorithm 1 on a polycube."""
    report.table("Alignment against solvers of integer programs", "polycube", "problems", "variables", "ours, ms",
                 "other", "theirs, ms", "theirs / ours")
    stems = sorted({file.name.split(".")[0] for file in folder.glob("*.*.json")})
    for stem in stems:
        files = sorted(folder.glob(f"{stem}.*.json"))
        variables = max(len(json.loads(file.read_text())["shape"]) for file in files)
        exact = [line["exact"] for line in solved(release, files, "--exact-only")]
        ours = 1e3 * sum(e["seconds"] for e in exact)
        for name, answers in others(release, highs, files):
            compare(report, (stem, len(files), variables), ours, exact, name, answers)
    if importlib.util.find_spec("pyscipopt") is None:
        report.line("\nSCIP is left out: it is not installed.")


def compare(report, head, ours, exact, name, answers):
    """A row for one of the others; an answer is cost, seconds, and whether it is proven."""
    missing = sum(not proven for _, _, proven in answers)
    for mine, (cost, _, proven) in zip(exact, answers):
        if proven and abs(cost - mine["cost"]) > SAME_COST * max(1.0, cost):
            report.missed += 1
            report.line(f"{name} finds the cost {cost}, we {mine['cost']}")
    theirs = 1e3 * sum(seconds for _, seconds, _ in answers)
    more = f" (gave up on {missing} after {PATIENCE:.0f} s each)" if missing else ""
    report.row(*head, ours, name, f"{theirs:,.1f}{more}", f"{'> ' if missing else ''}{theirs / ours:,.0f}")


def others(release, highs, files):
    try:
        from solvers import scip

        answers = [scip(json.loads(file.read_text()), PATIENCE) for file in files]
        yield "SCIP, MIQP", [(cost, seconds, status == "optimal") for cost, seconds, status in answers]
    except ImportError:
        pass  # `alignments` says so.
    for name, folder in (("HiGHS through good_lp, chords", highs), ("microlp through good_lp, chords", release)):
        if (folder / "examples" / "solve_problem").is_file():
            found = [line["linear"] for line in solved(folder, files)]
            yield name, [(f.get("cost"), f.get("seconds", PATIENCE), "cost" in f) for f in found]


def solved(release, files, *options):
    output = subprocess.check_output([release / "examples" / "solve_problem", *options, *files])
    return [json.loads(line) for line in output.splitlines()]


def factorisations(report, systems, folder):
    """The linear systems of a morph, with all their right sides."""
    try:
        import numpy
        from scipy.io import mmread
    except ImportError:
        return report.line("\nSuperLU, CHOLMOD and UMFPACK are left out: SciPy is not installed.")
    report.table("Morph against factorisations of the same matrix", "system", "unknowns", "right sides", "ours, ms",
                 "other", "theirs, ms", "theirs / ours", "answers differ by")
    for system in systems:
        read = lambda what: mmread(folder / f"{system['name']}.{what}.mtx")
        matrix, sides, mine = read("matrix").tocsc(), read("sides"), read("ours")
        ours = 1e3 * system["seconds"]
        for name, solve in factorisers(matrix):
            answer = []
            theirs = milliseconds(lambda: answer.append(solve(matrix, sides)))
            differ = float(numpy.abs(answer[0] - mine).max() / numpy.abs(mine).max())
            report.missed += differ > SAME_PLACE
            report.row(system["name"], system["unknowns"], sides.shape[1], ours, name, theirs, theirs / ours, f"{differ:.0e}")


def factorisers(matrix):
    """Names and functions of what can factorise the matrix; CHOLMOD only where it is symmetric."""
    from scipy.sparse.linalg import splu

    yield "SuperLU (SciPy)", lambda a, b: splu(a).solve(b)
    try:
        from cvxopt import cholmod, matrix as dense, spmatrix, umfpack
    except ImportError:
        return

    def through(solve):
        def run(a, b):
            a, x = a.tocoo(), dense(b)
            solve(spmatrix(a.data, a.row, a.col, a.shape), x)
            return numpy_of(x)

        return run

    if abs(matrix - matrix.T).max() <= 1e-12 * abs(matrix).max():
        yield "CHOLMOD (CVXOPT)", through(cholmod.linsolve)
    yield "UMFPACK (CVXOPT)", through(umfpack.linsolve)


def numpy_of(x):
    import numpy

    return numpy.array(x)
