#include "calibration/depth_correction_file.h"

#include "calibration/yaml_text.h"

namespace dominant_plane_detection {

DepthCorrection loadDepthCorrection(const std::string& file) {
  return readYaml(file, "a depth correction", [](const YAML::Node& root) {
    for (const char* name : {"columns", "rows", "inverse_depth"}) {
      if (!root.IsMap() || !root[name]) {
        throw std::runtime_error(std::string(name) + ": expected a value, got nothing");
      }
    }
    return DepthCorrection({root["columns"].as<int>(), root["rows"].as<int>(),
                            root["inverse_depth"].as<std::vector<double>>()});
  });
}

void saveDepthCorrection(const std::string& file, const FloorCorrection::Result& learned) {
  YAML::Emitter out;
  out.SetDoublePrecision(6);
  out << YAML::Comment(
      "1 / z' = 1 / z - c, [c] = 1/m, bilinear between the middles of columns x rows cells that\n"
      "cover the image, row by row. A part of c that is affine in the image turns planes into\n"
      "planes; no floor shows it. It is such that on average the planes of the images that c was\n"
      "learned from do not move. Zero is c where fewer than three images showed floor.");
  out << YAML::Newline << YAML::BeginMap;
  out << YAML::Key << "columns" << YAML::Value << learned.grid.columns;
  out << YAML::Key << "rows" << YAML::Value << learned.grid.rows;
  out << YAML::Key << "inverse_depth" << YAML::Value << YAML::Flow << learned.grid.inverse_depth;
  out << YAML::Key << "images" << YAML::Value << learned.images;
  out << YAML::Newline
      << YAML::Comment("[1/m] rms of floor cells over their plane on images not learned from");
  out << YAML::Newline << YAML::Key << "before" << YAML::Value << learned.before;
  out << YAML::Key << "after" << YAML::Value << learned.after;
  out << YAML::EndMap;
  writeYaml(file, out);
}

}  // namespace dominant_plane_detection
