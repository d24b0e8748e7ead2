"""What the plugin for the program MeshLab 2025.07 must be to be loaded; the program itself is not in Debian 12."""

import re
import subprocess

from conftest import required


def run(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def test_the_module_stands_alone():
    needed = set(re.findall(r"NEEDED.*\[(.*)\]", run("readelf", "-d", required("POLYCUBE_MODULE"))))
    host = {"libmeshlab-common.so", "libQt5Core.so.5", "libQt5Gui.so.5", "libQt5Widgets.so.5"}
    system = {"libstdc++.so.6", "libm.so.6", "libgcc_s.so.1", "libc.so.6", "ld-linux-x86-64.so.2"}
    assert needed <= host | system and "libmeshlab-common.so" in needed


def test_the_module_counts_in_single_precision():
    symbols = run("nm", "-DC", required("POLYCUBE_MODULE"))
    assert re.search(r" T qt_plugin_instance", symbols)
    assert "vcg::Point3<double>" not in symbols


def test_only_the_plugin_itself_is_exported():
    exported = [line for line in run("nm", "-DC", "--defined-only", required("POLYCUBE_MODULE")).splitlines()]
    assert not [line for line in exported if re.search(r" T (polycube|rust|cxxbridge|_R)", line)]
