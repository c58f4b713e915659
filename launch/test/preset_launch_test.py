#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""preset:=NAME of the launch files, which are read without starting a node: topics of each driver, and what overrides them."""
import re
import subprocess
import sys
import unittest
from pathlib import Path

import rospkg
from roslaunch.config import ROSLaunchConfig
from roslaunch.xmlloader import XmlLoader

sys.path.insert(0, str(Path(__file__).resolve().parent))
from graph import command  # noqa: E402

LAUNCH = Path(rospkg.RosPack().get_path("urban_nav_launch")) / "launch"
ROLES = {"left_image": "left", "right_image": "right", "left_info": "left_info", "right_info": "right_info", "imu": "imu", "gps": "gps",
         "points": "points", "laser_left": "laser_left", "depth0": "depth0"}


def load(file, **arguments):
    """Returns the nodes of a launch file with their remappings by name, and its parameters."""
    config = ROSLaunchConfig()
    XmlLoader(resolve_anon=False).load(str(LAUNCH / file), config, argv=[f"{name}:={value}" for name, value in arguments.items()], verbose=False)
    nodes = {node.name: {source.lstrip("/"): target for source, target in node.remap_args} for node in config.nodes}
    return nodes, {name: param.value for name, param in config.params.items()}


def presets_of_command():
    """Returns the ends of the topic names by preset and role, as `urban_nav doctor --help-all` lists them."""
    text = subprocess.run([str(command()), "doctor", "--help-all"], check=True, capture_output=True, text=True).stdout
    presets, name = {}, None
    for line in text[text.index("Presets (--preset):"):].splitlines()[1:]:
        if found := re.match(r"  (\w+): ", line):
            name = found[1]
            presets[name] = {}
        elif found := re.match(r"    (\w+): \.\.\./(.*?)(?: \(optional\))?$", line):
            presets[name][found[1]] = found[2].split(" .../")
        elif not line.startswith("    "):
            break
    return presets


class PresetLaunch(unittest.TestCase):
    def test_topics_are_those_of_the_command(self):
        presets = presets_of_command()
        self.assertEqual(sorted(presets), sorted(path.name.split(".")[0] for path in (LAUNCH / "presets").glob("*.launch.xml")))
        for name, roles in presets.items():
            text = (LAUNCH / "presets" / f"{name}.launch.xml").read_text()
            given = dict(re.findall(r'<arg name="preset_(\w+)" value="(/[^"]+)"/>', text))
            self.assertTrue(given, name)
            for argument, topic in given.items():
                if argument == "depth0_info" or (name, argument) in (("zed", "left_info"), ("zed", "right_info")):
                    continue  # the command finds camera_info in the folder of the images
                ends = [end.rstrip("*") for end in roles[ROLES[argument]]]
                self.assertTrue(any(topic.endswith("/" + end) for end in ends), f"{name}: {topic} is not one of {ends}")

    def test_an_odometry_that_does_not_exist_live_is_named_with_those_that_do(self):
        for file, arguments in (("robot.launch", {}), ("bag.launch", {"bag": "/none.bag"}), ("localization.launch", {"store": "/none.db"})):
            for odometry in ("stereo", "laser"):
                load(file, odometry=odometry, **arguments)
            with self.assertRaisesRegex(Exception, "odometry: expected stereo or laser, found both"):
                load(file, odometry="both", **arguments)

    def test_a_stereo_camera_is_read_by_the_odometry(self):
        nodes, _ = load("swf_vo.launch", preset="realsense")
        self.assertEqual(nodes["swf_vo"]["stereo/left/image_raw"], "/camera/infra1/image_rect_raw")
        self.assertEqual(nodes["swf_vo"]["stereo/right/camera_info"], "/camera/infra2/camera_info")
        self.assertEqual(nodes["swf_vo"]["imu/data"], "/camera/imu")

    def test_a_given_topic_overrides_the_preset(self):
        nodes, _ = load("swf_vo.launch", preset="realsense", left_image="/front/left", imu="/mti/imu")
        self.assertEqual(nodes["swf_vo"]["stereo/left/image_raw"], "/front/left")
        self.assertEqual(nodes["swf_vo"]["imu/data"], "/mti/imu")
        self.assertEqual(nodes["swf_vo"]["stereo/right/image_raw"], "/camera/infra2/image_rect_raw")

    def test_a_lidar_is_read_by_its_odometry(self):
        nodes, parameters = load("laser_odometry.launch", preset="livox")
        self.assertEqual(nodes["laser_odometry"]["points"], "/livox/lidar")
        self.assertAlmostEqual(parameters["/input/accelerometer_scale"], 9.80665)
        nodes, _ = load("laser_odometry.launch", preset="livox", points="/front/points")
        self.assertEqual(nodes["laser_odometry"]["points"], "/front/points")

    def test_stages_of_the_robot_read_the_images_that_are_rectified_once(self):
        nodes, _ = load("robot.launch", preset="zed")
        self.assertEqual(nodes["stereo_rectify"]["stereo/left/image_raw"], "/zed/zed_node/left/image_rect_gray")
        self.assertEqual(nodes["swf_vo"]["stereo/left/image_raw"], "stereo/left/image_rect")
        self.assertEqual(nodes["swf_vo"]["stereo/left/camera_info"], "/zed/zed_node/left/camera_info")
        nodes, _ = load("robot.launch", preset="ublox")
        self.assertEqual(nodes["pose_graph"]["gps/fix"], "/ublox/fix")
        self.assertEqual(nodes["swf_vo"]["stereo/left/camera_info"], "stereo/left/camera_info")

    def test_units_of_the_user_override_those_of_the_preset(self):
        file = Path(self.id().split(".")[-1] + ".yaml").resolve()
        file.write_text("accelerometer_scale: 1.0\n")
        self.addCleanup(file.unlink)
        _, parameters = load("bag.launch", preset="livox", bag="/none.bag", input=file)
        self.assertEqual(parameters["/input/accelerometer_scale"], 1.0)


if __name__ == "__main__":
    import rostest
    rostest.rosrun("urban_nav_launch", "preset_launch", PresetLaunch)
