#!/usr/bin/python3
"""`insonify grid`: a small survey by a multibeam over a bed of known heights, gridded, against these heights; its files as GDAL
and plain Python read them; and what is refused.

grid_test.py INSONIFY
"""

import ctypes
import ctypes.util
import math
import os
import re
import struct
import subprocess
import sys
import tempfile
import unittest
import zipfile

INSONIFY = os.path.abspath(sys.argv.pop(1))

# A bed of quads of 1 m over +-40 m with a mound of 2.5 m and a slope of 4 %, 10 m below the sonar's level. Two lines of 20 m,
# 12 m apart; their beams reach 45 degrees to both sides.
SCENARIO = """
world: bed.asc
surface: {level: 3}
water: {sound_speed: 1500}
pattern:
  lines: {center: [0, 0], length: 20, width: 24, spacing: 12, height: -2, speed: 2, turns: skip}
receiver: {time_varied_gain: 30}
sonars:
  - name: swath
    type: mbes
    frequency: 400.0e3
    beam_count: 61
    azimuth_aperture_deg: 90
    azimuth_resolution_deg: 2
    elevation_aperture_deg: 20
    transmit_elevation_aperture_deg: 2
    bin_count: 700
    max_range: 28
    ping_period: 0.4
  - name: side
    type: sss
    azimuth_aperture_deg: 1
    elevation_aperture_deg: 60
    bin_count: 40
    max_range: 20
    ping_period: 5
"""
BED, HALF = -12, 40


def bed(x, y):
    return BED + 0.04 * x + 2.5 * math.exp(-((x - 3) ** 2 + (y - 1) ** 2) / 50)


def insonify(*arguments, **options):
    return subprocess.run([INSONIFY, *arguments], check=False, capture_output=True, text=True, **options)


def tables(path):
    """Tables of an .npz: shape and flat list of numbers."""
    found = {}
    with zipfile.ZipFile(path) as archive:
        for name in archive.namelist():
            data = archive.read(name)
            length = struct.unpack_from("<H", data, 8)[0]
            header = eval(data[10:10 + length].decode(), {})  # pylint: disable=eval-used
            code = {"<f4": "f", "<f8": "d", "<u4": "I"}[header["descr"]]
            found[name[:-4]] = header["shape"], struct.unpack_from(f"<{math.prod(header['shape'])}{code}", data, 10 + length)
    return found


class GridTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        os.chdir(cls.folder.name)
        count = 2 * HALF + 1
        with open("bed.asc", "w", encoding="ascii") as file:
            file.write(f"ncols {count}\nnrows {count}\nxllcenter {-HALF}\nyllcenter {-HALF}\ncellsize 1\n")
            for y in range(HALF, -HALF - 1, -1):
                file.write(" ".join(f"{bed(x, y):.5f}" for x in range(-HALF, HALF + 1)) + "\n")
        with open("survey.yaml", "w", encoding="ascii") as file:
            file.write(SCENARIO)
        run = insonify("run", "survey.yaml", "-o", "run", "--no-pictures", "-q")
        assert run.returncode == 0, run.stderr
        cls.grid = insonify("grid", "run/swath.h5", "-o", "chart.npz", "-o", "chart.bag", "-o", "chart.tif", "-o", "chart.asc",
                            "-o", "chart.png", "--cell", "0.5", "--origin", "54.2,7.9")
        assert cls.grid.returncode == 0, cls.grid.stderr

    @classmethod
    def tearDownClass(cls):
        os.chdir("/")
        cls.folder.cleanup()

    def test_the_chart_is_within_special_order(self):
        shape, heights = tables("chart.npz")["height"]
        x, y = tables("chart.npz")["x"][1], tables("chart.npz")["y"][1]
        count, truth = tables("chart.npz")["count"][1], tables("chart.npz")["truth"][1]
        self.assertEqual(shape, (len(y), len(x)))
        self.assertEqual(tables("chart.npz")["datum"][1], (3,))  # The surface.
        errors, within = [], 0
        for row, north in enumerate(y):
            for column, east in enumerate(x):
                at = row * len(x) + column
                if count[at] == 0:
                    self.assertTrue(math.isnan(heights[at]))
                    continue
                # Heights count from the datum; corners of quads are a metre apart: the mound bends by 1 cm between them.
                true = bed(east, north) - 3
                self.assertAlmostEqual(truth[at], true, delta=0.03)
                errors.append(heights[at] - true)
                within += abs(errors[-1]) <= math.hypot(0.25, 0.0075 * -true)
        self.assertGreater(len(errors), 1200)  # 20 m x 32 m less the corners, four cells a square metre: 2560 at most.
        self.assertGreater(within, 0.97 * len(errors))
        self.assertAlmostEqual(sum(errors) / len(errors), 0, delta=0.03)

    def test_what_it_prints_agrees(self):
        out = self.grid.stdout
        special = float(re.search(r"special order ([0-9.]+) %", out)[1])
        self.assertGreater(special, 97)
        self.assertRegex(out, r"soundings +[0-9]+, 0 left out, [0-9]+ refused as outliers\n")
        self.assertRegex(out, r"cells +[0-9]+ x [0-9]+ of 0.5 m; ")
        low, high = map(float, re.search(r"depth +([0-9.]+) to ([0-9.]+) m", out).groups())
        self.assertAlmostEqual(low, 3 - bed(3, 1), delta=0.3)
        self.assertLess(high, 16.5)
        self.assertTrue(out.endswith("chart.npz\nchart.bag\nchart.tif\nchart.asc\nchart.png\n"))

    def test_gdal_reads_the_bag(self):
        name = ctypes.util.find_library("gdal")
        if name is None:
            self.skipTest("GDAL is not installed")
        gdal = ctypes.CDLL(name)
        for function, result, arguments in (
                ("GDALOpen", ctypes.c_void_p, [ctypes.c_char_p, ctypes.c_int]),
                ("GDALGetDriverByName", ctypes.c_void_p, [ctypes.c_char_p]),
                ("GDALGetDatasetDriver", ctypes.c_void_p, [ctypes.c_void_p]),
                ("GDALGetDriverShortName", ctypes.c_char_p, [ctypes.c_void_p]),
                ("GDALGetProjectionRef", ctypes.c_char_p, [ctypes.c_void_p]),
                ("GDALGetGeoTransform", ctypes.c_int, [ctypes.c_void_p, ctypes.POINTER(ctypes.c_double)]),
                ("GDALGetRasterXSize", ctypes.c_int, [ctypes.c_void_p]),
                ("GDALGetRasterYSize", ctypes.c_int, [ctypes.c_void_p]),
                ("GDALGetRasterBand", ctypes.c_void_p, [ctypes.c_void_p, ctypes.c_int]),
                ("GDALGetRasterNoDataValue", ctypes.c_double, [ctypes.c_void_p, ctypes.c_void_p]),
                ("GDALClose", None, [ctypes.c_void_p])):
            getattr(gdal, function).restype = result
            getattr(gdal, function).argtypes = arguments
        gdal.GDALRasterIO.argtypes = [ctypes.c_void_p, ctypes.c_int] + 4 * [ctypes.c_int] + [ctypes.c_void_p] + 5 * [ctypes.c_int]
        gdal.GDALAllRegister()
        if gdal.GDALGetDriverByName(b"BAG") is None:
            self.skipTest("this GDAL does not read BAG")
        shape, heights = tables("chart.npz")["height"]
        uncertainty = tables("chart.npz")["uncertainty"][1]
        dataset = gdal.GDALOpen(b"chart.bag", 0)
        self.assertIsNotNone(dataset)
        self.assertEqual(gdal.GDALGetDriverShortName(gdal.GDALGetDatasetDriver(dataset)), b"BAG")
        self.assertIn(b"WGS 84", gdal.GDALGetProjectionRef(dataset))
        self.assertEqual((gdal.GDALGetRasterYSize(dataset), gdal.GDALGetRasterXSize(dataset)), shape)
        place = (6 * ctypes.c_double)()
        self.assertEqual(gdal.GDALGetGeoTransform(dataset, place), 0)
        # At 54.2 degrees north 65 230 m a degree east and 111 303 m north; the grid's west edge as .npz has it.
        west, north = tables("chart.npz")["x"][1][0] - 0.25, tables("chart.npz")["y"][1][0] + 0.25
        self.assertAlmostEqual((place[0] - 7.9) * 65230, west, delta=0.05)
        self.assertAlmostEqual((place[3] - 54.2) * 111303, north, delta=0.05)
        self.assertAlmostEqual(place[1] * 65230, 0.5, delta=1e-3)
        self.assertAlmostEqual(place[5] * 111303, -0.5, delta=1e-3)
        for number, expected in ((1, heights), (2, uncertainty)):
            band = gdal.GDALGetRasterBand(dataset, number)
            self.assertEqual(gdal.GDALGetRasterNoDataValue(band, None), 1e6)
            values = (ctypes.c_float * len(expected))()
            self.assertEqual(gdal.GDALRasterIO(band, 0, 0, 0, shape[1], shape[0], values, shape[1], shape[0], 6, 0, 0), 0)
            self.assertEqual([1e6 if math.isnan(value) else value for value in expected], list(values))
        gdal.GDALClose(dataset)

    def test_a_chart_is_a_world_again(self):
        with open("again.yaml", "w", encoding="ascii") as file:
            file.write("world: chart.asc\npings: 1\nsonars: [{name: a, beam_count: 8, bin_count: 20, max_range: 5}]\n")
        self.assertEqual(insonify("run", "again.yaml", "-o", "again", "--no-pictures", "-q").returncode, 0)

    def test_methods_and_choices_act(self):
        def first_depth(*options):
            done = insonify("grid", "run/swath.h5", "-o", "other.npz", "-f", "--cell", "1", *options)
            self.assertEqual(done.returncode, 0, done.stderr)
            return float(re.search(r"depth +([0-9.]+)", done.stdout)[1]), done.stdout
        mean, median, shoal = (first_depth("--method", name)[0] for name in ("mean", "median", "shoal"))
        self.assertLess(shoal, mean)
        self.assertAlmostEqual(mean, median, delta=0.2)
        self.assertIn(" 0 refused", first_depth("--outliers", "0")[1])
        self.assertNotIn(" 0 left out", first_depth("--detection", "phase")[1])
        self.assertNotIn(" 0 left out", first_depth("--least-quality", "2.5")[1])
        self.assertAlmostEqual(first_depth("--datum", "0")[0], mean - 3, delta=0.011)
        self.assertNotIn("truth", first_depth("--no-truth")[1])

    def test_a_cast_bends_the_rays(self):
        def mean_height(*options):
            done = insonify("grid", "run/swath.h5", "-o", "cast.npz", "-f", "--cell", "1", *options)
            self.assertEqual(done.returncode, 0, done.stderr)
            known = [height for height in tables("cast.npz")["height"][1] if not math.isnan(height)]
            return sum(known) / len(known)

        def by_cast(speed):
            with open("cast.csv", "w", encoding="ascii") as file:
                file.write(f"depth,speed\n0,{speed}\n50,{speed}\n")
            return mean_height("--profile", "cast.csv")
        straight = mean_height()
        self.assertAlmostEqual(by_cast(1500), straight, delta=0.002)
        # The sonar is 5 m deep; below it sound that is slower by a thirtieth has come from less deep.
        self.assertAlmostEqual(by_cast(1450) + 5, (straight + 5) * 1450 / 1500, delta=0.05)

    def test_without_its_world_there_is_no_truth(self):
        os.makedirs("far/away", exist_ok=True)
        os.makedirs("empty", exist_ok=True)
        done = insonify("grid", "../../run/swath.h5", "-o", "chart.asc", "-f", "--folder", "../../empty", cwd="far/away")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"truth +.*no file .*/empty/bed\.asc \(--folder DIR names the scenario's folder\)\n")

    def test_what_is_refused(self):
        for arguments, message in (
                (["run/side.h5", "-o", "a.png"], "run/side.h5: side is a side-scan sonar: insonify mosaic lays its lines onto a chart"),
                (["run/swath.h5", "run/side.h5", "-o", "a.png"],
                 "run/side.h5: side is a side-scan sonar: insonify mosaic lays its lines onto a chart"),
                (["run/swath.h5", "-o", "a.bmp"], "--output a.bmp: must end in .png, .bag, .tif, .asc, .npz"),
                (["run/swath.h5", "-o", "chart.png"], "chart.png exists already: --force replaces it"),
                (["run/swath.h5", "-o", "a.png", "--least-quality", "90"],
                 r"no sounding is left to grid: all [0-9]+ were left out by quality or detection"),
                (["run/swath.h5", "-o", "a.png", "--cell", "0.001"],
                 r"a grid of [0-9]+ m x [0-9]+ m with cells of 0.001 m has [0-9.]+e\+0[89] of them; the most is 1e\+08"),
                (["run/swath.h5", "-o", "a.png", "--cell", "0"],
                 "--cell: 0 must be a number, greater than 0, at most 10000"),
                (["nothing.h5", "-o", "a.png"], "nothing.h5: no such file")):
            done = insonify("grid", *arguments)
            self.assertEqual(done.returncode, 2)
            self.assertRegex(done.stderr, f"^insonify: {message}( \\(insonify grid --help\\))?\n$")
            self.assertFalse(os.path.exists("a.png"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
