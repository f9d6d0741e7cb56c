#!/usr/bin/env python3
"""Makes a ping of a wall, prints the place of the loudest echo, and saves the picture.

    python3 first_ping.py            # writes first_ping.png
"""

import numpy as np

import insonify

# A wall of concrete, 8 m wide and 6 m high, 7 m ahead of the origin and turned by 20 degrees.
scene = insonify.Scene()
scene.add("wall", vertices=[[0, -4, -3], [0, 4, -3], [0, 4, 3], [0, -4, 3]], faces=[[0, 1, 2], [0, 2, 3]],
          material="concrete", pose=insonify.Pose.rpy((7, 0, 0), (0, 0, 20)))

# A sonar that is sold, over 12 m of range.
sonar = insonify.SonarConfig(preset="tritech-gemini-720i", max_range=12)
sim = insonify.Simulator(sonar, scene)
ping = sim.ping()

level = insonify.to_db(ping.intensity)  # [bins, beams], dB re the source at 1 m
bin_, beam = np.unravel_index(np.argmax(level), level.shape)
print(f"{level.shape[0]} bins x {level.shape[1]} beams, {np.mean(ping.instance == 0):.0%} of them show the wall")
print(f"Loudest: {level[bin_, beam]:.1f} dB at {ping.ranges[bin_]:.2f} m, "
      f"{np.degrees(ping.azimuths[beam]):.1f} degrees to port")
insonify.write_png("first_ping.png", insonify.fan(ping))
