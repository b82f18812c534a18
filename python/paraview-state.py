"""The run of this folder in ParaView: water coloured by speed, grains as spheres of their true size coloured by speed, the
pipe, the bed line.  Copied into every run folder by `livebed run`.

    paraview --script=DIR/paraview-state.py         or File > Load State... in ParaView
    pvpython DIR/paraview-state.py OUT.png [TIME]   draws one picture, of the last moment when no time [s] is given
"""
import os
import sys

from paraview import simple

# The window of ParaView does not tell a script where it lies: there the folder counts in which the run was written.
RUN = os.path.dirname(os.path.abspath(__file__)) if "__file__" in globals() else "{folder of the run}"
WIDTH = 1600  # of the picture [pixels]
SAND = [0, 0.87, 0.78, 0.60, 0.5, 0.95, 0.55, 0.15, 1, 0.75, 0.05, 0.05]  # at rest to fast

# bed.csv as a line that knows its times; this runs inside ParaView's own filter.
BED_TIMES = """
import numpy
times = numpy.loadtxt({path!r}, delimiter=",", skiprows=1, usecols=0, ndmin=1)
information = self.GetOutputInformation(0)
information.Remove(self.GetExecutive().TIME_STEPS())
for time in times:
    information.Append(self.GetExecutive().TIME_STEPS(), time)
information.Remove(self.GetExecutive().TIME_RANGE())
information.Append(self.GetExecutive().TIME_RANGE(), times[0])
information.Append(self.GetExecutive().TIME_RANGE(), times[-1])
"""
BED_LINE = """
import numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray
with open({path!r}) as file:
    x = [float(name[len("y_at_"):-len("_m")]) for name in file.readline().strip().split(",")[1:]]
rows = numpy.loadtxt({path!r}, delimiter=",", skiprows=1, ndmin=2)
information = self.GetOutputInformation(0)
time = information.Get(self.GetExecutive().UPDATE_TIME_STEP()) if information.Has(self.GetExecutive().UPDATE_TIME_STEP()) else rows[-1, 0]
row = rows[numpy.argmin(abs(rows[:, 0] - time))]
points, lines = vtkPoints(), vtkCellArray()
lines.InsertNextCell(len(x))
for place, height in zip(x, row[1:]):
    lines.InsertCellPoint(points.InsertNextPoint(place, height, {z!r}))
output.SetPoints(points)
output.SetLines(lines)
"""


def path(name):
    """A file of the run, or None where it has none."""
    full = os.path.join(RUN, name)
    return full if os.path.exists(full) else None


def coloured(display, where, name, view, title, place, preset=None, points=None):
    """Colours by the magnitude of a vector, by a preset of ParaView or by points (value, r, g, b), with a bar of its own."""
    simple.ColorBy(display, (where, name, "Magnitude"), separate=True)
    colours = simple.GetColorTransferFunction(name, display, separate=True)
    if preset:
        colours.ApplyPreset(preset, True)
    else:
        colours.RGBPoints, colours.ColorSpace = points, "RGB"
    display.RescaleTransferFunctionToDataRangeOverTime()
    bar = simple.GetScalarBar(colours, view)
    bar.Title, bar.ComponentTitle, bar.Orientation = title, "", "Horizontal"
    bar.WindowLocation, bar.Position, bar.ScalarBarLength = "Any Location", [place, 0.03], 0.35
    for part in ("TitleColor", "LabelColor"):
        setattr(bar, part, [0, 0, 0])
    display.SetScalarBarVisibility(view, True)


def show_grains(view, nearer):
    grains = simple.PVDReader(registrationName="grains", FileName=path("grains.pvd"))
    display = simple.Show(grains, view)
    display.SetRepresentationType("Point Gaussian")
    display.ShaderPreset = "Sphere"
    display.ScaleByArray, display.SetScaleArray = True, ["POINTS", "diameter"]
    display.UseScaleFunction = False
    display.GaussianRadius = 0.5  # times the diameter
    display.Position = [0, 0, nearer]
    coloured(display, "POINTS", "velocity", view, "speed of the grains [m/s]", 0.55, points=SAND)


def show_pipe(view, nearer):
    pipe = simple.XMLPolyDataReader(registrationName="pipe", FileName=[path("pipe.vtp")])
    display = simple.Show(pipe, view)
    display.AmbientColor = display.DiffuseColor = [0, 0, 0]
    display.LineWidth, display.Position = 3, [0, 0, nearer]


def show_bed(view, nearer):
    table = path("bed.csv")
    bed = simple.ProgrammableSource(registrationName="bed line", OutputDataSetType="vtkPolyData",
                                    ScriptRequestInformation=BED_TIMES.format(path=table),
                                    Script=BED_LINE.format(path=table, z=nearer))
    display = simple.Show(bed, view)
    display.AmbientColor = display.DiffuseColor = [0.9, 0.1, 0.1]
    display.LineWidth = 2


def has_rows(table):
    with open(table) as file:
        return sum(1 for _ in file) > 1


def main():
    if path("flow.pvd") is None:
        raise RuntimeError(f"{RUN} holds no flow.pvd: the run has not released its grains yet, or its folder has been moved; then "
                           "write its new place into the line RUN = of paraview-state.py")
    view = simple.GetActiveViewOrCreate("RenderView")
    view.UseColorPaletteForBackground = False
    view.Background = [1, 1, 1]
    view.OrientationAxesVisibility = False
    view.InteractionMode = "2D"

    flow = simple.PVDReader(registrationName="flow", FileName=path("flow.pvd"))
    display = simple.Show(flow, view)
    display.SetRepresentationType("Surface")
    coloured(display, "CELLS", "velocity", view, "speed of the water [m/s]", 0.1, preset="Viridis (matplotlib)")
    x0, x1, y0, y1 = flow.GetDataInformation().GetBounds()[:4]
    nearer = 0.01 * (y1 - y0)  # what is drawn in front lies nearer to the eye
    if path("grains.pvd"):
        show_grains(view, nearer)
    if path("pipe.vtp"):
        show_pipe(view, 2 * nearer)
    if path("bed.csv") and has_rows(path("bed.csv")):
        show_bed(view, 2 * nearer)

    scene = simple.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.GoToLast()
    stamp = simple.AnnotateTimeFilter(registrationName="time", Input=flow, Format="t = {time:.3f} s")
    simple.Show(stamp, view).Color = [0, 0, 0]

    height = (y1 - y0) / 0.84  # room for the colour bars below
    view.ViewSize = [WIDTH, int(WIDTH * height / (x1 - x0))]
    centre = [(x0 + x1) / 2, y1 - height / 2, 0]
    view.CameraFocalPoint, view.CameraPosition = centre, [centre[0], centre[1], x1 - x0]
    view.CameraViewUp, view.CameraParallelProjection, view.CameraParallelScale = [0, 1, 0], True, height / 2
    simple.SetActiveSource(flow)
    if len(sys.argv) > 1 and sys.argv[1].endswith(".png"):
        if len(sys.argv) > 2:
            scene.AnimationTime = float(sys.argv[2])
        simple.SaveScreenshot(sys.argv[1], view, ImageResolution=view.ViewSize)
    else:
        simple.Render(view)


main()
