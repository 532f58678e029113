#pragma once

#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>

namespace dominant_plane_detection {

/// The main() of a command-line program: parses, runs, and ends with one line for an exception.
/// @param app knows the options.
/// @param run what to do once they are read; returns the exit status.
/// @return the exit status: 1 after an exception, CLI11's for options that cannot be read.
template <typename Run>
int runTool(CLI::App& app, int argc, char** argv, Run&& run) {
  CLI11_PARSE(app, argc, argv);
  try {
    return run();
  } catch (const std::exception& error) {
    std::cerr << app.get_name() << ": " << error.what() << '\n';
    return 1;
  }
}

}  // namespace dominant_plane_detection
