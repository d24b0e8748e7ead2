"""fetch_headers.sh tells what Debian no longer has from what could not be asked for."""

import functools
import http.server
import os
import socket
import subprocess
import threading

import pytest
from conftest import ROOT


def fetch(mirror, folder):
    """The exit code and the message of a try with this mirror."""
    command = [ROOT / "meshlab_plugin/fetch_headers.sh", "2025.07", folder / "headers"]
    done = subprocess.run(command, env={**os.environ, "DEBIAN_MIRROR": mirror}, capture_output=True, text=True, timeout=120)
    assert not (folder / "headers").exists()
    return done.returncode, done.stderr


@pytest.fixture
def empty_mirror(tmp_path):
    """The address of a web server without any file."""
    handler = functools.partial(http.server.SimpleHTTPRequestHandler, directory=tmp_path)
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}/debian"
        server.shutdown()


def test_a_suite_that_is_gone_has_its_own_code(empty_mirror, tmp_path):
    code, message = fetch(empty_mirror, tmp_path)
    assert code == 3 and "does not have the source" in message


def test_a_network_fault_says_what_to_do(tmp_path):
    with socket.socket() as unused:
        unused.bind(("127.0.0.1", 0))
        code, message = fetch(f"http://127.0.0.1:{unused.getsockname()[1]}/debian", tmp_path)
    assert code == 4 and "Check the network" in message and "DEBIAN_MIRROR" in message
