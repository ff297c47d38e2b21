/// A sample of what `./dev fuzz` does for as long as one likes, without libFuzzer, so that every run of the
/// tests has it: the stored inputs of a reader as they are, and damaged ones.
///
///   test_fuzz READER COUNT SEED CORPUS
///
/// An input that crashes the reader, keeps it for 20 s or takes more than 2 GB is left as crash-READER in the
/// present folder, where `fuzz_READER crash-READER` of the preset `fuzz` takes it.
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "mutation.hpp"
#include "system/sandbox.hpp"

#define SOLIDUS_READER(name) int fuzz_##name(const std::uint8_t* data, std::size_t size)
extern "C" {
SOLIDUS_READER(case);
SOLIDUS_READER(material);
SOLIDUS_READER(point);
SOLIDUS_READER(csv);
SOLIDUS_READER(overrides);
SOLIDUS_READER(checkpoint);
SOLIDUS_READER(mesh);
SOLIDUS_READER(vtk);
SOLIDUS_READER(openfoam);
SOLIDUS_READER(import);
SOLIDUS_READER(report);
}

namespace {

namespace fs = std::filesystem;
using Reader = int (*)(const std::uint8_t*, std::size_t);

const std::map<std::string, Reader> k_readers = {
    {"case", fuzz_case},           {"material", fuzz_material},     {"point", fuzz_point},  {"csv", fuzz_csv},
    {"overrides", fuzz_overrides}, {"checkpoint", fuzz_checkpoint}, {"mesh", fuzz_mesh},    {"vtk", fuzz_vtk},
    {"openfoam", fuzz_openfoam},   {"import", fuzz_import},         {"report", fuzz_report}};

// For the handler of signals, which may not allocate.
std::string crash_file;  // NOLINT
std::string input;       // NOLINT

/// Leaves the input that is being read, and ends as the signal asks.
extern "C" void leave_input(int signal) {
  const int file = open(crash_file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (file >= 0 && write(file, input.data(), input.size()) < 0) _exit(3);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The quoted words of libFuzzer's dictionary.
std::vector<std::string> words(const fs::path& file) {
  std::vector<std::string> found;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (line.size() < 2 || line.front() != '"') continue;
    std::string word;
    for (std::size_t i = 1; i + 1 < line.size(); ++i) {
      if (line[i] == '\\' && i + 2 < line.size()) ++i;
      word.push_back(line[i]);
    }
    found.push_back(word);
  }
  return found;
}

void read(Reader reader) {
  alarm(20);
  reader(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());  // NOLINT: bytes are bytes
  alarm(0);
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const auto reader = arguments.size() == 4 ? k_readers.find(arguments[0]) : k_readers.end();
  if (reader == k_readers.end()) {
    std::fputs("usage: test_fuzz READER COUNT SEED CORPUS\n", stderr);
    return 1;
  }
  std::vector<fs::path> files(fs::directory_iterator(arguments[3]), fs::directory_iterator{});
  std::sort(files.begin(),
            files.end());  // the same inputs from the same seed, whatever the order on the disk
  std::vector<std::string> corpus;
  for (const auto& file : files) corpus.push_back(content(file));
  if (corpus.empty()) {
    std::fprintf(stderr, "%s holds no input\n", arguments[3].c_str());
    return 1;
  }

  crash_file = "crash-" + arguments[0];
  fs::remove(crash_file);
  for (const int signal : {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGALRM})
    std::signal(signal, leave_input);
  FILE* const answer = fdopen(dup(STDOUT_FILENO), "w");
  for (FILE* const said : {stdout, stderr})  // readers warn of what they read
    if (answer == nullptr || std::freopen("/dev/null", "w", said) == nullptr) return 1;
  constexpr double k_memory = 2UL << 30;
  solidus::sandbox::limit_memory(k_memory);
  for (const auto& text : corpus) {
    input = text;
    read(reader->second);
  }
  solidus::fuzz::Mutation mutation(corpus, words(SOLIDUS_SOURCE_DIR "/tests/fuzz/toml.dict"),
                                   std::stoull(arguments[2]));
  for (unsigned long n = std::stoul(arguments[1]); n > 0; --n) {
    input = mutation.next();
    read(reader->second);
  }
  std::fprintf(answer, "%zu stored inputs and %s damaged ones\n", corpus.size(), arguments[1].c_str());
  return 0;
}
