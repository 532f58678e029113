#include "synthetic/renderer.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "dominant_plane_detection/detection.h"
#include "synthetic/camera_rays.h"

namespace dominant_plane_detection {
namespace {

/// [m] by which rays towards the projector start off the surface.
constexpr float kSurfaceOffset = 1e-3F;

void addMesh(RTCDevice device, RTCScene scene, const TriangleMesh& mesh) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                           sizeof(mesh.vertices[0]), mesh.vertices.size());
  std::memcpy(vertices, mesh.vertices.data(), mesh.vertices.size() * sizeof(mesh.vertices[0]));
  void* triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            sizeof(mesh.triangles[0]), mesh.triangles.size());
  std::memcpy(triangles, mesh.triangles.data(), mesh.triangles.size() * sizeof(mesh.triangles[0]));
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

RTCRay rayFrom(const Eigen::Vector3f& origin) {
  RTCRay ray{};
  ray.org_x = origin.x();
  ray.org_y = origin.y();
  ray.org_z = origin.z();
  ray.mask = std::numeric_limits<unsigned>::max();
  return ray;
}

/// @param far in lengths of `direction`; negative: Embree skips the ray.
void aim(const Eigen::Vector3f& direction, float far, RTCRay& ray) {
  ray.dir_x = direction.x();
  ray.dir_y = direction.y();
  ray.dir_z = direction.z();
  ray.tfar = far;
}

}  // namespace

class Renderer::Implementation {
 public:
  explicit Implementation(const Scene& scene)
      : objects_(scene.objects), camera_(scene.camera), rays_(cameraRays(scene.camera)) {
    device_ = rtcNewDevice("threads=1");
    if (device_ == nullptr) throw std::runtime_error("Embree does not start on this machine");
    scene_ = rtcNewScene(device_);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    for (const SceneObject& object : objects_) addMesh(device_, scene_, object.mesh);
    rtcCommitScene(scene_);
  }
  ~Implementation() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  Rendering render(const Eigen::Isometry3d& pose, const Layers& layers) const {
    Rendering rendering;
    rendering.width = camera_.width;
    rendering.height = camera_.height;
    rendering.focal_length = camera_.fx;
    const auto pixels =
        static_cast<std::size_t>(camera_.width) * static_cast<std::size_t>(camera_.height);
    rendering.depth.resize(pixels);
    rendering.cosine.resize(pixels);
    rendering.labels.resize(pixels);
    if (layers.colour) rendering.colour.resize(3 * pixels);
    if (layers.shadow) rendering.shadow.resize(pixels);
    if (layers.surface_normals) rendering.surface_normals.resize(pixels, Eigen::Vector3f::Zero());
    // The plane z = 0, seen from the camera.
    rendering.normal = pose.linear().transpose() * Eigen::Vector3d::UnitZ();
    rendering.distance = pose.translation().z();

    Row row(pose.cast<float>(), static_cast<std::size_t>(camera_.width));
    for (int v = 0; v < camera_.height; ++v) {
      castRow(pose.cast<float>(), v, row);
      shadeRow(pose.cast<float>(), v, row, rendering);
      if (layers.shadow) shadowRow(v, row, rendering);
    }
    return rendering;
  }

 private:
  /// Rays of an image row, cast together: Embree is several times faster at neighbours in a bunch.
  struct Row {
    Row(const Eigen::Isometry3f& pose, std::size_t size)
        // The projector stands to the right of the camera, as a Kinect v1 has it.
        : projector(pose * Eigen::Vector3f(static_cast<float>(SensorNoise::kBaseline), 0.0F, 0.0F)),
          hits(size, RTCRayHit{rayFrom(pose.translation()), RTCHit{}}),
          shadow_rays(size, rayFrom(projector)),  // rays with a common origin are faster
          surface(size, projector) {}
    Eigen::Vector3f projector;  ///< [m]
    std::vector<RTCRayHit> hits;
    std::vector<RTCRay> shadow_rays;
    std::vector<Eigen::Vector3f> surface;  ///< [m] where rays to the projector start
  };

  static RTCIntersectContext coherentContext() {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    return context;
  }

  static bool hasHit(const RTCRayHit& hit) { return hit.hit.geomID != RTC_INVALID_GEOMETRY_ID; }

  void castRow(const Eigen::Isometry3f& pose, int v, Row& row) const {
    std::size_t pixel = static_cast<std::size_t>(v) * row.hits.size();
    for (RTCRayHit& hit : row.hits) {
      const Eigen::Vector3f ray = rays_[pixel++].homogeneous();
      // The direction's z is 1 in the optical frame: the ray's parameter is the depth. Where the
      // lens sees nothing the ray is switched off: Embree skips what ends before it begins.
      const bool usable = !std::isnan(ray.x());
      const Eigen::Vector3f direction = pose.linear() * (usable ? ray : Eigen::Vector3f::UnitZ());
      aim(direction, usable ? std::numeric_limits<float>::infinity() : -1.0F, hit.ray);
      hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    }
    RTCIntersectContext context = coherentContext();
    rtcIntersect1M(scene_, &context, row.hits.data(), static_cast<unsigned>(row.hits.size()),
                   sizeof(RTCRayHit));
  }

  void shadeRow(const Eigen::Isometry3f& pose, int v, Row& row, Rendering& rendering) const {
    std::size_t i = static_cast<std::size_t>(v) * row.hits.size();
    for (std::size_t u = 0; u < row.hits.size(); ++u, ++i) {
      const RTCRayHit& hit = row.hits[u];
      if (!hasHit(hit)) continue;
      const SceneObject& object = objects_[hit.hit.geomID];
      const Eigen::Vector3f direction(hit.ray.dir_x, hit.ray.dir_y, hit.ray.dir_z);
      const Eigen::Vector3f point = pose.translation() + hit.ray.tfar * direction;
      Eigen::Vector3f normal(hit.hit.Ng_x, hit.hit.Ng_y, hit.hit.Ng_z);
      normal /= std::copysign(normal.norm(), -normal.dot(direction));
      rendering.depth[i] = hit.ray.tfar;
      rendering.cosine[i] = -normal.dot(direction) / direction.norm();
      rendering.labels[i] = static_cast<std::uint8_t>(label(object, point));
      if (!rendering.colour.empty()) {
        paint(object, point, normal, rendering.cosine[i], &rendering.colour[3 * i]);
      }
      if (!rendering.surface_normals.empty()) {
        rendering.surface_normals[i] = pose.linear().transpose() * normal;
      }
      row.surface[u] = point + kSurfaceOffset * normal;
    }
  }

  void shadowRow(int v, Row& row, Rendering& rendering) const {
    for (std::size_t u = 0; u < row.hits.size(); ++u) {
      const bool seen = hasHit(row.hits[u]);
      aim(row.surface[u] - row.projector, seen ? 1.0F : -1.0F, row.shadow_rays[u]);
    }
    RTCIntersectContext context = coherentContext();
    rtcOccluded1M(scene_, &context, row.shadow_rays.data(),
                  static_cast<unsigned>(row.shadow_rays.size()), sizeof(RTCRay));
    const std::size_t begin = static_cast<std::size_t>(v) * row.hits.size();
    for (std::size_t u = 0; u < row.hits.size(); ++u) {
      // A negative end is how Embree says occluded.
      rendering.shadow[begin + u] = hasHit(row.hits[u]) && row.shadow_rays[u].tfar < 0.0F ? 1 : 0;
    }
  }

  static Label label(const SceneObject& object, const Eigen::Vector3f& point) {
    if (object.ground) return Label::kGround;
    return point.z() > 0.0F ? Label::kObstacle : Label::kDropOff;
  }

  /// Lambert's law with a light above and one at the camera.
  static void paint(const SceneObject& object, const Eigen::Vector3f& point,
                    const Eigen::Vector3f& normal, float cosine, std::uint8_t* pixel) {
    const float above = std::max(normal.dot(Eigen::Vector3f(0.3F, 0.2F, 0.93F)), 0.0F);
    float light = 0.25F + 0.45F * above + 0.3F * cosine;
    if (object.tiles > 0.0) {
      const auto side = static_cast<float>(object.tiles);
      const bool dark = (static_cast<int>(std::floor(point.x() / side)) +
                         static_cast<int>(std::floor(point.y() / side))) %
                            2 !=
                        0;
      light *= dark ? 0.85F : 1.0F;
    }
    for (int channel = 0; channel < 3; ++channel) {
      const float value = 255.0F * light * static_cast<float>(object.colour[channel]);
      pixel[channel] = static_cast<std::uint8_t>(std::clamp(value, 0.0F, 255.0F));
    }
  }

  std::vector<SceneObject> objects_;
  CameraModel camera_;
  std::vector<Eigen::Vector2f> rays_;  ///< [-] as `cameraRays`
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
};

Renderer::Renderer(const Scene& scene) : implementation_(std::make_unique<Implementation>(scene)) {}
Renderer::~Renderer() = default;

Rendering Renderer::render(const Eigen::Isometry3d& pose, const Layers& layers) const {
  return implementation_->render(pose, layers);
}

}  // namespace dominant_plane_detection
