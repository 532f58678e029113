#include "inputs.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <utility>

namespace dominant_plane_detection {
namespace {

namespace fs = std::filesystem;

std::string extension(const fs::path& path) {
  std::string text = path.extension().string();
  std::transform(text.begin(), text.end(), text.begin(), [](char c) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  });
  return text;
}

std::vector<std::string> pngFilesIn(const fs::path& folder) {
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && extension(entry.path()) == ".png") {
      files.push_back(entry.path().string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// The stem of each file, with its folder's name before it where a stem comes more than once.
std::vector<std::string> frameNames(const std::vector<std::string>& files) {
  std::map<std::string, int> stems;
  for (const std::string& file : files) ++stems[fs::path(file).stem().string()];
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const std::string& file : files) {
    const fs::path path = fs::absolute(file);
    const std::string stem = path.stem().string();
    std::string name = stem;
    if (stems[stem] > 1) name = path.parent_path().filename().string() + "_" + stem;
    // Equal folder names, too: number what would otherwise be written over.
    const std::string base = name;
    for (int i = 2; !taken.insert(name).second; ++i) name = base + "_" + std::to_string(i);
    names.push_back(name);
  }
  return names;
}

/// The images of another source, corrected.
class CorrectedSource : public FrameSource {
 public:
  CorrectedSource(std::unique_ptr<FrameSource> source, const DepthCorrection& correction)
      : source_(std::move(source)), correction_(correction) {}

  std::size_t size() const override { return source_->size(); }
  std::optional<Frame> next() override {
    std::optional<Frame> frame = source_->next();
    if (frame) frame->depth = correction_.correct(frame->depth);
    return frame;
  }

 private:
  std::unique_ptr<FrameSource> source_;
  DepthCorrection correction_;
};

}  // namespace

std::size_t Inputs::frames() const {
  std::size_t frames = 0;
  for (const auto& source : sources) frames += source->size();
  return frames;
}

Inputs openInputs(const std::vector<std::string>& paths, const SourceOptions& options) {
  Inputs inputs;
  std::vector<std::string> png_files;
  for (const std::string& path : paths) {
    std::error_code error;
    if (fs::is_directory(path, error)) {
      const auto files = pngFilesIn(path);
      if (files.empty()) inputs.errors.push_back(path + ": there are no PNG files in this folder");
      png_files.insert(png_files.end(), files.begin(), files.end());
    } else if (!fs::exists(path, error)) {
      inputs.errors.push_back(path + ": there is no such file or folder");
    } else if (extension(path) == ".png") {
      png_files.push_back(path);
    } else if (extension(path) == ".bag" || extension(path) == ".oni") {
      try {
        const auto open = extension(path) == ".bag" ? openBag : openOni;
        inputs.sources.push_back(open(path, options));
      } catch (const std::exception& reason) {
        inputs.errors.push_back(path + ": " + reason.what());
      }
    } else {
      inputs.errors.push_back(path + ": expected a .png file, a folder of them, a .bag or an .oni");
    }
  }
  if (!png_files.empty()) {
    inputs.sources.push_back(openPngFiles(png_files, frameNames(png_files), options));
  }
  if (options.correction) {
    for (auto& source : inputs.sources) {
      source = std::make_unique<CorrectedSource>(std::move(source), *options.correction);
    }
  }
  return inputs;
}

}  // namespace dominant_plane_detection
