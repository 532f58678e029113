#pragma once

#include <sensor_msgs/Image.h>

#include <memory>
#include <mutex>
#include <optional>

#include "core/disparity_table.h"
#include "dominant_plane_detection/depth_calibration.h"
#include "dominant_plane_detection/depth_correction.h"
#include "openni2/image_pool.h"

namespace dominant_plane_detection {

/// Turns the images of a depth sensor into millimetres as users correct them:
/// z' = z_scale z + z_offset, and then without the error that is fixed to the pixels, where a
/// correction of it is given. No reading (0) stays none, and what leaves the range of 16 bits
/// becomes none.
///
/// An image that has to be changed is written anew: the memory of the sensor's own may be that of
/// others, too, whom OpenNI2 shares it with. May be used from any thread.
class DepthCorrector {
 public:
  /// @param calibration from raw disparity to distance.
  explicit DepthCorrector(const DepthCalibration& calibration = DepthCalibration::kinect(),
                          const std::optional<DepthCorrection>& pixels = std::nullopt);

  /// @param z_offset [m]
  void set(double z_offset, double z_scale);

  /// @param depth 16UC1, in millimetres, or raw disparity.
  /// @return the same image where there is nothing to correct.
  /// @throw std::runtime_error where subscribers keep more images than ImagePool::kMostTaken.
  sensor_msgs::ImagePtr correct(const sensor_msgs::ImagePtr& depth, bool raw);

 private:
  struct Correction {
    double offset;         ///< [mm]
    double scale;          ///< [-]
    DisparityTable table;  ///< with both
  };

  sensor_msgs::ImagePtr likeness(const sensor_msgs::Image& image);
  void correctPixels(sensor_msgs::Image& image);

  DepthCalibration calibration_;
  std::optional<DepthCorrection> pixels_;
  std::mutex pixels_mutex_;  ///< of the memory in it
  ImagePool pool_;
  std::mutex mutex_;  ///< of the pointer
  std::shared_ptr<const Correction> correction_;
};

}  // namespace dominant_plane_detection
