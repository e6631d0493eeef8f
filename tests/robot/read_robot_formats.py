#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads what `cairn robot` writes, strictly, and prints it as JSON: {"spheres": {link: [[x, y, z, r], ...]}, "ignored": [[a, b], ...]}.

  read_robot_formats.py srdf|curobo|xrdf|mjcf FILE

Shares no code with the writers. Anything that the stated schema does not have ends with exit code 1 and a sentence:
elements and attributes (srdfdom's model.cpp; MuJoCo's XML reference), keys (cuRobo's template.yml; the XRDF page of NVIDIA
Isaac), keys given twice, numbers that are no finite floats.
"""

import json
import math
import sys
import xml.etree.ElementTree as ElementTree


def fail(sentence):
    sys.exit(f"read_robot_formats.py: {sentence}")


def numbers(text, count):
    found = [float(word) for word in text.split()]
    if len(found) != count or not all(map(math.isfinite, found)):
        fail(f"'{text}' is not {count} finite numbers")
    return found


# For each element its attributes, required ones first, and its children.
SRDF = {
    "robot": (["name"], [], ["link_sphere_approximation", "disable_collisions"]),
    "link_sphere_approximation": (["link"], [], ["sphere"]),
    "sphere": (["center", "radius"], [], []),
    "disable_collisions": (["link1", "link2", "reason"], [], []),
}
MJCF = {
    "mujoco": (["model"], [], ["compiler", "worldbody", "contact", "equality"]),
    "compiler": (["angle"], [], []),
    "worldbody": ([], [], ["body", "geom"]),
    "body": (["name"], ["pos", "quat"], ["joint", "freejoint", "inertial", "geom", "body"]),
    "joint": (["type", "axis", "name", "limited"], ["range", "damping", "frictionloss"], []),
    "equality/joint": (["joint1", "joint2", "polycoef"], [], []),
    "freejoint": (["name"], [], []),
    "inertial": (["pos", "mass", "fullinertia"], [], []),
    "geom": (["type", "size", "pos"], ["quat"], []),
    "contact": ([], [], ["exclude"]),
    "equality": ([], [], ["joint"]),
    "exclude": (["body1", "body2"], [], []),
}


def check(element, schema, parent=""):
    own = f"{parent}/{element.tag}"
    rule = schema.get(own, schema.get(element.tag))
    if rule is None:
        fail(f"<{element.tag}> is not of the schema")
    required, optional, children = rule
    for name in required:
        if name not in element.attrib:
            fail(f"<{element.tag}> lacks {name}")
    for name in element.attrib:
        if name not in required + optional:
            fail(f"<{element.tag}> may not have {name}")
    if (element.text or "").strip() or (element.tail or "").strip():
        fail(f"<{element.tag}> has text")
    for child in element:
        if child.tag not in children:
            fail(f"<{child.tag}> may not be in <{element.tag}>")
        check(child, schema, element.tag)


def read_srdf(path):
    root = ElementTree.parse(path).getroot()
    check(root, SRDF)
    spheres = {link.get("link"): [numbers(s.get("center"), 3) + numbers(s.get("radius"), 1) for s in link]
               for link in root.iter("link_sphere_approximation")}
    reasons = {pair.get("reason") for pair in root.iter("disable_collisions")}
    if not reasons <= {"Adjacent", "Always"}:
        fail(f"reasons {reasons}")
    return spheres, [[pair.get("link1"), pair.get("link2")] for pair in root.iter("disable_collisions")]


def read_mjcf(path):
    root = ElementTree.parse(path).getroot()
    check(root, MJCF)
    if root.find("compiler").get("angle") != "radian":
        fail("angles are not radians")
    spheres = {}
    for body in root.iter("body"):
        balls = [numbers(g.get("pos"), 3) + numbers(g.get("size"), 1)
                 for g in body.findall("geom") if g.get("type") == "sphere"]
        if balls:
            spheres[body.get("name")] = balls
    return spheres, [[pair.get("body1"), pair.get("body2")] for pair in root.iter("exclude")]


def load_yaml(path):
    import yaml

    class Strict(yaml.SafeLoader):
        pass

    def mapping(loader, node):
        keys = [loader.construct_object(key) for key, _ in node.value]
        if len(keys) != len(set(keys)):
            fail(f"a key is given twice: {keys}")
        return {loader.construct_object(k): loader.construct_object(v, deep=True) for k, v in node.value}

    Strict.add_constructor(yaml.resolver.BaseResolver.DEFAULT_MAPPING_TAG, mapping)
    with open(path, encoding="utf-8") as stream:
        return yaml.load(stream, Loader=Strict)


def keys_are(value, keys, where):
    if not isinstance(value, dict) or set(value) != set(keys):
        fail(f"{where} has the keys {sorted(value)}, not {sorted(keys)}")


def floats(values, where):
    if not isinstance(values, list) or not all(isinstance(v, float) and math.isfinite(v) for v in values):
        fail(f"{where} is not a list of floats: {values}")
    return values


def names(values, where):
    if not isinstance(values, list) or not all(isinstance(v, str) for v in values):
        fail(f"{where} is not a list of names: {values}")
    return values


def spheres_of(value, where):
    spheres = {}
    for link, balls in value.items():
        spheres[link] = []
        for ball in balls:
            keys_are(ball, ["center", "radius"], where)
            spheres[link].append(floats(ball["center"], where) + floats([ball["radius"]], where))
            if len(spheres[link][-1]) != 4:
                fail(f"a center of {where} has not three coordinates")
    return spheres


def ignored_of(value, where):
    return [[a, b] for a, others in value.items() for b in names(others, where)]


def read_curobo(path):
    document = load_yaml(path)
    keys_are(document, ["robot_cfg"], "the document")
    keys_are(document["robot_cfg"], ["kinematics"], "robot_cfg")
    robot = document["robot_cfg"]["kinematics"]
    keys_are(robot, ["urdf_path", "asset_root_path", "base_link", "ee_link", "link_names", "lock_joints", "extra_links",
                     "collision_link_names", "collision_spheres", "collision_sphere_buffer", "extra_collision_spheres",
                     "self_collision_ignore", "self_collision_buffer", "use_global_cumul", "mesh_link_names", "cspace"],
             "kinematics")
    cspace = robot["cspace"]
    keys_are(cspace, ["joint_names", "retract_config", "null_space_weight", "cspace_distance_weight", "max_jerk",
                      "max_acceleration"], "cspace")
    for key in ("retract_config", "null_space_weight", "cspace_distance_weight"):
        if len(floats(cspace[key], key)) != len(names(cspace["joint_names"], "joint_names")):
            fail(f"{key} has not a value for each joint")
    spheres = spheres_of(robot["collision_spheres"], "collision_spheres")
    if robot["collision_link_names"] != list(spheres) or set(robot["self_collision_buffer"]) != set(spheres):
        fail("names of links with spheres differ")
    return spheres, ignored_of(robot["self_collision_ignore"], "self_collision_ignore")


def read_xrdf(path):
    document = load_yaml(path)
    keys_are(document, ["format", "format_version", "default_joint_positions", "cspace", "tool_frames", "collision",
                        "self_collision", "geometry"], "the document")
    if document["format"] != "xrdf" or document["format_version"] != 1.0:
        fail("it is no XRDF 1.0")
    cspace = document["cspace"]
    keys_are(cspace, ["joint_names", "acceleration_limits", "jerk_limits"], "cspace")
    for key in ("acceleration_limits", "jerk_limits"):
        if len(floats(cspace[key], key)) != len(names(cspace["joint_names"], "joint_names")):
            fail(f"{key} has not a value for each joint")
    if set(document["default_joint_positions"]) != set(cspace["joint_names"]):
        fail("default_joint_positions are not those of the joints")
    floats(list(document["default_joint_positions"].values()), "default_joint_positions")
    if not names(document["tool_frames"], "tool_frames"):
        fail("there is no tool frame")
    keys_are(document["collision"], ["geometry", "buffer_distance"], "collision")
    keys_are(document["self_collision"], ["geometry", "buffer_distance", "ignore"], "self_collision")
    name = document["collision"]["geometry"]
    if document["self_collision"]["geometry"] != name:
        fail("cuRobo wants one geometry")
    keys_are(document["geometry"], [name], "geometry")
    keys_are(document["geometry"][name], ["spheres"], name)
    spheres = spheres_of(document["geometry"][name]["spheres"], "spheres")
    for section in ("collision", "self_collision"):
        buffers = document[section]["buffer_distance"]
        floats(list(buffers.values()), "buffer_distance")
        if set(buffers) != set(spheres):
            fail("buffer_distance is not given for each link with spheres")
    return spheres, ignored_of(document["self_collision"]["ignore"], "ignore")


READERS = {"srdf": read_srdf, "mjcf": read_mjcf, "curobo": read_curobo, "xrdf": read_xrdf}


def main():
    if len(sys.argv) != 3 or sys.argv[1] not in READERS:
        fail("usage: read_robot_formats.py srdf|curobo|xrdf|mjcf FILE")
    spheres, ignored = READERS[sys.argv[1]](sys.argv[2])
    json.dump({"spheres": spheres, "ignored": ignored}, sys.stdout)


if __name__ == "__main__":
    main()
