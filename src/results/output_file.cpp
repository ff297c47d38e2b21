#include "results/output_file.hpp"

#include <cerrno>
#include <system_error>
#include <utility>

namespace solidus::results {

namespace {

std::string reason(int error) {
  return std::generic_category().message(error);
}

}  // namespace

OutputFile::OutputFile(std::filesystem::path path, Mode mode) : path_(std::move(path)) {
  errno = 0;
  file_.reset(std::fopen(path_.c_str(), mode == Mode::replace ? "wb" : "ab"));
  if (!file_) throw OutputError(path_.string(), "cannot open for writing: " + reason(errno));
}

void OutputFile::write(std::string_view bytes) {
  errno = 0;
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size())
    throw OutputError(path_.string(), "cannot write: " + reason(errno));
}

void OutputFile::write(std::span<const std::byte> bytes) {
  write(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

void OutputFile::flush() {
  errno = 0;
  if (std::fflush(file_.get()) != 0) throw OutputError(path_.string(), "cannot write: " + reason(errno));
}

void OutputFile::close() {
  flush();
  errno = 0;
  if (std::fclose(file_.release()) != 0) throw OutputError(path_.string(), "cannot write: " + reason(errno));
}

namespace {

std::filesystem::path part_of(const std::filesystem::path& path) {
  return path.string() + ".part";
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path path) : path_(std::move(path)), file_(part_of(path_)) {}

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
