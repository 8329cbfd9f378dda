"""The fixture that every test of the program uses."""

import pytest
from driver import Folder


@pytest.fixture
def folder(tmp_path):
    """An empty folder with the meshes of shapes.py, written on demand."""
    return Folder(tmp_path)
