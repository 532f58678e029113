#include "calibration/pair_file.h"

#include <csv.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace dominant_plane_detection {

std::vector<DepthPair> loadPairs(const std::string& file) {
  std::vector<DepthPair> pairs;
  try {
    using Reader = io::CSVReader<3, io::trim_chars<' ', '\t'>, io::no_quote_escape<','>,
                                 io::throw_on_overflow, io::single_and_empty_line_comment<'#'>>;
    Reader reader(file);
    reader.read_header(io::ignore_missing_column, "raw", "distance", "sigma");
    if (!reader.has_column("raw") || !reader.has_column("distance")) {
      throw std::runtime_error("a column is missing");
    }
    DepthPair pair;
    while (reader.read_row(pair.raw, pair.distance, pair.sigma)) {
      pairs.push_back(pair);
      pair = DepthPair();
    }
  } catch (const std::exception& error) {
    throw std::runtime_error(file +
                             ": expected a CSV file with the columns raw,distance (metres) and "
                             "perhaps sigma (metres), and numbers in them: " +
                             error.what());
  }
  return pairs;
}

void appendPair(const std::string& file, const DepthPair& pair) {
  const bool begin = !std::filesystem::exists(file) || std::filesystem::file_size(file) == 0;
  std::ofstream stream(file, std::ios::app);
  stream.precision(7);
  if (begin) stream << "raw,distance\n";
  stream << pair.raw << ',' << pair.distance << '\n';
  stream.close();
  if (!stream) throw std::runtime_error(file + ": cannot be written");
}

}  // namespace dominant_plane_detection
