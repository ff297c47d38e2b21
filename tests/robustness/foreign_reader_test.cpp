/// A reader of meshes that is missing, damaged, of another build, hangs, dies or answers nonsense: each ends
/// in one message with exit code 1, and nothing is written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "foreign_files.hpp"
#include "system/version.hpp"

namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using namespace solidus::tests;

/// A copy of the program in a folder whose name has a blank, and what replaces its reader there.
class ForeignReader : public ForeignFiles {
 protected:
  void SetUp() override {
    ForeignFiles::SetUp();
    fs::create_directories(folder_ / "a copy");
    fs::copy_file(SOLIDUS_BINARY_DIR "/solidus", folder_ / "a copy/solidus");
  }
  void become(const std::string& content) const {
    write("a copy/solidus-reader", content);
    fs::permissions(folder_ / "a copy/solidus-reader", fs::perms::owner_all);
  }
  void script(const std::string& lines) const { become("#!/bin/bash\n" + lines + "\n"); }
  std::string whole_reader() const {
    std::ifstream file(SOLIDUS_BINARY_DIR "/solidus-reader", std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void expect_nothing_read(const std::vector<std::string>& phrases) const {
    expect_refused("export SOLIDUS_MESH_TIME='10 s'; './a copy/solidus' run case.toml -o out", phrases);
    EXPECT_FALSE(has("out/history.csv"));
    EXPECT_FALSE(has("out/checkpoint"));
  }
};

TEST_F(ForeignReader, IsFoundBesideTheProgramWhateverThePathAndTheFolder) {
  become(whole_reader());
  EXPECT_EQ(shell("'./a copy/solidus' check case.toml").code, 0);
  EXPECT_EQ(shell("ln -s 'a copy/solidus' link; ./link check case.toml").code, 0);
  const Outcome outcome = shell("env PATH=\"$PWD/a copy:/bin\" solidus check case.toml");
  EXPECT_EQ(outcome.code, 0) << outcome.said;
}

TEST_F(ForeignReader, ThatIsMissingOrCannotBeStartedIsNamed) {
  expect_nothing_read({"part.geo", "'solidus-reader', is missing next to"});
  fs::create_directory(folder_ / "a copy/solidus-reader");
  expect_nothing_read({"part.geo", "a copy/solidus-reader', cannot be started"});
  fs::remove(folder_ / "a copy/solidus-reader");
  write("a copy/solidus-reader", "no program");
  expect_nothing_read({"cannot be started: Permission denied"});
  become("no program");
  expect_nothing_read({"cannot be started: Exec format error"});
  script("exit 127");  // what the loader ends with where a library is missing
  expect_nothing_read({"part.geo", "cannot run", "ldd"});
}

// The restriction by the system is what holds, whatever a script says (SECURITY.md): it is there while a mesh
// is handed back, for a script that is not trusted. A pipe that no one empties keeps the reader alive.
TEST_F(ForeignReader, IsRestrictedByTheSystemUnlessTheScriptIsTrusted) {
  write("part.geo", std::string(k_square) + "Mesh.MeshSizeMax = 0.2;\n");
  script("exec 5< <(exec '" SOLIDUS_BINARY_DIR
         "/solidus-reader' 4>&1 >/dev/null); reader=$!\n"
         "head -c 1 <&5 > first; grep Seccomp: /proc/$reader/status > filter; cat first - <&5 >&4");
  EXPECT_EQ(shell("'./a copy/solidus' mesh-info part.geo").code, 0);
  EXPECT_EQ(shell("cat filter").said, "Seccomp:\t2\n");
  EXPECT_EQ(shell("'./a copy/solidus' mesh-info part.geo --trust-geo").code, 0);
  EXPECT_EQ(shell("cat filter").said, "Seccomp:\t0\n");
}

/// Two triangles among so many nodes that reading them takes a while.
std::string mesh_of_two_triangles(int n_nodes) {
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" + std::to_string(n_nodes) +
                     "\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 1 1 0\n";
  for (int node = 5; node <= n_nodes; ++node) text += std::to_string(node) + " 0.5 0.5 0\n";
  return text + "$EndNodes\n$Elements\n2\n1 2 2 1 1 1 2 3\n2 2 2 1 1 2 4 3\n$EndElements\n";
}

// A mesh of a format that the program reads itself needs no reader: a copy of the program reads it, with the
// same limits and restrictions, and nothing of the program is open to it but the two pipes.
TEST_F(ForeignReader, IsNotNeededForAMeshThatTheProgramReadsItself) {
  write("part.msh", mesh_of_two_triangles(4));
  EXPECT_EQ(shell("'./a copy/solidus' mesh-info part.msh").code, 0);
  write("part.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0\n");
  expect_refused("'./a copy/solidus' mesh-info part.msh", {"part.msh"});
  write("part.msh", mesh_of_two_triangles(1500000));
  expect_refused("export SOLIDUS_MESH_MEMORY='10 MB'; './a copy/solidus' mesh-info part.msh",
                 {"part.msh", "more memory than 10 MB"});
  const Outcome watched = shell(
      "exec 7< part.msh; './a copy/solidus' mesh-info part.msh >/dev/null & program=$!\n"
      "while kill -0 $program 2>/dev/null; do for child in $(cat /proc/$program/task/$program/children); do\n"
      "  grep Seccomp: /proc/$child/status; ls /proc/$child/fd | tail -1; done; done 2>/dev/null | sort -u");
  EXPECT_THAT(watched.said, AllOf(HasSubstr("Seccomp:\t2\n"), Not(HasSubstr("7\n"))));
}

TEST_F(ForeignReader, OfAnotherBuildIsRefused) {
  std::string reader = whole_reader();
  const std::string& version = solidus::program_version();  // without a commit, as tests do not set it
  for (std::size_t at = reader.find(version); at != std::string::npos; at = reader.find(version, at + 1))
    reader[at] ^= 1;  // another first figure
  become(reader);
  expect_nothing_read({"part.geo", "solidus-reader is of version", "the program of " + version});
}

TEST_F(ForeignReader, ThatEndsDiesOrHangsIsNamed) {
  script("exit 7");
  expect_nothing_read({"part.geo", "exit code 7"});
  script("kill -KILL $$");
  expect_nothing_read({"part.geo", "was killed"});
  script("kill -SEGV $$");
  expect_nothing_read({"part.geo", "the reader crashed", "Segmentation"});
  script("kill -ABRT $$");
  expect_nothing_read({"part.geo", "the reader crashed", "Aborted"});
  script("exec sleep 60");
  expect_nothing_read({"part.geo", "longer than 10 s"});
  script("exec 4>&-; exec sleep 60");
  expect_nothing_read({"part.geo", "went on without an answer"});
  script("'" SOLIDUS_BINARY_DIR
         "/solidus-reader' 4>&1 >&4 | head -c 60 >&4; kill -KILL $$");  // in mid-answer
  expect_nothing_read({"part.geo", "was killed"});
}

TEST_F(ForeignReader, ThatTakesLongIsReportedWithItsLimit) {
  script("exec sleep 60");
  const Outcome slow = shell("export SOLIDUS_MESH_TIME='7 s'; './a copy/solidus' check case.toml");
  EXPECT_EQ(slow.code, 1);
  EXPECT_THAT(slow.said, AllOf(HasSubstr("is being read or meshed for 5 s"), HasSubstr("up to 7 s"),
                               HasSubstr("longer than 7 s")));
}

TEST_F(ForeignReader, ThatAnswersNonsenseIsNamed) {
  for (const char* nonsense :
       {"echo some text >&4", "head -c 100000 /dev/zero >&4", "yes >&4", "printf '\\0\\0\\0\\0' >&4; yes >&4",
        "printf '\\11\\0\\0\\0' >&4; exec sleep 60"}) {
    script(nonsense);
    expect_nothing_read({"part.geo", "a copy/solidus-reader', answered is no mesh"});
  }
}

TEST_F(ForeignReader, ThatHangsIsGivenUpAtASignal) {
  script("exec sleep 60");
  for (const char* signal : {"TERM", "HUP"}) {
    const Outcome outcome = shell("timeout --foreground --preserve-status -s " + std::string(signal) +
                                  " 2 './a copy/solidus' run case.toml -o out");
    EXPECT_EQ(outcome.code, 2) << signal << ": " << outcome.said;
    EXPECT_THAT(outcome.said, HasSubstr("stopped by a signal while the mesh was read"));
    EXPECT_FALSE(has("out/history.csv"));
  }
}

}  // namespace
