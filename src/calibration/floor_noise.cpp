#include "calibration/floor_noise.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <utility>

#include "calibration/median.h"

namespace dominant_plane_detection {
namespace {

constexpr double kBin = 0.5;         // [m]
constexpr int kFloorWindow = 41;     // [px]
constexpr float kFloorShare = 0.7F;  // [-] of it that is ground
constexpr int kBlocks = 7;           // [blocks] a side of what is about one
constexpr int kWindow = 112;         // [px]
constexpr int kWindowStep = 28;      // [px]
/// [px] Of every fourth row and column: an hour's drive fits into memory, and neighbours say no
/// more.
constexpr int kPixelStep = 4;
constexpr std::size_t kMinFigures = 50;
/// [-] Of normally distributed numbers' median absolute value.
constexpr double kMedian = 0.6745;

double medianOf(std::vector<float> values) {
  if (values.size() < kMinFigures) return std::numeric_limits<double>::quiet_NaN();
  return static_cast<double>(median(std::move(values)));
}

/// @return sums over size x size pixels, at each block's place.
cv::Mat blockSums(const cv::Mat& pixels, int size) {
  const cv::Mat whole =
      pixels(cv::Rect(0, 0, pixels.cols / size * size, pixels.rows / size * size));
  cv::Mat means;
  cv::resize(whole, means, {}, 1.0 / size, 1.0 / size, cv::INTER_AREA);
  return means * (size * size);
}

cv::Mat windowSums(const cv::Mat& values, int size) {
  cv::Mat sums;
  cv::boxFilter(values, sums, CV_32F, {size, size}, {-1, -1}, false, cv::BORDER_CONSTANT);
  return sums;
}

NoiseModel fit(const std::vector<FloorNoiseFigures>& figures, double FloorNoiseFigures::*figure) {
  std::vector<FloorNoiseFigures> known;
  for (const FloorNoiseFigures& f : figures) {
    if (f.*figure > 0.0) known.push_back(f);  // it is a number, and not without errors
  }
  if (known.size() < 2) {
    throw std::runtime_error("Expected floor at two depths, half a metre apart, got " +
                             std::to_string(known.size()) + ".");
  }
  // Relative errors count, as thresholds are multiples.
  const auto rows = static_cast<Eigen::Index>(known.size());
  Eigen::MatrixX2d terms(rows, 2);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const FloorNoiseFigures& f = known[static_cast<std::size_t>(i)];
    const double z = 0.5 * (f.nearest + f.farthest);
    terms.row(i) << 1.0 / (f.*figure), z * z / (f.*figure);
  }
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(rows);
  const Eigen::Vector2d both = terms.colPivHouseholderQr().solve(ones);
  const auto alone = [&](int column) {
    return terms.col(column).dot(ones) / terms.col(column).squaredNorm();
  };
  if (both[1] < 0.0) return {alone(0), 0.0};
  if (both[0] < 0.0) return {0.0, alone(1)};
  return {both[0], both[1]};
}

}  // namespace

struct FloorNoise::Heights {
  cv::Mat height, depth, floor;  ///< [m], [m], [-]; CV_32F, 0 where there is no floor

  Heights(const DepthView& view, const CameraModel& camera, const Detection& detection) {
    const cv::Size size(view.width, view.height);
    cv::Mat ground(size, CV_32F);
    for (int i = 0; i < size.area(); ++i) {
      ground.at<float>(i / size.width, i % size.width) =
          detection.onPlane(i % size.width, i / size.width) ? 1.0F : 0.0F;
    }
    const cv::Mat share = windowSums(ground, kFloorWindow) / (kFloorWindow * kFloorWindow);
    height = cv::Mat::zeros(size, CV_32F);
    depth = cv::Mat::zeros(size, CV_32F);
    floor = cv::Mat::zeros(size, CV_32F);
    for (int v = 0; v < size.height; ++v) {
      for (int u = 0; u < size.width; ++u) {
        const double z = static_cast<double>(metresAt(view, u, v));
        if (share.at<float>(v, u) < kFloorShare || !(z > 0.0 && std::isfinite(z))) continue;
        const Eigen::Vector2d ray = camera.ray({u, v});
        if (!ray.allFinite()) continue;  // a lens that cannot be undone there
        height.at<float>(v, u) = static_cast<float>(detection.height(z * ray.homogeneous()));
        depth.at<float>(v, u) = static_cast<float>(z);
        floor.at<float>(v, u) = 1.0F;
      }
    }
  }
};

FloorNoise::Bin* FloorNoise::binOf(double z) {
  const double bin = std::floor(z / kBin) - 1.0;
  return bin >= 0.0 && bin < static_cast<double>(kBins) ? &bins_[static_cast<std::size_t>(bin)]
                                                        : nullptr;
}

void FloorNoise::add(const DepthView& depth, const CameraModel& camera,
                     const Detection& detection) {
  if (!detection.found()) return;
  ++images_;
  const Heights heights(depth, camera, detection);
  addPixels(heights);
  for (int size = 0; size < kSizes; ++size) addBlocks(heights, size);
  addWindows(heights);
}

void FloorNoise::addPixels(const Heights& h) {
  for (int v = 0; v < h.floor.rows; v += kPixelStep) {
    for (int u = 0; u + 1 < h.floor.cols; u += kPixelStep) {
      Bin* bin = binOf(static_cast<double>(h.depth.at<float>(v, u)));
      if (bin == nullptr) continue;
      const float height = h.height.at<float>(v, u);
      ++bin->readings;
      bin->square_height += std::pow(static_cast<double>(height), 2);
      if (h.floor.at<float>(v, u + 1) == 0.0F) continue;
      bin->differences.push_back(std::abs(h.height.at<float>(v, u + 1) - height));
    }
  }
}

/// @param size 0, 1, 2 for blocks of 4, 8, 16 px.
void FloorNoise::addBlocks(const Heights& h, int size) {
  const int block = 4 << size;
  const cv::Mat count = blockSums(h.floor, block);
  cv::Mat used;  // 1 where half of it is read
  cv::Mat(count >= 0.5 * block * block).convertTo(used, CV_32F, 1.0 / 255.0);
  cv::Mat mean, depth;
  cv::divide(blockSums(h.height, block), cv::max(count, 1.0), mean);
  cv::divide(blockSums(h.depth, block), cv::max(count, 1.0), depth);
  mean = mean.mul(used);
  const cv::Mat blocks = windowSums(used, kBlocks), sums = windowSums(mean, kBlocks);
  for (int y = 0; y < mean.rows; ++y) {
    for (int x = 0; x < mean.cols; ++x) {
      // Where a quarter of the window is floor, as for the detection.
      if (used.at<float>(y, x) == 0.0F || 4.0F * blocks.at<float>(y, x) < kBlocks * kBlocks)
        continue;
      Bin* bin = binOf(static_cast<double>(depth.at<float>(y, x)));
      if (bin == nullptr) continue;
      bin->locals[static_cast<std::size_t>(size)].push_back(
          std::abs(mean.at<float>(y, x) - sums.at<float>(y, x) / blocks.at<float>(y, x)));
    }
  }
}

void FloorNoise::addWindows(const Heights& h) {
  const cv::Mat count = windowSums(h.floor, kWindow);
  const cv::Mat height = windowSums(h.height, kWindow), depth = windowSums(h.depth, kWindow);
  for (int v = kWindowStep / 2; v < h.floor.rows; v += kWindowStep) {
    for (int u = kWindowStep / 2; u < h.floor.cols; u += kWindowStep) {
      const auto readings = static_cast<double>(count.at<float>(v, u));
      if (readings < 0.5 * kWindow * kWindow) continue;
      Bin* bin = binOf(static_cast<double>(depth.at<float>(v, u)) / readings);
      if (bin == nullptr) continue;
      bin->windows.push_back(std::abs(height.at<float>(v, u) / count.at<float>(v, u)));
    }
  }
}

std::vector<FloorNoiseFigures> FloorNoise::figures() const {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  std::vector<FloorNoiseFigures> all;
  for (const Bin& bin : bins_) {
    FloorNoiseFigures f;
    f.nearest = kBin * static_cast<double>(all.size() + 1);
    f.farthest = f.nearest + kBin;
    f.readings = bin.readings;
    f.height = bin.readings < kMinFigures
                   ? kNaN
                   : std::sqrt(bin.square_height / static_cast<double>(bin.readings));
    f.neighbour = medianOf(bin.differences) / (kMedian * std::sqrt(2.0));
    f.local = kNaN;
    for (const std::vector<float>& locals : bin.locals) {
      f.local = std::fmax(f.local, medianOf(locals) / kMedian);
    }
    f.smooth = medianOf(bin.windows) / kMedian;
    all.push_back(f);
  }
  return all;
}

NoiseModel FloorNoise::localError(const std::vector<FloorNoiseFigures>& figures) {
  return fit(figures, &FloorNoiseFigures::local);
}
NoiseModel FloorNoise::smoothError(const std::vector<FloorNoiseFigures>& figures) {
  return fit(figures, &FloorNoiseFigures::smooth);
}

}  // namespace dominant_plane_detection
