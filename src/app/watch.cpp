/// A small server for one machine: requests are checked by a token, and the page is made again when the run
/// has gone on.
#include "app/watch.hpp"

#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/random.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "numbers/index_casts.hpp"
#include "results/formats/pvd.hpp"
#include "results/report/report_page.hpp"
#include "system/errors.hpp"

namespace solidus::app {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t k_most_request = 8192;   // [byte]
constexpr std::size_t k_most_visitors = 64;    // connected at once
constexpr std::chrono::seconds k_patience{4};  // with a visitor that says nothing
constexpr std::chrono::seconds k_soonest{2};   // between two pages
constexpr double k_share = 0.05;               // of the time goes into pages at most
constexpr std::chrono::seconds k_looks_on{10}, k_last_page{6};

std::string random_token() {
  std::array<std::uint8_t, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw InputError({}, "the system has no random numbers for the address of --watch");
  std::string out;
  for (const std::uint8_t byte : bytes) out += fmt::format("{:02x}", byte);
  return out;
}

/// Takes the same time wherever the texts differ.
bool same(const std::string& a, const std::string& b) {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    difference |= static_cast<unsigned>(a[i]) ^ static_cast<unsigned>(b[i]);
  return difference == 0;
}

std::string response(const char* status, const char* type, const std::string& body) {
  return fmt::format(
      "HTTP/1.1 {}\r\nContent-Type: {}; charset=utf-8\r\nContent-Length: {}\r\nCache-Control: no-store\r\n"
      "X-Content-Type-Options: nosniff\r\nReferrer-Policy: no-referrer\r\nConnection: close\r\n\r\n{}",
      status, type, body.size(), body);
}

/// A page that looks again by itself.
std::string waiting(const std::string& text) {
  std::string safe;
  for (const char c : text) safe += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  return "<!doctype html><meta charset=utf-8><meta http-equiv=refresh content=2><title>Solidus</title><p>" +
         safe;
}

std::string header(const std::string& request, const std::string& name) {
  std::string lower = request;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const std::size_t at = lower.find("\r\n" + name + ":");
  if (at == std::string::npos) return {};
  std::size_t begin = at + name.size() + 3;
  while (begin < lower.size() && lower[begin] == ' ') ++begin;
  return lower.substr(begin, lower.find("\r\n", begin) - begin);
}

}  // namespace

Watch::Watch(fs::path folder)
    : folder_(std::move(folder)),
      since_(fs::file_time_type::clock::now() - std::chrono::seconds(1)),
      token_(random_token()) {
  // A free port of this machine alone; the address holds a random token, which other users of the machine do
  // not know.
  socket_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in here{};
  here.sin_family = AF_INET;
  here.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof here;
  auto* const address = reinterpret_cast<sockaddr*>(&here);
  if (socket_ < 0 || ::bind(socket_, address, size) != 0 || ::listen(socket_, 8) != 0 ||
      ::getsockname(socket_, address, &size) != 0) {
    const int error = errno;
    if (socket_ >= 0) ::close(socket_);
    throw InputError({}, fmt::format("--watch cannot listen on this machine: {}", std::strerror(error)));
  }
  // The address names the port and the token, without which nothing is answered.
  host_ = fmt::format(":{}", ntohs(here.sin_port));
  address_ = fmt::format("http://127.0.0.1{}/{}/", host_, token_);
  // Signals are for the run: this thread hears none.
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  // The thread is started with all signals blocked, and inherits that.
  try {
    thread_ = std::thread([this] { serve(); });
  } catch (const std::system_error& error) {
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    ::close(socket_);
    throw InputError({}, fmt::format("--watch cannot start its thread: {}", error.what()));
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

Watch::~Watch() {
  stop_ = true;
  thread_.join();
  ::close(socket_);
}

void Watch::finish() {
  const auto looked = Clock::time_point(Clock::duration(asked_.load()));
  ended_ = true;
  if (asked_ == 0 || Clock::now() - looked > k_looks_on) return;
  const auto until = Clock::now() + k_last_page;
  while (!last_served_ && Clock::now() < until) std::this_thread::sleep_for(std::chrono::milliseconds(50));
}

void Watch::serve() {
  std::vector<Visitor> visitors;
  std::vector<pollfd> wait;
  while (!stop_) {
    // Waits for a new visitor or for words of one that is there, a tenth of a second at most, so
    // that it ends soon when asked to.
    wait.assign(1, {socket_, POLLIN, 0});
    for (const Visitor& visitor : visitors) wait.push_back({visitor.connection, POLLIN, 0});
    ::poll(wait.data(), wait.size(), 100);
    // A visitor is heard when it says something: one that only connects, as browsers do ahead of time, keeps
    // no client waiting.
    for (std::size_t i = visitors.size(); i-- > 0;) {
      const bool said = wait[i + 1].revents != 0;
      if (said ? hear(visitors[i]) : Clock::now() < visitors[i].until) continue;
      ::close(visitors[i].connection);
      visitors.erase(visitors.begin() + static_cast<std::ptrdiff_t>(i));
    }
    if (wait[0].revents == 0) continue;
    const int connection = ::accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC);
    if (connection < 0) continue;
    // The number of visitors is bounded: whoever has waited longest goes.
    if (visitors.size() == k_most_visitors) {  // the one that has been here longest leaves
      ::close(visitors.front().connection);
      visitors.erase(visitors.begin());
    }
    visitors.push_back({connection, {}, Clock::now() + k_patience});
  }
  for (const Visitor& visitor : visitors) ::close(visitor.connection);
}

bool Watch::hear(Visitor& visitor) {
  std::array<char, 2048> part{};
  const ssize_t n = ::recv(visitor.connection, part.data(), part.size(), MSG_DONTWAIT);
  if (n <= 0 || visitor.request.size() > k_most_request) return false;
  visitor.request.append(part.data(), as_size(n));
  if (visitor.request.find("\r\n\r\n") == std::string::npos) return Clock::now() < visitor.until;
  try {
    answer(visitor.connection, reply(visitor.request));
  } catch (const std::exception&) {
    // The request is left without an answer; the run continues.
  }
  return false;
}

void Watch::answer(int connection, const std::string& text) {
  // A visitor that does not read or write for two seconds is given up.
  const timeval patience{2, 0};
  ::setsockopt(connection, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  ::setsockopt(connection, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
  for (std::size_t sent = 0; sent < text.size();) {
    const ssize_t n = ::send(connection, text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
    if (n <= 0) return;
    sent += as_size(n);
  }
  // Until the other side has it: closing at once may drop what is on its way.
  ::shutdown(connection, SHUT_WR);
  std::array<char, 2048> part{};
  const auto until = Clock::now() + k_patience;
  while (::recv(connection, part.data(), part.size(), 0) > 0 && Clock::now() < until) {
  }
}

std::string Watch::reply(const std::string& request) {
  const std::string none = response("404 Not Found", "text/plain", "there is nothing here\n");
  // A page of another site could ask through a name that it points to this machine: then the name is wrong.
  const std::string host = header(request, "host");
  if (host != "127.0.0.1" + host_ && host != "localhost" + host_) return none;
  if (!request.starts_with("GET ")) return none;
  const std::string path = request.substr(4, request.find(' ', 4) - 4);
  if (path.size() < token_.size() + 2 || !same(path.substr(0, token_.size() + 2), "/" + token_ + "/"))
    return none;
  // Behind the token either nothing, which asks for the page, or the stamp by which the page knows
  // that it is old.
  const std::string what = path.substr(token_.size() + 2);
  if (!what.empty() && what != "stamp") return none;
  asked_ = Clock::now().time_since_epoch().count();
  if (!begun())
    return what.empty() ? response("200 OK", "text/html", waiting("The run is being set up …"))
                        : response("200 OK", "text/plain", "none");
  renew();
  if (what.empty() && ended_) last_served_ = true;
  return what.empty() ? response("200 OK", "text/html", page_) : response("200 OK", "text/plain", stamp_);
}

bool Watch::begun() const {
  std::error_code error;
  const auto changed = fs::last_write_time(folder_ / "case.toml", error);
  return !error && changed >= since_ && fs::exists(folder_ / "history.csv", error);
}

std::string Watch::stamp() const {
  std::error_code error;
  std::string out;
  for (const std::string_view name :
       std::initializer_list<std::string_view>{"history.csv", results::k_collection, "summary.json"}) {
    const auto size = fs::file_size(folder_ / name, error);
    out += fmt::format("{}-", error ? 0 : size);
  }
  return out;
}

// Pages cost the machine that computes: they take a small share of the time.
void Watch::renew() {
  const std::string now = stamp();
  const bool due = Clock::now() - made_ > std::max(std::chrono::duration<double>(k_soonest), cost_ / k_share);
  if (!page_.empty() && (now == stamp_ || !(due || ended_))) return;
  const auto began = Clock::now();
  try {
    page_ = results::report_text({{folder_}}).text;
    // By it the page knows that there is a newer one.
    page_ += fmt::format("<script type=\"text/plain\" id=\"stamp\">{}</script>\n", now);
  } catch (const std::exception& error) {
    page_ = waiting(error.what());
  }
  stamp_ = now;
  made_ = Clock::now();
  cost_ = made_ - began;
}

}  // namespace solidus::app
