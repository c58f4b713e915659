#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""bag.launch over a simulated drive: labels as a user sees them in rviz, and one that is corrected by a click."""
import sys
from pathlib import Path

import rospy
from geometry_msgs.msg import PointStamped
from sensor_msgs import point_cloud2
from sensor_msgs.msg import Image, PointCloud2
from urban_nav_msgs.srv import CorrectLabel

sys.path.insert(0, str(Path(__file__).resolve().parent))
from graph import rviz_file, services  # noqa: E402
from launch_case import LaunchCase  # noqa: E402

SECONDS = 24
GROUND, WALLS = {1, 2, 3}, {4, 5}


class LabelsLaunch(LaunchCase):
    @classmethod
    def record(cls, folder):
        return cls.simulated(folder, SECONDS, "stereo", "ladybug", "lasers")[0]

    def has_said(self, key, value):
        """Whether the diagnostics of the stage have had this entry."""
        return any(item.key == key and item.value.startswith(value)
                   for array in list(self.listener.diagnostics) for status in array.status for item in status.values)

    def test_a_laser_in_other_units_is_named_with_its_repair(self):
        """By the file of `input` ranges are kilometres, which makes the laser one in millimetres."""
        conventions = Path(self.folder) / "input.yaml"
        conventions.write_text("laser_left_range_scale: 1000\n")
        self.addCleanup(rospy.delete_param, "/input")
        self.launch("bag.launch", bag=self.bag, input=conventions, rviz="false", loops="false", dense="false", graph="false")
        self.expect(lambda: any("laser_left/scan is not used" in text and "set input/laser_left_range_scale to 1 " in text for text in self.messages("laser_mapper")),
                    lambda: str(self.messages("laser_mapper")[-3:]))
        self.assertFalse(any("laser_right/scan is not used" in text for text in self.messages("laser_mapper")))

    def messages(self, name):
        """What a stage has reported in /diagnostics."""
        return [status.message for array in list(self.listener.diagnostics) for status in array.status if name in status.name]

    def test_labels_come_and_are_corrected_by_a_click(self):
        clouds, images = [], []
        subscribers = [rospy.Subscriber("/labels/cloud", PointCloud2, clouds.append, queue_size=1000),
                       rospy.Subscriber("/labels/image", Image, images.append, queue_size=100)]
        clicks = rospy.Publisher("/clicked_point", PointStamped, queue_size=1)
        self.launch("bag.launch", bag=self.bag, labels="true", rviz="false", loops="false", dense="false", graph="false", laser_map="false")
        self.expect(lambda: sum(cloud.width for cloud in list(clouds)) > 20000 and len(images) > 2, lambda: f"{len(clouds)} clouds, {len(images)} images")
        self.look_at(rviz_file("labels"))
        points = [point for cloud in list(clouds) for point in point_cloud2.read_points(cloud, ("x", "y", "z", "probability", "label", "unsure"))]
        sure = [point for point in points if point[5] == 0]
        self.assertGreater(len(sure), len(points) // 2)
        self.assertTrue(all(0.0 < point[3] <= 1.0 for point in points))
        self.assertEqual({cloud.header.frame_id for cloud in clouds}, {"odom"})
        self.assertEqual({image.encoding for image in images}, {"mono8"})
        ground = sorted(point[2] for point in sure if point[4] in GROUND)
        wall = sorted(point[2] for point in sure if point[4] in WALLS)
        self.assertGreater(wall[len(wall) // 2], ground[len(ground) // 2] + 0.5, "walls stand on the ground")

        self.expect(lambda: "/scene_labeler/correct" in services(), "the service")
        correct = rospy.ServiceProxy("/scene_labeler/correct", CorrectLabel)
        self.assertFalse(correct("gravel").success, "no class")
        click = PointStamped()
        click.header.frame_id = "odom"
        click.point.x, click.point.y, click.point.z = sure[-1][:3]
        self.expect(lambda: clicks.get_num_connections() > 0, "the stage hears clicks")
        clicks.publish(click)
        answers = []

        def is_corrected():
            answers.append(correct("dirt_path"))
            return answers[-1].success
        self.expect(is_corrected, lambda: answers[-1].message)  # clicks come on another connection than services
        self.expect(lambda: self.has_said("corrections", "1"), "the correction in the diagnostics")
        for subscriber in subscribers:
            subscriber.unregister()


if __name__ == "__main__":
    import rostest
    rostest.rosrun("urban_nav_launch", "labels_launch", LabelsLaunch)
