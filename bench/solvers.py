"""Solves problem files as MIQP with SCIP and compares with the project's solvers.

    cargo build --release --example solve_problem
    pip install pyscipopt
    python bench/solvers.py target/release/examples/solve_problem problem.json...
    python bench/solvers.py target/release/examples/solve_problem --random 20 [--variables 30]

A problem file is the JSON form of `polycube::align::problem::Problem`. Prints for each file the cost and the seconds
of SCIP and of both solvers, and exits with 1 if a cost differs by more than 1e-6 of itself.
"""

import argparse
import json
import random
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from pyscipopt import Model, quicksum

FRACTION = 2**20


def random_problem(rng, n, pairs, differences, rows=0):
    """A feasible problem like those of one axis: facets in order, neighbours kept apart, near ones paired."""
    hidden = sorted(rng.uniform(0, 2 * n) for _ in range(n))
    chosen = []
    for _ in range(pairs):
        a = rng.randrange(n)
        b = min(max(a + rng.randint(-8, 8), 0), n - 1)
        chosen.append({"a": a, "b": b, "weight": rng.randint(1, 4)})
    kept = []
    for _ in range(differences):
        low = rng.randrange(n - 1)
        high = min(low + rng.randint(1, 8), n - 1)
        kept.append({"low": low, "high": high, "gap": rng.randint(0, 1)})
    linear = []
    for _ in range(rows):
        # Levels 0, 2, 4… satisfy everything, so there is a solution.
        terms = [[rng.randrange(n), rng.uniform(-2, 2)] for _ in range(3)]
        linear.append({"terms": terms, "at_least": sum(c * 2 * i for i, c in terms) - rng.uniform(0, 2)})
    shape = [{"weight": rng.randint(3, 12), "target": t + rng.gauss(0, 2)} for t in hidden]
    return {"shape": shape, "pairs": chosen, "halvings": rng.randint(0, 8), "differences": kept, "linear": linear}


def scip(problem, time_limit):
    """Optimal cost and seconds; the cost is evaluated again at the rounded levels."""
    model = Model()
    model.hideOutput()
    model.setParam("limits/time", time_limit)
    model.setParam("limits/gap", 0.0)
    rate = 0.5 ** problem["halvings"]
    shape = [(s["weight"], round(s["target"] * FRACTION) / FRACTION) for s in problem["shape"]]
    x = [model.addVar(vtype="I", lb=None, ub=None) for _ in shape]

    def cost(x, total):
        pairs = total(p["weight"] * (x[p["a"]] - x[p["b"]]) * (x[p["a"]] - x[p["b"]]) for p in problem["pairs"])
        return pairs + rate * total(w * (x[i] - t) * (x[i] - t) for i, (w, t) in enumerate(shape))

    for d in problem["differences"]:
        model.addCons(x[d["high"]] - x[d["low"]] >= d["gap"])
    for row in problem["linear"]:
        model.addCons(quicksum(c * x[i] for i, c in row["terms"]) >= row["at_least"])
    bound = model.addVar(lb=0)
    model.addCons(bound >= cost(x, quicksum))
    model.setObjective(bound)
    clock = time.perf_counter()
    model.optimize()
    seconds = time.perf_counter() - clock
    levels = [round(model.getVal(v)) for v in x]
    return cost(levels, sum), seconds, model.getStatus()


def write_random(count, variables, rows, seed):
    folder = Path(tempfile.mkdtemp(prefix="problems-"))
    rng = random.Random(seed)
    for i in range(count):
        problem = random_problem(rng, variables, variables, 2 * variables, rows)
        (folder / f"{i:03}.json").write_text(json.dumps(problem))
    return sorted(folder.glob("*.json"))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="the built example solve_problem")
    parser.add_argument("files", nargs="*")
    parser.add_argument("--random", type=int, default=0, help="number of random problems to add")
    parser.add_argument("--variables", type=int, default=30, help="variables of each random problem")
    parser.add_argument("--rows", type=int, default=0, help="constraints of each that are not differences")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--time-limit", type=float, default=60.0, help="seconds for SCIP on each problem")
    options = parser.parse_args()
    files = options.files + write_random(options.random, options.variables, options.rows, options.seed)
    differ = 0
    print(f"{'file':12} {'SCIP cost':>16} {'SCIP s':>9} {'exact s':>10} {'warm s':>10} {'linear s':>10}  agree")
    for file in files:
        ours = json.loads(subprocess.check_output([options.program, str(file)]))
        problem = json.loads(Path(file).read_text())
        cost, seconds, status = scip(problem, options.time_limit)
        # The exact solver refuses constraints that are not differences.
        costs = [ours[name].get("cost") for name in (["linear"] if problem["linear"] else ["exact", "linear"])]
        agree = all(c is not None and abs(c - cost) <= 1e-6 * max(1.0, cost) for c in costs)
        differ += not agree
        times = [ours.get(name, {}).get("seconds", float("nan")) for name in ("exact", "exact_warm", "linear")]
        columns = " ".join(f"{t:10.6f}" for t in times)
        print(f"{Path(file).name:12} {cost:16.6f} {seconds:9.4f} {columns}  {'yes' if agree else f'NO {costs}'} {status}")
    print(f"{len(files)} problems, {differ} differ")
    return 1 if differ else 0


if __name__ == "__main__":
    sys.exit(main())
