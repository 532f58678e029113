// Says what is wrong with a running system or a recording, and what to change.

#include <ros/init.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "doctor_live.h"
#include "doctor_report.h"
#include "source_arguments.h"

namespace dominant_plane_detection {
namespace {

constexpr const char* kDescription =
    "Looks at a running system, or at a recording, and says what is wrong with it: one line a\n"
    "finding, with a code, what was seen, the likely cause and what to change.\n\n"
    "The exit status is 0 where nothing was found, 1 where something was, and 2 where it could "
    "not\n"
    "look.\n\n"
    "Examples:\n"
    "  doctor\n"
    "  doctor drive.bag --set base_frame=base_link\n"
    "  doctor depth/ --camera 525,525,319.5,239.5 --depth-scale 5000\n";

constexpr int kHealthy = 0;
constexpr int kFound = 1;
constexpr int kUnusable = 2;

struct Options {
  SourceArguments source;
  std::string node;
  double duration = 10.0;
};

void declare(CLI::App& app, Options& options) {
  declareSource(app, options.source, false);
  app.get_option("--set")->description(
      "one parameter of the detection or its node, such as base_frame; may be repeated");
  app.add_option("--duration", options.duration, "[s] to listen to a running system")
      ->check(CLI::Range(1.0, 600.0))
      ->capture_default_str();
  app.add_option("--node", options.node, "the detection to look at, where several run")
      ->type_name("NAME");
}

std::vector<DoctorReport> examine(const Options& options) {
  const SourceOptions source = options.source.readSourceOptions();
  if (options.source.inputs.empty()) {
    return examineLive(options.source,
                       {options.source.topic, options.node, source.camera, options.duration});
  }
  DoctorSettings settings;
  settings.take(options.source);
  std::vector<DoctorReport> reports;
  for (const std::string& input : options.source.inputs) {
    const bool bag = std::filesystem::path(input).extension() == ".bag";
    reports.push_back(bag ? examineBag(input, settings, {options.source.topic, source.camera})
                          : examineFrames(input, settings, source));
  }
  return reports;
}

/// @return the exit status.
int print(const std::vector<DoctorReport>& reports) {
  bool healthy = true;
  for (const DoctorReport& report : reports) {
    for (Finding finding : report.findings) {
      healthy = false;
      if (reports.size() > 1) finding.text = report.name + ": " + finding.text;
      std::cout << asLine(finding) << '\n';
    }
  }
  if (!healthy) return kFound;
  std::cout << "healthy: nothing wrong was found in ";
  for (std::size_t i = 0; i < reports.size(); ++i) {
    std::cout << (i == 0 ? "" : "; ") << reports[i].name << " (" << reports[i].looked_at << ")";
  }
  std::cout << '\n';
  return kHealthy;
}

}  // namespace
}  // namespace dominant_plane_detection

int main(int argc, char** argv) {
  using namespace dominant_plane_detection;  // NOLINT: a main() of a few lines
  ros::init(argc, argv, "doctor", ros::init_options::AnonymousName);
  CLI::App app(kDescription, "doctor");
  Options options;
  declare(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kHealthy : kUnusable;
  }
  try {
    return print(examine(options));
  } catch (const std::exception& error) {
    std::cerr << "doctor: " << error.what() << '\n';
    return kUnusable;
  }
}
