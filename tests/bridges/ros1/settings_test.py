#!/usr/bin/python3
"""Settings of the node of ROS 1: dynamic_reconfigure, the topic ~set, parameters at its start, and how it ends.

settings_test.py INSONIFY
"""

import signal
import time

import ros1_kit as kit
from dynamic_reconfigure.client import Client
from dynamic_reconfigure import DynamicReconfigureCallbackException

TWO_SONARS = """world: none
points: [{position: [6, 0.5, 0], target_strength_db: -10}]
sonars:
  - {name: fls, beam_count: 8, bin_count: 30, max_range: 12, ping_period: 0.05, sampling: {columns_per_beam: 1, rows: 8}}
  - {name: 2nd-fls, beam_count: 8, bin_count: 30, max_range: 9, ping_period: 0.05, sampling: {columns_per_beam: 1, rows: 8}}
"""


def edge(max_range, bins):
    """Centre of the last bin, where the first begins at 0.2 m."""
    return max_range - (max_range - 0.2) / bins / 2


def total(image):
    """Sum of the values of a decoded sonar image."""
    data = image.image.data
    return sum(data[::2]) + 256 * sum(data[1::2])


class SettingsTest(kit.MasterTest):
    def test_range_and_gain_act_on_the_next_ping(self):
        node = self.start()
        images = kit.Listener("/insonify/image")
        before = images.next()
        self.assertAlmostEqual(kit.far_edge(before), edge(12, 90), places=5)
        client = Client("/insonify", timeout=kit.PATIENCE)
        described = {each["name"]: each for each in client.get_parameter_descriptions()}
        self.assertEqual(set(described), {"range", "gain"})
        self.assertEqual((described["range"]["default"], described["range"]["max"]), (12, 48))

        answer = client.update_configuration({"range": 9.0})
        self.assertEqual(answer["range"], 9)
        next_one = images.image_after(time.time())
        self.assertAlmostEqual(next_one.ranges[-1], edge(9, 90), places=5)
        self.assertEqual(next_one.header.frame_id, "fls_beams")

        quiet = total(next_one)
        self.assertEqual(client.update_configuration({"gain": 12})["gain"], 12)
        self.assertGreater(total(images.image_after(time.time())), quiet)
        self.assertEqual(client.get_configuration()["gain"], 12)

        status, seconds = node.end(signal.SIGINT)
        self.assertEqual(status, 0)
        self.assertLess(seconds, kit.PROMPT)
        self.assertRegex(node.said(), r"\d+ pings in [\d.]+ s \([\d.]+ Hz\); [\d.]+ ms from transmission to message")

    def test_what_is_wrong_is_refused_and_changes_nothing(self):
        node = self.start()
        images = kit.Listener("/insonify/image")
        client = Client("/insonify", timeout=kit.PATIENCE)
        for settings, reason in (({"range": -3.0}, "max_range = -3 m must be greater than 0"),
                                 ({"gain": 300.0}, "gain = 300 dB must be from -100 to 100 dB")):
            with self.assertRaises(DynamicReconfigureCallbackException):
                client.update_configuration(settings)
            node.wait_to_say(reason)
        self.assertEqual({name: client.get_configuration()[name] for name in ("range", "gain")}, {"range": 12, "gain": 0})
        self.assertAlmostEqual(kit.far_edge(images.next()), edge(12, 90), places=5)

    def test_any_setting_by_a_topic(self):
        self.start()
        answers = []
        from std_msgs.msg import String
        kit.subscribe("/insonify/set_result", String, lambda message: answers.append(message.data))
        ask = kit.connected(kit.rospy.Publisher("/insonify/set", String, queue_size=5))
        images = kit.Listener("/insonify/image")
        for text, begin in (("max_range=7\nbeam_count=12", "done: max_range=7\nbeam_count=12"), ("", "refused: a message holds"),
                            ("max_rnage=7", "refused: ")):
            count = len(answers)
            ask.publish(text)
            kit.wait_for(lambda: len(answers) > count, message=f"no answer to {text!r}")
            self.assertTrue(answers[-1].startswith(begin), answers[-1])
        self.assertIn("max_range", answers[-1])
        self.assertEqual(images.image_after(time.time()).image.beam_count, 12)

    def test_options_are_parameters_of_the_node(self):
        self.master.set("/dory", {"range": 8, "bits": 16, "world_frame": "odom", "fan_height": 300, "gain": 3.5,
                                  "publish_tf": False, "set": ["beam_count=16"], "rnage": 3})
        self.addCleanup(self.master.proxy.deleteParam, "/test", "/dory")
        node = self.start("__name:=dory", "--fan-height", "240", "~fan:=/auv/fan", bits=())
        image = kit.decoded(kit.Listener("/dory/image").next())
        self.assertEqual((image.image.beam_count, image.image.dtype), (16, 2))
        self.assertAlmostEqual(image.ranges[-1], edge(8, 90), places=5)
        node.wait_to_say("warning: nothing reads the parameter /dory/rnage")
        self.assertEqual(Client("/dory", timeout=kit.PATIENCE).get_configuration()["gain"], 3.5)
        self.assertFalse(self.master.publishes("/dory", "/tf"))
        from geometry_msgs.msg import PoseStamped
        self.assertEqual(kit.rospy.wait_for_message("/dory/pose", PoseStamped, kit.PATIENCE).header.frame_id, "odom")
        from std_msgs.msg import String  # Latched: it was sent long ago.
        self.assertIn("name: fls", kit.rospy.wait_for_message("/dory/scenario", String, kit.PATIENCE).data)
        from sensor_msgs.msg import Image
        self.assertEqual(kit.rospy.wait_for_message("/auv/fan", Image, kit.PATIENCE).height, 240)  # The command line holds.

    def test_a_wrong_parameter_ends_it_with_a_line(self):
        self.master.set("/marlin", {"rate": "fast"})
        self.addCleanup(self.master.proxy.deleteParam, "/test", "/marlin")
        node = self.start("__name:=marlin")
        self.assertEqual(node.process.wait(timeout=kit.PATIENCE), 2)
        self.assertIn("parameter /marlin/rate: --rate", node.said())
        self.assertIn("rosparam delete /marlin/rate removes it", node.said())

    def test_several_sonars_have_names_below_the_node(self):
        self.master.set("/insonify", {"gain": 1.5, "_2nd_fls": {"gain": -2.5, "range": 7, "colour": "red"}, "3rd": {"range": 4}})
        self.addCleanup(self.master.proxy.deleteParam, "/test", "/insonify")
        kit.write("two.yaml", TWO_SONARS)
        node = self.start(scenario="two.yaml")
        self.assertEqual(Client("/insonify/fls", timeout=kit.PATIENCE).get_configuration()["gain"], 1.5)
        self.assertEqual(Client("/insonify/_2nd_fls", timeout=kit.PATIENCE).get_configuration()["range"], 7)
        for unread in ("_2nd_fls/colour", "3rd/range"):
            node.wait_to_say(f"warning: nothing reads the parameter /insonify/{unread}")
        client = Client("/insonify/_2nd_fls", timeout=kit.PATIENCE)
        self.assertEqual(client.update_configuration({"range": 6.0})["gain"], -2.5)
        edges = [kit.far_edge(kit.Listener(f"/insonify/{name}/image").next()) for name in ("fls", "_2nd_fls")]
        self.assertAlmostEqual(edges[0], edge(12, 30), places=5)
        self.assertAlmostEqual(edges[1], edge(6, 30), places=5)
        # 20 dB are a third of the 60 dB that values cover; what a sonar hears changes little from ping to ping.
        images = [kit.Listener(f"/insonify/{name}/image") for name in ("fls", "_2nd_fls")]
        before = [total(kit.decoded(each.next())) for each in images]
        client.update_configuration({"gain": 17.5})
        moment = time.time()
        rises = [total(each.image_after(moment)) - old for each, old in zip(images, before)]
        self.assertGreater(rises[1], 65535)
        self.assertLess(abs(rises[0]), rises[1] / 2)

    def test_it_reports_when_asked_and_ends_when_killed_by_ros(self):
        node = self.start("__name:=asked")
        kit.Listener("/asked/image").wait(3)
        node.process.send_signal(signal.SIGUSR1)
        node.wait_to_say("ms from transmission to message")
        self.kill_by_ros(node, "/asked")

    # While it sends without a pause; what was a race between the end and a look at roscore.
    def test_being_killed_by_ros_is_no_failure(self):
        for i in range(6):
            node = self.start("--rate", "1000", "--set", "ping_period=0.02", f"__name:=killed{i}")
            kit.Listener(f"/killed{i}/fan").wait(2)
            self.kill_by_ros(node, f"/killed{i}")

    def kill_by_ros(self, node, name):
        uri = self.master.proxy.lookupNode("/test", name)[2]
        kit.xmlrpc.client.ServerProxy(uri).shutdown("/test", "by the test")  # As `rosnode kill` does.
        begin = time.monotonic()
        self.assertEqual(node.process.wait(timeout=kit.PATIENCE), 0, node.said())
        self.assertLess(time.monotonic() - begin, kit.PROMPT)
        self.assertIn(f"ROS ends node {name}", node.said())


if __name__ == "__main__":
    kit.main()
