#include "result_writer.h"

#include <algorithm>
#include <iomanip>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "depth_summary.h"
#include "png_files.h"
#include "ros/overlay.h"

namespace dominant_plane_detection {
namespace {

/// @return the labels in place.
cv::Mat labelImage(const Detection& detection) {
  // OpenCV takes no const data; nothing writes to it.
  return {detection.image_height, detection.image_width, CV_8UC1,
          const_cast<std::uint8_t*>(detection.labels.data())};
}

cv::Mat groundMask(const Detection& detection) {
  return labelImage(detection) == static_cast<std::uint8_t>(Label::kGround);
}

/// @return a text as a field of a CSV file (RFC 4180).
std::string quoted(const std::string& text) {
  if (text.empty()) return text;
  std::string field = "\"";
  for (const char c : text) field += c == '"' ? std::string("\"\"") : std::string(1, c);
  return field + '"';
}

/// @return why there is no plane; where no depth is in range also what the depths look like.
std::string reasonOf(const Frame& frame, const Detection& detection) {
  const std::string more =
      detection.state == State::kNoDepth ? describeDepths(frame.depth) : std::string();
  return detection.reason + (more.empty() ? "" : " " + more);
}

/// @return 16 numbers, row-major, of [normal, distance]; empty while they are not known.
std::string covarianceText(const Detection& detection) {
  if (detection.covariance(0, 0) < 0.0) return "";
  const Eigen::IOFormat in_one_line(9, Eigen::DontAlignCols, " ", " ");
  std::ostringstream text;
  text << detection.covariance.format(in_one_line);
  return text.str();
}

}  // namespace

ResultWriter::ResultWriter(const std::string& folder, bool labels)
    : folder_(folder), labels_(labels) {
  for (const char* name : {"/masks", "/overlays"}) makeFolder(folder + name);
  if (labels) makeFolder(folder + "/labels");
  planes_.open(folder + "/planes.csv");
  if (!planes_) throw std::runtime_error(folder + "/planes.csv: could not be written");
  planes_ << "frame,state,normal_x,normal_y,normal_z,distance,mse,inliers,ms,reason,covariance\n";
}

void ResultWriter::write(const Frame& frame, const Detection& detection, double ms) {
  planes_ << frame.name << ',' << stateName(detection.state) << ',';
  planes_ << std::setprecision(std::numeric_limits<float>::max_digits10);
  if (detection.found()) {
    planes_ << detection.normal.x() << ',' << detection.normal.y() << ',' << detection.normal.z()
            << ',' << detection.distance << ',' << detection.mean_square_error;
  } else {
    planes_ << ",,,,";
  }
  planes_ << ',' << detection.inliers << ',' << std::setprecision(4) << ms << ','
          << quoted(reasonOf(frame, detection)) << ',' << covarianceText(detection) << '\n';
  if (!planes_.flush()) throw std::runtime_error(folder_ + "/planes.csv: could not be written");
  writePng(folder_ + "/masks", frame.name, groundMask(detection));
  if (labels_) writePng(folder_ + "/labels", frame.name, labelImage(detection));
  cv::Mat picture = greyPicture(frame.depth);
  paintOverlay(detection, picture);
  writePng(folder_ + "/overlays", frame.name, picture);
  Outcome& outcome = outcomes_[stateName(detection.state)];
  if (outcome.images++ == 0) outcome.first_reason = reasonOf(frame, detection);
  ms_.push_back(ms);
}

std::string ResultWriter::summary() const {
  std::ostringstream text;
  text << ms_.size() << " images";
  for (const auto& [state, outcome] : outcomes_) text << ", " << outcome.images << ' ' << state;
  if (!ms_.empty()) {
    std::vector<double> sorted = ms_;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    text << std::setprecision(3) << ", median " << *middle << " ms";
  }
  for (const auto& [state, outcome] : outcomes_) {
    if (!outcome.first_reason.empty()) text << '\n' << state << ": " << outcome.first_reason;
  }
  return text.str();
}

}  // namespace dominant_plane_detection
