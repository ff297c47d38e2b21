/// Lock of a results folder, which allows one run at a time: two runs would leave the tables of one and the
/// checkpoint of the other.
#pragma once

#include <filesystem>
#include <memory>

namespace solidus::results {

/// Holds the file `lock` of a results folder as long as it lives; it names the process and its host. The
/// system lets go of it when the process ends, however that happens; a lock that a process of this host left
/// behind is taken over.
class RunLock {
 public:
  /// Makes the folder where it is not there. Collective.
  /// Throws OutputError on every process where another run holds the folder, or where one of another host has
  /// left its lock and cannot be asked whether it runs.
  explicit RunLock(const std::filesystem::path& folder);

 private:
  class Held;
  std::shared_ptr<Held> held_;  ///< on process 0
};

}  // namespace solidus::results
