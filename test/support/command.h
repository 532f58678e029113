#pragma once

#include <sys/wait.h>

#include <cstdio>
#include <string>

namespace dominant_plane_detection {

struct Outcome {
  int status;        ///< -1 when it did not end by itself
  std::string text;  ///< standard output and standard error
};

/// Runs a command line in a shell.
inline Outcome run(const std::string& command) {
  Outcome outcome{-1, ""};
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  char buffer[256];
  while (fgets(buffer, sizeof(buffer), pipe) != nullptr) outcome.text += buffer;
  const int status = pclose(pipe);
  outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
}

}  // namespace dominant_plane_detection
