/// Files are written next to their name and renamed at the end, so that a reader never sees half of one.
#include "results/output/output_file.hpp"

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>
#include <vector>

namespace solidus::results {

namespace {

std::string reason(int error) {
  return std::generic_category().message(error);
}

}  // namespace

OutputFile::OutputFile(std::filesystem::path path, Mode mode) : OutputFile(path, mode, path) {}

OutputFile::OutputFile(std::filesystem::path path, Mode mode, std::filesystem::path shown)
    : path_(std::move(path)), shown_(std::move(shown)) {
  errno = 0;
  file_.reset(std::fopen(path_.c_str(), mode == Mode::replace ? "wb" : "ab"));
  if (!file_) throw OutputError(shown_.string(), "cannot open for writing: " + reason(errno));
}

void OutputFile::write(std::string_view bytes) {
  errno = 0;
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size())
    throw OutputError(shown_.string(), "cannot write: " + reason(errno));
}

void OutputFile::write(std::span<const std::byte> bytes) {
  write(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

void OutputFile::flush() {
  errno = 0;
  if (std::fflush(file_.get()) != 0) throw OutputError(shown_.string(), "cannot write: " + reason(errno));
}

void OutputFile::close() {
  flush();
  errno = 0;
  if (std::fclose(file_.release()) != 0) throw OutputError(shown_.string(), "cannot write: " + reason(errno));
}

SpoolFile::SpoolFile(std::filesystem::path path) : path_(std::move(path)) {
  errno = 0;
  file_.reset(std::fopen(path_.c_str(), "w+b"));
  std::error_code error;
  if (!file_) throw OutputError(path_.string(), "cannot open for writing: " + reason(errno));
  std::filesystem::remove(path_, error);
  if (error) throw OutputError(path_.string(), "cannot write: " + error.message());
}

void SpoolFile::write(std::span<const std::byte> bytes) {
  errno = 0;
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size())
    throw OutputError(path_.string(), "cannot write: " + reason(errno));
  size_ += bytes.size();
}

void SpoolFile::seek(std::uint64_t at) {
  errno = 0;
  if (fseeko(file_.get(), static_cast<off_t>(at), SEEK_SET) != 0)
    throw OutputError(path_.string(), "cannot write: " + reason(errno));
}

void SpoolFile::overwrite(std::uint64_t at, std::span<const std::byte> bytes) {
  const std::uint64_t end = size_;
  seek(at);
  write(bytes);
  seek(end);
  size_ = end;
}

void SpoolFile::copy_to(OutputFile& out) {
  seek(0);  // which writes what is buffered
  std::vector<std::byte> buffer(std::size_t{1} << 17);
  for (std::uint64_t left = size_; left > 0;) {
    errno = 0;
    const std::size_t n =
        std::fread(buffer.data(), 1, std::min<std::uint64_t>(left, buffer.size()), file_.get());
    if (n == 0) throw OutputError(path_.string(), "cannot read: " + reason(errno));
    out.write(std::span<const std::byte>(buffer).first(n));
    left -= n;
  }
}

namespace {

std::filesystem::path part_of(const std::filesystem::path& path) {
  return path.string() + ".part";
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path path)
    : path_(std::move(path)), file_(part_of(path_), OutputFile::Mode::replace, path_) {}

AtomicFile::~AtomicFile() {
  std::error_code ignored;
  if (!committed_) std::filesystem::remove(file_.path(), ignored);
}

void AtomicFile::commit() {
  file_.close();
  std::error_code error;
  std::filesystem::rename(file_.path(), path_, error);
  if (error) throw OutputError(path_.string(), "cannot write: " + error.message());
  committed_ = true;
}

void write_file(const std::filesystem::path& path, std::string_view text) {
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

}  // namespace solidus::results
