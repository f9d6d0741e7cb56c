#!/usr/bin/python3
"""Where the vehicle is: by tf, by odometry, by simulated time, and what the node says where they are missing.

poses_test.py INSONIFY
"""

import itertools
import math
import subprocess
import threading
import time

import ros1_kit as kit
from geometry_msgs.msg import PoseStamped, TransformStamped
from sensor_msgs.msg import Image
from tf2_msgs.msg import TFMessage


def transform(parent, child, stamp, x=0.0, y=0.0, yaw=0.0):
    each = TransformStamped()
    each.header.frame_id, each.child_frame_id = parent, child
    each.header.stamp = kit.rospy.Time.from_sec(stamp)
    each.transform.translation.x, each.transform.translation.y = x, y
    each.transform.rotation.w, each.transform.rotation.z = math.cos(yaw / 2), math.sin(yaw / 2)
    return TFMessage([each])


def values(image):
    """The values of a sonar image with 16 bits, in order."""
    data = image.image.data
    return [low + 256 * high for low, high in zip(data[::2], data[1::2])]


class Poses:
    """Those that the node publishes, newest last."""

    def __init__(self, node="/insonify"):
        self.all = []
        self._subscriber = kit.subscribe(f"{node}/pose", PoseStamped, self.all.append)

    def wait(self, right, again=lambda: None):
        """The first for which right() is true, doing something again and again until then."""
        def found():
            again()
            return next(filter(right, list(self.all)), None)
        return kit.wait_for(found, message=lambda: f"no such pose among {self.all[-1:]}")


class PosesTest(kit.MasterTest):
    def publisher(self, topic, kind, **options):
        publisher = kit.rospy.Publisher(topic, kind, queue_size=100, **options)
        self.addCleanup(publisher.unregister)
        return kit.connected(publisher)

    # From world over odom, 10 m ahead and turned by a quarter, to base_link, 2 m further: at (10, 2), heading to +y.
    def test_tf_is_composed_at_the_newest_time_that_all_have(self):
        self.start("--tf", "base_link", "__name:=by_tf")
        poses = Poses("/by_tf")
        static = self.publisher("/tf_static", TFMessage, latch=True)
        static.publish(transform("world", "odom", 0, x=10, yaw=math.pi / 2))
        tf = self.publisher("/tf", TFMessage)
        now = math.floor(time.time()) - 1000  # The node's own time must not count.
        tf.publish(transform("odom", "base_link", now + 0.25, x=1))
        tf.publish(transform("odom", "base_link", now + 0.5, x=2))
        pose = poses.wait(lambda pose: abs(pose.pose.position.y - 2) < 1e-9)
        self.assertAlmostEqual(pose.pose.position.x, 10)
        self.assertAlmostEqual(pose.pose.orientation.z, math.sin(math.pi / 4))
        # Pings that follow without a newer pose have the time that has passed since added.
        self.assertTrue(now + 0.5 <= pose.header.stamp.to_sec() < now + 0.5 + kit.PATIENCE, pose.header.stamp)
        # An older one that comes late changes nothing.
        tf.publish(transform("odom", "base_link", now + 0.4, x=7))
        tf.publish(transform("odom", "base_link", now + 0.75, x=3))
        poses.wait(lambda pose: abs(pose.pose.position.y - 3) < 1e-9)
        self.assertFalse([pose for pose in poses.all if pose.pose.position.y > 3.5])

    def test_transforms_of_a_simulation_that_begins_again_count(self):
        self.start("--tf", "base_link", "--clock", "simulated", "__name:=again")
        poses = Poses("/again")
        tf = self.publisher("/tf", TFMessage)
        clock = self.publisher("/clock", kit.rosgraph_msgs.msg.Clock)
        for begin, x in ((500, 4), (20, 6)):
            ticks = itertools.count()

            def tell():
                now = begin + next(ticks) / 32
                tf.publish(transform("world", "base_link", now, x=x))
                clock.publish(kit.clock(now))
                # One that was on its way while time was set back; in the first round it comes again, and is no news.
                tf.publish(transform("world", "base_link", 500, x=4))
            pose = poses.wait(lambda pose: abs(pose.pose.position.x - x) < 1e-9, tell)
            self.assertTrue(begin <= pose.header.stamp.to_sec() < begin + 60, pose.header.stamp)

    def test_a_tree_that_does_not_lead_to_the_world_is_told(self):
        node = self.start("--tf", "base_link", "--world-frame", "map", "__name:=lost")
        tf = self.publisher("/tf", TFMessage)
        kit.wait_for(lambda: tf.publish(transform("island", "base_link", time.time())) or "leads from" in node.said()
                     or time.sleep(0.1), message="it did not say so")
        self.assertIn("/tf: leads from base_link up to island, not to map", node.said())

    def test_missing_publishers_are_told_and_found(self):
        node = self.start("--odometry", "/auv/odom", "__name:=patient")
        node.wait_to_say("/auv/odom: nobody publishes nav_msgs/Odometry to it")
        odom = self.publisher("/auv/odom", kit.nav_msgs.msg.Odometry)
        node.wait_to_say("/auv/odom: is published now")
        poses = Poses("/patient")
        pose = poses.wait(lambda pose: True, lambda: odom.publish(kit.odometry(time.time(), 3, frame="map")))
        self.assertEqual(pose.pose.position.x, 3)
        node.wait_to_say("its poses are in the frame map; they are taken for poses in the world's, world")

    def test_a_pose_that_is_none_is_told_once(self):
        node = self.start("--odometry", "/auv/odom2", "__name:=strict")
        odom = self.publisher("/auv/odom2", kit.nav_msgs.msg.Odometry)
        poses = Poses("/strict")
        for _ in range(3):
            odom.publish(kit.odometry(time.time(), 1, yaw_wz=(0.5, 0.1)))
            time.sleep(0.1)
        refusal = "/auv/odom2: world_from_vehicle"
        node.wait_to_say(refusal)
        poses.wait(lambda pose: pose.pose.position.x == 2, lambda: odom.publish(kit.odometry(time.time(), 2)))
        self.assertEqual(node.said().count(refusal), 1, node.said())
        self.assertFalse([pose for pose in poses.all if pose.pose.position.x == 1])

    # Heading to +y at 9 m/s: along the axes of the vehicle that is (9, 0, 0). While a sonar listens to 40 m it moves by
    # half a metre, as the echoes of `insonify run` show on a trajectory of that speed.
    def test_the_twist_of_odometry_is_along_the_axes_of_the_vehicle(self):
        text = kit.SCENARIO.replace("max_range: 12", "max_range: 40").replace("[6, 0.5", "[0.5, 30").replace(
            "ping_period: 0.0625", "ping_period: 0.25").replace("bin_count: 90", "bin_count: 900") + "motion_in_ping: true\npings: 1\n"
        kit.write("moving.yaml", text + "trajectory:\n  - {time: 0, position: [0, 0, 0], orientation_deg: [0, 0, 90]}\n"
                                        "  - {time: 10, position: [0, 90, 0], orientation_deg: [0, 0, 90]}\n")
        subprocess.run([kit.INSONIFY, "run", "moving.yaml", "-o", "moving", "--no-pictures", "--record", "h5"],
                       cwd=kit.FOLDER, check=True, stdout=subprocess.DEVNULL)
        subprocess.run([kit.INSONIFY, "export", "moving/fls.h5", "-o", "moving.bag"], cwd=kit.FOLDER, check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        with kit.rosbag.Bag(str(kit.FOLDER / "moving.bag")) as bag:
            expected = values(next(bag.read_messages("/fls/sonar_image")).message)

        images = {}
        for name, speed in (("moving", 9), ("still", 0)):
            self.start("--odometry", f"/{name}/odom", "--clock", "simulated", f"__name:={name}", scenario="moving.yaml")
            listener = kit.Listener(f"/{name}/image")
            odom = self.publisher(f"/{name}/odom", kit.nav_msgs.msg.Odometry)
            clock = self.publisher("/clock", kit.rosgraph_msgs.msg.Clock)
            message = kit.odometry(0, 0, yaw_wz=(math.cos(math.pi / 4), math.sin(math.pi / 4)))
            message.twist.twist.linear.x = speed
            odom.publish(message)
            kit.wait_for(lambda: self.master.received(f"/{name}", f"/{name}/odom"), message="the pose was not received")
            # Again and again: the first node's connection does not tell that the second's is there.
            kit.wait_for(lambda: listener.messages or clock.publish(kit.clock(0)), message="no image came")
            images[name] = values(kit.decoded(listener.messages[0]))
        self.assertGreater(max(expected), 10000)
        self.assertLessEqual(max(abs(a - b) for a, b in zip(images["moving"], expected)), 1)
        self.assertGreater(max(abs(a - b) for a, b in zip(images["still"], expected)), 1000)

    # Twenty at once: no ping is dropped, and none is made between. Two poses have the same place. A program that reads
    # its first picture when all pings are made gets twenty, of 16 MB together: more than sockets hold.
    def test_a_ping_for_each_pose(self):
        node = self.start("--ping-at", "/ask", "__name:=asked")
        poses = Poses("/asked")
        made, fans = threading.Event(), []
        self.addCleanup(made.set)
        kit.subscribe("/asked/fan", Image, lambda fan: made.wait() and fans.append(fan.header.stamp.to_sec()))
        ask = self.publisher("/ask", PoseStamped)
        for number in range(1, 21):
            pose = PoseStamped()
            pose.header.frame_id, pose.header.stamp = "world", kit.rospy.Time.from_sec(number)
            pose.pose.position.x, pose.pose.orientation.w = number // 2, 1
            ask.publish(pose)
        kit.wait_for(lambda: len(poses.all) >= 20, message=lambda: f"only {len(poses.all)} pings, {node.said()}")
        made.set()
        kit.wait_for(lambda: len(fans) >= 20, message=lambda: f"only pictures {fans}")
        self.assertEqual(fans[:20], list(range(1, 21)))
        pose.header.stamp = kit.rospy.Time.from_sec(21)  # A ping that nobody has asked for would come before it.
        ask.publish(pose)
        kit.wait_for(lambda: len(poses.all) >= 21, message="no ping for the last pose")
        self.assertEqual([(each.header.stamp.to_sec(), round(each.pose.position.x, 5)) for each in poses.all],
                         [(number, min(number, 20) // 2) for number in range(1, 22)])

    def test_use_sim_time_holds_unless_the_command_line_says_otherwise(self):
        self.master.set("/use_sim_time", True)
        self.addCleanup(self.master.proxy.deleteParam, "/test", "/use_sim_time")
        node = self.start("__name:=simulated")
        poses = Poses("/simulated")
        node.wait_to_say("/clock: nobody publishes rosgraph_msgs/Clock to it")
        self.assertEqual(poses.all, [])
        clock = self.publisher("/clock", kit.rosgraph_msgs.msg.Clock)
        ticks = itertools.count()
        poses.wait(lambda pose: pose.header.stamp.to_sec() > 500.3, lambda: clock.publish(kit.clock(500 + next(ticks) / 32)))
        stamps = [pose.header.stamp.to_sec() for pose in poses.all]
        self.assertTrue(all(500 <= stamp < 560 for stamp in stamps), stamps)
        self.assertEqual(stamps, sorted(stamps))
        # A simulation that begins again.
        count = len(poses.all)
        ticks = itertools.count()
        poses.wait(lambda pose: pose.header.stamp.to_sec() < 100, lambda: clock.publish(kit.clock(20 + next(ticks) / 32)))
        self.assertGreater(len(poses.all), count)

        self.start("--clock", "wall", "__name:=awake")
        self.assertGreater(Poses("/awake").wait(lambda pose: True).header.stamp.to_sec(), time.time() - 60)

    def test_the_vehicle_must_not_be_what_the_node_publishes(self):
        node = self.start("--tf", "fls", "__name:=circle")
        self.assertEqual(node.process.wait(timeout=kit.PATIENCE), 2)
        self.assertIn("--tf fls", node.said())


if __name__ == "__main__":
    kit.main()
