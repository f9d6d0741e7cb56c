#!/usr/bin/python3
"""Messages of the node of ROS 1 are those of the recording of the same pings, and rosbag records and plays them.

recording_test.py INSONIFY
"""

import pathlib
import re
import subprocess

import ros1_kit as kit
import genpy.message
from std_msgs.msg import String

try:
    import h5py
    import numpy as np
except ImportError as missing:
    kit.skip(f"{missing} (packages python3-h5py, python3-numpy)")

PERIOD = 0.0625  # A power of two: times of poses are exact [s].
PINGS = 6
TOPICS = {"/insonify/image": "/fls/sonar_image", "/insonify/fan": "/fls/fan", "/insonify/points": "/fls/points",
          "/insonify/pose": "/fls/pose", "/tf": "/tf"}


def x_at(ping):
    return 0.25 * ping


def insonify(*words):
    subprocess.run([kit.INSONIFY, *words], cwd=kit.FOLDER, check=True, stdout=subprocess.DEVNULL)


def raw_messages(bag, topic):
    """Their bytes."""
    return [message[1] for _, message, _ in bag.read_messages(topic, raw=True)]


class RecordingTest(kit.MasterTest):
    """The vehicle moves by odometry and simulated time; rosbag records."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        poses = "".join(f"  - {{time: {i * PERIOD}, position: [{x_at(i)}, 0.5, 0]}}\n" for i in range(PINGS + 1))
        kit.write("dive.yaml", f"{kit.SCENARIO}pings: {PINGS}\ntrajectory:\n{poses}")
        insonify("run", "dive.yaml", "-o", "out", "--no-pictures", "--record", "h5")
        recording = next((kit.FOLDER / "out").glob("*.h5"))
        insonify("export", str(recording), "-o", "expected.bag")
        cls.recording = h5py.File(recording)
        cls.expected = kit.rosbag.Bag(str(kit.FOLDER / "expected.bag"))

        node = kit.node("--odometry", "/auv/odom", "--clock", "simulated")
        cls.addClassCleanup(node.end)
        odom = kit.connected(kit.rospy.Publisher("/auv/odom", kit.nav_msgs.msg.Odometry, queue_size=10))
        clock = kit.connected(kit.rospy.Publisher("/clock", kit.rosgraph_msgs.msg.Clock, queue_size=1))
        topics = [*TOPICS, "/insonify/raw"]
        record = kit.Program("rosbag", "record", "-O", "x.bag", "-l", PINGS, "__name:=recorder", *topics)
        kit.wait_for(lambda: all("/recorder" in kit.connections("/insonify").get((topic, "o"), [])
                                 for topic in topics), message="rosbag was not connected")
        images = kit.Listener("/insonify/image")
        for i in range(PINGS):
            odom.publish(kit.odometry(i * PERIOD, x_at(i), 0.5))
            # The pose and the time come by two connections: the ping of a time that is told first has the pose before.
            kit.wait_for(lambda: cls.master.received("/insonify", "/auv/odom") > i, message="the pose was not received")
            clock.publish(kit.clock(i * PERIOD))
            images.wait(i + 1)
        kit.close_bag(record)
        cls.image_count = len(images.messages)
        cls.scenario = kit.rospy.wait_for_message("/insonify/scenario", String, kit.PATIENCE)  # It was sent long ago.
        cls.bag = kit.rosbag.Bag(str(kit.FOLDER / "x.bag"))
        cls.status, cls.seconds = node.end()

    def test_bytes_are_those_of_the_exported_bag(self):
        for topic, exported in TOPICS.items():
            found, expected = raw_messages(self.bag, topic), raw_messages(self.expected, exported)
            self.assertEqual(len(expected), PINGS, topic)
            self.assertEqual(len(found), PINGS, topic)
            for i in range(1, PINGS):  # The first has the stamp 1 ns, and 0 in the export.
                self.assertTrue(found[i] == expected[i], f"{topic}, ping {i}")

    def test_types_are_those_that_readers_know(self):
        types = {topic: (info.msg_type, info.message_count)
                 for topic, info in self.bag.get_type_and_topic_info().topics.items()}
        self.assertEqual(self.image_count, PINGS)  # rosbag stops there.
        self.assertEqual(types, {
            "/insonify/image": ("marine_acoustic_msgs/ProjectedSonarImage", PINGS),
            "/insonify/fan": ("sensor_msgs/Image", PINGS), "/insonify/raw": ("sensor_msgs/Image", PINGS),
            "/insonify/points": ("sensor_msgs/PointCloud2", PINGS),
            "/insonify/pose": ("geometry_msgs/PoseStamped", PINGS), "/tf": ("tf2_msgs/TFMessage", PINGS)})
        _, image, _ = next(self.bag.read_messages("/insonify/image", raw=True))
        self.assertEqual(image[2], "c72fc8e29ab227a547720a36666022fd")

    # A machine without marine_acoustic_msgs has nothing to compare them with.
    def test_rosbag_check_finds_nothing_to_migrate(self):
        for bag in ("x.bag", "expected.bag"):
            checked = subprocess.run(["rosbag", "check", bag], cwd=kit.FOLDER, check=False, capture_output=True, text=True)
            self.assertEqual(set(re.findall(r"(?m)^ \* From: (\S+)", checked.stdout)) - {"marine_acoustic_msgs/ProjectedSonarImage"},
                             set(), checked.stdout)

    def test_texts_of_definitions_are_those_of_ros(self):
        source = (pathlib.Path(__file__).resolve().parents[3] / "src/io/message/ros1_texts.cpp").read_text()
        texts = re.findall(r'\{"(\S+)", R"\((.*?)\)"\}', source, re.DOTALL)
        self.assertEqual(len(texts), 13)
        for name, text in texts:
            of_ros = genpy.message.get_message_class(name)._full_text.split("=" * 80)[0]
            self.assertEqual(text.strip(), of_ros.strip(), name)

    # The level of a cell, 10 log10(intensity) + 30 log10(range), from -100 to -40 dB.
    def test_values_are_those_of_the_hdf5_recording(self):
        count = 0
        for i, (_, message, _) in enumerate(self.bag.read_messages("/insonify/image")):
            shape = (len(message.ranges), message.image.beam_count)
            values = np.frombuffer(message.image.data, "<u2").reshape(shape)
            ranges = self.recording["range"][:]
            np.testing.assert_allclose(message.ranges, ranges, rtol=1e-6)
            intensity = self.recording["intensity"][i].astype(float)
            with np.errstate(divide="ignore"):
                level = 10 * np.log10(intensity) + 30 * np.log10(ranges)[:, None]
            exact = np.clip((level + 100) / 60, 0, 1) * 65535
            self.assertLess(np.abs(values - exact).max(), 1)
            count += np.count_nonzero((values > 0) & (values < 65535))
            self.assertEqual(message.header.seq, i)
            self.assertAlmostEqual(message.header.stamp.to_sec(), i * PERIOD, delta=2e-9)
        self.assertGreater(count, 40 * PINGS)  # It is no picture of nothing.

    # Rows are bins, column 0 the beam furthest to port. At first the strongest target is straight ahead.
    def test_raw_images_hold_the_same_values(self):
        for (_, raw, _), (_, image, _) in zip(self.bag.read_messages("/insonify/raw"),
                                              self.bag.read_messages("/insonify/image")):
            self.assertEqual((raw.encoding, raw.height, raw.width, raw.step), ("mono16", 90, 24, 48))
            self.assertEqual(raw.header.stamp, image.header.stamp)
            values = np.frombuffer(raw.data, "<u2").reshape(90, 24)
            self.assertTrue((values == np.frombuffer(image.image.data, "<u2").reshape(90, 24)).all())
            if raw.header.seq == 0:
                row, column = np.unravel_index(values.argmax(), values.shape)
                self.assertEqual(row, int((6 - 0.2) / (12 - 0.2) * 90))
                self.assertIn(column, (11, 12))

    def test_the_scenario_is_latched(self):
        self.assertIn("ping_period: 0.0625", self.scenario.data)

    def test_rosbag_plays_them(self):
        play = kit.Program("rosbag", "play", "--wait-for-subscribers", "x.bag", "--topics", "/insonify/image")
        images = kit.Listener("/insonify/image")
        images.wait(PINGS)
        play.end()
        self.assertEqual(len(images.messages), PINGS)
        recorded = raw_messages(self.bag, "/insonify/image")
        for i, message in enumerate(images.messages):
            self.assertTrue(message == recorded[i], f"ping {i}")

    def test_it_ends_when_asked(self):
        self.assertEqual(self.status, 0)
        self.assertLess(self.seconds, kit.PROMPT)


if __name__ == "__main__":
    kit.main()
