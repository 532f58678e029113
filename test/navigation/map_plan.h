#pragma once

#include <algorithm>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <set>
#include <vector>

#include "navigation/map_drive.h"
#include "navigation/map_robot.h"
#include "navigation/room_things.h"

namespace dominant_plane_detection {

constexpr double kArea = 0.5 * kCell * kCell;  // [m^2] of things in a cell that counts

/// What the exact images have shown, over the world.
class Seen {
 public:
  void add(double time, const Scene& scene, const std::vector<Thing>& things,
           const Rendering& exact, const Eigen::Isometry3d& camera, double free_range) {
    RayTable rays;
    rays.build(scene.camera);
    std::set<WorldCell> floor;
    std::map<WorldCell, double> obstacles;
    const double pixel = 1.0 / (scene.camera.fx * scene.camera.fy);
    std::vector<double> areas(things.size(), 0.0);
    for (int v = 0; v < exact.height; ++v) {
      for (int u = 0; u < exact.width; ++u) {
        const std::size_t i = static_cast<std::size_t>(v * exact.width + u);
        const double z = static_cast<double>(exact.depth[i]);
        if (!(z > 0.5 && z < free_range)) continue;
        const Eigen::Vector3d at = camera * (z * rays.ray(u, v).cast<double>());
        if (exact.labels[i] == static_cast<std::uint8_t>(Label::kGround)) {
          floor.insert(cellOf(at.head<2>()));
          continue;
        }
        obstacles[cellOf(at.head<2>())] += pixel * z * z;
        for (std::size_t k = 0; k < things.size(); ++k) {
          if (things[k].distanceTo(at.head<2>()) < 0.003) areas[k] += pixel * z * z;
        }
      }
    }
    for (const WorldCell& cell : floor) floor_[cell].push_back(time);
    for (const auto& [cell, area] : obstacles) {
      if (area >= kArea) obstacles_[cell].push_back(time);
    }
    things_.resize(areas.size());
    for (std::size_t k = 0; k < areas.size(); ++k) {
      if (areas[k] >= 2.0 * kArea) things_[k].push_back(time);
    }
  }
  bool floor(const WorldCell& cell, double now) const { return lately(floor_, cell, now); }
  bool obstacle(const WorldCell& cell, double now) const { return lately(obstacles_, cell, now); }
  bool thing(std::size_t k, double now) const { return lately(things_[k], now); }

 private:
  using Times = std::map<WorldCell, std::vector<double>>;
  static bool lately(const Times& times, const WorldCell& cell, double now) {
    const auto found = times.find(cell);
    return found != times.end() && lately(found->second, now);
  }
  static bool lately(const std::vector<double>& times, double now) {
    return times.size() >= 3 && times[times.size() - 3] > now - kMemory;
  }

  Times floor_, obstacles_;
  std::vector<std::vector<double>> things_;
};

/// A map against the plan, cell by cell of the map.
class Comparison {
 public:
  /// @param T_world_map where odometry has the robot now.
  Comparison(const LocalMap& map, const std::vector<Thing>& things, const Seen& seen, double now,
             const Eigen::Isometry2d& T_world_map)
      : cells_(map.grid().cells()) {
    const std::size_t all = map.grid().size();
    for (auto* cells : {&free_, &occupied_, &true_free_, &counts_, &thing_, &seen_thing_}) {
      cells->resize(all);
    }
    for (int y = 0; y < cells_; ++y) {
      for (int x = 0; x < cells_; ++x) {
        const Eigen::Vector2d place =
            T_world_map * (map.grid().origin() + kCell * Eigen::Vector2d(x + 0.5, y + 0.5));
        const std::size_t i = at(x, y);
        free_[i] = map.state(x, y) == LocalMap::kFree;
        occupied_[i] = map.state(x, y) == LocalMap::kOccupied;
        counts_[i] = seen.floor(cellOf(place), now);
        seen_thing_[i] = seen.obstacle(cellOf(place), now);
        const bool low = std::any_of(things.begin(), things.end(), [&](const Thing& t) {
          return t.distanceTo(place) < 0.5 * kCell;
        });
        thing_[i] = low;
        true_free_[i] = counts_[i] && !low;
      }
    }
  }

  void judge(MapFigures& figures) const {
    int both = 0, one = 0;
    forEach([&](int x, int y, std::size_t i) {
      if (true_free_[i]) ++(near(free_, x, y) ? both : one);
      if (free_[i] && counts_[i] && !near(true_free_, x, y)) ++one;
      figures.left_free += free_[i] && seen_thing_[i] && !near(occupied_, x, y);
      figures.obstacle_cells += seen_thing_[i];
    });
    if (both + one < 50) return;
    const double iou = static_cast<double>(both) / (both + one);
    ++figures.maps;
    figures.sum_iou += iou;
    figures.least_iou = std::min(figures.least_iou, iou);
  }
  /// @return whether a cell on a thing, or next to it, is occupied.
  bool shows(const Thing& thing, const LocalMap& map, const Eigen::Isometry2d& T_world_map) const {
    bool shown = false;
    forEach([&](int x, int y, std::size_t i) {
      const Eigen::Vector2d place =
          T_world_map * (map.grid().origin() + kCell * Eigen::Vector2d(x + 0.5, y + 0.5));
      shown = shown || (occupied_[i] && thing.distanceTo(place) < 1.5 * kCell);
    });
    return shown;
  }
  cv::Mat picture() const {
    cv::Mat image(cells_, 2 * cells_ + 4, CV_8UC3, cv::Scalar(255, 255, 255));
    forEach([&](int x, int y, std::size_t i) {
      const cv::Vec3b map = occupied_[i] ? cv::Vec3b(0, 0, 0)
                            : free_[i]   ? cv::Vec3b(240, 240, 240)
                                         : cv::Vec3b(150, 140, 120);
      const cv::Vec3b plan = thing_[i]       ? cv::Vec3b(0, 0, 0)
                             : true_free_[i] ? cv::Vec3b(240, 240, 240)
                                             : cv::Vec3b(150, 140, 120);
      image.at<cv::Vec3b>(cells_ - 1 - y, x) = map;
      image.at<cv::Vec3b>(cells_ - 1 - y, cells_ + 4 + x) = plan;
    });
    cv::Mat large;
    cv::resize(image, large, {}, 4, 4, cv::INTER_NEAREST);
    return large;
  }

 private:
  std::size_t at(int x, int y) const { return static_cast<std::size_t>(y * cells_ + x); }
  template <typename Visit>
  void forEach(Visit&& visit) const {
    for (int y = 0; y < cells_; ++y) {
      for (int x = 0; x < cells_; ++x) visit(x, y, at(x, y));
    }
  }
  /// @return whether one of a cell and those about it is in a set.
  bool near(const std::vector<bool>& cells, int x, int y) const {
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, cells_ - 1); ++j) {
      for (int i = std::max(x - 1, 0); i <= std::min(x + 1, cells_ - 1); ++i) {
        if (cells[at(i, j)]) return true;
      }
    }
    return false;
  }

  int cells_;
  std::vector<bool> free_, occupied_, true_free_, counts_, thing_, seen_thing_;
};

}  // namespace dominant_plane_detection
