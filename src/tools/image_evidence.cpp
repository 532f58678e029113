#include "image_evidence.h"

#include "ros/camera_conversion.h"

namespace dominant_plane_detection {

std::optional<CameraModel> ImageEvidence::cameraOf(const sensor_msgs::CameraInfo* info,
                                                   const DepthView& depth,
                                                   std::string& error) const {
  std::optional<CameraModel> camera = camera_;
  if (!camera) camera = cameraModel(*info, rectified_, error);
  if (camera && camera->width == 0) {
    camera->width = depth.width;
    camera->height = depth.height;
  }
  if (camera && (camera->width != depth.width || camera->height != depth.height)) {
    error = "expected a camera of the image's size";
    return std::nullopt;
  }
  return camera;
}

const Detection* ImageEvidence::refuse(const std::string& error) {
  ++refused_;
  refusal_ = error;
  return nullptr;
}

const Detection* ImageEvidence::study(const DepthView& depth, const CameraModel& camera,
                                      const Prior& prior) {
  return &study_.add(correction_ ? correction_->correct(depth) : depth, camera, prior);
}

const Detection* ImageEvidence::add(const sensor_msgs::Image& image,
                                    const sensor_msgs::CameraInfoConstPtr& info,
                                    const Prior& prior) {
  dominant_plane_detection::describe(image, seen_);
  if (info && !camera_) seen_.camera = cameraInfoFacts(*info, rectified_);
  std::string error;
  const auto depth = depth_reader_.read(image, error);
  if (!depth) return refuse(error);
  if (!info && !camera_) return nullptr;  // there is a rule for that
  const auto camera = cameraOf(info.get(), *depth, error);
  if (!camera) return refuse(error);
  return study(*depth, *camera, prior);
}

const Detection* ImageEvidence::add(const sensor_msgs::PointCloud2& cloud, const Prior& prior) {
  seen_.frame_id = cloud.header.frame_id;
  std::string error;
  const auto image = cloud_reader_.read(cloud, error);
  if (!image) return refuse(error);
  return study(image->depth, image->camera, prior);
}

void ImageEvidence::describe(InputFacts& facts) const {
  facts.frame_id = seen_.frame_id;
  facts.encoding = seen_.encoding;
  facts.width = seen_.width;
  facts.height = seen_.height;
  facts.camera = seen_.camera;
  if (refused_ <= study_.images()) return;
  facts.encoding_is_depth = seen_.encoding_is_depth;
  facts.refusal = refusal_;
}

}  // namespace dominant_plane_detection
