// Skins of triangles: STL files, and what makes a skin a closed one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include "mesh/files/stl_file.hpp"
#include "mesh/making/closed_shells.hpp"
#include "sample_mesh.hpp"
#include "system/errors.hpp"

namespace {

using namespace solidus;
using namespace solidus::mesh;
using ::testing::HasSubstr;

/// The twelve triangles of a box.
Facets box(const std::string& name, const Point& low, const Point& high) {
  Facets facets{name, {}};
  const auto corner = [&](unsigned c) {
    return Point{(c & 1U) != 0 ? high[0] : low[0], (c & 2U) != 0 ? high[1] : low[1],
                 (c & 4U) != 0 ? high[2] : low[2]};
  };
  constexpr std::array<std::array<unsigned, 4>, 6> k_faces = {
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& f : k_faces) {
    facets.triangles.push_back({corner(f[0]), corner(f[1]), corner(f[2])});
    facets.triangles.push_back({corner(f[0]), corner(f[2]), corner(f[3])});
  }
  return facets;
}

std::string complaint_of(const std::vector<Facets>& parts) {
  try {
    closed_shells(parts, "part.stl");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ClosedShells, KnowCavitiesWhateverWayTrianglesLook) {
  Facets part = box("part", {0, 0, 0}, {60, 40, 40});
  const Facets cavity = box("part", {10, 10, 10}, {30, 30, 30});
  part.triangles.insert(part.triangles.end(), cavity.triangles.begin(), cavity.triangles.end());
  std::swap(part.triangles[3][0], part.triangles[3][1]);
  std::swap(part.triangles[14][0], part.triangles[14][1]);
  part.triangles.push_back({Point{0, 0, 0}, Point{0, 0, 0}, Point{60, 0, 0}});  // without area
  const ClosedShells all = closed_shells({part}, "part.stl");
  ASSERT_EQ(all.shells.size(), 2U);
  EXPECT_EQ(all.points.size(), 16U);
  EXPECT_EQ(all.shells[0].depth, 0);
  EXPECT_EQ(all.shells[1].depth, 1);
  EXPECT_EQ(all.shells[1].around, 0);
  for (const Shell& shell : all.shells) {
    EXPECT_EQ(shell.triangles.size(), 12U);
    EXPECT_NEAR(winding_number(all, shell, {20, 20, 20}), 1, 1e-12);
  }
  EXPECT_NEAR(winding_number(all, all.shells[0], {50, 20, 20}), 1, 1e-12);
  EXPECT_NEAR(winding_number(all, all.shells[1], {50, 20, 20}), 0, 1e-12);
}

TEST(ClosedShells, SayWhereASkinIsOpen) {
  Facets part = box("part", {0, 0, 0}, {60, 40, 40});
  part.triangles.pop_back();
  EXPECT_THAT(complaint_of({part}), HasSubstr("3 edges belong to one triangle alone, the first near ("));
}

TEST(ClosedShells, SayWhereBodiesTouch) {
  const std::string complaint =
      complaint_of({box("a", {0, 0, 0}, {10, 10, 10}), box("b", {10, 0, 0}, {20, 10, 10})});
  EXPECT_THAT(complaint, HasSubstr("belong to more than two triangles"));
  EXPECT_THAT(complaint, HasSubstr("bodies touch there"));
}

class StlFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(SOLIDUS_BINARY_DIR) / ("stl_files_" + std::to_string(test::rank()));
    std::filesystem::create_directories(folder_);
  }
  std::string write(const std::string& file, const std::string& bytes) const {
    std::ofstream(folder_ / file, std::ios::binary) << bytes;
    return (folder_ / file).string();
  }
  static std::string text(const Facets& facets) {
    std::string out = "solid " + facets.name + "\n";
    for (const auto& triangle : facets.triangles) {
      out += "facet normal 0 0 0\n outer loop\n";
      for (const Point& p : triangle)
        out += "  vertex " + std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) +
               "\n";
      out += " endloop\nendfacet\n";
    }
    return out + "endsolid " + facets.name + "\n";
  }
  static std::string binary(const Facets& facets) {
    std::string out(80, ' ');
    out.replace(0, 5, "solid");  // as some programs write it
    const auto n = static_cast<std::uint32_t>(facets.triangles.size());
    out.append(reinterpret_cast<const char*>(&n), sizeof n);
    for (const auto& triangle : facets.triangles) {
      std::array<float, 12> x{};
      for (std::size_t i = 0; i < 9; ++i) x[3 + i] = static_cast<float>(triangle[i / 3][i % 3]);
      out.append(reinterpret_cast<const char*>(x.data()), sizeof x);
      out.append(2, '\0');
    }
    return out;
  }
  static std::string complaint(const std::string& path) {
    try {
      read_stl(path);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

 private:
  std::filesystem::path folder_;
};

TEST_F(StlFiles, TextAndBinaryHoldTheSame) {
  const Facets part = box("pump housing", {0, 0, -1}, {2, 3, 4});
  const std::vector<Facets> read =
      read_stl(write("text.stl", text(part) + text(box("b", {5, 5, 5}, {6, 6, 6}))));
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[0].name, "pump housing");
  EXPECT_EQ(read[0].triangles, part.triangles);
  const std::vector<Facets> second = read_stl(write("binary.stl", binary(part)));
  ASSERT_EQ(second.size(), 1U);
  EXPECT_EQ(second[0].triangles, part.triangles);
}

TEST_F(StlFiles, SayWhatIsWrong) {
  const Facets part = box("part", {0, 0, 0}, {1, 1, 1});
  const std::string bytes = binary(part), words = text(part);
  EXPECT_THAT(complaint(write("cut.stl", words.substr(0, words.size() / 2))), HasSubstr("cut"));
  std::string title = bytes.substr(0, bytes.size() - 7);
  title[0] = 'S';
  EXPECT_THAT(complaint(write("cut_binary.stl", title)), HasSubstr("says that it holds 12 triangles"));
  std::string wrong = words;
  wrong.replace(wrong.find("vertex 0"), 8, "vertex x");
  EXPECT_THAT(complaint(write("word.stl", wrong)), HasSubstr("word.stl:4"));
  wrong = words;
  wrong.replace(wrong.find("endfacet"), 8, "endfaced");
  EXPECT_THAT(complaint(write("wrong.stl", wrong)), HasSubstr("'endfaced' is no word"));
}

}  // namespace
