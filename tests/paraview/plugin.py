"""The plugin's proxies, and functions that the scripts inside of ParaView share."""

import pathlib
import xml.etree.ElementTree

PLUGIN = pathlib.Path(__file__).resolve().parents[2] / "filters" / "paraview" / "plugin"
GROUPS = ("sources", "filters", "writers")
# Largest time in milliseconds from a motion of the mouse to the start of drawing, in a drag on 99,456 triangles.
DRAG_LIMIT = 40


def proxies():
    """Return (group, name, XML element) of every source, reader, filter and writer of the plugin."""
    found = []
    for template in sorted(PLUGIN.glob("*.xml")):
        for group in xml.etree.ElementTree.parse(template).getroot().iter("ProxyGroup"):
            if group.get("name") in GROUPS:
                found += [(group.get("name"), proxy.get("name"), proxy) for proxy in group if proxy.tag in ("SourceProxy", "WriterProxy")]
    return found


def icons():
    """Return the paths of the icons in the plugin's resources. Every icon must be a file."""
    paths = []
    for prefix in xml.etree.ElementTree.parse(PLUGIN / "icons.qrc").getroot().iter("qresource"):
        for file in prefix.iter("file"):
            assert (PLUGIN / file.text).is_file(), file.text
            paths.append(f":{prefix.get('prefix')}/{file.get('alias', file.text)}")
    return paths


def fetch(proxy, port=0):
    """Update a proxy and return one of its outputs."""
    from paraview import servermanager

    proxy.UpdatePipeline()
    return servermanager.Fetch(proxy, idx=port)


def points_of(data):
    from vtkmodules.util.numpy_support import vtk_to_numpy

    return vtk_to_numpy(data.GetPoints().GetData()).astype(float)


def properties_of(proxy):
    """Return the properties of a vtkSMProxy by name."""
    found = {}
    iterator = proxy.NewPropertyIterator()
    iterator.Begin()
    while not iterator.IsAtEnd():
        found[iterator.GetKey()] = iterator.GetProperty()
        iterator.Next()
    return found
