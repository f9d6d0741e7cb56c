"""A client of Ping360 sonars, written from the published ping protocol alone."""

import struct

DATA, AUTO_DATA, ACK, NACK = 2300, 2301, 1, 2


def frame(number, payload=b"", destination=0):
    data = b"BR" + struct.pack("<HHBB", len(payload), number, 0, destination) + payload
    return data + struct.pack("<H", sum(data) & 0xffff)


def transducer(angle, gain=1, duration=40, period=400, frequency=750, count=1000, transmit=1):
    return frame(2601, struct.pack("<BBHHHHHBB", 1, gain, angle, duration, period, frequency, count, transmit, 0))


def auto_transmit(start, stop, step, gain=1, duration=40, period=250, frequency=750, count=200, delay=0):
    return frame(2602, struct.pack("<BBHHHHHHBB", 1, gain, duration, period, frequency, count, start, stop, step, delay))


def introduced(data):
    """Name and address of a sonar that answered a search, read as BlueOS does: zeros before a number are dropped."""
    lines = data.decode("ascii").split("\r\n")
    assert len(lines) == 5 and lines[1] == "Blue Robotics" and lines[2].startswith("MAC Address:- ") and not lines[4], lines
    title, address = lines[3].split(":- ")
    assert title == "IP Address", lines
    return lines[0], ".".join(str(int(part)) for part in address.split("."))


def parsed(data):
    """Id and payload of a frame, whose checksum must hold."""
    assert data[:2] == b"BR", data
    length, number = struct.unpack_from("<HH", data, 2)
    assert len(data) == length + 10, (len(data), length)
    assert struct.unpack_from("<H", data, len(data) - 2)[0] == sum(data[:-2]) & 0xffff
    return number, data[8:-2]


def samples_of(payload, header="<BBHHHHHH"):
    """Fields and samples of device_data."""
    fields = struct.unpack_from(header, payload)
    samples = payload[struct.calcsize(header):]
    assert fields[-1] == len(samples)
    return fields[:-1], samples


def loudest(samples):
    return max(range(len(samples)), key=lambda i: samples[i])
