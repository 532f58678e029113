#include "synthetic/renderer.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "dominant_plane_detection/detection.h"

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

RTCRay makeRay(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float far) {
  RTCRay ray{};
  ray.org_x = origin.x();
  ray.org_y = origin.y();
  ray.org_z = origin.z();
  ray.dir_x = direction.x();
  ray.dir_y = direction.y();
  ray.dir_z = direction.z();
  ray.tfar = far;
  ray.mask = std::numeric_limits<unsigned>::max();
  return ray;
}

}  // namespace

class Renderer::Implementation {
 public:
  explicit Implementation(const Scene& scene) : objects_(scene.objects) {
    rays_.build(scene.camera);
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

  Rendering render(const Eigen::Isometry3d& pose, bool shadows) const {
    const CameraModel& camera = rays_.camera();
    Rendering rendering;
    rendering.width = camera.width;
    rendering.height = camera.height;
    rendering.focal_length = camera.fx;
    const auto pixels =
        static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
    rendering.depth.resize(pixels);
    rendering.cosine.resize(pixels);
    rendering.labels.resize(pixels);
    rendering.colour.resize(3 * pixels);
    if (shadows) rendering.shadow.resize(pixels);
    // The plane z = 0, seen from the camera.
    rendering.normal = pose.linear().transpose() * Eigen::Vector3d::UnitZ();
    rendering.distance = pose.translation().z();

    for (int v = 0; v < camera.height; ++v) renderRow(pose.cast<float>(), v, shadows, rendering);
    return rendering;
  }

 private:
  void renderRow(const Eigen::Isometry3f& pose, int v, bool shadows, Rendering& rendering) const {
    for (int u = 0; u < rendering.width; ++u) {
      const Eigen::Vector3f ray = rays_.ray(u, v);
      if (std::isnan(ray.x())) continue;
      // The direction's z is 1 in the optical frame: the ray's parameter is the depth.
      const Eigen::Vector3f direction = pose.linear() * ray;
      RTCRayHit hit{};
      hit.ray = makeRay(pose.translation(), direction, std::numeric_limits<float>::infinity());
      hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
      rtcIntersect1(scene_, &context, &hit);
      if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;

      const std::size_t i =
          static_cast<std::size_t>(v) * static_cast<std::size_t>(rendering.width) +
          static_cast<std::size_t>(u);
      const SceneObject& object = objects_[hit.hit.geomID];
      const Eigen::Vector3f point = pose.translation() + hit.ray.tfar * direction;
      Eigen::Vector3f normal(hit.hit.Ng_x, hit.hit.Ng_y, hit.hit.Ng_z);
      normal.normalize();
      if (normal.dot(direction) > 0.0F) normal = -normal;
      rendering.depth[i] = hit.ray.tfar;
      rendering.cosine[i] = -normal.dot(direction.normalized());
      rendering.labels[i] = static_cast<std::uint8_t>(label(object, point));
      paint(object, point, normal, rendering.cosine[i], &rendering.colour[3 * i]);
      if (shadows) {
        // The projector stands to the right of the camera, as a Kinect v1 has it.
        const auto baseline = static_cast<float>(SensorNoise::kBaseline);
        const Eigen::Vector3f projector = pose * Eigen::Vector3f(baseline, 0.0F, 0.0F);
        rendering.shadow[i] = occluded(point + kSurfaceOffset * normal, projector) ? 1 : 0;
      }
    }
  }

  bool occluded(const Eigen::Vector3f& from, const Eigen::Vector3f& to) const {
    RTCRay ray = makeRay(from, to - from, 1.0F);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene_, &context, &ray);
    return ray.tfar < 0.0F;  // how Embree says yes
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
  RayTable rays_;
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
};

Renderer::Renderer(const Scene& scene) : implementation_(std::make_unique<Implementation>(scene)) {}
Renderer::~Renderer() = default;

Rendering Renderer::render(const Eigen::Isometry3d& pose, bool shadows) const {
  return implementation_->render(pose, shadows);
}

}  // namespace dominant_plane_detection
