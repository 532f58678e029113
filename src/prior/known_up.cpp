#include "prior/known_up.h"

#include <cstdio>

#include "prior/angle.h"

namespace dominant_plane_detection {
namespace {

constexpr double kDegree = 0.0174533;              // [rad]
constexpr double kContradiction = 15.0 * kDegree;  // [rad] a ramp, and what a mount may be off by
constexpr double kPatience = 1.0;                  // [s]

}  // namespace

/// A motion may turn what an accelerometer shows for a moment.
bool UpChoice::contradicts(double stamp, const Up& tf, const Up& gravity) {
  const double angle = angleBetween(tf.direction, gravity.direction);
  if (!(angle > kContradiction + gravity.error)) {
    contradicting_since_.reset();
    return false;
  }
  if (!contradicting_since_ || stamp < *contradicting_since_) contradicting_since_ = stamp;
  if (stamp - *contradicting_since_ < kPatience) return false;
  char text[160];
  std::snprintf(text, sizeof(text),
                "Up by tf is %.0f deg from up by gravity (at most %.0f): gravity is taken.",
                angle / kDegree, (kContradiction + gravity.error) / kDegree);
  remark_ = text;
  return true;
}

std::optional<KnownUp> UpChoice::choose(double stamp, const Candidates& candidates) {
  remark_.clear();
  const auto& [tf, gravity, tf_problem, gravity_problem] = candidates;
  if (!tf || !gravity) contradicting_since_.reset();
  const bool passed_over = tf && gravity && contradicts(stamp, *tf, *gravity);
  if (tf && !passed_over) return KnownUp{*tf, UpSource::kTf};
  if (!passed_over) remark_ = tf_problem;
  if (gravity) return KnownUp{*gravity, UpSource::kImu};
  if (!gravity_problem.empty()) remark_ += (remark_.empty() ? "" : " ") + gravity_problem;
  return std::nullopt;
}

}  // namespace dominant_plane_detection
