"""The page about Python, run as it stands.

With TRESS_PICTURES naming a folder, the pictures of the page are written there.
"""

import os
import pathlib
import re
import shutil

import numpy as np
import tress

ROOT = pathlib.Path(__file__).parents[3]


def test_every_block_runs_and_its_assertions_hold(tmp_path, monkeypatch):
    (tmp_path / "fixtures").mkdir()
    shutil.copy(ROOT / "fixtures" / "patch.hair", tmp_path / "fixtures")
    monkeypatch.chdir(tmp_path)
    text = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
    blocks = re.findall(r"^```python\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    assert len(blocks) > 8
    names = {}
    for block in blocks:
        exec(compile(block, "docs/python.md", "exec"), names)
    assert {"as it is.png", "groom.tress"} <= {path.name for path in tmp_path.iterdir()}
    folder = os.environ.get("TRESS_PICTURES")
    if folder:
        sheet = np.concatenate(names["row"], axis=1)
        pathlib.Path(folder, "python-edits.png").write_bytes(tress.png(sheet))
        pathlib.Path(folder, "python-turns.png").write_bytes(tress.png(names["colored"]))
