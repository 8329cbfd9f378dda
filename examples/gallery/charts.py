"""Line plots side by side, drawn by VTK's charts; needs a display."""

import math

import common
from vtkmodules.vtkChartsCore import vtkAxis, vtkChartLegend, vtkChartMatrix, vtkChartXY
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkTable, vtkVector2f, vtkVector2i
from vtkmodules.vtkViewsContext2D import vtkContextView
import vtkmodules.vtkRenderingContextOpenGL2  # noqa: F401  needed to draw charts
import vtkmodules.vtkRenderingFreeType  # noqa: F401  needed to draw their texts

INK = (0.16, 0.16, 0.18)
DARK = (41, 41, 46)
BLUE, ORANGE, GREEN, VIOLET = (41, 108, 160), (214, 110, 40), (13, 117, 82), (110, 80, 170)


def _column(name, values):
    array = vtkDoubleArray()
    array.SetName(name)
    for value in values:
        array.InsertNextValue(float(value))
    return array


def _ticks(axis, lower, upper, logarithmic, names):
    """Set the range of an axis. A logarithmic axis is labeled at powers of ten, or with `names` ({value: text}) if
    given."""
    if not logarithmic:
        axis.SetBehavior(vtkAxis.FIXED)
        axis.SetRange(lower, upper)
        return
    positions, labels = vtkDoubleArray(), vtkStringArray()
    lower, upper = math.log10(lower), math.log10(upper)
    step = max(1, round((upper - lower) / 7))
    shown = names or {10.0 ** k: f"1e{k}" for k in range(math.ceil(lower - 1e-9), math.floor(upper + 1e-9) + 1, step)}
    for value, text in shown.items():
        positions.InsertNextValue(math.log10(value))
        labels.InsertNextValue(text)
    axis.SetBehavior(vtkAxis.FIXED)
    axis.SetRange(lower, upper)
    axis.SetCustomTickPositions(positions, labels)


class Panel:
    """One plot. `x` and `y` are (label, lower, upper); with log, both axes have powers of ten."""

    def __init__(self, title, x, y, log=False, x_names=None, y_names=None):
        self.title, self.x, self.y, self.log = title, x, y, log
        self.names = x_names, y_names
        self.series = []

    def line(self, label, xs, ys, color, width=3.0, dots=False, dashed=False):
        """Add a line, with dots at its values; without a label it is not in the legend."""
        if self.log:
            pairs = [(math.log10(x), math.log10(y)) for x, y in zip(xs, ys) if x > 0 and y > 0]
        else:
            pairs = list(zip(xs, ys))
        self.series.append((label, pairs, color, width, dots, dashed))

    def fill(self, chart, text_size):
        chart.SetTitle(self.title)
        chart.GetTitleProperties().SetFontSize(text_size + 4)
        chart.GetTitleProperties().SetBold(True)
        chart.GetTitleProperties().SetColor(*INK)
        for place, (name, lower, upper), names in ((vtkAxis.BOTTOM, self.x, self.names[0]),
                                                   (vtkAxis.LEFT, self.y, self.names[1])):
            axis = chart.GetAxis(place)
            axis.SetTitle(name)
            for text in (axis.GetTitleProperties(), axis.GetLabelProperties()):
                text.SetFontSize(text_size)
                text.SetBold(False)
                text.SetColor(*INK)
            axis.GetGridPen().SetColor(225, 225, 228, 255)
            _ticks(axis, lower, upper, self.log, names)
        for number, (label, pairs, color, width, dots, dashed) in enumerate(self.series):
            table = vtkTable()
            table.AddColumn(_column("x", [x for x, _ in pairs]))
            table.AddColumn(_column(label or f"_{number}", [y for _, y in pairs]))
            plot = chart.AddPlot(0)  # 0 is a line plot
            plot.SetInputData(table, 0, 1)
            plot.SetColor(*color, 255)
            plot.SetWidth(width)
            if dots:
                plot.SetMarkerStyle(4)  # 4 is a disc
                plot.SetMarkerSize(11)
            if dashed:
                plot.GetPen().SetLineType(2)
            plot.SetLegendVisibility(bool(label))
        chart.SetShowLegend(any(label for label, *_ in self.series))
        chart.GetLegend().SetLabelSize(text_size)
        chart.GetLegend().GetPen().SetColor(200, 200, 205, 255)


def draw(path, panels, size=(1600, 640), text_size=18, legends=None, left=110):
    """Write the panels as one PNG. `legends`: for each panel a pair of vtkChartLegend's alignments. `left`: pixels
    for the names along the first panel's vertical axis."""
    view = vtkContextView()
    window = view.GetRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetSize(*size)
    window.SetMultiSamples(4)
    view.GetRenderer().SetBackground(1, 1, 1)
    matrix = vtkChartMatrix()
    view.GetScene().AddItem(matrix)
    matrix.SetSize(vtkVector2i(len(panels), 1))
    matrix.SetBorders(left, 80, 30, 50)  # space for the texts of the axes
    matrix.SetGutter(vtkVector2f(115, 0))
    for number, panel in enumerate(panels):
        matrix.SetChart(vtkVector2i(number, 0), vtkChartXY())
        chart = matrix.GetChart(vtkVector2i(number, 0))
        panel.fill(chart, text_size)
        across, up = (legends or [(vtkChartLegend.RIGHT, vtkChartLegend.TOP)] * len(panels))[number]
        chart.GetLegend().SetHorizontalAlignment(across)
        chart.GetLegend().SetVerticalAlignment(up)
    common.write_picture(window, path)
