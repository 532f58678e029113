#include "ros/driver_diagnostics.h"

#include <diagnostic_msgs/DiagnosticStatus.h>

#include <algorithm>

namespace dominant_plane_detection {
namespace {

using diagnostic_msgs::DiagnosticStatus;

constexpr double kSlow = 0.8;      // [-] share of the mode's rate below which to warn
constexpr double kShortest = 0.5;  // [s] of which a rate can be told
constexpr double kPatience = 5.0;  // [s] for which a camera may be looked for at the start

const char* nameOf(StreamState state) {
  switch (state) {
    case StreamState::kIdle:
      return "idle";
    case StreamState::kStarting:
      return "starting";
    case StreamState::kStreaming:
      return "streaming";
    case StreamState::kSilent:
      return "silent";
    case StreamState::kFailed:
      return "failed";
    default:
      return "finished";
  }
}

/// @return the streams that run, as "depth, rgb".
std::string running(const SessionStatus& status) {
  std::string names;
  for (const StreamKind kind : kAllStreams) {
    if (status.stream(kind).state != StreamState::kStreaming) continue;
    names += (names.empty() ? "" : ", ") + std::string(toString(kind));
  }
  return names;
}

}  // namespace

DriverDiagnostics::DriverDiagnostics(const ros::NodeHandle& node,
                                     const ros::NodeHandle& private_node, const std::string& name)
    : begin_(ros::SteadyTime::now()), updater_(node, private_node, name) {
  updater_.setHardwareID("none");
  updater_.add("camera", [this](auto& report) { reportCamera(report); });
  for (const StreamKind kind : kAllStreams) {
    updater_.add(toString(kind), [this, kind](auto& report) { reportStream(kind, report); });
  }
}

void DriverDiagnostics::setWanted(StreamKind kind, bool wanted) {
  const std::lock_guard<std::mutex> lock(mutex_);
  Stream& stream = streams_[static_cast<std::size_t>(kind)];
  if (stream.wanted == wanted) return;
  stream.wanted = wanted;
  stream.beginPeriod();
  stream.last_number = -1;
}

void DriverDiagnostics::beginNumbers() {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (Stream& stream : streams_) stream.last_number = -1;
}

void DriverDiagnostics::count(StreamKind kind, const SensorFrame& frame) {
  const std::lock_guard<std::mutex> lock(mutex_);
  Stream& stream = streams_[static_cast<std::size_t>(kind)];
  const int missing = frame.number - stream.last_number - 1;
  // A number that goes back is that of a stream or a recording that began again.
  if (stream.last_number >= 0 && missing > 0) stream.dropped += static_cast<std::uint64_t>(missing);
  stream.last_number = frame.number;
  stream.rate = frame.rate;
  ++stream.frames;
  if (frame.incomplete) ++stream.incomplete;
}

void DriverDiagnostics::report(const SessionStatus& status) {
  status_ = status;
  updater_.setHardwareID(status.camera.serial.empty() ? "none" : status.camera.serial);
  updater_.force_update();
}

void DriverDiagnostics::reportCamera(diagnostic_updater::DiagnosticStatusWrapper& report) const {
  const std::string names = running(status_);
  const bool starting =
      status_.connections == 0 && (ros::SteadyTime::now() - begin_).toSec() < kPatience;
  int restarts = 0;
  for (const StreamStatus& stream : status_.streams) restarts += stream.restarts;
  if (!status_.open) {
    report.summary(starting ? DiagnosticStatus::WARN : DiagnosticStatus::ERROR,
                   "searching: " + status_.problem);
  } else {
    report.summary(DiagnosticStatus::OK,
                   names.empty() ? "idle: no stream runs" : "streaming: " + names);
  }
  report.add("uri", status_.camera.uri);
  report.add("name", status_.camera.vendor + " " + status_.camera.name);
  report.add("serial number", status_.camera.serial);
  report.add("accelerometer", status_.accelerometer ? "yes" : "no");
  report.add("motor and light", status_.motor ? "yes" : "no");
  report.add("times opened", status_.connections);
  report.add("silent streams started anew", restarts);
}

void DriverDiagnostics::reportStream(StreamKind kind,
                                     diagnostic_updater::DiagnosticStatusWrapper& report) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const StreamStatus& status = status_.stream(kind);
  Stream& stream = streams_[static_cast<std::size_t>(kind)];
  if (!stream.wanted) {
    report.summary(DiagnosticStatus::OK, "idle: nobody listens");
  } else if (!status_.open) {
    report.summary(DiagnosticStatus::ERROR, "there is no camera");
    stream.beginPeriod();
  } else {
    summarise(status, stream, report);
  }
  report.add("state", nameOf(status.state));
  report.add("rate of the mode [1/s]", stream.rate);
  report.add("images", stream.frames);
  report.add("dropped images", stream.dropped);
  report.add("incomplete images", stream.incomplete);
  report.add("times silent and started anew", status.restarts);
}

/// Of a stream that is wanted. A rate is that of a period in which it streamed from the beginning.
void DriverDiagnostics::summarise(const StreamStatus& status, Stream& stream,
                                  diagnostic_updater::DiagnosticStatusWrapper& report) const {
  const double seconds = (ros::SteadyTime::now() - stream.since).toSec();
  if (status.state != StreamState::kStreaming) {
    const bool wrong = status.state == StreamState::kFailed || status.state == StreamState::kSilent;
    const bool finished = status.state == StreamState::kFinished;
    report.summary(wrong ? DiagnosticStatus::ERROR : DiagnosticStatus::OK,
                   wrong || finished ? status.text : "starting");
    return stream.beginPeriod();
  }
  if (seconds < kShortest) return report.summary(DiagnosticStatus::OK, "starting");
  const double rate = static_cast<double>(stream.frames - stream.reported) / seconds;
  const bool slow = rate < kSlow * stream.rate;
  report.summaryf(slow ? DiagnosticStatus::WARN : DiagnosticStatus::OK,
                  "%.1f images a second, %d by the mode", rate, stream.rate);
  report.addf("rate [1/s]", "%.2f", rate);
  stream.beginPeriod();
}

}  // namespace dominant_plane_detection
