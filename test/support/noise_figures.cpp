#include "support/noise_figures.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "dominant_plane_detection/noise_model.h"
#include "support/scoring.h"

namespace dominant_plane_detection {
namespace {

constexpr int kBins = 7;
constexpr double kBin = 0.5;    // [m]
constexpr int kBlock = 4;       // [px]
constexpr int kNeighbours = 7;  // [blocks] to either side

/// Heights of an image's floor, or of blocks of it; NaN elsewhere.
struct HeightImage {
  HeightImage(int image_width, int image_height)
      : width(image_width),
        height(image_height),
        heights(static_cast<std::size_t>(width * height), std::numeric_limits<double>::quiet_NaN()),
        depths(heights.size(), 0.0) {}
  std::size_t at(int u, int v) const { return static_cast<std::size_t>(v * width + u); }

  int width, height;
  std::vector<double> heights;  ///< [m]
  std::vector<double> depths;   ///< [m]
};

/// @return the bin of a depth, or -1.
int binOf(double z) {
  const int bin = static_cast<int>(std::floor(z / kBin)) - 1;
  return bin < kBins ? bin : -1;
}

template <typename Visit>
void forFloor(const ReferenceSet& set, const ReferenceImage& image, Visit&& visit) {
  const DepthView depth = set.view(image);
  for (int v = 0; v < image.depth.rows; ++v) {
    for (int u = 0; u < image.depth.cols; ++u) {
      if (image.ground.at<std::uint8_t>(v, u) != 255) continue;
      const Eigen::Vector3d point = set.point(depth, u, v);
      if (binOf(point.z()) < 0) continue;
      // The band that the recordings' masks were made with.
      const double height = image.up.dot(point) + image.height;
      if (std::abs(height) < 3.0 * NoiseModel{}.sigma(point.z())) visit(u, v, point);
    }
  }
}

/// Heights over the best plane of the floor's readings.
HeightImage heightsOf(const ReferenceSet& set, const ReferenceImage& image) {
  const NoiseModel noise;
  double weights = 0.0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  forFloor(set, image, [&](int, int, const Eigen::Vector3d& point) {
    const double weight = 1.0 / std::pow(noise.sigma(point.z()), 2);
    weights += weight;
    sum += weight * point;
    squares += weight * point * point.transpose();
  });
  const Eigen::Vector3d centre = sum / weights;
  const Eigen::Matrix3d scatter = squares / weights - centre * centre.transpose();
  const Eigen::Vector3d axis =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvectors().col(0);
  const Eigen::Vector3d up = axis.dot(centre) < 0.0 ? axis : Eigen::Vector3d(-axis);
  HeightImage result(image.depth.cols, image.depth.rows);
  forFloor(set, image, [&](int u, int v, const Eigen::Vector3d& point) {
    result.heights[result.at(u, v)] = up.dot(point - centre);
    result.depths[result.at(u, v)] = point.z();
  });
  return result;
}

/// Means of blocks that are floor all over.
HeightImage blocksOf(const HeightImage& image) {
  HeightImage blocks(image.width / kBlock, image.height / kBlock);
  for (int y = 0; y < blocks.height; ++y) {
    for (int x = 0; x < blocks.width; ++x) {
      double height = 0.0, depth = 0.0;  // NaN in one pixel is NaN in the sum
      for (int i = 0; i < kBlock * kBlock; ++i) {
        const std::size_t at = image.at(kBlock * x + i % kBlock, kBlock * y + i / kBlock);
        height += image.heights[at];
        depth += image.depths[at];
      }
      blocks.heights[blocks.at(x, y)] = height / (kBlock * kBlock);
      blocks.depths[blocks.at(x, y)] = depth / (kBlock * kBlock);
    }
  }
  return blocks;
}

double medianAbout(const HeightImage& blocks, int x, int y) {
  std::vector<double> values;
  for (int j = std::max(y - kNeighbours, 0); j <= std::min(y + kNeighbours, blocks.height - 1);
       ++j) {
    for (int i = std::max(x - kNeighbours, 0); i <= std::min(x + kNeighbours, blocks.width - 1);
         ++i) {
      const double value = blocks.heights[blocks.at(i, j)];
      if (!std::isnan(value)) values.push_back(value);
    }
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// What is collected of a bin.
struct Sums {
  std::size_t pixels = 0, blocks = 0;
  double heights = 0.0, locals = 0.0;  ///< [m^2] of squares
  std::vector<double> differences;     ///< [m]
};

void addPixels(const HeightImage& image, std::array<Sums, kBins>& bins) {
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      const std::size_t at = image.at(u, v);
      const int bin = binOf(image.depths[at]);
      if (bin < 0) continue;
      Sums& sums = bins[static_cast<std::size_t>(bin)];
      ++sums.pixels;
      sums.heights += std::pow(image.heights[at], 2);
      if (u + 1 == image.width || std::isnan(image.heights[at + 1])) continue;
      sums.differences.push_back(std::abs(image.heights[at + 1] - image.heights[at]));
    }
  }
}

void addBlocks(const HeightImage& blocks, std::array<Sums, kBins>& bins) {
  for (int y = 0; y < blocks.height; ++y) {
    for (int x = 0; x < blocks.width; ++x) {
      const std::size_t at = blocks.at(x, y);
      const int bin = binOf(blocks.depths[at]);
      if (bin < 0 || std::isnan(blocks.heights[at])) continue;
      Sums& sums = bins[static_cast<std::size_t>(bin)];
      ++sums.blocks;
      sums.locals += std::pow(blocks.heights[at] - medianAbout(blocks, x, y), 2);
    }
  }
}

}  // namespace

std::vector<NoiseFigures> noiseFigures(const ReferenceSet& set) {
  std::array<Sums, kBins> bins;
  for (const ReferenceImage& image : set.images) {
    const HeightImage heights = heightsOf(set, image);
    addPixels(heights, bins);
    addBlocks(blocksOf(heights), bins);
  }
  std::vector<NoiseFigures> figures;
  for (const Sums& sums : bins) {
    NoiseFigures bin;
    bin.nearest = kBin * static_cast<double>(figures.size() + 1);
    bin.farthest = bin.nearest + kBin;
    bin.pixels = sums.pixels;
    bin.height = std::sqrt(sums.heights / static_cast<double>(sums.pixels));
    bin.neighbour = quantile(sums.differences, 0.5);
    bin.local = std::sqrt(sums.locals / static_cast<double>(sums.blocks));
    figures.push_back(bin);
  }
  return figures;
}

}  // namespace dominant_plane_detection
