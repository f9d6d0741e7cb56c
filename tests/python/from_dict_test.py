"""Scenario.from_dict() takes what programs have at hand: NumPy's numbers and arrays, tuples, paths.

    PYTHONPATH=build/dev/python tests/python/from_dict_test.py INSONIFY_PROGRAM SOURCE_FOLDER
"""

import datetime
import pathlib
import sys
import tempfile
import unittest

import numpy as np

import insonify

POINT = {"position": [8, 0.5, 0], "target_strength_db": -10}


def scenario(**keys):
    return insonify.Scenario.from_dict({"points": [POINT], "sonars": [{"name": "fls"}], **keys})


class FromDictTest(unittest.TestCase):
    def message(self, act, kind=insonify.Error):
        with self.assertRaises(kind) as caught:
            act()
        return str(caught.exception)

    def test_numbers_and_arrays_of_numpy_are_those_of_python(self):
        plain = scenario(seed=7, receiver={"noise": False},
                         sonars=[{"name": "fls", "max_range": 12.5, "bin_count": 40, "position": [1, 2, -3]}])
        given = scenario(
            seed=np.uint64(7), receiver={"noise": np.bool_(False)}, points=[{**POINT, "position": np.array([8, 0.5, 0])}],
            sonars=({"name": np.str_("fls"), "max_range": np.float32(12.5), "bin_count": np.int32(40),
                     "position": (np.float64(1), np.array(2), np.int64(-3))},))
        self.assertEqual(given, plain)
        self.assertEqual(given.sonars[0].position, (1, 2, -3))

    def test_paths_are_texts(self):
        with tempfile.TemporaryDirectory() as folder:
            world = pathlib.Path(folder, "floor.obj")
            world.write_text("v -20 -20 -2\nv 20 -20 -2\nv 20 20 -2\nf 1 2 3\n")
            self.assertEqual(scenario(world=world).world, str(world))
            self.assertEqual(scenario(world=str(world)).world, str(world))

    def test_what_no_file_could_hold_is_refused_with_its_key(self):
        expected = " must be a number, a text, True, False, None, a list or a dict"
        for keys, message in (
                ({"seed": 3j}, "seed = 3j" + expected),
                ({"sonars": [{"name": "a"}, {"name": "b", "position": {1}}]}, "sonars[1].position = {1}" + expected),
                ({"sonars": [{"position": np.array([1, 2j, 0])}]}, "sonars[0].position[0] = (1+0j)" + expected),
                ({"water": {"salinity": datetime.date(2026, 6, 1)}},
                 "water.salinity = datetime.date(2026, 6, 1)" + expected),
                ({"receiver": {3: True}}, "receiver has the key 3, must be text"),
                ({4: 5}, "has the key 4, must be text"),
                ({"seed": b"7"}, "seed = b'7'" + expected)):
            self.assertEqual(self.message(lambda: insonify.Scenario.from_dict(keys)), message)

    def test_a_list_that_holds_itself_is_refused(self):
        endless = []
        endless.append(endless)
        self.message(lambda: scenario(sonars=endless), RecursionError)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
