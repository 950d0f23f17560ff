import os
import pathlib

import pytest


@pytest.fixture
def xml():
    return pathlib.Path(os.environ["RUNNEL_XML"])


@pytest.fixture
def program():
    return str(pathlib.Path(os.environ["RUNNEL_BIN"]) / "runnel")


@pytest.fixture(autouse=True)
def empty_folder(tmp_path, monkeypatch):
    """Every test in a folder of its own, with sockets of its own."""
    (tmp_path / "run").mkdir(mode=0o700)
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path / "run"))
    monkeypatch.chdir(tmp_path)
    return tmp_path
