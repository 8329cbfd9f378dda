"""Fixtures of the tests of the command-line program: `folder`, which all of them use, and `empty_temporary_folder`."""

import os

import pytest
from driver import Folder


@pytest.fixture
def folder(tmp_path):
    """Return an empty folder, into which the meshes of shapes.py are written on demand."""
    return Folder(tmp_path)


@pytest.fixture
def empty_temporary_folder(tmp_path_factory, monkeypatch):
    """Provide a folder for temporary files and check that it is empty at the end."""
    temporary = tmp_path_factory.mktemp("temporary")
    monkeypatch.setenv("TMPDIR", str(temporary))
    yield
    assert os.listdir(temporary) == []
