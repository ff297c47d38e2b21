#include "mesh/making/reader_process.hpp"

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
#include <ctime>
#include <filesystem>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>

#include "input/units.hpp"
#include "mesh/files/file_format.hpp"
#include "mesh/making/meshing_outlook.hpp"
#include "mesh/making/reader_message.hpp"
#include "system/errors.hpp"
#include "system/log.hpp"
#include "system/program_path.hpp"
#include "system/version.hpp"

extern char** environ;  // NOLINT: POSIX declares it nowhere

namespace solidus::mesh {

namespace {

constexpr const char* k_reader = "solidus-reader";  ///< name of the program

ReadMesh* reads_here = nullptr;  ///< null: readers read
bool (*give_up)() = nullptr;

constexpr const char* k_same_build = "the solidus-reader of the same build as this program";

/// Next to the program, or where an installation has it. `path` is of the mesh, for the message.
std::string reader_program(const std::string& path) {
  const std::filesystem::path folder = program_path().parent_path();
  for (const std::filesystem::path& place : {folder, folder.parent_path() / "libexec/solidus"})
    if (std::filesystem::exists(place / k_reader)) return (place / k_reader).string();
  throw InputError({path},
                   fmt::format("the program that reads meshes, '{}', is missing next to '{}'", k_reader,
                               program_path().string()),
                   "both in one folder, as they are built, or installed with cmake --install");
}

using Clock = std::chrono::steady_clock;

/// The ends of a pipe, which no program that is started inherits: read from the first, write to the second.
std::array<int, 2> open_pipe() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe to a reader of meshes");
  return ends;
}

/// A reader at work; it does not outlive this.
class Reader {
 public:
  Reader(const MeshSource& source, const ReaderLimits& limits, const TimeOfWay& time)
      : program_(reader_program(source.path)), source_(source), limits_(limits), time_(time) {}
  ~Reader() {
    if (pid_ > 0) {
      ::kill(pid_, SIGKILL);
      int status = 0;
      while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
      }
    }
    for (const int descriptor : {to_, from_})
      if (descriptor >= 0) ::close(descriptor);
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  /// Throws InputError where it cannot be started.
  void start();
  /// Sends the request, however slowly the reader takes it; one that does not take it has ended or answers.
  void request(const CastingGeometry* casting);
  /// Reads as much, whatever time it takes within the limit. Throws InputError where the reader ends before,
  /// or does not end.
  void take(void* bytes, std::size_t n);
  /// Takes what messages say of the mesh while it is waited for. Throws UnusableGeometry where it needs more
  /// memory than the reader may use.
  void hear(const MeshingOutlook& outlook);
  const std::string& program() const { return program_; }
  /// Processor time of the reader while it was last waited for [s].
  double processor_time() const { return processor_; }

 private:
  /// Processor time that the way may take [s].
  double most() const { return time_.processor + nodes_ * time_.processor_a_node; }
  /// Says every now and then what goes on, and throws where it goes on for too long.
  void check_time();
  void give(const void* bytes, std::size_t n);
  /// Waits until the pipe is ready for it (POLLIN, POLLOUT) or the other end has gone.
  void wait_for(int descriptor, short event);
  [[noreturn]] void ended();
  /// How it ended; empty where it goes on, which has closed its end of the pipe.
  std::optional<int> status();

  std::string program_;
  const MeshSource& source_;
  ReaderLimits limits_;
  std::string outlook_;  ///< ": " and a text; empty where nothing is known yet
  Clock::time_point begun_ = Clock::now();
  bool many_nodes_ = false;
  TimeOfWay time_;
  double nodes_ = 0;        ///< that are expected; 0: not known
  double processor_ = 0;    ///< [s]
  double next_report_ = 5;  ///< after so many seconds, then after twice as many, it reports that it goes on
  pid_t pid_ = -1;
  int to_ = -1, from_ = -1;
};

void Reader::start() {
  const auto [takes_request, to] = open_pipe();
  to_ = to;
  const auto [from, gives_answer] = open_pipe();
  from_ = from;
  // Beyond the descriptors that the reader will know them by, or one would close the other.
  const int reads = fcntl(takes_request, F_DUPFD_CLOEXEC, 10),
            writes = fcntl(gives_answer, F_DUPFD_CLOEXEC, 10);
  ::close(takes_request);
  ::close(gives_answer);
  fcntl(to_, F_SETFL, O_NONBLOCK);
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
  const int failed = posix_spawn(&pid_, program_.c_str(), &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(reads);
  ::close(writes);
  if (failed == 0) return;
  pid_ = -1;
  throw InputError({source_.path},
                   fmt::format("the program that reads meshes, '{}', cannot be started: {}", program_,
                               std::strerror(failed)),
                   k_same_build);
}

void Reader::request(const CastingGeometry* casting) {
  // A reader that dies at once breaks the pipe: its end is told by take().
  const auto before = std::signal(SIGPIPE, SIG_IGN);
  try {
    const PutBytes put = [this](const void* bytes, std::size_t n) { give(bytes, n); };
    put_text(program_version(), put);
    put_source(source_, put);
    const bool of_casting = casting != nullptr;
    put(&of_casting, sizeof of_casting);
    if (of_casting) put_casting(*casting, put);
    put(&limits_.memory, sizeof limits_.memory);
  } catch (const MessageError&) {  // NOLINT: take() finds the reader gone and says why
  } catch (...) {
    std::signal(SIGPIPE, before);
    throw;
  }
  std::signal(SIGPIPE, before);
}

void Reader::give(const void* bytes, std::size_t n) {
  const char* at = static_cast<const char*>(bytes);
  while (n > 0) {
    wait_for(to_, POLLOUT);
    const ssize_t written = ::write(to_, at, n);
    if (written < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (written <= 0) throw MessageError("the reader has gone");
    at += written;
    n -= static_cast<std::size_t>(written);
  }
}

void Reader::wait_for(int descriptor, short event) {
  constexpr int k_tick = 100;  // [ms]
  while (true) {
    pollfd waiting{descriptor, event, 0};
    if (::poll(&waiting, 1, k_tick) > 0) return;
    if (give_up != nullptr && give_up()) throw StepRejected("stopped by a signal while the mesh was read");
    check_time();
  }
}

void Reader::check_time() {
  if (clockid_t clock = 0; clock_getcpuclockid(pid_, &clock) == 0) {
    timespec time{};
    if (clock_gettime(clock, &time) == 0)
      processor_ = static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }
  const double taken = std::chrono::duration<double>(Clock::now() - begun_).count();
  if (taken > next_report_) {
    tell_progress(fmt::format(
        "'{}' is being read or meshed for {:.0f} s{}{}; {}", source_.path, taken,
        time_.what.empty() ? "" : " (" + time_.what + ")", outlook_,
        time_.processor > 0 ? fmt::format("another way follows after {:.0f} s of the processor", most())
                            : fmt::format("it may take up to {:.0f} s (SOLIDUS_MESH_TIME)", limits_.time)));
    next_report_ *= 2;
  }
  if (time_.processor > 0 && processor_ > most())
    throw MeshingTooLong({source_.path}, fmt::format("took longer than {:.0f} s and was ended", most()));
  if (taken > limits_.time) {
    const std::string what = "reading or meshing took longer than " +
                             std::to_string(std::lround(limits_.time)) + " s and was ended";
    const char* allowed = "larger elements, a script that ends, or more time: SOLIDUS_MESH_TIME=\"2 h\"";
    // Other ways of meshing have as many elements or more.
    if (many_nodes_) throw UnusableGeometry({source_.path}, what, allowed);
    throw InputError({source_.path}, what, allowed);
  }
}

void Reader::hear(const MeshingOutlook& outlook) {
  const std::string text = outlook_text(outlook);
  // A geometry that would take more memory than allowed is refused before it is meshed.
  if (const double memory = meshing_memory(outlook); memory > limits_.memory)
    throw UnusableGeometry(
        {source_.path},
        fmt::format("the geometry is {}: meshing it takes some {:.2g} GB, and {:.2g} GB may be used", text,
                    1e-9 * memory, 1e-9 * limits_.memory),
        "the unit of lengths in the file, larger elements ([[mesh.size]], --fineness), or more memory: "
        "SOLIDUS_MESH_MEMORY=\"32 GB\"");
  outlook_ = ": " + text;
  tell_outlook(outlook);
  logging::debug("'{}' is {}", source_.path, text);
  constexpr double k_many = 1e6;  // castings of many parts and thin walls have less
  many_nodes_ = outlook.nodes > k_many;
  nodes_ = outlook.nodes;
  if (!outlook.overlap.empty())
    logging::warn(
        "bodies of '{}' overlap: {}; the first of each two keeps it. Bodies that belong together touch: cut "
        "one out of the other",
        source_.path, outlook.overlap);
  if (many_nodes_)
    logging::warn(
        "'{}' is {}, where castings usually have 5 thousand to 500 thousand: are its unit and the sizes of "
        "elements meant so?",
        source_.path, text);
}

void Reader::take(void* bytes, std::size_t n) {
  char* at = static_cast<char*>(bytes);
  while (n > 0) {
    wait_for(from_, POLLIN);
    const ssize_t read = ::read(from_, at, n);
    if (read < 0 && errno == EINTR) continue;
    if (read <= 0) ended();
    at += read;
    n -= static_cast<std::size_t>(read);
  }
}

std::optional<int> Reader::status() {
  constexpr std::chrono::milliseconds k_patience(1000), k_tick(5);
  const Clock::time_point since = Clock::now();
  int status = 0;
  while (true) {
    const pid_t found = waitpid(pid_, &status, WNOHANG);
    if (found == pid_ || (found < 0 && errno != EINTR)) {
      pid_ = -1;
      return status;
    }
    if (Clock::now() - since > k_patience) return std::nullopt;
    std::this_thread::sleep_for(k_tick);
  }
}

void Reader::ended() {
  // How the program ended tells whether memory ran out, it crashed, or it could not start.
  const std::optional<int> how = status();
  if (!how)
    throw InputError({source_.path},
                     fmt::format("the program that reads meshes, '{}', went on without an answer", program_),
                     k_same_build);
  if (WIFSIGNALED(*how) && WTERMSIG(*how) == SIGKILL)
    throw InputError({source_.path},
                     "the program that read or meshed this file was killed: by the system, where memory ran "
                     "out, or by a user",
                     "larger elements, or fewer programs at the same time");
  if (WIFSIGNALED(*how))
    throw InputError({source_.path},
                     std::string("the reader crashed while it read or meshed this file (") +
                         strsignal(WTERMSIG(*how)) + ")",
                     "a file that is whole, other mesh options, or more memory than " +
                         std::to_string(std::lround(limits_.memory / 1e6)) +
                         " MB: SOLIDUS_MESH_MEMORY=\"8 GB\"");
  constexpr int k_cannot_run = 127;  // of the loader, where a library is missing
  if (WEXITSTATUS(*how) == k_cannot_run)
    throw InputError(
        {source_.path}, fmt::format("the program that reads meshes, '{}', cannot run", program_),
        fmt::format("the libraries that it needs; ldd '{}' names those that are missing", program_));
  throw InputError(
      {source_.path},
      "the file ended the program that read it, with exit code " + std::to_string(WEXITSTATUS(*how)),
      "a script that goes to its end");
}

[[noreturn]] void too_little_memory(const MeshSource& source, const ReaderLimits& limits) {
  throw InputError(
      {source.path},
      "reading or meshing needs more memory than " + std::to_string(std::lround(limits.memory / 1e6)) + " MB",
      "larger elements, or more memory: SOLIDUS_MESH_MEMORY=\"8 GB\"");
}

RawMesh take_answer(Reader& reader, const MeshSource& source, const ReaderLimits& limits) {
  const TakeBytes take = [&](void* bytes, std::size_t n) { reader.take(bytes, n); };
  // Outlooks come before the answer itself, any number of them.
  ReaderAnswer answer = ReaderAnswer::internal;
  take(&answer, sizeof answer);
  while (answer == ReaderAnswer::outlook) {
    reader.hear(take_outlook(take));
    take(&answer, sizeof answer);
  }
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
      throw InputError({source.path}, "the mesh cannot be read: " + take_text(take));
    case ReaderAnswer::outlook:
      break;  // taken above
  }
  throw MessageError("an answer of no kind");
}

RawMesh read_in_own_process(const MeshSource& source, const CastingGeometry* casting, const TimeOfWay& time,
                            double* spent) {
  const ReaderLimits limits = reader_limits(source, casting != nullptr);
  Reader reader(source, limits, time);
  reader.start();
  reader.request(casting);
  const auto note_time = [&] {
    if (spent != nullptr) *spent = reader.processor_time();
  };
  // The time is noted also when the geometry could not be meshed.
  try {
    RawMesh mesh = take_answer(reader, source, limits);
    note_time();
    return mesh;
  } catch (const InputError&) {
    note_time();
    throw;
  } catch (const MessageError& error) {
    throw InputError({source.path},
                     fmt::format("what the program that reads meshes, '{}', answered is no mesh: {}",
                                 reader.program(), error.what()),
                     k_same_build);
  }
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
    return !is_geometry(file_format(path).holds);
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

RawMesh read_in_one_way(const MeshSource& source, const CastingGeometry* casting, const TimeOfWay& time,
                        double* spent) {
  RawMesh mesh =
      reads_here != nullptr ? reads_here(source, casting) : read_in_own_process(source, casting, time, spent);
  // A file that is read several times says each thing once.
  static std::set<std::string> said;
  for (const std::string& note : mesh.notes)
    if (const std::string text = note.starts_with(source.path) ? note : source.path + ": " + note;
        said.insert(text).second)
      logging::warn("{}", text);
  return mesh;
}

RawMesh read_mesh(const MeshSource& source) {
  return read_in_one_way(source, nullptr);
}

RawMesh read_mesh(const std::string& path, double unit_in_metres, double element_size, int element_order,
                  const std::map<std::string, double>& constants, const GeometryChoice& geometry) {
  return read_mesh(MeshSource{path, unit_in_metres, element_size, element_order, constants, geometry});
}

}  // namespace solidus::mesh
