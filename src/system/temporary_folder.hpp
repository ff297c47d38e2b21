/// Folders for temporary files.
#pragma once

#include <string>

namespace solidus {

/// Returns the folder that programs take for temporary files: what TMPDIR, TEMP or TMP names, in this order,
/// else /tmp.
std::string temporary_folder();

/// Returns temporary_folder() where it can be written, else the first of /tmp, /dev/shm and /var/tmp that can
/// be; empty where none can.
std::string writable_temporary_folder();

}  // namespace solidus
