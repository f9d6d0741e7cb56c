"""Ping.plot(): axes in metres and degrees, a colour bar in decibels that says what they are relative to.

    PYTHONPATH=build/dev/python tests/python/plot_test.py COMMAND_LINE SOURCE_FOLDER
"""

import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import insonify

SKIPPED = 77


def make_ping(model="calibrated", target=(6.0, 2.0), **sonar):
    """A point target at 6 m ahead, 2 m to port."""
    config = insonify.SonarConfig(name="ahead", **{"beam_count": 40, "bin_count": 100, "min_range": 1, "max_range": 10,
                                                   "azimuth_aperture_deg": 90, **sonar})
    point = insonify.PointTarget(position=(*target, 0), target_strength_db=-5)
    scenario = insonify.Scenario(sonars=[config], points=[point] if model == "calibrated" else [], model=model)
    scene = insonify.Scene()
    scene.add("wall", [[9, -9, -1], [9, 9, -1], [9, 9, 1], [9, -9, 1]], [[0, 1, 2], [0, 2, 3]], "mud")
    sim = insonify.Simulator(scenario, scene)
    return sim, sim.ping()


class PlotTest(unittest.TestCase):
    def setUp(self):
        self.addCleanup(plt.close, "all")

    def test_a_target_is_where_it_is(self):
        _, ping = make_ping()
        for kind, expected in (("fan", (-2, 6)), ("polar", (np.degrees(np.arctan2(2, 6)), np.hypot(2, 6)))):
            axes = ping.plot(kind)
            mesh = axes.collections[0]
            corners = mesh.get_coordinates()  # [bins + 1, beams + 1, 2]
            level = mesh.get_array().reshape(100, 40)
            centres = (corners[1:, 1:] + corners[:-1, 1:] + corners[1:, :-1] + corners[:-1, :-1]) / 4
            before_the_wall = ping.sonar.bin_ranges()[:, None] < 8
            bin_, beam = np.unravel_index(np.argmax(np.where(before_the_wall, level, -400)), level.shape)
            np.testing.assert_allclose(centres[bin_, beam], expected, atol=0.2 if kind == "fan" else 1.2)

    def test_labels_of_a_narrow_fan_do_not_overlap(self):
        # Ahead, and turned to port: 15 m long, and 0.26 m wide.
        for turn in (0, 90):
            config = insonify.SonarConfig(name="side", type="msis", beam_count=1, bin_count=50, max_range=15,
                                          azimuth_aperture_deg=1, step_deg=90)
            scenario = insonify.Scenario(sonars=[config], points=[insonify.PointTarget(position=(9, 0, 0))])
            ping = insonify.Simulator(scenario).ping(head_angle=np.radians(turn))
            axes = ping.plot()
            axes.figure.canvas.draw()
            for axis in (axes.xaxis, axes.yaxis):
                low, high = sorted(axis.get_view_interval())
                boxes = [tick.label1.get_window_extent() for tick in axis.get_major_ticks()
                         if low <= tick.get_loc() <= high and tick.label1.get_text()]
                self.assertGreater(len(boxes), 1)
                for i, one in enumerate(boxes):
                    self.assertFalse(any(one.overlaps(other) for other in boxes[i + 1:]), f"{turn}: {boxes}")
            self.assertEqual(axes.get_aspect(), 1)

    def test_what_are_no_axes_is_refused(self):
        _, ping = make_ping()
        figure = plt.figure()
        with self.assertRaises(insonify.Error) as caught:
            ping.plot(ax=figure)
        self.assertEqual(str(caught.exception), "ax = <Figure size 640x480 with 0 Axes> must be axes of matplotlib, such as "
                                                "those of figure.add_subplot(); not a Figure")

    def test_the_colour_map_has_both_spellings(self):
        _, ping = make_ping()
        for options, name in (({}, "inferno"), ({"color_map": "viridis"}, "viridis"), ({"colour_map": "turbo"}, "turbo")):
            self.assertEqual(ping.plot(**options).collections[0].get_cmap().name, name)
        with self.assertRaisesRegex(insonify.Error, "colour_map is given twice: color_map is the same"):
            ping.plot(colour_map="grey", color_map="grey")

    def test_axes_and_colour_bar_have_units(self):
        _, ping = make_ping()
        fan, polar = ping.plot(), ping.plot("polar")
        self.assertEqual(fan.get_aspect(), 1)
        self.assertEqual((fan.get_xlabel(), fan.get_ylabel()), ("port (−) to starboard (+) [m]", "ahead [m]"))
        self.assertEqual((polar.get_xlabel(), polar.get_ylabel()), ("azimuth, positive to port [deg]", "range [m]"))
        np.testing.assert_allclose(polar.get_xlim(), (45, -45))  # Port to the left.
        for axes in (fan, polar):
            bar = axes.figure.axes[1]
            self.assertEqual(bar.get_ylabel(), "dB re source at 1 m, raised by 30 dB per decade of range")
            self.assertEqual(axes.get_title(), "ahead, ping 0, 0 s")
        _, paper = make_ping("paper")
        self.assertEqual(paper.plot().figure.axes[1].get_ylabel(), "echo intensity, 0 to 1")

    def test_levels_axes_and_colours_are_taken(self):
        _, ping = make_ping()
        axes = plt.subplots()[1]
        self.assertIs(ping.plot(ax=axes, levels=(-93, -31), colour_map="copper"), axes)
        self.assertEqual(axes.collections[0].get_clim(), (-93, -31))
        self.assertEqual(axes.collections[0].get_cmap().name, "copper")
        low, high = ping.plot().collections[0].get_clim()
        self.assertEqual((high - low, high % 5), (50, 0))

    def test_what_is_wrong_is_told(self):
        _, ping = make_ping()
        with self.assertRaisesRegex(insonify.Error, "^kind = 'round' must be fan or polar$"):
            ping.plot("round")
        with self.assertRaisesRegex(insonify.Error, r"^levels = \(-30, -90\) must be two rising numbers"):
            ping.plot(levels=(-30, -90))

    def test_counts_are_drawn_as_they_are(self):
        sim, without = make_ping(bits=6)
        scenario = sim.scenario.copy()
        scenario.receiver.counts = True
        scenario.receiver.full_scale_db = -60
        ping = insonify.Simulator(scenario, sim.scene).ping()
        axes = ping.plot(counts=True)
        mesh = axes.collections[0]
        self.assertEqual(mesh.get_clim(), (0, 63))
        np.testing.assert_array_equal(mesh.get_array().reshape(100, 40), ping.counts)
        self.assertEqual(mesh.get_array().max(), 63)
        self.assertEqual(axes.figure.axes[1].get_ylabel(), "counts of 6 bits")
        self.assertEqual(ping.plot(counts=True, levels=(0, 20)).collections[0].get_clim(), (0, 20))
        with self.assertRaisesRegex(insonify.Error, "^ping 0 has no counts; receiver.counts: true adds them"):
            without.plot(counts=True)

    def test_a_recorded_ping_and_a_scanned_one_are_drawn(self):
        sim, ping = make_ping()
        with tempfile.TemporaryDirectory() as folder:
            with insonify.Recording(f"{folder}/r.h5", sim) as recording:
                recording.add(ping)
            read = insonify.open(f"{folder}/r.h5")[0]
        np.testing.assert_array_equal(read.plot().collections[0].get_array(), ping.plot().collections[0].get_array())
        sim, _ = make_ping(type="msis", beam_count=1, azimuth_aperture_deg=4, step_deg=10)
        corners = sim.ping(head_angle=0.5).plot("polar").collections[0].get_coordinates()
        np.testing.assert_allclose(corners[0, :, 0], np.degrees(0.5) + np.array([2, -2]))

    def test_without_matplotlib_it_says_what_is_missing(self):
        program = ("import sys; sys.modules['matplotlib'] = None\n"
                   "import insonify\n"
                   "scenario = insonify.Scenario(sonars=[insonify.SonarConfig(beam_count=4, bin_count=9)])\n"
                   "ping = insonify.Simulator(scenario, insonify.Scene()).ping()\n"
                   "try:\n    ping.plot()\nexcept ImportError as error:\n    print(error)\n")
        done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
        self.assertEqual(done.stdout, "Ping.plot() needs matplotlib (Debian: apt-get install python3-matplotlib); "
                                      "insonify.fan(ping) gives a picture without it\n", done.stderr)


if __name__ == "__main__":
    try:
        import matplotlib
    except ImportError:
        print("Skipped: there is no matplotlib (python3-matplotlib)")
        sys.exit(SKIPPED)
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    unittest.main(argv=["plot_test.py"])
