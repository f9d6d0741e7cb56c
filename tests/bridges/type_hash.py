"""The hash by which ROS 2 since Iron tells definitions of messages apart: RIHS01 of REP-2016."""

import hashlib
import json
import re

NUMBERS = {"int8": 2, "uint8": 3, "int16": 4, "uint16": 5, "int32": 6, "uint32": 7, "int64": 8, "uint64": 9, "float32": 10,
           "float64": 11, "bool": 15, "byte": 16, "string": 17}
NESTED, ARRAY, SEQUENCE = 1, 48, 144
FIELD = re.compile(r"(?P<type>[\w/]+)(?P<array>\[(?P<length>\d*)\])?\s+(?P<name>\w+)$")


def described(name, text):
    """The description of one type, with its fields in order; constants are no part of it."""
    fields = []
    for line in text.splitlines():
        match = FIELD.match(line.strip())
        if not match:
            assert not line.strip() or "=" in line, line
            continue
        number = NUMBERS.get(match["type"], NESTED)
        package, _, last = match["type"].rpartition("/")
        nested = f"{package.split('/')[0]}/msg/{last}" if number == NESTED else ""
        length = int(match["length"] or 0)
        kind = number + (0 if not match["array"] else ARRAY if length else SEQUENCE)
        fields.append({"name": match["name"], "type": {"type_id": kind, "capacity": length, "string_capacity": 0,
                                                       "nested_type_name": nested}})
    return {"type_name": name, "fields": fields}


def type_hash(name, definition):
    """The hash of a type, as "std_msgs/msg/String", by its definition in the form of "ros2msg" schemas: the types that it
    is made of follow, each after a line of `=` and one with its name."""
    texts = re.split(r"(?m)^=+\nMSG: ", definition)
    descriptions = [described(name, texts[0])]
    for text in texts[1:]:
        package, _, last = text.splitlines()[0].rpartition("/")
        descriptions.append(described(f"{package.split('/')[0]}/msg/{last}", text.split("\n", 1)[1]))
    whole = {"type_description": descriptions[0],
             "referenced_type_descriptions": sorted(descriptions[1:], key=lambda each: each["type_name"])}
    return "RIHS01_" + hashlib.sha256(json.dumps(whole).encode()).hexdigest()
