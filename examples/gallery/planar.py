"""Create a cartoon, and draw tiles that show pictures as meshes in the plane."""

import bindpose
import numpy as np
import vtkmodules.vtkRenderingFreeType  # noqa: F401  needed to draw texts
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  needed to draw
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkGlyph3D, vtkTubeFilter
from vtkmodules.vtkFiltersSources import vtkRegularPolygonSource, vtkSphereSource
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkRenderWindow,
    vtkTextActor,
    vtkTexture,
    vtkWindowToImageFilter,
)

# The cat's limbs: start, end, and radii at both ends. The drawing is 1 wide and 1 high, with y upwards.
TAIL = [(0.64, 0.20), (0.78, 0.16), (0.87, 0.25), (0.88, 0.38), (0.82, 0.46)]
LIMBS = [((0.50, 0.30), (0.50, 0.50), 0.155, 0.12), ((0.50, 0.73), (0.50, 0.73), 0.155, 0.155),  # belly, head
         ((0.41, 0.81), (0.355, 0.93), 0.07, 0.012), ((0.59, 0.81), (0.645, 0.93), 0.07, 0.012),  # ears
         ((0.41, 0.53), (0.21, 0.63), 0.05, 0.042), ((0.21, 0.63), (0.13, 0.80), 0.042, 0.05),  # waving arm
         ((0.59, 0.53), (0.75, 0.50), 0.05, 0.04), ((0.75, 0.50), (0.655, 0.355), 0.04, 0.042),  # arm on the hip
         ((0.43, 0.22), (0.37, 0.075), 0.065, 0.055), ((0.57, 0.22), (0.61, 0.075), 0.065, 0.055),  # legs
         *[(a, b, 0.035, 0.035) for a, b in zip(TAIL, TAIL[1:])]]
BONES = {"body": [(0.50, 0.28), (0.50, 0.55)], "head": [(0.50, 0.62), (0.50, 0.84)],
         "arm": [(0.38, 0.545), (0.21, 0.63)], "hand": [(0.21, 0.63), (0.13, 0.80)],
         "other arm": [(0.62, 0.523), (0.74, 0.50)], "left leg": [(0.43, 0.20), (0.37, 0.08)],
         "right leg": [(0.57, 0.20), (0.61, 0.08)], "tail": TAIL[1:3], "tip": TAIL[3:5]}


def capsule(x, y, start, end, first, last):
    """Return the signed distance from a disc that moves from start to end and changes its radius."""
    a, along = np.array(start), np.subtract(end, start)
    length = along @ along
    share = np.clip(((x - a[0]) * along[0] + (y - a[1]) * along[1]) / length, 0, 1) if length else 0.0
    return np.hypot(x - a[0] - share * along[0], y - a[1] - share * along[1]) - first - share * (last - first)


def cat_distance(x, y):
    """Return a function that is negative inside of the cat; its zeros are the outline."""
    return np.min([capsule(x, y, *limb) for limb in LIMBS], axis=0)


def pixel_centers(size):
    at = (np.arange(size) + 0.5) / size
    return np.meshgrid(at, at[::-1])  # the first row is at the top


def cat(size):
    """Return a picture of a cat as RGBA pixels (size x size x 4 bytes)."""
    x, y = pixel_centers(size)
    pixel = 1 / size
    color = np.zeros((size, size, 3)) + (240, 150, 60)

    def paint(distance, rgb):
        share = np.clip(0.5 - distance / pixel, 0, 1)[..., None]
        color[:] = (1 - share) * color + share * np.array(rgb)

    for k in range(12):  # paint the stripes
        paint(np.maximum(np.abs(y - 0.13 - 0.075 * k + 0.03 * np.sin(9 * x)) - 0.012, -np.abs(x - 0.5) + 0.06), (205, 105, 35))
    paint(capsule(x, y, (0.50, 0.29), (0.50, 0.43), 0.085, 0.06), (255, 232, 200))
    paint(capsule(x, y, (0.46, 0.665), (0.54, 0.665), 0.05, 0.05), (255, 232, 200))
    for side in (-1, 1):
        middle = 0.5 + side * 0.062
        paint(capsule(x, y, (middle, 0.755), (middle, 0.77), 0.04, 0.04), (255, 255, 255))
        paint(capsule(x, y, (middle + 0.008, 0.755), (middle + 0.008, 0.76), 0.02, 0.02), (30, 30, 40))
        paint(capsule(x, y, (0.5, 0.645), (0.5 + side * 0.045, 0.662), 0.006, 0.006), (90, 40, 20))
        for k in (-1, 0, 1):
            paint(capsule(x, y, (0.5 + side * 0.07, 0.68 + 0.012 * k), (0.5 + side * 0.135, 0.68 + 0.03 * k), 0.003, 0.002), (90, 40, 20))
    paint(capsule(x, y, (0.49, 0.695), (0.51, 0.695), 0.014, 0.014), (230, 90, 110))
    distance = cat_distance(x, y)
    paint(-distance - 0.010, (70, 35, 20))  # paint a dark rim
    alpha = np.clip(0.5 - distance / pixel, 0, 1)[..., None] * 255
    return np.rint(np.concatenate([color, alpha], axis=2)).astype(np.uint8)


def bones_of(size):
    """Return the handles in pixels, for the mesh of a picture of this size."""
    ends = [[[(x * size - 0.5), (y * size - 0.5), 0] for x, y in bone] for bone in BONES.values()]
    return bindpose.handles(bones=ends, names=list(BONES), parents=[-1] * len(ends))


def to_image(pixels):
    rows, columns, components = pixels.shape
    image = vtkImageData()
    image.SetDimensions(columns, rows, 1)
    colors = np.ascontiguousarray(pixels[::-1]).reshape(-1, components)
    image.GetPointData().SetScalars(numpy_to_vtk(colors, deep=True))
    return image


def write_png(pixels, path):
    """Write a picture to a file and return its path."""
    writer = vtkPNGWriter()
    writer.SetInputData(to_image(pixels))
    writer.SetFileName(str(path))
    writer.Write()
    return path


def to_texture(pixels):
    """Return an opaque texture of the picture's colors."""
    texture = vtkTexture()
    texture.SetInputData(to_image(pixels[..., :3]))
    texture.InterpolateOn()
    texture.RepeatOff()
    return texture


def flat_actor(data, color=None, width=1.0):
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(data)
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().LightingOff()
    if color:
        actor.GetProperty().SetColor(color)
    actor.GetProperty().SetLineWidth(width)
    return actor


def painted(data, name="Color"):
    """Color the points individually by an array of three bytes."""
    actor = flat_actor(data)
    mapper = actor.GetMapper()
    mapper.ScalarVisibilityOn()
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray(name)
    mapper.SetColorModeToDefault()
    return actor


def bands(data, values, colors, levels=10):
    """Draw values from 0 to 1 at the points as bands between colors ((value, (r, g, b)), …)."""
    shown = vtkPolyData()
    shown.ShallowCopy(data)
    array = numpy_to_vtk(np.ascontiguousarray(values, dtype=float), deep=True)
    array.SetName("Shown")
    shown.GetPointData().AddArray(array)
    table = vtkLookupTable()
    table.SetNumberOfTableValues(levels)
    at, rgb = [value for value, _ in colors], np.array([color for _, color in colors])
    for level in range(levels):
        middle = (level + 0.5) / levels
        table.SetTableValue(level, *(np.interp(middle, at, rgb[:, k]) for k in range(3)), 1)
    table.SetRange(0, 1)
    actor = flat_actor(shown)
    mapper = actor.GetMapper()
    mapper.ScalarVisibilityOn()
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray("Shown")
    mapper.SetLookupTable(table)
    mapper.SetScalarRange(0, 1)
    mapper.InterpolateScalarsBeforeMappingOn()
    return actor


def dots(places, colors, radius, height=1.0):
    """Draw discs with a dark rim at points, each in its color (numbers 0 to 1)."""
    actors = []
    for place, color in zip(places, colors):
        for size, shade, up in ((1.0, (0.12, 0.12, 0.12), 0.0), (0.72, color, 0.1)):
            disc = vtkRegularPolygonSource()
            disc.SetNumberOfSides(40)
            disc.SetRadius(size * radius)
            disc.SetCenter(place[0], place[1], height + up * radius)
            disc.Update()
            actors.append(flat_actor(disc.GetOutput(), tuple(shade)))
    return actors


def textured(data, texture):
    actor = flat_actor(data)
    actor.SetTexture(texture)
    return actor


def wires(data, color=(0.1, 0.2, 0.5), opacity=0.6, width=1.0):
    """Draw the edges of triangles, slightly in front of the triangles."""
    actor = flat_actor(data, color, width)
    actor.GetProperty().SetRepresentationToWireframe()
    actor.GetProperty().SetOpacity(opacity)
    actor.AddPosition(0, 0, 0.1)
    return actor


def handle_actors(handles, radius):
    """Draw bones as bars, their ends and points as balls."""
    tube = vtkTubeFilter()
    tube.SetInputData(handles)
    tube.SetRadius(0.45 * radius)
    tube.SetNumberOfSides(16)
    tube.Update()
    ball = vtkSphereSource()
    ball.SetRadius(radius)
    ball.SetThetaResolution(24)
    ball.SetPhiResolution(24)
    balls = vtkGlyph3D()
    balls.SetInputData(handles)
    balls.SetSourceConnection(ball.GetOutputPort())
    balls.ScalingOff()
    balls.Update()
    actors = [flat_actor(tube.GetOutput(), (0.16, 0.45, 0.85)), flat_actor(balls.GetOutput(), (0.95, 0.85, 0.2))]
    for actor in actors:
        actor.AddPosition(0, 0, 4 * radius)
    return actors


def posed_points(handles, moved):
    """Return the handle dataset with other points."""
    copy = vtkPolyData()
    copy.DeepCopy(handles)
    for number, point in enumerate(moved):
        copy.GetPoints().SetPoint(number, point)
    return copy


def paper(size, square=32):
    """Draw gray and white squares behind transparent parts."""
    y, x = np.mgrid[:size, :size] * (1024 // square) // size
    return np.where(((x + y) % 2)[..., None], 255, 225).astype(np.uint8) * np.ones(3, np.uint8)


def show(tiles, box, tile=(620, 620), title=""):
    """Draw tiles side by side, each with a caption and actors; all show the same box (x0, x1, y0, y1).

    Return the window, which has not been rendered yet.
    """
    head, foot = (46 if title else 0), 40
    width, height = tile[0] * len(tiles), tile[1] + head + foot
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetSize(width, height)
    window.SetMultiSamples(8)
    window.SetNumberOfLayers(3)
    back = vtkRenderer()
    back.SetBackground(1, 1, 1)
    window.AddRenderer(back)
    for number, (_caption, actors) in enumerate(tiles):
        renderer = vtkRenderer()
        renderer.SetBackground(1, 1, 1)
        renderer.SetViewport(number / len(tiles), foot / height, (number + 1) / len(tiles), (foot + tile[1]) / height)
        for actor in actors:
            renderer.AddActor(actor)
        look_at(renderer, box, tile)
        renderer.SetLayer(1)
        window.AddRenderer(renderer)
    words = [(caption, (number + 0.5) * tile[0], 12, 19) for number, (caption, _actors) in enumerate(tiles)]
    words += [(title, width / 2, height - head + 10, 24)] if title else []
    front = vtkRenderer()
    front.SetLayer(2)
    for text, x, y, size in words:
        actor = vtkTextActor()
        actor.SetInput(text)
        actor.GetTextProperty().SetFontSize(size)
        actor.GetTextProperty().SetColor(0.15, 0.15, 0.15)
        actor.GetTextProperty().SetJustificationToCentered()
        actor.SetPosition(x, y)
        front.AddViewProp(actor)
    window.AddRenderer(front)
    return window


def look_at(renderer, box, tile):
    """Look along -z, with the box as large as the tile."""
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    middle = ((box[0] + box[1]) / 2, (box[2] + box[3]) / 2)
    high = max(box[3] - box[2], (box[1] - box[0]) * tile[1] / tile[0])
    camera.SetFocalPoint(*middle, 0)
    camera.SetPosition(*middle, high)
    camera.SetParallelScale(high / 2)
    camera.SetClippingRange(0.1 * high, 2 * high)


def snapshot(renderer, size):
    """Return a renderer's picture without antialiasing, as an array of rows from bottom to top, and its window."""
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(0)
    window.SetSize(size, size)
    window.AddRenderer(renderer)
    window.Render()
    grab = vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    grab.Update()
    return vtk_to_numpy(grab.GetOutput().GetPointData().GetScalars()).reshape(size, size, -1), window


def difference(shape, pixels, inside):
    """Return the largest difference (0 to 255) between the picture and the textured shape, rendered at the same size."""
    size = pixels.shape[0]
    renderer = vtkRenderer()
    renderer.AddActor(textured(shape, to_texture(pixels)))
    look_at(renderer, (-0.5, size - 0.5, -0.5, size - 0.5), (size, size))
    drawn = snapshot(renderer, size)[0][::-1, :, :3]
    return int(np.abs(drawn.astype(int) - pixels[..., :3])[inside].max())


def triangles_of(shape):
    return vtk_to_numpy(shape.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def points_of(shape):
    return vtk_to_numpy(shape.GetPoints().GetData())[:, :2].astype(float)


def signed_areas(points, triangles):
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]) / 2


def outline_of(triangles):
    """Return the edges that belong to only one triangle, directed as in this triangle."""
    edges = np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)])
    key = edges.min(axis=1) * (triangles.max() + 1) + edges.max(axis=1)
    _unique, first, count = np.unique(key, return_index=True, return_counts=True)
    return edges[first[count == 1]]


def edges(posed, shape, color=(0.25, 0.15, 0.1), width=2.0):
    """Return the outline of a posed shape as an actor in a list."""
    pairs = outline_of(triangles_of(shape))
    lines = vtkCellArray()
    for a, b in pairs:
        lines.InsertNextCell(2, [int(a), int(b)])
    data = vtkPolyData()
    data.SetPoints(posed.GetPoints())
    data.SetLines(lines)
    return [flat_actor(data, color, width)]
