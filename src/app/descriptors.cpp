#include "app/descriptors.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <utility>

#include "numbers/index_casts.hpp"

namespace solidus::app {

namespace {

constexpr std::size_t k_longest_line = 200;  // bytes
constexpr std::size_t k_most_files = 4;

/// Room for the control message, aligned as its header must be.
struct alignas(cmsghdr) Control {
  std::array<char, CMSG_SPACE(k_most_files * sizeof(int))> bytes{};
};

/// The address of a name without a file, which goes with its last socket.
sockaddr_un address_of(const std::string& name) {
  // A zero in front of the name tells Linux that it is no path: nothing is left on a disk when the program is
  // killed.
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path + 1, name.data(), std::min(name.size(), sizeof address.sun_path - 1));
  return address;
}

socklen_t length_of(const std::string& name) {
  return static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
}

}  // namespace

Descriptor::~Descriptor() {
  // The number is closed once: whoever gives a descriptor away keeps −1.
  if (number_ >= 0) ::close(number_);
}
Descriptor::Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  if (this != &other) {
    if (number_ >= 0) ::close(number_);
    number_ = std::exchange(other.number_, -1);
  }
  return *this;
}

Meeting open_meeting() {
  Meeting meeting{Descriptor(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0)), {}};
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  // The system's own choice is free for certain, and so two runs of one user never meet each other's
  // processes.
  socklen_t length = sizeof address.sun_family;  // no name: the system chooses one
  auto* const any = reinterpret_cast<sockaddr*>(&address);
  if (!meeting.socket.open() || ::bind(meeting.socket.number(), any, length) != 0)
    return Meeting{Descriptor(), {}};
  // The name that was chosen is read back, without the zero in front of it.
  length = sizeof address;
  if (::getsockname(meeting.socket.number(), any, &length) != 0 ||
      ::listen(meeting.socket.number(), SOMAXCONN) != 0)
    return Meeting{Descriptor(), {}};
  meeting.name.assign(address.sun_path + 1, length - offsetof(sockaddr_un, sun_path) - 1);
  return meeting;
}

Descriptor join_meeting(const std::string& name) {
  Descriptor connection(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0));
  const sockaddr_un address = address_of(name);
  if (connection.open() &&
      ::connect(connection.number(), reinterpret_cast<const sockaddr*>(&address), length_of(name)) == 0)
    return connection;
  return Descriptor();
}

std::optional<pid_t> process_behind(const Descriptor& connection) {
  ucred other{};
  // The system itself says who is at the other end, so that no word of the sender has to be believed.
  socklen_t length = sizeof other;
  if (::getsockopt(connection.number(), SOL_SOCKET, SO_PEERCRED, &other, &length) != 0 ||
      other.uid != ::geteuid())
    return std::nullopt;
  return other.pid;
}

bool send_files(const Descriptor& connection, const std::string& line, std::span<const int> files) {
  std::string text = line.substr(0, k_longest_line);
  // At least one byte has to go along, for without data no descriptors are sent.
  iovec part{text.data(), text.size()};
  Control control;
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  if (!files.empty()) {
    message.msg_control = control.bytes.data();
    message.msg_controllen = CMSG_SPACE(files.size_bytes());
    cmsghdr* const header = CMSG_FIRSTHDR(&message);
    header->cmsg_level = SOL_SOCKET;
    header->cmsg_type = SCM_RIGHTS;
    header->cmsg_len = CMSG_LEN(files.size_bytes());
    std::memcpy(CMSG_DATA(header), files.data(), files.size_bytes());
  }
  ssize_t sent = -1;
  // A signal that comes meanwhile is no failure: the call is repeated. A partner that is gone shall not end
  // this program by a signal of its own.
  do sent = ::sendmsg(connection.number(), &message, MSG_NOSIGNAL);
  while (sent < 0 && errno == EINTR);
  return sent == static_cast<ssize_t>(text.size());
}

std::optional<ReceivedFiles> receive_files(const Descriptor& connection) {
  std::array<char, k_longest_line> text{};
  iovec part{text.data(), text.size()};
  Control control;
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = control.bytes.data();
  message.msg_controllen = control.bytes.size();
  ssize_t n = -1;
  // Descriptors that arrive are closed in programs that this one starts.
  do n = ::recvmsg(connection.number(), &message, MSG_CMSG_CLOEXEC);
  while (n < 0 && errno == EINTR);
  // Nothing read means that the other side has gone.
  if (n <= 0) return std::nullopt;
  ReceivedFiles received{std::string(text.data(), as_size(n)), {}};
  // Each number that has arrived is taken into an object at once, so that it is closed whatever follows.
  for (cmsghdr* header = CMSG_FIRSTHDR(&message); header != nullptr; header = CMSG_NXTHDR(&message, header)) {
    if (header->cmsg_level != SOL_SOCKET || header->cmsg_type != SCM_RIGHTS) continue;
    const std::size_t count = (header->cmsg_len - CMSG_LEN(0)) / sizeof(int);
    for (std::size_t i = 0; i < count; ++i) {
      // The bytes are copied, since a control message need not be aligned for numbers.
      int number = -1;
      std::memcpy(&number, CMSG_DATA(header) + i * sizeof(int), sizeof number);
      received.files.emplace_back(number);
    }
  }
  return received;
}

}  // namespace solidus::app
