#pragma once

#include <cstddef>
#include <cstdint>

namespace dominant_plane_detection {

/// A depth image that somebody else owns; read in place, never copied.
///
/// 16-bit pixels hold multiples of `metres_per_unit` with 0 for "no reading"; float pixels hold
/// metres with NaN, infinities and values <= 0 for "no reading" (REP 118).
struct DepthView {
  enum class Type : std::uint8_t { kUint16, kFloat32 };

  DepthView() = default;
  /// @param image_step [byte] 0: the rows follow each other without a gap.
  DepthView(const std::uint16_t* pixels, int image_width, int image_height,
            float unit_in_metres = 0.001F, std::size_t image_step = 0)
      : DepthView(pixels, image_width, image_height, image_step, Type::kUint16, unit_in_metres) {}
  DepthView(const float* pixels, int image_width, int image_height, std::size_t image_step = 0)
      : DepthView(pixels, image_width, image_height, image_step, Type::kFloat32, 1.0F) {}

  const void* data = nullptr;
  int width = 0;                   ///< [px]
  int height = 0;                  ///< [px]
  std::size_t step = 0;            ///< [byte] from one row to the next, at least width * pixel size
  Type type = Type::kUint16;       ///< native byte order
  float metres_per_unit = 0.001F;  ///< [m] one unit of a 16-bit pixel; float pixels ignore it

  /// @return the first pixel of row `v`; `T` has to be the pixel type that `type` names.
  template <typename T>
  const T* row(int v) const {
    return reinterpret_cast<const T*>(static_cast<const std::uint8_t*>(data) +
                                      static_cast<std::size_t>(v) * step);
  }

 private:
  DepthView(const void* pixels, int image_width, int image_height, std::size_t image_step,
            Type pixel_type, float unit_in_metres)
      : data(pixels),
        width(image_width),
        height(image_height),
        step(image_step),
        type(pixel_type),
        metres_per_unit(unit_in_metres) {
    const std::size_t pixel = pixel_type == Type::kUint16 ? sizeof(std::uint16_t) : sizeof(float);
    if (step == 0 && width > 0) step = static_cast<std::size_t>(width) * pixel;
  }
};

/// @return [byte] the size of one pixel.
inline std::size_t pixelSize(DepthView::Type type) {
  return type == DepthView::Type::kUint16 ? sizeof(std::uint16_t) : sizeof(float);
}

/// @return [m] the factor that turns a pixel of the view into metres.
inline float metresPerUnit(const DepthView& depth) {
  return depth.type == DepthView::Type::kUint16 ? depth.metres_per_unit : 1.0F;
}

/// @return [m] the reading of pixel (u, v), with whatever stands for "no reading" in it. For single
/// pixels and pictures; loops over whole images in the core are vectorised.
inline float metresAt(const DepthView& depth, int u, int v) {
  return depth.type == DepthView::Type::kUint16
             ? depth.metres_per_unit * static_cast<float>(depth.row<std::uint16_t>(v)[u])
             : depth.row<float>(v)[u];
}

}  // namespace dominant_plane_detection
