#!/usr/bin/python3
"""The node of ROS 1 waits for a roscore that is not there, and survives its restart.

roscore_test.py INSONIFY
"""

import os
import signal
import time

import ros1_kit as kit
from dynamic_reconfigure.client import Client


class RoscoreTest(kit.NodeTest):
    def master(self):
        master = kit.Master()
        self.addCleanup(master.end)
        return master

    # Programs of their own, as each restart of roscore loses a node of rospy.
    def images(self, name, count, seconds=kit.PATIENCE):
        """How many images rosbag has recorded in that time, at most `count`."""
        record = kit.Program("rosbag", "record", "-l", count, "-O", name, "/insonify/image")
        self.addCleanup(record.end, signal.SIGKILL)
        kit.wait_for(lambda: record.process.poll() is not None, seconds, "rosbag has not recorded enough")
        with kit.rosbag.Bag(str(kit.FOLDER / name)) as bag:
            return bag.get_message_count("/insonify/image")

    def test_it_waits_for_a_roscore_and_can_be_ended_then(self):
        node = self.start()
        node.wait_to_say("no roscore answers at http://127.0.0.1")
        status, seconds = node.end(signal.SIGINT)
        self.assertEqual(status, 1)
        self.assertLess(seconds, kit.PROMPT)
        self.assertEqual(node.said().count("no roscore answers"), 1)

    def test_mistakes_are_told_without_a_roscore(self):
        kit.write("wrong.yaml", kit.SCENARIO.replace("max_range", "max_rnage"))
        for words, scenario, said in (((), "wrong.yaml", "max_rnage"), (("--bits", "9"), "dive.yaml", "--bits"),
                                      (("--odometry", "a", "--tf", "b"), "dive.yaml", "--odometry"),
                                      (("nonsense",), "dive.yaml", "nonsense")):
            node = self.start(*words, scenario=scenario)
            self.assertEqual(node.process.wait(timeout=kit.PATIENCE), 2, node.said())
            self.assertIn(said, node.said())
            self.assertEqual(len(node.said().splitlines()), 1)

    def test_the_address_of_roscore_must_be_one(self):
        node = self.start("__master:=elsewhere")
        self.assertEqual(node.process.wait(timeout=kit.PATIENCE), 2)
        self.assertIn("elsewhere must be like http://localhost:11311", node.said())

    def test_it_survives_a_restart(self):
        node = self.start("--odometry", "/odom")
        node.wait_to_say("no roscore answers")
        master = self.master()
        node.wait_to_say("roscore answers")
        # Poses come from a program that is started again with each roscore.
        odometry = self.odometry()
        self.assertEqual(self.images("before.bag", 3), 3)

        odometry.end(signal.SIGKILL)
        master.end()
        node.wait_to_say("does not answer any more")
        master = self.master()
        node.wait_to_say("it knows the node's topics now")
        state = master.proxy.getSystemState("/test")[2]
        topics = [{topic for topic, nodes in kind if "/insonify" in nodes} for kind in state]
        self.assertLessEqual({"/insonify/image", "/insonify/fan", "/insonify/raw", "/insonify/points", "/tf",
                              "/insonify/scenario", "/insonify/parameter_updates"}, topics[0])
        self.assertLessEqual({"/odom", "/insonify/set"}, topics[1])
        self.assertLessEqual({"/insonify/set_parameters", "/insonify/get_loggers"}, topics[2])
        self.assertEqual(dict(master.proxy.getTopicTypes("/test")[2])["/insonify/image"],
                         "marine_acoustic_msgs/ProjectedSonarImage")
        self.odometry(y=2.5)
        self.assertEqual(self.images("after.bag", 3), 3)
        self.assertEqual(self.last_y(), 2.5)  # The pose of the new program.
        # A service of the new roscore's.
        kit.rospy.init_node("late", disable_signals=True)
        self.assertEqual(Client("/insonify", timeout=kit.PATIENCE).update_configuration({"range": 8.0})["range"], 8)

        status, seconds = node.end(signal.SIGTERM)
        self.assertEqual(status, 0)
        self.assertLess(seconds, kit.PROMPT)

    def test_a_second_node_of_its_name_takes_its_place(self):
        master = self.master()
        first = self.start()
        first.wait_to_say("node /insonify of ROS 1")
        second = self.start()
        second.wait_to_say("node /insonify of ROS 1")
        first.process.wait(timeout=kit.PATIENCE)
        self.assertIn("/insonify", first.said())
        self.assertEqual(self.images("second.bag", 3), 3)
        self.assertIsNone(second.process.poll(), second.said())
        self.assertNotIn("Shutdown", second.said())
        self.assertTrue(master.proxy.lookupNode("/test", "/insonify")[2])

    # Between two looks of the node's.
    def test_it_survives_a_restart_that_it_did_not_see(self):
        master = self.master()
        node = self.start("--odometry", "/odom")
        node.wait_to_say("node /insonify of ROS 1")
        node.process.send_signal(signal.SIGSTOP)
        master.end()
        master = self.master()
        self.odometry(y=-1.5)
        kit.wait_for(lambda: master.publishes("/pilot", "/odom"), message="nobody publishes odometry")
        node.process.send_signal(signal.SIGCONT)
        node.wait_to_say("it knows the node's topics now")
        self.assertEqual(self.last_y(), -1.5)
        self.assertNotIn("does not answer", node.said())

    # As `rosnode cleanup` does with a node that does not answer in time.
    def test_a_roscore_that_forgets_it_was_not_started_again(self):
        master = self.master()
        node = self.start("--odometry", "/odom")
        node.wait_to_say("node /insonify of ROS 1")
        uri = master.proxy.lookupNode("/test", "/insonify")[2]
        master.proxy.unsubscribeParam("/insonify", uri, "/rosout_disable_topics_generation")
        for kind, forget in zip(master.proxy.getSystemState("/test")[2],
                                (lambda topic: master.proxy.unregisterPublisher("/insonify", topic, uri),
                                 lambda topic: master.proxy.unregisterSubscriber("/insonify", topic, uri),
                                 lambda name: master.proxy.unregisterService(
                                     "/insonify", name, master.proxy.lookupService("/test", name)[2]))):
            for name, nodes in kind:
                if "/insonify" in nodes:
                    forget(name)
        node.wait_to_say("roscore had forgotten this node; it knows the node's topics now")
        self.assertNotIn("started again", node.said())
        self.odometry()
        self.assertEqual(self.images("known.bag", 3), 3)

    def last_y(self):
        """y of the third of the poses that come from now on [m]."""
        record = kit.Program("rosbag", "record", "-l", 3, "-O", "pose.bag", "/insonify/pose")
        self.addCleanup(record.end, signal.SIGKILL)
        kit.wait_for(lambda: record.process.poll() is not None, message="no poses")
        with kit.rosbag.Bag(str(kit.FOLDER / "pose.bag")) as bag:
            return [message.pose.position.y for _, message, _ in bag.read_messages()][-1]

    def odometry(self, y=1.0):
        program = kit.Program(kit.sys.executable, __file__, kit.INSONIFY, "--odometry", os.environ["ROS_MASTER_URI"], y)
        self.addCleanup(program.end, signal.SIGKILL)
        return program

    def test_it_ends_when_roscore_is_gone(self):
        master = self.master()
        node = self.start()
        node.wait_to_say("node /insonify of ROS 1")
        master.end()
        node.wait_to_say("does not answer any more")
        status, seconds = node.end(signal.SIGINT)
        self.assertEqual(status, 0)
        self.assertLess(seconds, kit.PROMPT)

    def test_it_ends_when_roscore_hangs(self):
        master = self.master()
        node = self.start()
        node.wait_to_say("node /insonify of ROS 1")
        master.program.process.send_signal(signal.SIGSTOP)
        time.sleep(1.2)  # The node asks twice a second.
        status, seconds = node.end(signal.SIGINT)
        self.assertEqual(status, 0)
        self.assertLess(seconds, kit.PROMPT)
        self.assertRegex(node.said(), r"pings in [\d.]+ s")


def publish_odometry(uri, y):
    """Poses at y, ten times a second, until the process is ended."""
    os.environ["ROS_MASTER_URI"] = uri
    kit.rospy.init_node("pilot", disable_signals=True)
    publisher = kit.rospy.Publisher("/odom", kit.nav_msgs.msg.Odometry, queue_size=1)
    while True:
        publisher.publish(kit.odometry(time.time(), 0, float(y)))
        time.sleep(0.1)


if __name__ == "__main__":
    if kit.sys.argv[1:2] == ["--odometry"]:
        publish_odometry(*kit.sys.argv[2:])
    kit.main()
