"""Layers of recordings: indexed as NumPy does, and read only as far as they are asked for.

    PYTHONPATH=build/dev/python tests/python/layers_test.py COMMAND_LINE SOURCE_FOLDER
"""

import pathlib
import tempfile
import unittest

import h5py
import numpy as np

import insonify

BINS, BEAMS, PINGS = 30, 12, 4


def record(folder):
    scene = insonify.Scene()
    scene.add("floor", [[-20, -20, -2], [20, -20, -2], [20, 20, -2], [-20, 20, -2]], [[0, 1, 2], [0, 2, 3]])
    sonar = insonify.SonarConfig(name="ahead", beam_count=BEAMS, bin_count=BINS, max_range=9, orientation_deg=(0, 25, 0))
    receiver = insonify.ReceiverConfig(field=True, counts=True, full_scale_db=-40, speckle=True)
    scenario = insonify.Scenario(sonars=[sonar], ground_truth="full", receiver=receiver)
    sim = insonify.Simulator(scenario, scene)
    path = pathlib.Path(folder, "r.h5")
    pings = [sim.ping(pose=insonify.Pose.rpy((0.3 * k, 0, 0)), time=0.5 * k) for k in range(PINGS)]
    with insonify.Recording(path, sim) as recording:
        for ping in pings:
            recording.add(ping)
    return path, pings


class LayersTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.path, cls.pings = record(cls.folder.name)
        cls.recording = insonify.open(cls.path)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_counts_are_drawn_in_place_of_intensities(self):
        for draw in insonify.draw_fan, insonify.draw_polar:
            made, read = draw(self.pings[1], counts=True), draw(self.recording[1], counts=True)
            np.testing.assert_array_equal(made, read)
            self.assertFalse(np.array_equal(made, draw(self.pings[1])))
            greys = draw(self.recording[1], counts=True, annotations=False, colour_map="grey")
            self.assertGreater(greys.max(), greys.min())
        with self.assertRaisesRegex(insonify.Error, "counts are drawn as they are, linear, without levels"):
            insonify.draw_fan(self.pings[1], (-80, -40), counts=True)
        with self.assertRaisesRegex(insonify.Error, "counts are drawn as they are, linear, without a scale"):
            insonify.draw_fan(self.pings[1], scale="db", counts=True)

    def test_every_layer_is_there_as_h5py_reads_it(self):
        rec = self.recording
        self.assertEqual(rec.layers, ["intensity", "field", "counts", "instance", "material", "elevation",
                                      "strongest_instance", "strongest_share", "elevation_spread", "path_order", "shadow",
                                      "direct_intensity"])
        with h5py.File(self.path) as file:
            for name in rec.layers:
                layer, expected = getattr(rec, name), file[name][()]
                if name == "field":
                    expected = expected[..., 0] + 1j * expected[..., 1]
                    self.assertEqual(layer.dtype, np.complex64)
                self.assertEqual((layer.shape, layer.dtype), (expected.shape, expected.dtype), name)
                np.testing.assert_array_equal(np.asarray(layer), expected, name)
                self.assertEqual(layer.unit, file[name].attrs["units"])
                self.assertEqual(layer.description, file[name].attrs["description"])
            np.testing.assert_array_equal(rec.time, file["time"])
            np.testing.assert_array_equal(rec.range, file["range"])
            np.testing.assert_array_equal(rec.azimuth, file["azimuth"])
            np.testing.assert_array_equal(rec.world_from_sonar, file["world_from_sonar"])
        self.assertIsNone(rec.head_angle)
        self.assertEqual(rec.instance_names, ["floor"])

    def test_they_are_indexed_as_arrays_are(self):
        for name in ("intensity", "field", "strongest_share"):
            layer = getattr(self.recording, name)
            whole = np.asarray(layer)
            for index in (2, -1, np.int64(1), slice(1, 3), slice(None, None, 2), slice(None, None, -1), slice(5, 1, -2),
                          slice(3, 3), ..., (1, 4), (1, slice(3, 20, 4)), (..., 2), (slice(None), 7, slice(2, 9, 3)),
                          (0, ..., slice(None, None, -2)), (2, 3, 1), [0, 2], (slice(None), [1, 5]), whole > 0.1):
                found, expected = layer[index], whole[index]
                np.testing.assert_array_equal(found, expected, f"{name}[{index}]")
                self.assertEqual(np.shape(found), np.shape(expected), f"{name}[{index}]")
            self.assertEqual((len(layer), layer.ndim, layer.size), (len(whole), whole.ndim, whole.size))
            for index in (PINGS, -PINGS - 1, (0, BINS), (0,) * (layer.ndim + 1), (..., ...)):
                with self.assertRaises(IndexError):
                    layer[index]

    def test_they_read_only_what_is_asked_for(self):
        asked = []

        class Watched:
            def __init__(self, recording):
                self._facts = recording._facts
                self._recording = recording

            def _read(self, name, slices):
                asked.append(slices)
                return self._recording._read(name, slices)

        layer = insonify.RecordedLayer(Watched(self.recording), "instance")
        self.assertEqual(asked, [])
        layer[1, 5:9, ::4]
        self.assertEqual(asked, [[(1, 1, 1), (5, 4, 1), (0, 3, 4)]])

    def test_they_stand_for_arrays(self):
        layer = self.recording.intensity
        whole = np.asarray(layer)
        self.assertEqual(layer.max(), whole.max())
        np.testing.assert_array_equal(layer * 2 + layer, whole * 2 + whole)
        np.testing.assert_array_equal(self.recording.instance == 0, np.asarray(self.recording.instance) == 0)
        np.testing.assert_array_equal(insonify.to_db(layer), insonify.to_db(whole))
        with self.assertRaises(AttributeError):
            layer.maximal
        with self.assertRaises(TypeError):
            layer[0, 0, 0] = 1

    def test_recorded_pings_have_their_tables(self):
        for made, read in zip(self.pings, self.recording):
            for name in self.recording.layers:
                np.testing.assert_array_equal(getattr(read, name), getattr(made, name), name)
                self.assertTrue(np.shares_memory(getattr(read, name), getattr(read, name)))
            self.assertEqual((read.number, read.time), (made.number, made.time))

    def test_it_is_exported(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "r.npz")
            insonify.export(self.recording, file)
            with np.load(file) as exported:
                for name in self.recording.layers:
                    np.testing.assert_array_equal(exported[name], np.asarray(getattr(self.recording, name)), name)
            with self.assertRaisesRegex(insonify.Error, "r.npz"):
                insonify.export([self.path], file)
            insonify.export([self.path], file, replace=True, compress=False)
            with self.assertRaisesRegex(TypeError, "^export.. has no option 'replaec'$"):
                insonify.export(self.path, file, replaec=True)
            with self.assertRaisesRegex(insonify.Error, "levels must be two rising numbers"):
                insonify.export(self.path, file, levels=(3, 2))
            with self.assertRaisesRegex(insonify.Error, r"levels must be two rising numbers \[dB\] from -400 to 400"):
                insonify.export(self.path, file, levels=(-90, float("inf")))
            with self.assertRaisesRegex(insonify.Error, "r.txt"):
                insonify.export(self.path, pathlib.Path(folder, "r.txt"))

    def test_what_was_not_recorded_is_none(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "other.h5")
            with h5py.File(path, "w") as file:
                file["intensity"] = np.arange(24, dtype=np.uint8).reshape(2, 3, 4)
            rec = insonify.open(path)
            self.assertEqual((rec.layers, rec.instance, rec.range, rec.instance_names), (["intensity"], None, None, []))
            np.testing.assert_array_equal(rec.intensity[1, :, 2], [14, 18, 22])


if __name__ == "__main__":
    unittest.main(argv=["layers_test.py"])
