#include "core/plane_selection.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace dominant_plane_detection {

State PlaneSelection::consider(const HessePlane& plane, std::size_t points, double nearest,
                               const std::optional<Eigen::Vector3d>& centre) {
  const Eigen::Vector3d foot = plane.distance * plane.normal;
  const Candidate candidate{plane, points, nearest, centre.value_or(foot)};
  const bool large = points >= minPoints();
  const State verdict = large ? checkPose(plane) : State::kTooSmall;
  took_last_ = verdict == State::kFound && beatsBest(candidate);
  if (took_last_) {
    largest_ = isLarger(candidate) ? std::max(largest_, points) : points;
    best_ = candidate;
  } else if (verdict != State::kFound && points > refused_.points) {
    refused_ = candidate;
    refusal_ = verdict;
  }
  return verdict;
}

PlaneSelection::Rank PlaneSelection::rank(const Candidate& candidate) const {
  const auto& expected = limits_.expected_height;
  if (expected && std::abs(candidate.plane.distance - expected->height) <= expected->tolerance) {
    return Rank::kExpected;
  }
  const bool may_be_lowest = limits_.lowest_from > 0 && candidate.points >= limits_.lowest_from;
  return may_be_lowest ? Rank::kLowest : Rank::kAny;
}

bool PlaneSelection::beatsBest(const Candidate& candidate) const {
  // [m] What differs by less may be one floor, bent by the sensor's error.
  constexpr double kLevels = 0.1;
  if (!found()) return true;
  const Rank ours = rank(candidate), best = rank(best_);
  if (ours != best) return ours > best;
  const double lower = best_.plane.signedDistance(candidate.centre);
  if (ours == Rank::kLowest && std::abs(lower) > kLevels) return lower > 0.0;
  return isLarger(candidate);
}

bool PlaneSelection::isLarger(const Candidate& candidate) const {
  constexpr double kLike = 1.25;
  const auto ours = static_cast<double>(candidate.points), best = static_cast<double>(best_.points);
  const bool levels = std::isfinite(candidate.nearest) && std::isfinite(best_.nearest);
  const bool like = ours < kLike * best && static_cast<double>(largest_) < kLike * ours;
  return levels && like ? candidate.nearest < best_.nearest : ours > best;
}

std::size_t PlaneSelection::toBeat() const {
  if (!found()) return limits_.min_points;
  const Rank best = rank(best_);
  if (limits_.expected_height && best != Rank::kExpected) return limits_.min_points;
  if (best == Rank::kLowest) return limits_.lowest_from;
  return std::max(best_.points, limits_.min_points);
}

bool PlaneSelection::isOpen(std::size_t points) const {
  if (!found()) return points > 0;
  return toBeat() < best_.points ? points >= toBeat() : points > best_.points;
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
          "The largest plane is tilted by %.3f rad from the expected up direction, more than %s"
          "%.3f rad.",
          tilt(refused_.plane),
          limits_.lowest_from > 0 ? "a level one may be (prefer), " : "max_tilt = ",
          limits_.max_tilt);
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
