/// A copy of the process answers requests through a socket, under restrictions; the parent watches its
/// memory and its end.
#include "results/formats/hdf5_reader.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <new>
#include <optional>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

#include "numbers/index_casts.hpp"
#include "results/formats/hdf5_file.hpp"
#include "results/output/output_error.hpp"
#include "system/sandbox.hpp"

namespace solidus::results {

namespace {

enum class Call { open, text, numbers, integers, rows, width };
enum class Outcome { answered, failed, no_memory };

/// The head of an answer; as many bytes follow.
struct Answer {
  Outcome outcome = Outcome::failed;
  std::size_t bytes = 0;
};

constexpr std::size_t k_longest_text = 1 << 20;

/// Transfers all bytes, however many the socket takes or gives at once; false where the other end has gone.
template <class Transfer>
bool transfer_all(const Transfer& transfer, std::size_t n) {
  for (std::size_t done = 0; done < n;) {
    const ssize_t some = transfer(done, n - done);
    if (some < 0 && errno == EINTR) continue;
    if (some <= 0) return false;
    done += as_size(some);
  }
  return true;
}

bool get(int socket, void* bytes, std::size_t n) {
  return transfer_all(
      [&](std::size_t at, std::size_t left) { return ::read(socket, static_cast<char*>(bytes) + at, left); },
      n);
}

bool give(int socket, const void* bytes, std::size_t n) {
  return transfer_all(
      [&](std::size_t at, std::size_t left) {
        return ::write(socket, static_cast<const char*>(bytes) + at, left);
      },
      n);
}

/// The memory of its own that this process holds [bytes]; none where the system does not say.
std::optional<double> held_memory() {
  std::ifstream statm("/proc/self/statm");
  double size = 0, resident = 0, shared = 0, text = 0, library = 0, data = 0;
  if (!(statm >> size >> resident >> shared >> text >> library >> data)) return std::nullopt;
  return data * static_cast<double>(sysconf(_SC_PAGESIZE));
}

}  // namespace

struct Hdf5Reader::Request {
  Call call = Call::open;
  std::int64_t first = 0;     ///< row
  std::size_t n_values = 0;   ///< to be read
  std::size_t name_size = 0;  ///< the name follows
};

namespace {

template <class T>
std::vector<char> read_values(const Hdf5File& file, const std::string& name, std::int64_t first,
                              std::size_t n) {
  std::vector<T> values(n);
  file.read_rows<T>(name, first, values);
  std::vector<char> bytes(n * sizeof(T));
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

std::vector<char> bytes_of(std::int64_t number) {
  std::vector<char> bytes(sizeof number);
  std::memcpy(bytes.data(), &number, sizeof number);
  return bytes;
}

std::vector<char> answer(const Hdf5File& file, Call call, const std::string& name, std::int64_t first,
                         std::size_t n) {
  switch (call) {
    case Call::open:
      return {};
    case Call::text: {
      const std::string text = file.read_text(name);
      return {text.begin(), text.end()};
    }
    case Call::numbers:
      return read_values<double>(file, name, first, n);
    case Call::integers:
      return read_values<std::int64_t>(file, name, first, n);
    case Call::rows:
      return bytes_of(file.rows(name));
    case Call::width:
      return bytes_of(file.width(name));
  }
  return {};
}

/// Restricts the copy for good: what belongs to the program is out of its reach.
/// @return the socket, by its number here
int restrict_copy(int socket, double bytes_of_file) {
  constexpr int k_socket = 3;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) std::signal(signal, SIG_DFL);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGUSR1})
    std::signal(signal, SIG_IGN);  // the program decides
  if (dup2(socket, k_socket) != k_socket) _exit(1);
  closefrom(k_socket + 1);  // on kernels before 5.9 too, which have no close_range()
  constexpr double k_beside = 5e8, k_of_file = 4;
  if (const auto held = held_memory()) sandbox::limit_memory(*held + k_beside + k_of_file * bytes_of_file);
  sandbox::forbid_all_but_reading();
  return k_socket;
}

}  // namespace

Hdf5Reader::Hdf5Reader(std::filesystem::path path, double patience) : path_(std::move(path)) {
  // HDF5 may crash or hang on a damaged file, so a copy of this process reads it. The copy may take as long
  // as the size of the file explains, and a patience on top.
  std::error_code error;
  const auto size = static_cast<double>(std::filesystem::file_size(path_, error));
  const double bytes = error ? 0.0 : size;
  seconds_ = patience + 1e-6 * bytes;
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    fail(std::string("cannot be read: ") + std::strerror(errno));
  copy_ = ::fork();
  // The copy gives up its rights before it opens the file, then answers requests until the other end is
  // closed. What goes wrong is an answer too.
  if (copy_ == 0) {
    const int socket = restrict_copy(ends[1], bytes);
    std::optional<Hdf5File> file;
    Request request;
    while (get(socket, &request, sizeof request)) {
      std::string name(request.name_size, '\0');
      if (!get(socket, name.data(), name.size())) break;
      Answer head;
      std::vector<char> body;
      try {
        if (!file) file.emplace(path_, Hdf5File::Mode::read);
        body = answer(*file, request.call, name, request.first, request.n_values);
        head.outcome = Outcome::answered;
      } catch (const std::bad_alloc&) {
        head.outcome = Outcome::no_memory;
      } catch (const std::exception& failure) {
        const std::string reason = failure.what();
        body.assign(reason.begin(), reason.end());
      }
      head.bytes = body.size();
      if (!give(socket, &head, sizeof head) || !give(socket, body.data(), body.size())) break;
    }
    // It leaves without running destructors that belong to the parent.
    _exit(0);
  }
  const int why = errno;
  ::close(ends[1]);
  to_copy_ = ends[0];
  // The first request is empty: it shows whether the file can be opened at all.
  try {
    if (copy_ < 0) fail(std::string("cannot be read by a process of its own: ") + std::strerror(why));
    ask({}, {});
  } catch (...) {
    end_copy();
    throw;
  }
}

Hdf5Reader::~Hdf5Reader() {
  end_copy();
}

void Hdf5Reader::end_copy() {
  if (to_copy_ >= 0) ::close(std::exchange(to_copy_, -1));
  if (copy_ <= 0) return;
  ::kill(copy_, SIGKILL);
  while (::waitpid(copy_, nullptr, 0) < 0 && errno == EINTR) {
  }
  copy_ = -1;
}

void Hdf5Reader::fail(const std::string& what) const {
  throw OutputError(path_.string(), what);
}

void Hdf5Reader::ended() {
  int status = 0;
  pid_t found = -1;
  do found = ::waitpid(copy_, &status, 0);
  while (found < 0 && errno == EINTR);
  copy_ = -1;
  if (found > 0 && WIFSIGNALED(status))
    fail(fmt::format("HDF5 crashed (signal {}, {}) while {}", WTERMSIG(status), strsignal(WTERMSIG(status)),
                     doing_));
  fail("the process that reads it has ended while " + doing_);
}

void Hdf5Reader::put(const void* bytes, std::size_t n) {
  if (copy_ < 0) fail("the process that reads it has ended");
  const auto send = [&](std::size_t at, std::size_t left) {
    return ::send(to_copy_, static_cast<const char*>(bytes) + at, left, MSG_NOSIGNAL);
  };
  if (!transfer_all(send, n)) ended();
}

void Hdf5Reader::take(void* bytes, std::size_t n) {
  // A deadline for the whole answer, not for each part of it.
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds_);
  const auto receive = [&](std::size_t at, std::size_t left) -> ssize_t {
    // The copy that reads may hang on a damaged file; then it is ended when its time is over.
    for (;;) {
      const auto still = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
      if (still <= 0) {
        end_copy();
        fail(fmt::format("HDF5 came to no end within {:.0f} s while {}", seconds_, doing_));
      }
      pollfd from{to_copy_, POLLIN, 0};
      if (::poll(&from, 1, static_cast<int>(still)) > 0) break;
    }
    return ::read(to_copy_, static_cast<char*>(bytes) + at, left);
  };
  if (!transfer_all(receive, n)) ended();
}

std::size_t Hdf5Reader::ask(const Request& request, const std::string& name) {
  doing_ = request.call == Call::open ? "opening it" : "reading '" + name + "'";
  Request with_name = request;
  with_name.name_size = name.size();
  put(&with_name, sizeof with_name);
  put(name.data(), name.size());
  Answer head;
  take(&head, sizeof head);
  if (head.outcome == Outcome::answered) return head.bytes;
  if (head.outcome == Outcome::no_memory || head.bytes > k_longest_text)
    fail("HDF5 asked for more memory than such a file takes while " + doing_);
  std::string reason(head.bytes, '\0');
  take(reason.data(), reason.size());
  throw OutputError({}, reason);
}

std::int64_t Hdf5Reader::ask_number(const Request& request, const std::string& name) {
  std::int64_t number = 0;
  if (ask(request, name) != sizeof number) fail("holds no '" + name + "'");
  take(&number, sizeof number);
  return number;
}

std::string Hdf5Reader::read_text(const std::string& name) {
  const std::size_t size = ask({.call = Call::text}, name);
  if (size > k_longest_text) fail("holds no text '" + name + "'");
  std::string text(size, '\0');
  take(text.data(), size);
  return text;
}

template <class T>
void Hdf5Reader::read_rows(const std::string& name, std::int64_t first, std::span<T> values) {
  if (values.empty()) return;
  constexpr Call k_call = std::is_same_v<T, double> ? Call::numbers : Call::integers;
  if (ask({.call = k_call, .first = first, .n_values = values.size()}, name) != values.size_bytes())
    fail("cannot read '" + name + "'");
  take(values.data(), values.size_bytes());
}

template void Hdf5Reader::read_rows<double>(const std::string&, std::int64_t, std::span<double>);
template void Hdf5Reader::read_rows<std::int64_t>(const std::string&, std::int64_t, std::span<std::int64_t>);

std::int64_t Hdf5Reader::rows(const std::string& name) {
  return ask_number({.call = Call::rows}, name);
}

std::int64_t Hdf5Reader::width(const std::string& name) {
  return ask_number({.call = Call::width}, name);
}

}  // namespace solidus::results
