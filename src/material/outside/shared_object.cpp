/// dlopen and dlsym with their messages.
#include "material/outside/shared_object.hpp"

#include <dlfcn.h>

#include <filesystem>

namespace solidus::material {

SharedObject::SharedObject(const std::string& file, const SourceLocation& where)
    : file_(file), where_(where), handle_(nullptr) {
  std::error_code unreadable;
  if (!std::filesystem::is_regular_file(file, unreadable))
    throw InputError(where, "there is no shared object '" + file + "'",
                     "a path relative to the material file, as in library = \"liblaw.so\"");
  handle_ = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle_ == nullptr) {
    const char* reason = dlerror();
    throw InputError(where, "the shared object cannot be loaded: " + std::string(reason ? reason : file),
                     "a library for this machine, whose own libraries are found (ldd shows them)");
  }
}

void* SharedObject::find(const std::string& symbol) const {
  return dlsym(handle_, symbol.c_str());
}

void* SharedObject::get(const std::string& symbol, const std::string& what) const {
  if (void* address = find(symbol)) return address;
  throw InputError(where_, "'" + file_ + "' has no symbol '" + symbol + "' (" + what + ")",
                   "nm -D shows the symbols of a library");
}

}  // namespace solidus::material
