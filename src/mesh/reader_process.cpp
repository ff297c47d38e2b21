#include "mesh/reader_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/prctl.h>
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
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>

#include "input/units.hpp"
#include "mesh/file_format.hpp"
#include "mesh/reader_message.hpp"
#include "mesh/reader_sandbox.hpp"
#include "system/errors.hpp"
#include "system/log.hpp"
#include "system/program_path.hpp"

extern char** environ;  // NOLINT: POSIX declares it nowhere

namespace solidus::mesh {

namespace {

constexpr const char* k_verb = "--read-mesh-for-parent";
constexpr int k_request = 3, k_answer = 4;  ///< descriptors of the reader
enum class Answer : int { mesh, unusable_geometry, input_error, memory, internal };

#if defined(__SANITIZE_ADDRESS__)
#define SOLIDUS_SHADOW_MEMORY
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SOLIDUS_SHADOW_MEMORY
#endif
#endif
#ifdef SOLIDUS_SHADOW_MEMORY
constexpr bool k_limits_memory = false;  // AddressSanitizer reserves terabytes
#else
constexpr bool k_limits_memory = true;
#endif

bool starts_readers = false;
bool (*give_up)() = nullptr;

using Clock = std::chrono::steady_clock;

// --- in the reader ---

void put_all(int descriptor, const void* bytes, std::size_t n) {
  const char* at = static_cast<const char*>(bytes);
  while (n > 0) {
    const ssize_t written = ::write(descriptor, at, n);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) throw std::runtime_error("the other end of the pipe has gone");
    at += written;
    n -= static_cast<std::size_t>(written);
  }
}

void take_all(int descriptor, void* bytes, std::size_t n) {
  char* at = static_cast<char*>(bytes);
  while (n > 0) {
    const ssize_t read = ::read(descriptor, at, n);
    if (read < 0 && errno == EINTR) continue;
    if (read <= 0) throw std::runtime_error("the other end of the pipe has gone");
    at += read;
    n -= static_cast<std::size_t>(read);
  }
}

int serve() {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  // Ctrl-C reaches all processes of a terminal: the parent decides.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGUSR1}) std::signal(signal, SIG_IGN);
  const PutBytes put = [](const void* bytes, std::size_t n) { put_all(k_answer, bytes, n); };
  const TakeBytes take = [](void* bytes, std::size_t n) { take_all(k_request, bytes, n); };
  const auto say = [&](Answer answer) { put(&answer, sizeof answer); };
  const MeshSource source = take_source(take);
  bool of_casting = false;
  take(&of_casting, sizeof of_casting);
  std::optional<CastingGeometry> casting;
  if (of_casting) casting = take_casting(take);
  double memory = 0;
  take(&memory, sizeof memory);
  limit_memory(k_limits_memory ? memory : 0);
  if (!source.trust_script) forbid_all_but_reading();
  try {
    const RawMesh mesh = read_mesh_here(source, casting ? &*casting : nullptr);
    say(Answer::mesh);
    put_mesh(mesh, put);
  } catch (const UnusableGeometry& error) {
    say(Answer::unusable_geometry);
    put_text(error.what(), put);
  } catch (const InputError& error) {
    say(Answer::input_error);
    put_text(error.what(), put);
  } catch (const std::bad_alloc&) {
    say(Answer::memory);
  } catch (const std::exception& error) {
    say(Answer::internal);
    put_text(error.what(), put);
  }
  return 0;
}

// --- in the program ---

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
  posix_spawn_file_actions_adddup2(&actions, reads, k_request);
  posix_spawn_file_actions_adddup2(&actions, writes, k_answer);
  posix_spawn_file_actions_addclosefrom_np(&actions, k_answer + 1);
  const std::string program = program_path().string();
  std::string name = "solidus", verb = k_verb;
  std::array<char*, 3> argv = {name.data(), verb.data(), nullptr};
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
  Answer answer = Answer::internal;
  take(&answer, sizeof answer);
  switch (answer) {
    case Answer::mesh:
      return take_mesh(take, limits.memory);
    case Answer::unusable_geometry:
      throw UnusableGeometry({}, take_text(take));
    case Answer::input_error:
      throw InputError({}, take_text(take));
    case Answer::memory:
      too_little_memory(source, limits);
    case Answer::internal:
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

std::optional<int> serve_as_reader(int argc, char** argv) {
  if (argc == 2 && std::strcmp(argv[1], k_verb) == 0) {
    int code = 3;
    try {
      code = serve();
    } catch (const std::exception&) {  // NOLINT: the parent reads no more
    }
    _exit(code);  // what libraries do at the end of a process must not spoil an answer that is given
  }
  starts_readers = true;
  return {};
}

void read_in_processes() {
  starts_readers = true;
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
  return starts_readers ? read_in_own_process(source, casting) : read_mesh_here(source, casting);
}

RawMesh read_mesh(const MeshSource& source) {
  return read_in_one_way(source, nullptr);
}

}  // namespace solidus::mesh
