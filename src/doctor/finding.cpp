#include "doctor/finding.h"

#include <algorithm>
#include <cstddef>
#include <sstream>

namespace dominant_plane_detection {

const char* codeName(Code code) { return kCodeNames[static_cast<std::size_t>(code)]; }

std::string asLine(const Finding& finding) {
  return std::string(codeName(finding.code)) + ": " + finding.text;
}

std::string inOneLine(const std::string& text) {
  std::string line, word;
  for (std::istringstream words(text); words >> word;) {
    const bool is_rule = word.size() > 1 && word.find_first_not_of('-') == std::string::npos;
    if (!is_rule) line += (line.empty() ? "" : " ") + word;
  }
  return line;
}

bool hasCode(const Findings& findings, Code code) {
  return std::any_of(findings.begin(), findings.end(),
                     [code](const Finding& finding) { return finding.code == code; });
}

}  // namespace dominant_plane_detection
