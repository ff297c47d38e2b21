#include "mesh/making/reader.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "mesh/making/reader_message.hpp"
#include "numbers/index_casts.hpp"
#include "system/errors.hpp"
#include "system/log.hpp"
#include "system/program_path.hpp"
#include "system/version.hpp"

extern char** environ;  // NOLINT: POSIX declares it nowhere

namespace solidus::mesh {

namespace {

constexpr const char* k_reader = "solidus-reader";  ///< name of the program

bool (*give_up)() = nullptr;

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

/// The ends of a pipe, which no program that is started inherits: read from the first, write to the second.
std::array<int, 2> open_pipe() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe to a reader of meshes");
  return ends;
}

/// Private memory that this process may write to, as RLIMIT_DATA counts it [byte].
double bytes_held() {
  std::ifstream pages("/proc/self/statm");
  double size = 0, resident = 0, shared = 0, text = 0, unused = 0, data = 0;
  pages >> size >> resident >> shared >> text >> unused >> data;
  return data * static_cast<double>(sysconf(_SC_PAGESIZE));
}

}  // namespace

void give_up_reading_when(bool (*asked)()) {
  give_up = asked;
}

Reader::Reader(const MeshSource& source, const ReaderLimits& limits, const TimeOfWay& time)
    : source_(source), limits_(limits), time_(time) {}

/// A reader that is still at work is ended: its answer is no longer wanted.
Reader::~Reader() {
  if (pid_ > 0) {
    ::kill(pid_, SIGKILL);
    int status = 0;
    while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
  }
  for (const int descriptor : {to_, from_})
    if (descriptor >= 0) ::close(descriptor);
}

Reader::Pipes Reader::open_pipes() {
  const auto [takes_request, to] = open_pipe();
  to_ = to;
  const auto [from, gives_answer] = open_pipe();
  from_ = from;
  // Beyond the descriptors that the reader will know them by, or one would close the other.
  const Pipes pipes{fcntl(takes_request, F_DUPFD_CLOEXEC, 10), fcntl(gives_answer, F_DUPFD_CLOEXEC, 10)};
  ::close(takes_request);
  ::close(gives_answer);
  fcntl(to_, F_SETFL, O_NONBLOCK);
  return pipes;
}

/// Starts the program with three standard descriptors that lead nowhere and the two pipes; it inherits
/// nothing else.
void Reader::start() {
  program_ = reader_program(source_.path);
  const Pipes pipes = open_pipes();
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, pipes.reads, k_request_descriptor);
  posix_spawn_file_actions_adddup2(&actions, pipes.writes, k_answer_descriptor);
  posix_spawn_file_actions_addclosefrom_np(&actions, k_answer_descriptor + 1);
  std::string name = k_reader;
  std::array<char*, 2> argv = {name.data(), nullptr};
  const int failed = posix_spawn(&pid_, program_.c_str(), &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(pipes.reads);
  ::close(pipes.writes);
  if (failed == 0) return;
  pid_ = -1;
  throw InputError({source_.path},
                   fmt::format("the program that reads meshes, '{}', cannot be started: {}", program_,
                               std::strerror(failed)),
                   k_same_build);
}

/// Reads in a copy of this process, for formats that need no other program: quicker, and as safe from
/// crashes.
void Reader::fork(ReadRequest* read) {
  program_ = program_path().string();
  const Pipes pipes = open_pipes();
  pid_ = ::fork();
  if (pid_ == 0) answer(pipes.reads, pipes.writes, read);
  ::close(pipes.reads);
  ::close(pipes.writes);
  if (pid_ < 0)
    throw InputError({source_.path},
                     std::string("no process that reads the mesh can be started: ") + std::strerror(errno));
}

void Reader::answer(int reads, int writes, ReadRequest* read) {
  // Nothing that this copy has of its parent may be heard of, written to or called by it.
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) std::signal(signal, SIG_DFL);
  const int nowhere = ::open("/dev/null", O_RDWR);
  for (const int standard : {0, 1, 2}) ::dup2(nowhere, standard);
  ::dup2(reads, k_request_descriptor);
  ::dup2(writes, k_answer_descriptor);
  ::closefrom(k_answer_descriptor + 1);
  int code = 3;
  try {
    serve_request(read, bytes_held());
    code = 0;
  } catch (const std::exception&) {  // NOLINT: the other end has gone
  }
  _exit(code);
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

/// Writes as much as the pipe takes, and looks after time and signals while it is full.
void Reader::give(const void* bytes, std::size_t n) {
  const char* at = static_cast<const char*>(bytes);
  while (n > 0) {
    wait_for(to_, POLLOUT);
    const ssize_t written = ::write(to_, at, n);
    if (written < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (written <= 0) throw MessageError("the reader has gone");
    at += written;
    n -= as_size(written);
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
  // Limits are of processor time where they choose between ways of meshing, so that a busy machine meshes
  // alike; the limit of the clock ends what hangs.
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

/// Reads until all bytes are there; the end of the pipe is the end of the reader.
void Reader::take(void* bytes, std::size_t n) {
  char* at = static_cast<char*>(bytes);
  while (n > 0) {
    wait_for(from_, POLLIN);
    const ssize_t read = ::read(from_, at, n);
    if (read < 0 && errno == EINTR) continue;
    if (read <= 0) ended();
    at += read;
    n -= as_size(read);
  }
}

/// How the reader ended; nothing where it closed its pipe and goes on.
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

}  // namespace solidus::mesh
