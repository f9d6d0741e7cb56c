"""`insonify emulate oculus` with two targets, for tests."""

import os
import unittest

from emulated import Emulated
from oculus_client import BEAMS512, METRES, SIMPLE, Client

USUAL = METRES | SIMPLE | BEAMS512

# A target 4.1 m ahead, and one to starboard: at 3 m forward and 4 m to the right, 5 m away at 53.13 degrees.
SCENARIO = """
water: {sound_speed: 1500, temperature_c: 12, salinity: 20}
points:
  - {position: [4.1, 0, 0], target_strength_db: -20}
  - {position: [3, -4, 0], target_strength_db: -16}
sonars:
  - {name: head, type: msis, beam_count: 1, bin_count: 100, azimuth_aperture_deg: 2, max_range: 20}
  - {name: fls, beam_count: 60, azimuth_aperture_deg: 120, bin_count: 400, min_range: 0.5, max_range: 12,
     sampling: {columns_per_beam: 1, rows: 20}}
  - {name: fine, beam_count: 40, azimuth_aperture_deg: 60, frequency: 1.9e6, bin_count: 300, max_range: 6,
     sampling: {columns_per_beam: 1, rows: 20}}
"""
NOISE = ("--set", "receiver.ambient_noise_db=106")  # Fills pixels with values between dark and bright.
addresses = iter(range(1, 200))


class Sonar(Emulated):
    """insonify emulate oculus in a folder of its own, on a loopback address of its own."""

    def __init__(self, *options, scenario=SCENARIO, **files):
        self.address = f"127.{os.getpid() // 250 % 250 + 1}.{os.getpid() % 250 + 1}.{next(addresses)}"
        super().__init__("oculus", "dive.yaml", "--address", self.address, *options,
                         files={"dive.yaml": scenario, **files})
        line = self.process.stdout.readline()
        while line and not line.startswith("Oculus"):
            line = self.process.stdout.readline()
        if not line:
            raise AssertionError(self.process.communicate()[1])
        assert line == f"Oculus fls on TCP {self.address}:52100, status to UDP {self.address}:52102\n", line
        self.clients = []

    def client(self):
        self.clients.append(Client(self.address))
        return self.clients[-1]

    def close(self):
        for client in self.clients:
            client.close()
        super().close()


class OculusCase(unittest.TestCase):
    def sonar(self, *options, **more):
        sonar = Sonar(*options, **more)
        self.addCleanup(sonar.close)
        return sonar
