#!/usr/bin/env python3
"""Prints the depth topic of a bag and its frame, for replay.launch.

usage: bag_topics.py FILE.bag [TOPIC]
"""
import sys

import rosbag


def depth_topics(bag):
    """Returns {topic: frame_id} of the images that can be depth."""
    topics = {}
    names = [name for name, info in bag.get_type_and_topic_info().topics.items()
             if info.msg_type == "sensor_msgs/Image"]
    for name in names:
        for _, image, _ in bag.read_messages(topics=[name]):
            if image.encoding in ("16UC1", "32FC1"):
                topics[name] = image.header.frame_id
            break
    return topics


def main(file, wanted=None):
    with rosbag.Bag(file) as bag:
        topics = depth_topics(bag)
    if wanted:
        topics = {name: frame for name, frame in topics.items() if name == wanted}
    if len(topics) != 1:
        sys.exit("{}: expected one depth topic (16UC1 or 32FC1), found: {}".format(
            file, ", ".join(sorted(topics)) or "none"))
    name, frame = next(iter(topics.items()))
    print(name, frame)


if __name__ == "__main__":
    try:
        main(*sys.argv[1:])
    except (OSError, rosbag.ROSBagException) as error:
        sys.exit("{}: {}".format(sys.argv[1], error))
