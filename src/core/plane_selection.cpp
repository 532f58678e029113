#include "core/plane_selection.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace dominant_plane_detection {

State PlaneSelection::consider(const HessePlane& plane, std::size_t points, double nearest) {
  const Candidate candidate{plane, points, nearest};
  const bool large = points >= minPoints();
  const State verdict = large ? checkPose(plane) : State::kTooSmall;
  took_last_ = verdict == State::kFound && beatsBest(candidate);
  if (took_last_) {
    best_ = candidate;
    largest_ = std::max(largest_, points);
  } else if (verdict != State::kFound && points > refused_.points) {
    refused_ = candidate;
    refusal_ = verdict;
  }
  return verdict;
}

bool PlaneSelection::beatsBest(const Candidate& candidate) const {
  constexpr double kLike = 1.25;
  const auto ours = static_cast<double>(candidate.points), best = static_cast<double>(best_.points);
  const bool levels = std::isfinite(candidate.nearest) && std::isfinite(best_.nearest);
  const bool like = ours < kLike * best && static_cast<double>(largest_) < kLike * ours;
  return levels && like ? candidate.nearest < best_.nearest : ours > best;
}

bool PlaneSelection::clearlyTooTilted(const HessePlane& plane) const {
  // Twenty degrees; the normal of nine tiles is good to a few at the end of the range.
  constexpr double kMargin = 0.35;  // [rad]
  return tilt(plane) > limits_.max_tilt + kMargin;
}

State PlaneSelection::checkPose(const HessePlane& plane) const {
  if (tilt(plane) > limits_.max_tilt) return State::kTooTilted;
  if (plane.distance < limits_.min_height || plane.distance > limits_.max_height) {
    return State::kOutOfHeightRange;
  }
  return State::kFound;
}

double PlaneSelection::tilt(const HessePlane& plane) const {
  // The Hesse normal points away from the camera, hence the minus.
  return std::acos(std::clamp(-plane.normal.dot(limits_.expected_up), -1.0, 1.0));
}

void PlaneSelection::explain(std::size_t seeds_tried, std::array<char, 256>& sentence) const {
  const auto print = [&](const char* format, auto... values) {
    std::snprintf(sentence.data(), sentence.size(), format, values...);
  };
  switch (refusal_) {
    case State::kTooSmall:
      print(
          "The largest plane holds %zu pixels, fewer than the required %zu (min_share, min_patch).",
          refused_.points, limits_.min_points);
      break;
    case State::kTooTilted:
      print(
          "The largest plane is tilted by %.3f rad from the expected up direction, more than "
          "max_tilt = %.3f rad.",
          tilt(refused_.plane), limits_.max_tilt);
      break;
    case State::kOutOfHeightRange:
      print("The camera is %.3f m over the largest plane, expected %.3f to %.3f m.",
            refused_.plane.distance, limits_.min_height, limits_.max_height);
      break;
    default:
      print("None of %zu seeds lies on a plane.", seeds_tried);
  }
}

}  // namespace dominant_plane_detection
