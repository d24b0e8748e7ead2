"""What the documentation shows is run, and nothing public is without documentation."""

import doctest
import inspect
import re
import runpy
import sys

import pytest
from snippets import DOCUMENTS, HERE, blocks

import polycube



def documented() -> dict[str, object]:
    """Everything public by its name, members of classes included."""
    found = {name: getattr(polycube, name) for name in polycube.__all__}
    for name, value in list(found.items()):
        if inspect.isclass(value) and not issubclass(value, Exception):
            members = {k: v for k, v in vars(value).items() if not k.startswith("_")}
            found |= {f"{name}.{k}": v for k, v in members.items()}
    return found


EXAMPLES = {"polycube": polycube} | {k: v for k, v in documented().items() if ">>>" in (inspect.getdoc(v) or "")}


@pytest.mark.parametrize("name", EXAMPLES)
def test_examples_in_docstrings(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    test = doctest.DocTestParser().get_doctest(inspect.getdoc(EXAMPLES[name]), {}, name, None, None)
    assert test.examples
    report = []
    doctest.DocTestRunner(verbose=False).run(test, out=report.append)
    assert not report, "".join(report)


def test_everything_public_is_documented():
    values = {name: value for name, value in documented().items() if name not in ("__version__", "EXAMPLES")}
    assert [name for name, value in values.items() if not inspect.getdoc(value)] == []


@pytest.mark.parametrize("document", DOCUMENTS.values(), ids=DOCUMENTS)
def test_the_documents(document, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code = blocks(document)
    assert code
    names: dict[str, object] = {}
    for block in code:
        exec(compile(block, str(document), "exec"), names)


@pytest.mark.parametrize("example", sorted((HERE / "examples").glob("*.py")), ids=lambda path: path.name)
def test_the_examples(example, tmp_path, monkeypatch):
    for module in re.findall(r"^import (\w+)", example.read_text(), re.MULTILINE):
        pytest.importorskip(module)
    monkeypatch.setattr(sys, "argv", [example.name, str(tmp_path)])
    runpy.run_path(str(example), run_name="__main__")
    assert list(tmp_path.iterdir())
