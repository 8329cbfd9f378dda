"""The fixture `folder`, which all tests of the command-line program use."""

import pytest
from driver import Folder


@pytest.fixture
def folder(tmp_path):
    """Return an empty folder, into which the meshes of shapes.py are written on demand."""
    return Folder(tmp_path)
