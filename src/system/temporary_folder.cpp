#include "system/temporary_folder.hpp"

#include <unistd.h>

#include <cstdlib>

namespace solidus {

std::string temporary_folder() {
  for (const char* name : {"TMPDIR", "TEMP", "TMP"})
    if (const char* folder = std::getenv(name)) return folder;
  return "/tmp";
}

std::string writable_temporary_folder() {
  for (const std::string& folder :
       {temporary_folder(), std::string("/tmp"), std::string("/dev/shm"), std::string("/var/tmp")})
    if (::access(folder.c_str(), W_OK | X_OK) == 0) return folder;
  return {};
}

}  // namespace solidus
