#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <optional>
#include <string>

#include "doctor/finding.h"

namespace dominant_plane_detection {

/// Expects a finding of a code, with all of some words in its text.
inline void expectFinding(const std::optional<Finding>& finding, Code code,
                          std::initializer_list<const char*> words) {
  ASSERT_TRUE(finding) << "expected " << codeName(code);
  EXPECT_EQ(codeName(finding->code), std::string(codeName(code)));
  for (const char* word : words) {
    EXPECT_NE(finding->text.find(word), std::string::npos)
        << "expected '" << word << "' in: " << finding->text;
  }
  EXPECT_EQ(finding->text.find('\n'), std::string::npos) << "one line a finding";
}

/// Expects one finding, of a code.
inline void expectOnly(const Findings& findings, Code code,
                       std::initializer_list<const char*> words = {}) {
  ASSERT_EQ(findings.size(), 1U) << "expected " << codeName(code);
  expectFinding(findings.front(), code, words);
}

}  // namespace dominant_plane_detection
