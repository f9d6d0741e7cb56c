#!/usr/bin/python3
"""The services ~ping: a ping for a pose, with its image as the answer, called by rospy.

ping_service_test.py INSONIFY
"""

import pathlib
import signal
import threading

import genmsg
import genmsg.msg_loader
import ros1_kit as kit
from geometry_msgs.msg import PoseStamped

ROOT = pathlib.Path(__file__).resolve().parents[3]
TWO = kit.SCENARIO + """  - {name: _up, beam_count: 12, bin_count: 60, azimuth_aperture_deg: 40, elevation_aperture_deg: 25, max_range: 9,
     ping_period: 0.125, sampling: {columns_per_beam: 2, rows: 40}}
"""


def ping_class():
    """The class that genpy would make of ros1/srv/Ping.srv: a message of one field has the bytes of that field."""
    image, definitions = kit.image_type(), {}
    for name, kind in (("marine_acoustic_msgs/ProjectedSonarImage", image), ("geometry_msgs/PoseStamped", PoseStamped)):
        lines = definitions[name] = []
        for line in kind._full_text.splitlines():
            if line.startswith("MSG: "):
                lines = definitions[line.removeprefix("MSG: ")] = []
            elif not line.startswith("====="):
                lines.append(line)
    for name, lines in definitions.items():
        file = kit.FOLDER / f"{name}.msg"
        file.parent.mkdir(exist_ok=True)
        file.write_text("\n".join(lines))
    context = genmsg.MsgContext.create_default()
    service = genmsg.msg_loader.load_srv_from_file(context, str(ROOT / "ros1/srv/Ping.srv"), "insonify_ros1/Ping")
    packages = {name.split("/")[0] for name in definitions}
    genmsg.msg_loader.load_depends(context, service, {package: [str(kit.FOLDER / package)] for package in packages})

    class Ping:
        _type, _md5sum = "insonify_ros1/Ping", genmsg.compute_md5(context, service)
        _request_class, _response_class = PoseStamped, image
    return Ping


def pose(time, x, frame="world"):
    stamped = PoseStamped()
    stamped.header.frame_id, stamped.header.stamp = frame, kit.rospy.Time.from_sec(time)
    stamped.pose.position.x, stamped.pose.orientation.w = x, 1
    return stamped


def nearest(image):
    """Range of the nearest strong value [m]."""
    beams, data = image.image.beam_count, image.image.data
    values = [low + 256 * high for low, high in zip(data[::2], data[1::2])]
    return next(image.ranges[i // beams] for i, value in enumerate(values) if value > 0.6 * max(values))


class PingServiceTest(kit.MasterTest):
    def service(self, name):
        kit.rospy.wait_for_service(name, timeout=kit.PATIENCE)
        return kit.rospy.ServiceProxy(name, ping_class())

    # The nearest target is at (4, -1.5, 0.2), 4.28 m from the origin; from x = 2, 2.51 m. Bins are 0.13 m long.
    def test_a_pose_is_answered_by_the_image_of_its_ping(self):
        self.start("--ping-at", "/ask1", "__name:=one")
        ping = self.service("/one/ping")
        for time, x, distance in ((70.5, 0, 4.28), (12.25, 2, 2.51), (70.5, 0, 4.28)):  # Time may go back.
            image = ping(pose(time, x))
            self.assertEqual(image.header.stamp.to_sec(), time)
            self.assertEqual(image.image.beam_count, 24)
            self.assertAlmostEqual(nearest(image), distance, delta=0.2)
        self.assertGreater(ping(pose(0, 1)).header.stamp.to_sec(), 1e9)  # Without a stamp: now.

    # Calls at once, with poses by the topic between: each has the image of its own.
    def test_many_clients_have_each_their_own(self):
        self.start("--ping-at", "/ask2", "__name:=many")
        ping = self.service("/many/ping")
        ask = kit.connected(kit.rospy.Publisher("/ask2", PoseStamped, queue_size=100))
        stamps = {}

        def call(number):
            for i in range(5):
                stamp = 100 * number + i + 1
                stamps[stamp] = ping(pose(stamp, 0)).header.stamp.to_sec()
        clients = [threading.Thread(target=call, args=(number,)) for number in range(1, 5)]
        for client in clients:
            client.start()
            ask.publish(pose(7, 1))
        for client in clients:
            client.join()
        self.assertEqual(len(stamps), 20)
        self.assertEqual(list(stamps), list(stamps.values()))

    # The second sonar pings half as often.
    def test_each_sonar_has_a_service(self):
        kit.write("two.yaml", TWO)
        self.start("--ping-at", "/ask3", "__name:=two", scenario="two.yaml")
        first, second = self.service("/two/fls/ping"), self.service("/two/_up/ping")
        self.assertEqual(second(pose(1, 0)).image.beam_count, 12)
        self.assertEqual(first(pose(2, 0)).image.beam_count, 24)
        self.assertEqual(second(pose(3, 0)).header.stamp.to_sec(), 3)
        with self.assertRaisesRegex(kit.rospy.ServiceException, "the sonar does not ping yet: its ping_period is longer"):
            second(pose(4, 0))

    def test_what_is_wrong_is_refused_and_the_next_is_answered(self):
        self.start("--ping-at", "/ask4", "__name:=strict")
        ping = self.service("/strict/ping")
        wrong = pose(1, 0)
        wrong.pose.orientation.w = 0.5
        for request, reason in ((pose(1, 0, "map"), r"the pose is in the frame map; it must be in world \(--world-frame\)"),
                                (wrong, "world_from_vehicle"), (pose(1, 1e9), "position")):
            with self.assertRaisesRegex(kit.rospy.ServiceException, reason):
                ping(request)
            self.assertEqual(ping(pose(5, 0)).header.stamp.to_sec(), 5)

    def test_without_ping_at_there_is_none(self):
        node = self.start("__name:=free")
        node.wait_to_say("node /free of ROS 1")
        self.assertNotEqual(self.master.proxy.lookupService("/test", "/free/ping")[0], 1)

    # Held until the sound of 12 m could be back; 7500 m, 10 s.
    def test_a_node_that_ends_answers(self):
        node = kit.Program(kit.INSONIFY, "bridge", "ros1", "dive.yaml", "--set", "max_range=7500", "--set", "ping_period=11",
                           "--ping-at", "/ask5", "__name:=ends")
        self.addCleanup(node.end, signal.SIGKILL)
        ping, said = self.service("/ends/ping"), []

        def call():
            try:
                ping(pose(1, 0))
            except kit.rospy.ServiceException as error:
                said.append(str(error))
        client = threading.Thread(target=call)
        client.start()
        self.assertEqual(node.end(signal.SIGINT)[0], 0)
        client.join(kit.PATIENCE)
        self.assertEqual(len(said), 1)


if __name__ == "__main__":
    kit.main()
