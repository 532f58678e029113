#include "result_writer.h"

#include <filesystem>
#include <iomanip>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "calibration/median.h"
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

std::ofstream openTable(const std::string& file) {
  std::ofstream table(file);
  if (!table) throw std::runtime_error(file + ": could not be written");
  return table;
}

/// @return a plane as four fields.
std::string numbers(const Eigen::Vector3d& normal, double distance) {
  std::ostringstream text;
  text << std::setprecision(std::numeric_limits<float>::max_digits10) << normal.x() << ','
       << normal.y() << ',' << normal.z() << ',' << distance;
  return text.str();
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

ResultWriter::ResultWriter(const std::string& folder, bool labels, bool further_planes)
    : folder_(folder), labels_(labels) {
  for (const char* name : {"/masks", "/overlays"}) makeFolder(folder + name);
  if (labels) makeFolder(folder + "/labels");
  planes_ = openTable(folder + "/planes.csv");
  planes_ << "frame,state,normal_x,normal_y,normal_z,distance,mse,inliers,ms,reason,covariance\n";
  std::filesystem::remove(folder + "/planes_more.csv");  // of an earlier run
  if (!further_planes) return;
  further_planes_ = openTable(folder + "/planes_more.csv");
  further_planes_ << "frame,rank,normal_x,normal_y,normal_z,distance,inliers,kind\n";
}

void ResultWriter::writePlane(const Frame& frame, const Detection& detection, double ms) {
  planes_ << frame.name << ',' << stateName(detection.state) << ',';
  if (detection.found()) {
    planes_ << numbers(detection.normal, detection.distance) << ','
            << std::setprecision(std::numeric_limits<float>::max_digits10)
            << detection.mean_square_error;
  } else {
    planes_ << ",,,,";
  }
  planes_ << ',' << detection.inliers << ',' << std::setprecision(4) << ms << ','
          << quoted(reasonOf(frame, detection)) << ',' << covarianceText(detection) << '\n';
  if (!planes_.flush()) throw std::runtime_error(folder_ + "/planes.csv: could not be written");
}

void ResultWriter::writeFurtherPlanes(const Frame& frame, const Detection& detection) {
  int rank = 1;
  for (const FurtherPlane& plane : detection.further_planes) {
    further_planes_ << frame.name << ',' << ++rank << ',' << numbers(plane.normal, plane.distance)
                    << ',' << plane.inliers << ',' << kindName(plane.kind) << '\n';
  }
  if (!further_planes_.flush()) {
    throw std::runtime_error(folder_ + "/planes_more.csv: could not be written");
  }
}

void ResultWriter::write(const Frame& frame, const Detection& detection, double ms) {
  writePlane(frame, detection, ms);
  if (further_planes_.is_open()) writeFurtherPlanes(frame, detection);
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
  if (!ms_.empty()) text << std::setprecision(3) << ", median " << median(ms_) << " ms";
  for (const auto& [state, outcome] : outcomes_) {
    if (!outcome.first_reason.empty()) text << '\n' << state << ": " << outcome.first_reason;
  }
  return text.str();
}

}  // namespace dominant_plane_detection
