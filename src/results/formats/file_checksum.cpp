/// The sum goes over all bytes behind the first block, where it is kept.
#include "results/formats/file_checksum.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "results/output/output_error.hpp"

namespace solidus::results {

namespace {

/// An open file, closed whatever happens.
class Descriptor {
 public:
  Descriptor(const std::filesystem::path& file, int flags) : id_(::open(file.c_str(), flags | O_CLOEXEC)) {
    if (id_ < 0) throw OutputError(file.string(), std::string("cannot be opened: ") + std::strerror(errno));
  }
  ~Descriptor() { ::close(id_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  operator int() const { return id_; }  // NOLINT: passes as the system's type

 private:
  int id_;
};

/// The user block of a file of this content: text, and zeros behind it.
std::string user_block(const std::filesystem::path& file, int descriptor) {
  std::vector<unsigned char> buffer(std::size_t{1} << 16);
  std::uint64_t size = k_user_block;
  unsigned long crc = crc32(0, nullptr, 0);
  // The sum runs over the content in blocks, so that a large file needs no large memory.
  while (true) {
    const ssize_t n = pread(descriptor, buffer.data(), buffer.size(), static_cast<off_t>(size));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw OutputError(file.string(), std::string("cannot be read: ") + std::strerror(errno));
    if (n == 0) break;
    crc = crc32(crc, buffer.data(), static_cast<unsigned>(n));
    size += static_cast<std::uint64_t>(n);
  }
  std::string block =
      fmt::format("Solidus: {} bytes with the CRC-32 {:08x} behind the first {}\n", size, crc, k_user_block);
  block.resize(k_user_block, '\0');
  return block;
}

}  // namespace

void write_checksum(const std::filesystem::path& file) {
  const Descriptor descriptor(file, O_RDWR);
  const std::string block = user_block(file, descriptor);
  if (pwrite(descriptor, block.data(), block.size(), 0) != static_cast<ssize_t>(block.size()) ||
      (fsync(descriptor) != 0 && errno != EINVAL))  // a device has nothing to bring to a disk
    throw OutputError(file.string(), std::string("cannot write: ") + std::strerror(errno),
                      "is there room on the disk?");
}

void check_checksum(const std::filesystem::path& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0 || !S_ISREG(status.st_mode))
    throw OutputError(file.string(), "is no regular file");
  const Descriptor descriptor(file, O_RDONLY);
  std::string found(k_user_block, '\0');
  if (pread(descriptor, found.data(), found.size(), 0) != static_cast<ssize_t>(found.size()))
    throw OutputError(file.string(), "is cut off");
  if (!found.starts_with("Solidus: "))
    throw OutputError(file.string(), "is no checkpoint that this version of Solidus can read");
  if (found != user_block(file, descriptor))
    throw OutputError(file.string(), "is damaged: its content is not that of its checksum");
}

}  // namespace solidus::results
