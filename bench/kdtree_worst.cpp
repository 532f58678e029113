// The paper's algorithm before images that are hard for it: thread CPU time and work of each.
// kdtree_worst [PART] tries those with PART in their names.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "core/kdtree_search.h"
#include "core/plane_selection.h"
#include "core/ray_table.h"
#include "support/synthetic_depth.h"

namespace dominant_plane_detection {
namespace {

using Image = OwnedDepth<float>;

struct NamedImage {
  std::string name;
  Image depth;
};

struct NamedParameters {
  std::string name;
  Parameters parameters;
};

double threadSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// @param depth_at [m] of pixel (u, v) along a ray (x, y, 1).
Image draw(const std::function<double(int u, int v, double x, double y)>& depth_at) {
  const CameraModel camera = testCamera();
  Image image(camera.width, camera.height);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector2d ray = camera.ray({u, v});
      image.at(u, v) = static_cast<float>(depth_at(u, v, ray.x(), ray.y()));
    }
  }
  return image;
}

/// Adds noise of a standard deviation of constant + quadratic z^2.
Image noisy(Image image, double constant, double quadratic) {
  std::mt19937 generator(1);
  std::normal_distribution<double> gauss;
  for (float& z : image.pixels) {
    const auto depth = static_cast<double>(z);
    z = static_cast<float>(depth + (constant + quadratic * depth * depth) * gauss(generator));
  }
  return image;
}

std::vector<NamedImage> images() {
  std::vector<NamedImage> all;
  const auto wall = [](double distance) {
    return draw([=](int, int, double, double) { return distance; });
  };
  const Image floor = planeDepth(testCamera(), upOf(0.5, 0.1), 0.8);
  for (const double distance : {0.06, 0.1, 0.6, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 3.9}) {
    char name[32];
    std::snprintf(name, sizeof(name), "wall %.2f m", distance);
    all.push_back({name, noisy(wall(distance), 0.0, 1.4e-3)});
  }
  all.push_back({"wall 2.5 m, exact", wall(2.5)});
  all.push_back({"floor", noisy(floor, 0.0, 1.4e-3)});
  all.push_back({"floor, exact", floor});
  for (const double wave : {0.05, 0.2, 0.6}) {
    for (const double height : {0.005, 0.02, 0.05}) {
      char name[48];
      std::snprintf(name, sizeof(name), "wavy floor %.2f m, %.3f m", wave, height);
      Image image = floor;
      const CameraModel camera = testCamera();
      for (int v = 0; v < camera.height; ++v) {
        for (int u = 0; u < camera.width; ++u) {
          const auto z = static_cast<double>(image.at(u, v));
          const double x = z * camera.ray({u, v}).x();
          image.at(u, v) +=
              static_cast<float>(height * std::sin(6.28 * x / wave) * std::cos(6.28 * z / wave));
        }
      }
      all.push_back({name, noisy(image, 0.001, 0.0)});
    }
  }
  for (const double sigma : {0.02, 0.05, 0.1, 0.3}) {
    char name[32];
    std::snprintf(name, sizeof(name), "wall 2 m, noise %.2f m", sigma);
    all.push_back({name, noisy(wall(2.0), sigma, 0.0)});
    std::snprintf(name, sizeof(name), "floor, noise %.2f m", sigma);
    all.push_back({name, noisy(floor, sigma, 0.0)});
  }
  for (const double radius : {0.3, 0.8}) {
    char name[32];
    std::snprintf(name, sizeof(name), "sphere of %.1f m", radius);
    all.push_back({name, draw([=](int, int, double x, double y) {
                     const double r2 = x * x + y * y, middle = radius + 0.55;
                     const double root = radius * radius * (1.0 + r2) - middle * middle * r2;
                     return root > 0.0 ? (middle - std::sqrt(root)) / (1.0 + r2) : 2.0;
                   })});
    std::snprintf(name, sizeof(name), "inside a sphere of %.1f m", radius);
    all.push_back({name, draw([=](int, int, double x, double y) {
                     return radius / std::sqrt(1.0 + x * x + y * y);
                   })});
  }
  std::mt19937 generator(1);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator);
  };
  for (const double deep : {0.02, 0.1, 0.3, 3.0}) {
    char name[48];
    std::snprintf(name, sizeof(name), "random depths of 0.6 m and %.2f m more", deep);
    all.push_back({name, draw([&](int, int, double, double) { return 0.6 + uniform(0.0, deep); })});
  }
  for (const int tile : {1, 2, 16}) {
    for (const double step : {0.01, 0.03, 0.08}) {
      char name[48];
      std::snprintf(name, sizeof(name), "checkerboard %d px, %.2f m", 2 * tile, step);
      all.push_back({name, draw([=](int u, int v, double, double) {
                       return 0.6 + ((u / (2 * tile) + v / (2 * tile)) % 2) * step;
                     })});
    }
  }
  for (const int tread : {16, 64}) {
    char name[32];
    std::snprintf(name, sizeof(name), "steps of %d rows", tread);
    all.push_back(
        {name, draw([=](int, int v, double, double) { return 0.6 + 0.03 * (v / tread); })});
  }
  all.push_back({"specks before a wall", draw([](int u, int v, double, double) {
                   return u % 32 < 8 && v % 32 < 8 ? 0.09 : 0.13;
                 })});
  all.push_back({"a speck before a wall", draw([](int u, int v, double, double) {
                   return std::abs(u - 320) < 6 && std::abs(v - 400) < 6 ? 0.06 : 0.12;
                 })});
  all.push_back({"a patch before a wall", draw([](int u, int v, double, double) {
                   return std::abs(u - 320) < 120 && std::abs(v - 300) < 120 ? 0.09 : 0.13;
                 })});
  all.push_back({"a bowl round a patch", draw([](int u, int v, double x, double y) {
                   if (std::abs(u - 320) < 20 && std::abs(v - 240) < 20) return 0.06;
                   const double r2 = 1.0 + x * x + y * y, c = 0.06;  // 9.5 cm about the patch
                   return (c + std::sqrt(c * c - r2 * (c * c - 0.095 * 0.095))) / r2;
                 })});
  return all;
}

std::vector<NamedParameters> parameterSets() {
  std::vector<NamedParameters> all;
  Parameters near;
  near.algorithm = Algorithm::kKdtree;
  all.push_back({"defaults", near});
  near.range_min = 0.05;
  Parameters wide = near;
  wide.delta = {0.1, 0.0};
  for (const double epsilon : {0.002, 0.02, 1.0}) {
    for (const double gamma : {0.005, 0.05}) {
      char name[64];
      std::snprintf(name, sizeof(name), "delta 0.1, epsilon %.3f, gamma %.3f", epsilon, gamma);
      Parameters p = wide;
      p.epsilon = {epsilon, 0.0};
      p.gamma = {gamma, 0.0};
      all.push_back({name, p});
    }
  }
  for (const NoiseModel& noise : {NoiseModel{0.01, 0.0}, {0.1, 0.1}}) {
    char name[64];
    std::snprintf(name, sizeof(name), "delta 0.1, noise %.2f + %.1f z^2", noise.constant,
                  noise.quadratic);
    Parameters p = wide;
    p.noise = noise;
    all.push_back({name, p});
  }
  return all;
}

/// @param part of the names of the images that are tried.
void run(const std::string& part) {
  const CameraModel camera = testCamera();
  RayTable rays;
  rays.build(camera);
  const std::vector<NamedParameters> sets = parameterSets();
  double slowest_of_all = 0.0;
  std::printf("%-40s %10s %10s   %s\n", "image", "defaults", "worst", "parameters of the worst");
  for (const NamedImage& image : images()) {
    if (image.name.find(part) == std::string::npos) continue;
    double at_defaults = 0.0, slowest = 0.0;
    std::string slowest_name;
    for (const NamedParameters& set : sets) {
      const Parameters& p = set.parameters;
      const DepthView view = image.depth.view();
      const ImageInput input{
          view, rays, {1.0F, static_cast<float>(p.range_min), static_cast<float>(p.range_max)}};
      PlaneSelection selection(
          {p.expected_up, p.max_tilt, p.min_height, p.max_height, 640U * 480U / 20U});
      KdtreeSearch search;
      const double begin = threadSeconds();
      Effort effort;
      search.run(input, p, selection, effort);
      const double seconds = threadSeconds() - begin;
      if (set.name == "defaults") at_defaults = seconds;
      if (seconds <= slowest) continue;
      slowest = seconds;
      char counts[128];
      std::snprintf(counts, sizeof(counts),
                    "; %zu seeds, %zu tests, %zu searches, %zu decompositions", effort.seeds,
                    effort.tests, effort.searches, effort.fits);
      slowest_name = set.name + counts;
    }
    slowest_of_all = std::max(slowest_of_all, slowest);
    std::printf("%-40s %7.0f ms %7.0f ms   %s\n", image.name.c_str(), 1e3 * at_defaults,
                1e3 * slowest, slowest_name.c_str());
    std::fflush(stdout);
  }
  std::printf("slowest: %.0f ms\n", 1e3 * slowest_of_all);
}

}  // namespace
}  // namespace dominant_plane_detection

int main(int argc, char** argv) { dominant_plane_detection::run(argc > 1 ? argv[1] : ""); }
