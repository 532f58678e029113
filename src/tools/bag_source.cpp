#include <image_transport/camera_common.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <cstdio>
#include <map>
#include <set>

#include "bag_topics.h"
#include "doctor/topic_advice.h"
#include "frame_source.h"
#include "ros/camera_conversion.h"
#include "ros/depth_conversion.h"

namespace dominant_plane_detection {
namespace {

std::string chooseTopic(const rosbag::Bag& bag, const std::string& wanted) {
  const std::set<std::string> topics = depthTopics(bag);
  if (!wanted.empty() && topics.count(wanted) != 0) return wanted;
  if (wanted.empty() && topics.size() == 1) return *topics.begin();
  const std::string names = listed({topics.begin(), topics.end()});
  if (topics.empty()) throw std::runtime_error("there are no depth images (16UC1, 32FC1) in it");
  if (wanted.empty()) {
    throw std::runtime_error("there are several depth topics, choose one with --topic: " + names);
  }
  throw std::runtime_error("there is no depth topic " + wanted + " in it, but " + names);
}

std::string frameName(const ros::Time& stamp) {
  char name[32];
  std::snprintf(name, sizeof(name), "%u.%09u", stamp.sec, stamp.nsec);
  return name;
}

class BagSource : public FrameSource {
 public:
  BagSource(const std::string& file, const SourceOptions& options) : options_(options) {
    bag_.open(file, rosbag::bagmode::Read);
    topic_ = chooseTopic(bag_, options.topic);
    cameras_ = cameraInfos(bag_, image_transport::getCameraInfoTopic(topic_));
    images_.addQuery(bag_, rosbag::TopicQuery(topic_));
    next_ = images_.begin();
  }

  std::size_t size() const override { return const_cast<rosbag::View&>(images_).size(); }

  std::optional<Frame> next() override {
    if (next_ == images_.end()) return std::nullopt;
    const rosbag::MessageInstance message = *next_;
    ++next_;
    image_ = message.instantiate<sensor_msgs::Image>();
    if (!image_) {
      throw UnreadableFrame(bag_.getFileName() + ": expected an image on " + topic_ + ", got " +
                            message.getDataType());
    }
    Frame frame;
    frame.name = frameName(image_->header.stamp);
    frame.frame_id = image_->header.frame_id;
    std::string error;
    const auto depth = reader_.read(*image_, error);
    if (!depth) throw UnreadableFrame(bag_.getFileName() + " " + frame.name + ": " + error);
    frame.depth = *depth;
    frame.camera = camera(image_->header.stamp, frame);
    return frame;
  }

 private:
  /// The camera_info of the image's stamp, or else the last one before it, or else the first.
  CameraModel camera(const ros::Time& stamp, const Frame& frame) const {
    if (options_.camera) {
      CameraModel model = *options_.camera;
      if (model.width == 0) {
        model.width = frame.depth.width;
        model.height = frame.depth.height;
      }
      return model;
    }
    if (cameras_.empty()) {
      throw UnreadableFrame(bag_.getFileName() + ": there is no " +
                            image_transport::getCameraInfoTopic(topic_) +
                            " in it, give --camera FX,FY,CX,CY or --camera-info FILE");
    }
    auto info = cameras_.upper_bound(stamp);
    if (info != cameras_.begin()) --info;
    std::string error;
    const auto model = cameraModel(*info->second, false, error);
    if (!model) throw UnreadableFrame(bag_.getFileName() + " " + frame.name + ": " + error);
    return *model;
  }

  SourceOptions options_;
  rosbag::Bag bag_;
  std::string topic_;
  rosbag::View images_;
  rosbag::View::iterator next_;
  std::map<ros::Time, sensor_msgs::CameraInfoConstPtr> cameras_;
  sensor_msgs::ImageConstPtr image_;  ///< memory of the last frame
  DepthReader reader_;
};

}  // namespace

std::unique_ptr<FrameSource> openBag(const std::string& file, const SourceOptions& options) {
  return std::make_unique<BagSource>(file, options);
}

}  // namespace dominant_plane_detection
