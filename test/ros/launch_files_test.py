#!/usr/bin/env python3
"""What the launch files make of their arguments: parameters, topics and command lines, without running any."""
import os
import pathlib
import shlex
import tempfile
import unittest

import roslaunch.config
import roslaunch.xmlloader

LAUNCH = pathlib.Path(__file__).resolve().parent.parent.parent / "launch"


def load(name, **arguments):
    config = roslaunch.config.ROSLaunchConfig()
    roslaunch.xmlloader.XmlLoader().load(
        str(LAUNCH / (name + ".launch")), config, verbose=False,
        argv=["{}:={}".format(key, value) for key, value in arguments.items()])
    return config


def parameters(config, node):
    """Returns {name: value} of a node's private parameters."""
    prefix = node + "/"
    return {key[len(prefix):]: each.value for key, each in config.params.items()
            if key.startswith(prefix)}


def arguments_of(config, name):
    """Returns the command line of a node as roslaunch takes it apart."""
    node, = [node for node in config.nodes if node.name == name]
    return shlex.split(node.args)


class Parameters(unittest.TestCase):
    def setUp(self):
        handle, self.file = tempfile.mkstemp(suffix=".yaml")
        with os.fdopen(handle, "w") as file:
            file.write("depth_registration: true\nraw_disparity: false\nz_scale: 1.02\n"
                       "depth_calibration: /mine.yaml\ndepth_camera_info_url: file:///mine.yaml\n")

    def tearDown(self):
        os.remove(self.file)

    def test_a_file_holds_where_no_argument_is_given(self):
        driver = parameters(load("camera", params=self.file), "/camera/driver")
        self.assertIs(driver["depth_registration"], True)
        self.assertIs(driver["raw_disparity"], False)
        self.assertEqual(driver["z_scale"], 1.02)
        self.assertEqual(driver["depth_calibration"], "/mine.yaml")
        self.assertEqual(driver["depth_camera_info_url"], "file:///mine.yaml")
        self.assertEqual(driver["device_id"], "#1")

    def test_an_argument_overrides_the_file(self):
        driver = parameters(load("camera", params=self.file, depth_registration="false",
                                 raw_disparity="true", depth_calibration="/other.yaml",
                                 depth_camera_info_url="file:///other.yaml"), "/camera/driver")
        self.assertIs(driver["depth_registration"], False)
        self.assertIs(driver["raw_disparity"], True)
        self.assertEqual(driver["depth_calibration"], "/other.yaml")
        self.assertEqual(driver["depth_camera_info_url"], "file:///other.yaml")

    def test_robots_and_hands_take_a_file_for_the_driver_too(self):
        for name in ("pioneer", "handheld"):
            config = load(name, driver_params=self.file)
            driver = parameters(config, "/camera/driver")
            self.assertEqual(driver["z_scale"], 1.02, name)
            # Topics depend on these two, so that they are the arguments' own.
            self.assertIs(driver["depth_registration"], False, name)
            detection, = [node for node in config.nodes if node.name == "plane_detection"]
            self.assertEqual(dict(detection.remap_args)["depth/image_raw"],
                             "/camera/depth/image_raw", name)


    def test_a_sensor_and_a_correction_are_the_nodelets_own(self):
        nodes = {"detection": "/plane_detection", "replay": "/plane_detection",
                 "pioneer": "/camera/plane_detection", "handheld": "/camera/plane_detection"}
        for name, node in nodes.items():
            arguments = {"bag": "/some.bag"} if name == "replay" else {}
            plain = parameters(load(name, **arguments), node)
            profile = parameters(load(name, sensor="xtion", **arguments), node)
            self.assertEqual({key: profile[key] for key in profile if profile[key] != plain.get(key)},
                             {"sensor": "xtion"}, name)
        for name, node in (("detection", "/plane_detection"), ("replay", "/plane_detection"),
                           ("pioneer", "/camera/driver"), ("handheld", "/camera/driver")):
            arguments = {"bag": "/some.bag"} if name == "replay" else {}
            corrected = parameters(load(name, correction="/c.yaml", **arguments), node)
            self.assertEqual(corrected["correction"], "/c.yaml", name)
            self.assertNotIn("correction", parameters(load(name, **arguments), node), name)


    def test_what_a_robot_knows_reaches_the_detection(self):
        nodes = {"detection": "/plane_detection", "replay": "/plane_detection",
                 "pioneer": "/camera/plane_detection", "handheld": "/camera/plane_detection"}
        for name, node in nodes.items():
            arguments = {"bag": "/some.bag"} if name == "replay" else {}
            plain = parameters(load(name, **arguments), node)
            # What is not asked for stays as the parameters' file has it.
            self.assertEqual(plain.get("base_frame"), "base_link" if name == "pioneer" else None,
                             name)
            for key in ("publish_tf", "use_imu"):
                self.assertNotIn(key, plain, name)
            told = load(name, base_frame="my_base", imu="/my_imu", **arguments)
            self.assertEqual(parameters(told, node)["base_frame"], "my_base", name)
            detection, = [n for n in told.nodes if n.name == "plane_detection"]
            self.assertEqual(dict(detection.remap_args)["imu/data_raw"], "/my_imu", name)
        for name in nodes:
            arguments = {"bag": "/some.bag"} if name == "replay" else {"rectified": "true"}
            told = load(name, ground_frame="my_ground", publish_tf="ground", use_imu="false",
                        **arguments)
            told = parameters(told, nodes[name])
            self.assertEqual(told["ground_frame"], "my_ground", name)
            self.assertEqual(told["publish_tf"], "ground", name)
            self.assertIs(told["use_imu"], False, name)
            self.assertIs(told["rectified"], name != "replay", name)

    def test_calibrations_reach_the_driver(self):
        for name in ("pioneer", "handheld"):
            urls = {f"{kind}_camera_info_url": f"file:///{kind}.yaml"
                    for kind in ("depth", "rgb", "ir")}
            driver = parameters(load(name, **urls), "/camera/driver")
            self.assertEqual({key: driver[key] for key in urls}, urls, name)


class Managers(unittest.TestCase):
    def managers(self, device_id):
        """Returns the manager of the driver, that of the detection, and all that are started."""
        config = load("handheld", device_id=device_id)
        loads = {node.name: node.args.split()[-1] for node in config.nodes
                 if node.args.startswith("load ")}
        started = {node.name for node in config.nodes if node.args == "manager"}
        return loads["driver"], loads["plane_detection"], started

    def test_a_camera_shares_its_manager_with_the_detection(self):
        for device_id in ("#1", "virtual://rubbish_bin", "1206120026", "1.5", "true"):
            driver, detection, started = self.managers(device_id)
            self.assertEqual(driver, detection)
            self.assertEqual(started, {driver})

    def test_a_recording_is_played_in_a_manager_of_its_own(self):
        driver, detection, started = self.managers("/recordings/old.oni")
        self.assertNotEqual(driver, detection)
        self.assertEqual(started, {driver, detection})


class Processing(unittest.TestCase):
    def test_nodelets_of_the_cameras_manager_where_they_are_asked_for(self):
        for name in ("camera", "pioneer", "handheld"):
            plain = {node.name for node in load(name).nodes}
            nodes = [node for node in load(name, processing="true").nodes if node.name not in plain]
            self.assertEqual({node.args.split()[1].split("/")[0] for node in nodes},
                             {"image_proc", "depth_image_proc"}, name)
            self.assertEqual(len(nodes), 7, name)
            for node in nodes:
                self.assertEqual(node.namespace, "/camera/", name)
                self.assertEqual(node.args.split()[-1], "camera_nodelet_manager", name)

    def test_depth_is_not_interpolated(self):
        config = load("camera", processing="true")
        for node in ("rectify_depth", "rectify_registered_depth"):
            self.assertEqual(parameters(config, "/camera/" + node), {"interpolation": 0})
        self.assertEqual(parameters(config, "/camera/rectify_color"), {})

    def test_a_recordings_manager_has_them_too(self):
        nodes = load("handheld", processing="true", device_id="/some.oni").nodes
        points, = [node for node in nodes if node.name == "depth_points"]
        self.assertEqual(points.args.split()[-1], "camera_nodelet_manager_of_recording")


class CommandLines(unittest.TestCase):
    BAG = "/a folder/of mine/drive.bag"

    def test_paths_may_have_blanks(self):
        record = arguments_of(load("record", bag=self.BAG), "recorder")
        self.assertIn("--output-name=" + self.BAG, record)
        self.assertIn(self.BAG, arguments_of(load("replay", bag=self.BAG), "player"))

    def test_record_takes_the_topics_that_there_are(self):
        record = arguments_of(load("record", bag=self.BAG), "recorder")
        self.assertEqual(record[-6:], ["/camera/depth/image_raw", "/camera/depth/camera_info",
                                       "/camera/rgb/image_raw", "/camera/imu/data_raw", "/tf",
                                       "/tf_static"])
        registered = arguments_of(load("record", bag=self.BAG, registration="true"), "recorder")
        self.assertEqual(registered[-6:-4], ["/camera/depth_registered/image_raw",
                                             "/camera/depth_registered/camera_info"])

    def test_a_recorder_that_ends_ends_the_launch(self):
        recorder, = [node for node in load("record", bag=self.BAG).nodes if node.name == "recorder"]
        self.assertTrue(recorder.required)


if __name__ == "__main__":
    unittest.main()
