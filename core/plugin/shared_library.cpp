#include "core/plugin/shared_library.h"

#include <dlfcn.h>

namespace runnel {

Result<SharedLibrary> SharedLibrary::Open(const std::filesystem::path& file) {
  // NOW: a missing symbol is an error here, not a crash later. LOCAL: plugins do not see each
  // other.
  void* const handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (handle == nullptr) {
    const char* const reason = dlerror();
    return Error{.message = "cannot load the library " + file.string() + ": " +
                            (reason != nullptr ? reason : "unknown reason")};
  }
  return SharedLibrary(file, handle);
}

void* SharedLibrary::FindSymbol(const char* name) const noexcept { return dlsym(handle_, name); }

}  // namespace runnel
