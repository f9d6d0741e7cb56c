#!/usr/bin/python3
"""The package in ros1/: its launch file starts the node with its arguments, and the layout of rviz shows topics that exist.

launch_test.py INSONIFY VERSION
"""

import os
import pathlib
import re
import shutil
import signal
import sys
import unittest
import xml.etree.ElementTree

VERSION = sys.argv.pop()
import ros1_kit as kit  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[3]
if shutil.which("roslaunch") is None:
    kit.skip("there is no roslaunch (package python3-roslaunch)")
TOPICS = {"image", "fan", "raw", "points", "true_points", "pose", "scenario"}


class LaunchTest(unittest.TestCase):
    def test_the_package_has_the_version_of_the_project(self):
        package = xml.etree.ElementTree.parse(ROOT / "ros1/package.xml").getroot()
        self.assertEqual(package.find("version").text, VERSION)
        self.assertEqual(package.find("name").text, "insonify_ros1")

    def test_the_layout_shows_topics_of_the_node(self):
        layout = (ROOT / "ros1/rviz/insonify.rviz").read_text()
        shown = re.findall(r"Topic: /insonify/(\w+)", layout)
        self.assertEqual(set(shown), {"fan", "points", "pose"})
        self.assertLessEqual(set(shown), TOPICS)

    def test_roslaunch_starts_it(self):
        kit.write("dive.yaml", kit.SCENARIO)
        os.environ["ROS_PACKAGE_PATH"] = f"{ROOT / 'ros1'}:/usr/share"
        os.environ["PATH"] = f"{os.path.dirname(kit.BRIDGE)}:{os.environ['PATH']}"
        launch = kit.Program("roslaunch", "-p", kit.PORT, "insonify_ros1", "bridge.launch",
                             f"scenario:={kit.FOLDER / 'dive.yaml'}", "name:=dory", "range:=8", "gain:=3", "tf:=base_link",
                             "publish_tf:=false", "world_frame:=odom", "levels:=-95:-45", "options:=--bits 8")
        self.addCleanup(launch.end, signal.SIGINT)  # Which ends its children too.
        launch.wait_to_say("node /dory of ROS 1")
        master = kit.xmlrpc.client.ServerProxy(os.environ["ROS_MASTER_URI"])
        expected = {f"/dory/{topic}" for topic in TOPICS}

        def own():
            return {topic for topic, nodes in master.getSystemState("/test")[2][0] if "/dory" in nodes}
        kit.wait_for(lambda: expected <= own(), message=f"not all of {expected} are published")
        self.assertNotIn("/tf", own())
        subscribed = master.getSystemState("/test")[2][1]
        self.assertIn("/dory", dict(subscribed)["/tf"])
        self.assertEqual(master.getParam("/test", "/dory/levels")[2], "-95:-45")
        kit.rospy.init_node("tester", disable_signals=True)
        from dynamic_reconfigure.client import Client
        settings = Client("/dory", timeout=kit.PATIENCE).get_configuration()
        self.assertEqual((settings["range"], settings["gain"]), (8, 3))
        from geometry_msgs.msg import TransformStamped
        from tf2_msgs.msg import TFMessage
        here = TransformStamped()
        here.header.frame_id, here.child_frame_id, here.transform.rotation.w = "odom", "base_link", 1
        static = kit.rospy.Publisher("/tf_static", TFMessage, queue_size=1, latch=True)
        static.publish(TFMessage([here]))
        image = kit.decoded(kit.Listener("/dory/image").next())
        self.assertEqual(image.image.dtype, 0)
        self.assertEqual(len(image.image.data), 24 * 90)
        status, _ = launch.end(signal.SIGINT)
        self.assertEqual(status, 0)
        self.assertIn("ms from transmission to message", launch.said())


if __name__ == "__main__":
    kit.main()
