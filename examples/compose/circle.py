"""circle.py -- odometry of a vehicle that circles the ferry at half a metre per second and looks at it: for ROS 2, with rclpy."""

import math

import rclpy
from nav_msgs.msg import Odometry
from rclpy.node import Node

CENTRE, RADIUS, HEIGHT, SPEED = (26.0, 1.0), 25.0, 7.6, 0.5  # Of the circle in the scene [m, m/s].


class Circle(Node):
    def __init__(self):
        super().__init__("vehicle")
        self.publisher = self.create_publisher(Odometry, "/bluerov/odom", 10)
        self.start = self.get_clock().now()
        self.create_timer(0.05, self.publish)

    def publish(self):
        now = self.get_clock().now()
        angle = math.pi + (now - self.start).nanoseconds * 1e-9 * SPEED / RADIUS
        yaw = angle + math.pi  # Towards the centre.
        message = Odometry()
        message.header.stamp = now.to_msg()
        message.header.frame_id = "odom"
        message.child_frame_id = "base_link"
        position = message.pose.pose.position
        position.x = CENTRE[0] + RADIUS * math.cos(angle)
        position.y = CENTRE[1] + RADIUS * math.sin(angle)
        position.z = HEIGHT
        message.pose.pose.orientation.z = math.sin(yaw / 2)
        message.pose.pose.orientation.w = math.cos(yaw / 2)
        message.twist.twist.linear.y = -SPEED  # In the vehicle's frame: it goes sideways.
        message.twist.twist.angular.z = SPEED / RADIUS
        self.publisher.publish(message)


if __name__ == "__main__":
    rclpy.init()
    rclpy.spin(Circle())
