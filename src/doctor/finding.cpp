#include "doctor/finding.h"

#include <algorithm>
#include <cstddef>

namespace dominant_plane_detection {

const char* codeName(Code code) { return kCodeNames[static_cast<std::size_t>(code)]; }

std::string asLine(const Finding& finding) {
  return std::string(codeName(finding.code)) + ": " + finding.text;
}

bool hasCode(const Findings& findings, Code code) {
  return std::any_of(findings.begin(), findings.end(),
                     [code](const Finding& finding) { return finding.code == code; });
}

}  // namespace dominant_plane_detection
