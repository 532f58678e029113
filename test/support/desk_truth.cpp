#include "support/desk_truth.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

#include "support/recordings.h"

namespace dominant_plane_detection {

std::vector<DeskTruth> readDeskTruth() {
  std::ifstream file(recordingsFolder() + "/handheld_desk_truth.csv");
  std::vector<DeskTruth> truths;
  std::string line;
  std::getline(file, line);  // the header
  while (std::getline(file, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream numbers(line);
    DeskTruth t{};
    numbers >> t.stamp >> t.up.x() >> t.up.y() >> t.up.z() >> t.floor >> t.table >> t.on_floor >>
        t.on_table;
    truths.push_back(t);
  }
  return truths;
}

const DeskTruth* findTruth(const std::vector<DeskTruth>& truths, double stamp) {
  const auto truth = std::find_if(truths.begin(), truths.end(), [&](const DeskTruth& t) {
    return std::abs(t.stamp - stamp) < 2e-6;
  });
  return truth == truths.end() ? nullptr : &*truth;
}

}  // namespace dominant_plane_detection
