// Skins of triangles that are made again: shells that are united, new triangles, a wrap around skins that
// cross themselves.
#include "mesh/cgal/remeshed_skin.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include "mesh/cgal/united_shells.hpp"
#include "mesh/making/casting_geometry.hpp"
#include "mesh/making/kept_mesh.hpp"
#include "system/errors.hpp"

namespace {

using namespace solidus::mesh;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using Triangles = std::vector<std::array<Point, 3>>;

/// The twelve triangles of a box.
Triangles box(const Point& low, const Point& high) {
  Triangles triangles;
  const auto corner = [&](unsigned c) {
    return Point{(c & 1U) != 0 ? high[0] : low[0], (c & 2U) != 0 ? high[1] : low[1],
                 (c & 4U) != 0 ? high[2] : low[2]};
  };
  constexpr std::array<std::array<unsigned, 4>, 6> k_faces = {
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& f : k_faces) {
    triangles.push_back({corner(f[0]), corner(f[1]), corner(f[2])});
    triangles.push_back({corner(f[0]), corner(f[2]), corner(f[3])});
  }
  return triangles;
}

/// A cylinder about z whose sides are needles: as many as `sides`, as long as it is high.
Triangles cylinder_of_needles(int sides, double radius, double height) {
  Triangles triangles;
  const auto rim = [&](int i, double z) {
    const double angle = 2 * std::numbers::pi * i / sides;
    return Point{radius * std::cos(angle), radius * std::sin(angle), z};
  };
  for (int i = 0; i < sides; ++i) {
    const int j = (i + 1) % sides;
    triangles.push_back({rim(i, 0), rim(j, 0), rim(j, height)});
    triangles.push_back({rim(i, 0), rim(j, height), rim(i, height)});
    triangles.push_back({Point{0, 0, 0}, rim(j, 0), rim(i, 0)});
    triangles.push_back({Point{0, 0, height}, rim(i, height), rim(j, height)});
  }
  return triangles;
}

/// A tube about z.
Triangles tube(int sides, double outer, double inner, double height) {
  Triangles triangles;
  const auto rim = [&](int i, double radius, double z) {
    const double angle = 2 * std::numbers::pi * i / sides;
    return Point{radius * std::cos(angle), radius * std::sin(angle), z};
  };
  const auto square = [&](const Point& a, const Point& b, const Point& c, const Point& d) {
    triangles.push_back({a, b, c});
    triangles.push_back({a, c, d});
  };
  for (int i = 0; i < sides; ++i) {
    const int j = i + 1 == sides ? 0 : i + 1;
    square(rim(i, outer, 0), rim(j, outer, 0), rim(j, outer, height), rim(i, outer, height));
    square(rim(j, inner, 0), rim(i, inner, 0), rim(i, inner, height), rim(j, inner, height));
    square(rim(i, inner, 0), rim(j, inner, 0), rim(j, outer, 0), rim(i, outer, 0));
    square(rim(j, inner, height), rim(i, inner, height), rim(i, outer, height), rim(j, outer, height));
  }
  return triangles;
}

/// A box whose middle of the top is drawn down through its bottom: it is closed, and crosses itself.
Triangles box_that_crosses_itself() {
  Triangles triangles = box({0, 0, 0}, {40, 40, 20});
  Triangles all(triangles.begin(), triangles.begin() + 2);
  all.insert(all.end(), triangles.begin() + 4, triangles.end());
  const std::array<Point, 4> rim = {{{0, 0, 20}, {40, 0, 20}, {40, 40, 20}, {0, 40, 20}}};
  const std::array<Point, 4> brink = {{{14, 14, 20}, {26, 14, 20}, {26, 26, 20}, {14, 26, 20}}};
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t j = (i + 1) % 4;
    all.push_back({rim[i], rim[j], brink[j]});
    all.push_back({rim[i], brink[j], brink[i]});
    all.push_back({brink[i], brink[j], Point{20, 20, -3}});
  }
  return all;
}

ClosedShells shells_of(const std::vector<Facets>& parts) {
  return closed_shells(parts, "part.stl");
}

/// The least ratio of height to longest edge of the triangles of a shell, 0.87 in an equilateral one.
double slenderest(const ClosedShells& all) {
  double least = 1;
  for (const auto& t : corners_of(all, all.shells.front())) {
    const auto length = [](const Point& a, const Point& b) {
      return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    };
    const double a = length(t[0], t[1]), b = length(t[1], t[2]), c = length(t[2], t[0]), s = (a + b + c) / 2;
    const double longest = std::max({a, b, c}),
                 area = std::sqrt(std::max(0.0, s * (s - a) * (s - b) * (s - c)));
    least = std::min(least, 2 * area / (longest * longest));
  }
  return least;
}

TEST(RemeshedSkin, NeedlesBecomeTrianglesAndRimsStay) {
  const ClosedShells needles = shells_of({{"", cylinder_of_needles(180, 20, 60)}});
  EXPECT_LT(slenderest(needles), 0.02);
  const RemeshedSkin skin = remeshed_skin(needles, {.sizes = {4}}, "part.stl");
  ASSERT_EQ(skin.shells.shells.size(), 1U);
  EXPECT_GT(slenderest(skin.shells), 0.2);
  const SkinDeviation& d = skin.deviation;
  const double exact = 90 * std::sin(2 * std::numbers::pi / 180) * 400 * 60;
  EXPECT_NEAR(d.facets_volume, exact, 1e-6 * exact);
  EXPECT_NEAR(d.volume, enclosed_volume(skin.shells, skin.shells.shells.front()), 1e-6 * exact);
  EXPECT_NEAR(d.volume, exact, 0.02 * exact);
  // A chord of 4 mm lies 0.1 mm below the round; an edge of a third more twice that.
  EXPECT_LT(d.distance, 0.4);
  double low = 0, high = 0;
  for (const Point& p : skin.shells.points) low = std::min(low, p[2]), high = std::max(high, p[2]);
  EXPECT_NEAR(low, 0, 1e-9);
  EXPECT_NEAR(high, 60, 1e-9);
}

TEST(RemeshedSkin, ABoxKeepsItsVolumeAndACavityIsTakenOff) {
  Triangles part = box({0, 0, 0}, {60, 40, 40});
  const Triangles cavity = box({10, 10, 10}, {30, 30, 30});
  part.insert(part.end(), cavity.begin(), cavity.end());
  const RemeshedSkin skin = remeshed_skin(shells_of({{"", part}}), {.sizes = {5, 5}}, "part.stl");
  EXPECT_NEAR(skin.deviation.volume, 60 * 40 * 40 - 20 * 20 * 20, 1e-6);
  EXPECT_NEAR(skin.deviation.area, 2 * (60 * 40 + 60 * 40 + 40 * 40) + 6 * 400, 1e-6);
  EXPECT_NEAR(skin.deviation.distance, 0, 1e-9);
  ASSERT_EQ(skin.shells.shells.size(), 2U);
  EXPECT_EQ(skin.shells.shells[1].depth, 1);
  EXPECT_THAT(deviation_text(skin, 1e-3), HasSubstr("it encloses 88 cm3 ("));
}

// Edges of 16 mm lie 1.6 mm within the round, and the wall is 0.8 mm thick.
TEST(RemeshedSkin, OfAThinWallHasShorterEdgesWhereLongOnesWouldSpoilIt) {
  const ClosedShells thin = shells_of({{"", tube(120, 20, 19.2, 40)}});
  const RemeshedSkin skin = remeshed_skin(thin, {.sizes = {16}}, "part.stl");
  const SkinDeviation& d = skin.deviation;
  EXPECT_NEAR(d.volume, d.facets_volume, k_skin_tolerance * d.facets_volume);
  EXPECT_LT(d.distance, 0.8);
}

TEST(RemeshedSkin, WhatCrossesItselfIsNamedWithItsPlaceAndWrapped) {
  const ClosedShells crossing = shells_of({{"", box_that_crosses_itself()}});
  try {
    remeshed_skin(crossing, {.sizes = {4}}, "part.stl");
    FAIL() << "the new skin crosses itself as the facets do";
  } catch (const solidus::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("part.stl: the new skin crosses itself near ("));
  }
  const RemeshedSkin skin = remeshed_skin(crossing, {.sizes = {4}, .wraps = true}, "part.stl");
  EXPECT_NEAR(skin.deviation.volume, skin.deviation.facets_volume,
              k_skin_tolerance * skin.deviation.facets_volume);
  EXPECT_LT(skin.deviation.distance, 8);  // where the hollow is narrower than an element it is filled
}

TEST(UnitedShells, OfOneNameBecomeOneWithANoteOfWhatTheyHadInCommon) {
  Triangles part = box({0, 0, 0}, {60, 40, 20});
  const Triangles boss = box({20, 10, 10}, {40, 30, 50});
  part.insert(part.end(), boss.begin(), boss.end());
  std::vector<std::string> notes;
  const ClosedShells united = united_shells(shells_of({{"part", part}}), "part.stl", notes);
  ASSERT_EQ(united.shells.size(), 1U);
  EXPECT_EQ(united.shells[0].depth, 0);
  EXPECT_NEAR(enclosed_volume(united, united.shells[0]), 60 * 40 * 20 + 20 * 20 * 30, 1e-6);
  EXPECT_THAT(notes, ElementsAre(HasSubstr("2 closed skins that cross or touch each other")));
  EXPECT_THAT(notes.front(), HasSubstr("4e+03 of 6.4e+04 cubic units of the file in common"));
}

TEST(UnitedShells, AChainOfNineBecomesOneWhateverTheirOrder) {
  Triangles part;
  for (const int i : {0, 2, 4, 6, 8, 1, 3, 5, 7}) {
    const Triangles link = box({10.0 * i, 0.1 * i, 0}, {10.0 * i + 13, 20 + 0.1 * i, 20 + 0.1 * i});
    part.insert(part.end(), link.begin(), link.end());
  }
  std::vector<std::string> notes;
  const ClosedShells united = united_shells(shells_of({{"", part}}), "part.stl", notes);
  EXPECT_EQ(united.shells.size(), 1U);
  EXPECT_THAT(notes, ElementsAre(HasSubstr("9 closed skins")));
}

TEST(UnitedShells, StayAsTheyAreWhereNoneCrosses) {
  Triangles part = box({0, 0, 0}, {60, 40, 40});
  const Triangles cavity = box({10, 10, 10}, {30, 30, 30});
  part.insert(part.end(), cavity.begin(), cavity.end());
  std::vector<std::string> notes;
  EXPECT_EQ(united_shells(shells_of({{"part", part}}), "part.stl", notes).shells.size(), 2U);
  EXPECT_THAT(notes, IsEmpty());
}

TEST(UnitedShells, OfTwoNamesAreRefusedWithThePlace) {
  std::vector<std::string> notes;
  try {
    united_shells(
        shells_of({{"wheel", box({0, 0, 0}, {60, 40, 20})}, {"chill", box({50, 10, 5}, {80, 30, 15})}}),
        "part.stl", notes);
    FAIL() << "which one should keep what they have in common?";
  } catch (const UnusableGeometry& error) {
    EXPECT_THAT(error.what(), HasSubstr("the bodies 'wheel' and 'chill' cross each other near (60, "));
  }
}

TEST(FacetsOfACasting, AreRemeshedWhereNoTimeIsLeftForGmsh) {
  const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "needles.stl";
  {
    std::ofstream text(file);
    text << "solid needles\n";
    for (const auto& t : cylinder_of_needles(90, 20, 60)) {
      text << "facet normal 0 0 0\nouter loop\n";
      for (const Point& p : t) text << "vertex " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
      text << "endloop\nendfacet\n";
    }
    text << "endsolid needles\n";
  }
  CastingGeometry geometry;
  geometry.sizes = {{"needles", 8e-3, 5e-3}, {"mould", 20e-3, 20e-3, 0}};
  geometry.mould = MouldBlock{"mould", "core", {0.03, 0.03, 0.03, 0.03, 0.03, 0.03}};
  KeptMesh kept;
  kept.search().time_of_direct_ways = 0;
  const RawMesh mesh = mesh_casting({file.string(), 1e-3}, geometry);
  EXPECT_EQ(kept.search().way->number, 5);
  EXPECT_GE(kept.search().way->quality, k_sound_quality);
  EXPECT_THAT(mesh.notes, ElementsAre(HasSubstr("stands for the facets: it encloses 7")));
  EXPECT_EQ(kept.notes(), mesh.notes);
}

}  // namespace
