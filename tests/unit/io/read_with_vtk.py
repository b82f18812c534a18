"""Opens a .vtr, .vtp or .pvd file with VTK's own readers and prints what they found, one fact a line:

    extent 0 3 0 2 0 0 | points N | verts N | lines N | time T | coordinates x ... | array NAME TYPE COMPONENTS v v v ...
"""
import sys

from vtkmodules.vtkCommonCore import vtkObject
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLRectilinearGridReader

vtkObject.GlobalWarningDisplayOn()
faults = []


def show(name, array):
    values = [array.GetComponent(t, c) for t in range(array.GetNumberOfTuples()) for c in range(array.GetNumberOfComponents())]
    print("array", name, array.GetDataTypeAsString(), array.GetNumberOfComponents(), *map(repr, values))


def show_all(data):
    for k in range(data.GetNumberOfArrays()):
        show(data.GetArrayName(k), data.GetArray(k))


path = sys.argv[1]
grid = path.endswith(".vtr")
reader = vtkXMLRectilinearGridReader() if grid else vtkXMLPolyDataReader()
reader.AddObserver("ErrorEvent", lambda *_: faults.append(path))
reader.SetFileName(path)
reader.Update()
data = reader.GetOutput()
if faults or data.GetNumberOfPoints() == 0:
    sys.exit(f"VTK cannot read {path}")
print("time", repr(data.GetFieldData().GetArray("TimeValue").GetValue(0)))
print("information", repr(reader.GetOutputInformation(0).Get(reader.GetExecutive().TIME_STEPS()) or ()))
if grid:
    print("extent", *data.GetExtent())
    show("x", data.GetXCoordinates())
    show("y", data.GetYCoordinates())
    show_all(data.GetCellData())
else:
    print("points", data.GetNumberOfPoints())
    print("verts", data.GetNumberOfVerts())
    print("lines", data.GetNumberOfLines())
    if data.GetNumberOfLines():
        print("length", data.GetCell(0).GetNumberOfPoints(), data.GetCell(0).GetPointId(0),
              data.GetCell(0).GetPointId(data.GetCell(0).GetNumberOfPoints() - 1))
    show("points", data.GetPoints().GetData())
    show_all(data.GetPointData())
