#!/usr/bin/python3
"""python/livebed.py against a run that the program has just made, and against VTK's own readers.

    tests/python/test_livebed.py PROGRAM
"""
import base64
import os
import re
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLRectilinearGridReader

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import livebed  # noqa: E402

PROGRAM = sys.argv.pop(1)
SMALL = ["mesh.length=0.12", "mesh.height=0.06", "pipe.x=0.05", "bed.count=500", "time.spin_up=0.05", "time.end=0.1",
         "output.series_every=0.005", "output.bed_every=0.02", "output.fields_every=0.04", "output.checkpoint_every=0.05"]


def make_run(folder, *more):
    words = [PROGRAM, "run", str(ROOT / "cases/quick"), "--quiet", "--no-bed-cache", "--out", str(folder)]
    for key in (*SMALL, *more):
        words += ["--set", key]
    subprocess.run(words, check=True, stdout=subprocess.DEVNULL)


class ARun(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.temporary.name) / "run"
        make_run(cls.folder)
        cls.run_ = livebed.Run(cls.folder)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def vtk(self, reader, name):
        reader.SetFileName(str(self.folder / name))
        reader.Update()
        return reader.GetOutput()

    def test_series_and_bed_are_the_tables(self):
        run = self.run_
        self.assertEqual(run.series["time_s"][0], 0)
        self.assertEqual(len(run.series["time_s"]), 21)
        self.assertEqual(run.series["S_over_D"][-1], run.summary["scour_depth_over_D"])
        self.assertEqual(run.bed.y.shape, (len(run.bed.t), len(run.bed.x)))
        np.testing.assert_allclose(np.diff(run.bed.x), 0.001, atol=1e-9)
        np.testing.assert_array_equal(run.bed.at(0.041), run.bed.y[2])
        self.assertAlmostEqual(np.median(run.bed.y[0]), run.case["bed"]["level"], delta=0.002)
        self.assertIn("time_s", run.table("packing.csv"))

    def test_water_is_what_vtk_reads(self):
        run = self.run_
        self.assertEqual(len(run.flow_times), 3)
        flow = run.flow(0.05)
        self.assertEqual(flow.time, run.flow_times[1])
        grid = self.vtk(vtkXMLRectilinearGridReader(), "fields/flow_000001.vtr")
        np.testing.assert_array_equal(flow.x, vtk_to_numpy(grid.GetXCoordinates()))
        np.testing.assert_array_equal(flow.y, vtk_to_numpy(grid.GetYCoordinates()))
        for name in ("p", "k", "epsilon", "nut", "open", "solid"):
            np.testing.assert_array_equal(getattr(flow, name).ravel(), vtk_to_numpy(grid.GetCellData().GetArray(name)))
        velocity = vtk_to_numpy(grid.GetCellData().GetArray("velocity"))
        np.testing.assert_array_equal(flow.velocity.reshape(-1, 2), velocity[:, :2])
        self.assertEqual(flow.vorticity.shape, (len(flow.y_centre), len(flow.x_centre)))

    def test_vorticity_is_that_of_a_turning_body(self):
        x = np.linspace(0, 1, 11)
        u, v = np.meshgrid((x[1:] + x[:-1]) / 2, (x[1:] + x[:-1]) / 2)
        zero = np.zeros((10, 10))
        flow = livebed.Flow(0, x, x, np.stack([-3 * v, 3 * u], axis=-1), zero, zero, zero, zero, zero, zero)
        np.testing.assert_allclose(flow.vorticity, 6)

    def test_grains_are_what_vtk_reads_and_fill_what_solid_says(self):
        run = self.run_
        grains = run.grains(-1)
        self.assertEqual(grains.time, run.grain_times[-1])
        np.testing.assert_array_equal(grains.id, np.arange(500))
        points = self.vtk(vtkXMLPolyDataReader(), "grains/grains_000002.vtp")
        places = vtk_to_numpy(points.GetPoints().GetData())
        np.testing.assert_array_equal(np.column_stack([grains.x, grains.y]), places[:, :2])
        for name in ("diameter", "omega"):
            np.testing.assert_array_equal(getattr(grains, name), vtk_to_numpy(points.GetPointData().GetArray(name)))
        for name in ("velocity", "drag"):
            np.testing.assert_array_equal(getattr(grains, name), vtk_to_numpy(points.GetPointData().GetArray(name))[:, :2])
        flow = run.flow(-1)
        area = np.outer(np.diff(flow.y), np.diff(flow.x))
        volume = np.pi / 6 * (grains.diameter**3).sum() / run.case["grains"]["diameter"]
        self.assertAlmostEqual((flow.solid * area).sum() / volume, 1, delta=0.02)

    def test_pipe_and_checkpoints(self):
        x, _, diameter = self.run_.pipe
        self.assertAlmostEqual(x, 0.05, places=6)
        self.assertAlmostEqual(diameter, 0.02, places=6)
        self.assertEqual([path.suffix for path in self.run_.checkpoints], [".h5", ".h5"])

    def test_a_run_that_goes_on_is_read_without_its_last_half_row(self):
        folder = Path(self.temporary.name) / "going-on"
        folder.mkdir()
        (folder / "case.resolved.toml").write_bytes((self.folder / "case.resolved.toml").read_bytes())
        text = (self.folder / "series.csv").read_text()
        cut = text[: text.rindex(",")]
        (folder / "series.csv").write_text(cut)
        run = livebed.Run(folder)
        self.assertEqual(len(run.series["time_s"]), 20)
        (folder / "series.csv").write_text(text)
        self.assertEqual(len(run.series["time_s"]), 20)
        run.refresh()
        self.assertEqual(len(run.series["time_s"]), 21)
        for name, asked in (("summary.json", lambda: run.summary), ("bed.csv", lambda: run.bed),
                            ("flow.pvd", lambda: run.flow(0)), ("grains.pvd", lambda: run.grains(0)),
                            ("pipe.vtp", lambda: run.pipe)):
            with self.assertRaisesRegex(livebed.RunError, name):
                asked()

    def test_faults_name_the_file_and_what_is_wrong(self):
        with self.assertRaisesRegex(livebed.RunError, "nowhere is no folder"):
            livebed.Run(Path(self.temporary.name) / "nowhere")
        with self.assertRaisesRegex(livebed.RunError, "holds no case.resolved.toml"):
            livebed.Run(self.temporary.name)
        bad = Path(self.temporary.name) / "bad"
        bad.write_text("a,b\n1,2\n3,x\n")
        with self.assertRaisesRegex(livebed.RunError, "line 3"):
            livebed.read_table(bad)
        bad.write_text("a,b\n1,2,3\n")
        with self.assertRaisesRegex(livebed.RunError, "line 2: 3 values for 2 columns"):
            livebed.read_table(bad)
        whole = (self.folder / "fields/flow_000001.vtr").read_bytes()
        bad.write_bytes(whole[: len(whole) // 2])
        with self.assertRaisesRegex(livebed.RunError, "damaged"):
            livebed.read_vtk(bad)
        place = whole.index(b'Name="p"') + 200
        bad.write_bytes(whole[:place] + b"AAAAAAAA" + whole[place + 8:])
        with self.assertRaisesRegex(livebed.RunError, "damaged in the array p"):
            livebed.read_vtk(bad)
        bad.write_text("<VTKFile><DataArray/></VTKFile>")
        with self.assertRaisesRegex(livebed.RunError, "VTK file"):
            livebed.read_vtk(bad)

    def test_a_raw_block_reads_like_base64(self):
        whole = (self.folder / "fields/flow_000001.vtr").read_text()
        block = bytearray()

        def moved(match):
            text, offset = match[2], len(block)
            blocks, = struct.unpack_from("<Q", base64.b64decode(text[:32]))
            head = (24 + 8 * blocks + 2) // 3 * 4
            block.extend(base64.b64decode(text[:head]) + base64.b64decode(text[head:]))
            return f'{match[1]} format="appended" offset="{offset}"/>'

        xml = re.sub(r'(<DataArray [^>]*) format="binary">\n(.*)\n</DataArray>', moved, whole).replace("</VTKFile>\n", "")
        raw = Path(self.temporary.name) / "raw.vtr"
        raw.write_bytes(xml.encode() + b'<AppendedData encoding="raw">\n_' + block + b"\n</AppendedData>\n</VTKFile>\n")
        old, new = livebed.read_vtk(raw), livebed.read_vtk(self.folder / "fields/flow_000001.vtr")
        self.assertEqual(old[0], new[0])
        for section, arrays in new[1].items():
            for name, values in arrays.items():
                np.testing.assert_array_equal(old[1][section][name], values)

    def test_water_alone_has_no_grains(self):
        folder = Path(self.temporary.name) / "water"
        words = [PROGRAM, "run", str(ROOT / "cases/quick"), "--quiet", "--out", str(folder), "--set", "bed.thickness=0"]
        for key in (*(k for k in SMALL if not k.startswith("bed.")), "pipe.present=false"):
            words += ["--set", key]
        subprocess.run(words, check=True, stdout=subprocess.DEVNULL)
        run = livebed.Run(folder)
        self.assertIsNone(run.pipe)
        self.assertEqual(run.flow(0).solid.max(), 0)
        for asked in (lambda: run.bed, lambda: run.grains(0)):
            with self.assertRaisesRegex(livebed.RunError, "no grains"):
                asked()

    def test_the_example_draws_its_figures(self):
        figures = Path(self.temporary.name) / "figures"
        done = subprocess.run([sys.executable, str(ROOT / "python/example.py"), str(self.folder), str(figures)],
                              env={**os.environ, "PYTHONPATH": str(ROOT / "python"), "MPLBACKEND": "agg"},
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("scour_depth_over_D = ", done.stdout)
        drawn = {path.stem for path in figures.glob("*.png")}
        self.assertGreaterEqual(drawn, {"depth", "bed", "space-time", "moment"})


unittest.main()
