#include "freenect_driver/optional_functions.h"

#include <dlfcn.h>

namespace dominant_plane_detection::freenect_driver {
namespace {

/// @return a handle of the library that libfreenect's functions come from; never closed.
void* loadedLibrary() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<void*>(&::freenect_init), &info) == 0) return nullptr;
  return dlopen(info.dli_fname, RTLD_LAZY | RTLD_NOLOAD);
}

template <typename Function>
void find(void* library, const char* name, Function& function) {
  if (library != nullptr) function = reinterpret_cast<Function>(dlsym(library, name));
}

OptionalFunctions findAll() {
  void* const library = loadedLibrary();
  OptionalFunctions functions;
  find(library, "freenect_list_device_attributes", functions.list_device_attributes);
  find(library, "freenect_free_device_attributes", functions.free_device_attributes);
  find(library, "freenect_enabled_subdevices", functions.enabled_subdevices);
  find(library, "freenect_set_flag", functions.set_flag);
  find(library, "freenect_set_exposure", functions.set_exposure);
  find(library, "freenect_copy_registration", functions.copy_registration);
  find(library, "freenect_destroy_registration", functions.destroy_registration);
  return functions;
}

}  // namespace

const OptionalFunctions& optionalFunctions() {
  static const OptionalFunctions functions = findAll();
  return functions;
}

}  // namespace dominant_plane_detection::freenect_driver
