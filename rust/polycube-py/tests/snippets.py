"""The Python code of the documents: what is run by the tests, and what `mypy --strict` must pass.

python snippets.py FOLDER     writes that of each document to a file in FOLDER
"""

import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parents[1]
DOCUMENTS = {"module": HERE / "README.md", "project": HERE.parents[1] / "README.md"}
DOCUMENTS["guide"] = HERE.parents[1] / "docs" / "guide.md"


def blocks(document: Path) -> list[str]:
    """The blocks of Python in a document."""
    return re.findall(r"```python\n(.*?)```", document.read_text(), re.DOTALL)


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for name, document in DOCUMENTS.items():
        (folder / f"{name}.py").write_text("\n".join(blocks(document)))
