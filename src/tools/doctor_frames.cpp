#include <stdexcept>

#include "doctor/image_rules.h"
#include "doctor_report.h"
#include "doctor_sample.h"
#include "inputs.h"

namespace dominant_plane_detection {
DoctorReport examineFrames(const std::string& path, const DoctorSettings& settings,
                           const SourceOptions& options) {
  SourceOptions corrected = options;
  corrected.correction = settings.correction;
  const Inputs inputs = openInputs({path}, corrected);
  if (!inputs.errors.empty()) throw std::runtime_error(inputs.errors.front());
  const std::size_t every = sampleStep(inputs.frames());
  ImageStudy study(settings.detection);
  std::size_t number = 0;
  for (const auto& source : inputs.sources) {
    while (const auto frame = source->next()) {
      if (number++ % every == 0) study.add(frame->depth, frame->camera);
    }
  }
  return {path,
          std::to_string(study.images()) + " of " + std::to_string(inputs.frames()) +
              " depth images, " + std::to_string(study.planes()) + " with a plane",
          study.findings()};
}

}  // namespace dominant_plane_detection
