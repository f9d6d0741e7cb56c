#!/usr/bin/python3
"""Soundings of the node of ROS 1 are those of the recording of the same pings; only its multibeam has them.

soundings_test.py INSONIFY
"""

import subprocess

import ros1_kit as kit

PERIOD = 0.0625  # A power of two: times of poses are exact [s].
PINGS = 3
TOPICS = {"/insonify/swath/detections": "/swath/detections", "/insonify/swath/soundings": "/swath/soundings"}
SCENARIO = """world: floor.obj
sonars:
  - {name: swath, type: mbes, beam_count: 24, bin_count: 200, azimuth_aperture_deg: 120, azimuth_resolution_deg: 4,
     elevation_aperture_deg: 4, max_range: 12, ping_period: 0.0625}
  - {name: fls, beam_count: 8, bin_count: 20, max_range: 12, ping_period: 0.0625}
"""


def insonify(*words):
    subprocess.run([kit.INSONIFY, *words], cwd=kit.FOLDER, check=True, stdout=subprocess.DEVNULL)


class SoundingsTest(kit.MasterTest):
    def test_they_are_those_of_the_exported_bag(self):
        kit.write("floor.obj", "v -50 -50 -5\nv 50 -50 -5\nv 50 50 -5\nv -50 50 -5\nf 1 2 3 4\n")
        poses = "".join(f"  - {{time: {i * PERIOD}, position: [{0.25 * i}, 0.5, 0]}}\n" for i in range(PINGS + 1))
        kit.write("dive.yaml", f"{SCENARIO}pings: {PINGS}\ntrajectory:\n{poses}")
        insonify("run", "dive.yaml", "-o", "out", "--no-pictures", "--record", "h5")
        insonify("export", "out/swath.h5", "out/fls.h5", "-o", "expected.bag")
        node = self.start("--odometry", "/auv/odom", "--clock", "simulated")
        odom = kit.connected(kit.rospy.Publisher("/auv/odom", kit.nav_msgs.msg.Odometry, queue_size=10))
        clock = kit.connected(kit.rospy.Publisher("/clock", kit.rosgraph_msgs.msg.Clock, queue_size=1))
        listeners = {topic: kit.Listener(topic) for topic in TOPICS}
        for i in range(PINGS):
            odom.publish(kit.odometry(i * PERIOD, 0.25 * i, 0.5))
            kit.wait_for(lambda: self.master.received("/insonify", "/auv/odom") > i, message="the pose was not received")
            clock.publish(kit.clock(i * PERIOD))
            for listener in listeners.values():
                listener.wait(i + 1)
        with kit.rosbag.Bag(str(kit.FOLDER / "expected.bag")) as bag:
            for topic, exported in TOPICS.items():
                expected = [message[1] for _, message, _ in bag.read_messages(exported, raw=True)]
                self.assertEqual(len(expected), PINGS)
                self.assertGreater(len(expected[0]), 400)  # It is no message of nothing.
                for i in range(1, PINGS):  # The first has the stamp 1 ns, and 0 in the export.
                    self.assertTrue(listeners[topic].messages[i] == expected[i], f"{topic}, ping {i}")
        for sonar, wanted in (("swath", True), ("fls", False)):
            self.assertEqual(self.master.publishes("/insonify", f"/insonify/{sonar}/detections"), wanted)
        node.end()


if __name__ == "__main__":
    kit.main()
