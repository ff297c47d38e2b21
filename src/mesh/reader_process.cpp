#include "mesh/reader_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

#include "input/units.hpp"
#include "mesh/file_format.hpp"
#include "mesh/reader_message.hpp"
#include "system/errors.hpp"
#include "system/log.hpp"
#include "system/program_path.hpp"

extern char** environ;  // NOLINT: POSIX declares it nowhere

namespace solidus::mesh {

namespace {

constexpr const char* k_reader = "solidus-reader";  ///< name of the program

ReadMesh* reads_here = nullptr;  ///< null: readers read
bool (*give_up)() = nullptr;

/// Beside the program, or where an installation has it. `path` is of the mesh, for the message.
std::string reader_program(const std::string& path) {
  const std::filesystem::path folder = program_path().parent_path();
  for (const std::filesystem::path& place : {folder, folder.parent_path() / "libexec/solidus"})
    if (std::filesystem::exists(place / k_reader)) return (place / k_reader).string();
  throw InputError({path},
                   fmt::format("the program that reads meshes, '{}', is missing beside '{}'", k_reader,
                               program_path().string()),
                   "both in one folder, as they are built, or installed with cmake --install");
}

using Clock = std::chrono::steady_clock;

/// A reader at work; it does not outlive this.
class Reader {
 public:
  Reader(const MeshSource& source, const CastingGeometry* casting, const ReaderLimits& limits);
  ~Reader() {
    if (pid_ > 0) {
      ::kill(pid_, SIGKILL);
      wait();
    }
    for (const int descriptor : {to_, from_})
      if (descriptor >= 0) ::close(descriptor);
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  /// Reads as much, whatever time it takes within the limit. Throws InputError where the reader ends before,
  /// or does not end.
  void take(void* bytes, std::size_t n);

 private:
  /// Waits until bytes arrive or the reader has ended.
  void wait_for_bytes();
  [[noreturn]] void ended();
  int wait() {
    int status = 0;
    while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    pid_ = -1;
    return status;
  }

  const MeshSource& source_;
  ReaderLimits limits_;
  Clock::time_point begun_ = Clock::now();
  double next_report_ = 5;  ///< after so many seconds, then after twice as many, it is said that it goes on
  pid_t pid_ = -1;
  int to_ = -1, from_ = -1;
};

Reader::Reader(const MeshSource& source, const CastingGeometry* casting, const ReaderLimits& limits)
    : source_(source), limits_(limits) {
  const std::string program = reader_program(source.path);
  std::array<int, 2> request{}, answer{};
  if (pipe2(request.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe to a reader of meshes");
  if (pipe2(answer.data(), O_CLOEXEC) != 0) {
    ::close(request[0]);
    ::close(request[1]);
    throw std::runtime_error("no pipe to a reader of meshes");
  }
  to_ = request[1];
  from_ = answer[0];
  // Beyond the descriptors that the reader will know them by, or one would close the other.
  const int reads = fcntl(request[0], F_DUPFD_CLOEXEC, 10), writes = fcntl(answer[1], F_DUPFD_CLOEXEC, 10);
  ::close(request[0]);
  ::close(answer[1]);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, reads, k_request_descriptor);
  posix_spawn_file_actions_adddup2(&actions, writes, k_answer_descriptor);
  posix_spawn_file_actions_addclosefrom_np(&actions, k_answer_descriptor + 1);
  std::string name = k_reader;
  std::array<char*, 2> argv = {name.data(), nullptr};
  const int failed = posix_spawn(&pid_, program.c_str(), &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(reads);
  ::close(writes);
  if (failed != 0) {
    pid_ = -1;
    throw std::runtime_error(std::string("a reader of meshes cannot be started: ") + std::strerror(failed));
  }
  // A reader that dies at once breaks the pipe: its end is told by take().
  const auto before = std::signal(SIGPIPE, SIG_IGN);
  try {
    const PutBytes put = [this](const void* bytes, std::size_t n) { put_all(to_, bytes, n); };
    put_text(SOLIDUS_VERSION, put);
    put_source(source, put);
    const bool of_casting = casting != nullptr;
    put(&of_casting, sizeof of_casting);
    if (of_casting) put_casting(*casting, put);
    put(&limits_.memory, sizeof limits_.memory);
  } catch (const std::runtime_error&) {  // NOLINT: take() finds the reader gone and says why
  }
  std::signal(SIGPIPE, before);
}

void Reader::wait_for_bytes() {
  constexpr int k_tick = 100;  // [ms]
  while (true) {
    pollfd waiting{from_, POLLIN, 0};
    if (::poll(&waiting, 1, k_tick) > 0) return;
    if (give_up != nullptr && give_up()) throw StepRejected("stopped by a signal while the mesh was read");
    const double taken = std::chrono::duration<double>(Clock::now() - begun_).count();
    if (taken > next_report_) {
      logging::info(
          "'{}' is being read or meshed for {:.0f} s; it may take up to {:.0f} s (SOLIDUS_MESH_TIME)",
          source_.path, taken, limits_.time);
      next_report_ *= 2;
    }
    if (taken > limits_.time)
      throw InputError({source_.path},
                       "reading or meshing took longer than " + std::to_string(std::lround(limits_.time)) +
                           " s and was ended",
                       "larger elements, a script that ends, or more time: SOLIDUS_MESH_TIME=\"2 h\"");
  }
}

void Reader::take(void* bytes, std::size_t n) {
  char* at = static_cast<char*>(bytes);
  while (n > 0) {
    wait_for_bytes();
    const ssize_t read = ::read(from_, at, n);
    if (read < 0 && errno == EINTR) continue;
    if (read <= 0) ended();
    at += read;
    n -= static_cast<std::size_t>(read);
  }
}

void Reader::ended() {
  const int status = wait();
  const std::string limit = std::to_string(std::lround(limits_.memory / 1e6)) + " MB";
  if (WIFSIGNALED(status))
    throw InputError(
        {source_.path},
        std::string("Gmsh crashed while it read or meshed this file (") + strsignal(WTERMSIG(status)) + ")",
        "a file that is whole, other mesh options, or more memory than " + limit +
            ": SOLIDUS_MESH_MEMORY=\"8 GB\"");
  throw InputError(
      {source_.path},
      "the file ended the program that read it, with exit code " + std::to_string(WEXITSTATUS(status)),
      "a script that goes to its end");
}

[[noreturn]] void too_little_memory(const MeshSource& source, const ReaderLimits& limits) {
  throw InputError(
      {source.path},
      "reading or meshing needs more memory than " + std::to_string(std::lround(limits.memory / 1e6)) + " MB",
      "larger elements, or more memory: SOLIDUS_MESH_MEMORY=\"8 GB\"");
}

RawMesh read_in_own_process(const MeshSource& source, const CastingGeometry* casting) {
  const ReaderLimits limits = reader_limits(source, casting != nullptr);
  Reader reader(source, casting, limits);
  const TakeBytes take = [&](void* bytes, std::size_t n) { reader.take(bytes, n); };
  ReaderAnswer answer = ReaderAnswer::internal;
  take(&answer, sizeof answer);
  switch (answer) {
    case ReaderAnswer::mesh:
      return take_mesh(take, limits.memory);
    case ReaderAnswer::unusable_geometry:
      throw UnusableGeometry({}, take_text(take));
    case ReaderAnswer::input_error:
      throw InputError({}, take_text(take));
    case ReaderAnswer::memory:
      too_little_memory(source, limits);
    case ReaderAnswer::internal:
      break;
  }
  throw InputError({source.path}, "the mesh cannot be read: " + take_text(take));
}

/// "8 GB" or "500 MB" in bytes.
double bytes_of(const std::string& text) {
  double number = 0;
  std::array<char, 4> unit{};
  const int found = std::sscanf(text.c_str(), "%lf %3s", &number, unit.data());
  const std::string_view named(unit.data());
  const double scale = named == "GB" ? 1e9 : named == "MB" ? 1e6 : 0;
  if (found != 2 || !(number > 0) || scale == 0)
    throw InputError({"SOLIDUS_MESH_MEMORY"}, "'" + text + "' is no amount of memory",
                     "\"8 GB\" or \"500 MB\"");
  return number * scale;
}

double seconds_of(const std::string& text) {
  try {
    const double time = units::parse_quantity(text, "s");
    if (time > 0) return time;
  } catch (const std::invalid_argument&) {  // NOLINT: said below
  }
  throw InputError({"SOLIDUS_MESH_TIME"}, "'" + text + "' is no duration", "\"20 min\"");
}

/// Whether a regular file is none that Gmsh would have to mesh.
bool holds_mesh(const std::string& path) {
  try {
    return !is_geometry(file_format(path));
  } catch (const InputError&) {  // the reader says what is wrong with it
    return true;
  }
}

}  // namespace

void read_in_this_process(ReadMesh* read) {
  reads_here = read;
}

void give_up_reading_when(bool (*asked)()) {
  give_up = asked;
}

ReaderLimits reader_limits(const MeshSource& source, bool meshes) {
  const double machine =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  ReaderLimits limits{0.5 * machine, 1800};
  std::error_code error;
  const auto size = static_cast<double>(std::filesystem::file_size(source.path, error));
  // A file that holds a mesh becomes some twenty times as large in memory, and takes a second per megabyte
  // where the machine is busy.
  if (!error && !meshes && holds_mesh(source.path))
    limits = {std::min(limits.memory, 1e9 + 60 * size), 60 + size / 1e6};
  if (const char* memory = std::getenv("SOLIDUS_MESH_MEMORY")) limits.memory = bytes_of(memory);
  if (const char* time = std::getenv("SOLIDUS_MESH_TIME")) limits.time = seconds_of(time);
  return limits;
}

RawMesh read_in_one_way(const MeshSource& source, const CastingGeometry* casting) {
  return reads_here != nullptr ? reads_here(source, casting) : read_in_own_process(source, casting);
}

RawMesh read_mesh(const MeshSource& source) {
  return read_in_one_way(source, nullptr);
}

RawMesh read_mesh(const std::string& path, double unit_in_metres, double element_size, int element_order,
                  const std::map<std::string, double>& constants, const GeometryChoice& geometry) {
  return read_mesh(MeshSource{path, unit_in_metres, element_size, element_order, constants, geometry});
}

}  // namespace solidus::mesh
