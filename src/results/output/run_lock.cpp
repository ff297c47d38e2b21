/// A file that is locked by the system, with the name of its owner for messages.
#include "results/output/run_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <sstream>
#include <string>

#include "results/output/output_error.hpp"
#include "system/log.hpp"

namespace solidus::results {

namespace {

namespace fs = std::filesystem;

constexpr const char* k_advice = "wait for it to end, or choose another folder with -o";

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

std::string own_mark() {
  return fmt::format("process {} on {}\n", getpid(), host_name());
}

/// Process that made a lock, as its file states; the host is empty if the file does not state it.
struct Owner {
  long process = 0;
  std::string host;
};

/// Reads the mark of a lock; a file without one has no owner.
Owner owner_of(int descriptor) {
  std::array<char, 512> text{};
  Owner owner;
  if (pread(descriptor, text.data(), text.size() - 1, 0) <= 0) return owner;
  std::istringstream words(text.data());
  std::string process, on;
  words >> process >> owner.process >> on >> owner.host;
  return owner;
}

}  // namespace

/// The locked file, which is removed when it is let go.
class RunLock::Held {
 public:
  explicit Held(const fs::path& folder) : path_(folder / "lock") {
    while (!lock_what_is_there()) {
    }
    // The lock is ours from here on. A mark of another computer may be that of a run whose lock this file
    // system does not show.
    const Owner before = owner_of(descriptor_);
    if (!before.host.empty() && before.host != host_name()) {
      ::close(descriptor_);
      throw OutputError(
          folder.string(),
          fmt::format("process {} on {} runs in this folder, or was killed there", before.process,
                      before.host),
          fmt::format("if it does not run any more, remove {}; else {}", path_.string(), k_advice));
    }
    if (!before.host.empty())
      logging::info("{}: process {} left its lock behind; it does not run any more", folder.string(),
                    before.process);
    const std::string mark = own_mark();
    if (ftruncate(descriptor_, 0) != 0 ||
        pwrite(descriptor_, mark.data(), mark.size(), 0) != static_cast<ssize_t>(mark.size())) {
      const std::string reason = std::strerror(errno);
      ::close(descriptor_);
      throw OutputError(path_.string(), "cannot write: " + reason);
    }
  }
  ~Held() {
    // The file is removed before the lock is released: a process that waits for it finds another file, or
    // none, and tries again.
    ::unlink(path_.c_str());
    ::close(descriptor_);
  }
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;

 private:
  /// False where the file was removed between its opening and its locking.
  bool lock_what_is_there() {
    descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0644);
    if (descriptor_ < 0)
      throw OutputError(path_.string(), std::string("cannot write: ") + std::strerror(errno));
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && refused(errno)) {
      const Owner owner = owner_of(descriptor_);
      ::close(descriptor_);
      throw OutputError(path_.parent_path().string(),
                        fmt::format("a run is under way in this folder: process {} on {}", owner.process,
                                    owner.host.empty() ? "this host" : owner.host),
                        k_advice);
    }
    // The file may have been removed between opening and locking: then the lock is on a file that nobody
    // finds.
    struct stat opened {
    }, named{};
    if (fstat(descriptor_, &opened) == 0 && stat(path_.c_str(), &named) == 0 &&
        opened.st_ino == named.st_ino && opened.st_dev == named.st_dev)
      return true;
    ::close(descriptor_);
    return false;
  }

  /// Whether another process holds the lock. Where the file system has no locks the mark decides.
  bool refused(int error) const {
    if (error == EWOULDBLOCK) return true;
    const Owner owner = owner_of(descriptor_);
    return owner.host == host_name() && owner.process > 0 &&
           ::kill(static_cast<pid_t>(owner.process), 0) == 0;
  }

  fs::path path_;
  int descriptor_ = -1;
};

RunLock::RunLock(const fs::path& folder) {
  on_first_process([&] {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
      throw OutputError(folder.string(), "cannot make the results folder: " + error.message(),
                        "choose another folder with -o");
    held_ = std::make_shared<Held>(folder);
  });
}

}  // namespace solidus::results
