#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <fstream>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace dominant_plane_detection {

/// A recording of a Kinect v1 as libfreenect's fakenect plays it: a folder with one file for each
/// image or reading, named after its time, and a list of them.
class FakenectSession {
 public:
  /// Begins anew in a folder of its own, which ends with the session.
  explicit FakenectSession(const std::string& name);
  ~FakenectSession();
  FakenectSession(const FakenectSession&) = delete;
  FakenectSession& operator=(const FakenectSession&) = delete;

  std::string folder() const { return folder_.string(); }

  // Times are in [s] and have to ascend.
  /// @param raw 16-bit, 640x480, raw 11-bit disparity.
  void addDepth(double time, const cv::Mat& raw);
  /// @param rgb 8-bit, 640x480, red first.
  void addColour(double time, const cv::Mat& rgb);
  /// @param felt [m/s^2] in the Kinect's own axes: x to its left, y up, z where it looks.
  void addAcceleration(double time, const Eigen::Vector3d& felt);
  /// Plays what there is again and again, without writing it again.
  /// @param period [s] from one beginning to the next.
  void repeat(double period, int times);

 private:
  void write(char kind, double time, const std::string& header, const void* data, std::size_t bytes,
             const std::string& ending);

  void list(const std::string& name) { index_ << name << '\n' << std::flush; }

  struct Entry {
    char kind;
    double time;  ///< [s]
    std::string ending;
  };
  static std::string nameOf(const Entry& entry);

  std::filesystem::path folder_;
  std::vector<Entry> entries_;
  std::ofstream index_;
};

}  // namespace dominant_plane_detection
