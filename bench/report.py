"""Tables in Markdown, on what they were measured, and how time is taken."""

import os
import platform
import resource
import subprocess
import time
from pathlib import Path


class Report:
    """Writes as it goes, to the screen and, if asked for, to a file."""

    def __init__(self, file=None):
        self.file = open(file, "w") if file else None
        self.missed = 0

    def line(self, text=""):
        print(text, flush=True)
        if self.file:
            print(text, file=self.file, flush=True)

    def table(self, title, *columns):
        self.line(f"\n## {title}\n")
        self.row(*columns)
        self.row("---", *["--:"] * (len(columns) - 1))

    def row(self, *cells):
        self.line("| " + " | ".join(number(c) if isinstance(c, float) else str(c) for c in cells) + " |")

    def target(self, what, size, measured, allowed, unit="ms"):
        """A row of what was measured against what is allowed; up to 1 is within the target."""
        ratio = measured / allowed
        self.missed += ratio > 1
        mark = "" if ratio <= 1 else " **missed**"
        self.row(what, size, f"{number(measured)} {unit}", f"{number(allowed)} {unit}", f"{ratio:.2f}{mark}")


def number(value):
    """Three digits."""
    return f"{value:,.0f}" if abs(value) >= 100 else f"{value:.3g}"


def machine():
    """One line on the machine and what else it had to do."""
    models = [l.split(":", 1)[1].strip() for l in lines("/proc/cpuinfo") if l.startswith("model name")]
    memory = next((int(l.split()[1]) / 2**20 for l in lines("/proc/meminfo") if l.startswith("MemTotal")), 0)
    commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], capture_output=True, text=True).stdout.strip()
    rust = subprocess.run(["rustc", "--version"], capture_output=True, text=True).stdout.split()[1:2]
    parts = [
        f"{models[0] if models else platform.processor()}, {os.cpu_count()} processors, {memory:.0f} GB",
        platform.platform(terse=True),
        f"rustc {' '.join(rust)}",
        f"commit {commit}",
        time.strftime("%-d %B %Y"),
        f"load {os.getloadavg()[0]:.1f} before",
    ]
    return "; ".join(part for part in parts if part)


def lines(path):
    return Path(path).read_text().splitlines() if Path(path).is_file() else []


def processor_time():
    """Of this process and of those that it waited for, in seconds."""
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(u.ru_utime + u.ru_stime for u in used)


def milliseconds(work, runs=1):
    """The shortest time that `work` takes or, if that is less as the machine is busy, its mean processor time."""
    best, before = float("inf"), processor_time()
    for _ in range(runs):
        start = time.perf_counter()
        work()
        best = min(best, time.perf_counter() - start)
    return 1e3 * min(best, (processor_time() - before) / runs)


def process(call):
    """Milliseconds that a process takes from start to end or, where that is less because the machine is busy, of
    processor time; and the most memory that it has, in MB."""
    start = time.perf_counter()
    running = subprocess.Popen([str(word) for word in call], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, used = os.wait4(running.pid, 0)
    running.returncode = os.waitstatus_to_exitcode(status)
    # 4: the meshes are written, but coarser than the shape asks for.
    if running.returncode not in (0, 4):
        raise subprocess.CalledProcessError(running.returncode, call)
    spent = min(time.perf_counter() - start, used.ru_utime + used.ru_stime)
    return 1e3 * spent, used.ru_maxrss / 1024.0
