#include "ros/seen_inputs.h"

#include "doctor/stamp_offset.h"
#include "ros/camera_conversion.h"
#include "ros/depth_conversion.h"

namespace dominant_plane_detection {

void SeenInputs::keepLatest(std::vector<double>& stamps, const ros::Time& stamp) {
  constexpr std::size_t kKept = 30;
  if (stamps.size() == kKept) stamps.erase(stamps.begin());
  stamps.push_back(stamp.toSec());
}

void SeenInputs::add(const sensor_msgs::Image& image) {
  describe(image, facts_);
  keepLatest(image_stamps_, image.header.stamp);
}

void SeenInputs::add(const sensor_msgs::CameraInfo& info) {
  ++facts_.info.messages;
  facts_.camera = cameraInfoFacts(info, rectified_);
  keepLatest(info_stamps_, info.header.stamp);
}

std::optional<double> SeenInputs::infoOffset() const {
  return stampOffset(image_stamps_, info_stamps_);
}

}  // namespace dominant_plane_detection
