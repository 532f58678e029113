#include "prior/turn_history.h"

#include <algorithm>

namespace dominant_plane_detection {
namespace {

constexpr double kKept = 1.0;     // [s]
constexpr double kBeyond = 0.05;  // [s] that the last rate may be carried on for

Eigen::Quaterniond turned(const Eigen::Vector3d& rate, double seconds) {
  const double angle = rate.norm() * seconds;
  if (!(angle != 0.0)) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, rate.normalized()));
}

}  // namespace

void TurnHistory::add(double stamp, const Eigen::Vector3d& rate) {
  if (!rate.allFinite()) return;
  const bool follows =
      !steps_.empty() && stamp >= steps_.back().stamp && stamp - steps_.back().stamp < kKept;
  if (!follows) steps_.clear();
  const Eigen::Quaterniond orientation =
      steps_.empty()
          ? Eigen::Quaterniond::Identity()
          : (steps_.back().orientation * turned(rate, stamp - steps_.back().stamp)).normalized();
  steps_.push_back({stamp, orientation, rate});
  while (stamp - steps_.front().stamp > kKept) steps_.pop_front();
}

std::optional<Eigen::Quaterniond> TurnHistory::at(double stamp) const {
  if (steps_.empty() || stamp < steps_.front().stamp || stamp > steps_.back().stamp + kBeyond) {
    return std::nullopt;
  }
  // The step into which the stamp falls has the rate up to its own stamp.
  const auto next = std::find_if(steps_.begin(), steps_.end(),
                                 [&](const Step& step) { return step.stamp >= stamp; });
  const Step& step = next == steps_.end() ? steps_.back() : *next;
  return step.orientation * turned(step.rate, stamp - step.stamp);
}

std::optional<Eigen::Quaterniond> TurnHistory::turn(double from, double to) const {
  const auto first = at(from), last = at(to);
  if (!first || !last) return std::nullopt;
  return first->conjugate() * *last;
}

}  // namespace dominant_plane_detection
