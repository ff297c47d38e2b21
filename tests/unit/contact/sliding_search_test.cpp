#include "contact/surfaces/sliding_search.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "parallel/parallel.hpp"
#include "sliding_bodies.hpp"

namespace solidus::contact {
namespace {

using test::Sliding;

// A random landscape of n × n warped quads, turned by `phase`.
std::vector<Face> landscape(int n, unsigned seed, double phase) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> height(-0.3, 0.3);
  const auto m = static_cast<std::size_t>(n + 1);
  std::vector<Point> x(m * m);
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = 0; j < m; ++j) {
      const double h = height(random) / n;
      const double a = static_cast<double>(i) / n, b = static_cast<double>(j) / n;
      x[i * m + j] = {a * std::cos(phase) - h * std::sin(phase), b,
                      a * std::sin(phase) + h * std::cos(phase)};
    }
  std::vector<Face> faces;
  for (std::size_t i = 0; i + 1 < m; ++i)
    for (std::size_t j = 0; j + 1 < m; ++j) {
      Face f;
      f.shape = mesh::Shape::quad4;
      f.n_nodes = 4;
      f.x = {x[i * m + j], x[(i + 1) * m + j], x[(i + 1) * m + j + 1], x[i * m + j + 1]};
      faces.push_back(f);
    }
  return faces;
}

// The same rule without a tree: nearest within reach, of equals the lowest.
SurfacePoint brute_force(std::span<const Face> faces, const Point& p, double reach, const Point& facing) {
  SurfacePoint best;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Projection projection = closest_point(faces[f], p);
    if (projection.distance > reach || dot(faces[f].normal(projection.xi), facing) >= k_facing_cosine)
      continue;
    if (best.face < 0 || projection.distance < best.projection.distance * (1 - 1e-9))
      best = {static_cast<Index>(f), projection};
  }
  return best;
}

TEST(SlidingSearch, FindsThePartnersOfBruteForceWhereverTheSurfaceHasMovedAndWhateverTheHint) {
  const int n = 12;
  const std::vector<Face> start = landscape(n, 5, 0);
  SlidingSearch moving(start, 0.05);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-0.1, 1.1), small(-0.15, 0.15);
  for (double phase : {0.0, 0.01, 0.02, 0.04, 0.6}) {
    const std::vector<Face> faces = landscape(n, 5, phase);
    moving.move(faces);
    for (int i = 0; i < 40; ++i) {
      const double a = place(random), h = small(random);
      const Point p{a * std::cos(phase), place(random), a * std::sin(phase) + h};
      const Point facing{0, 0, -1};
      const SurfacePoint expected = brute_force(faces, p, 0.12, facing);
      for (Index hint : {-1, 0, 70, 143}) {
        const SurfacePoint found = moving.closest(p, 0.12, facing, hint);
        ASSERT_EQ(found.face, expected.face);
        if (found.face < 0) continue;
        EXPECT_EQ(found.projection.distance, expected.projection.distance);
        EXPECT_EQ(found.projection.xi, expected.projection.xi);
      }
    }
  }
}

// Points that are left out must not matter: their closest face is never one of those that are watched.
TEST(SlidingSearch, NeverLeavesOutAPointThatMeetsAWatchedFace) {
  std::vector<Face> faces = landscape(12, 5, 0.4);
  SlidingSearch search(faces, 0.02);
  std::vector<char> watched(faces.size(), 0);
  for (std::size_t f = 0; f < 30; ++f) watched[f] = 1;
  search.watch(watched, faces);
  std::mt19937 random(6);
  std::uniform_real_distribution<double> place(-0.1, 1.1), small(-0.15, 0.15);
  int n_left_out = 0, n_met = 0;
  for (int move = 0; move < 5; ++move) {
    for (Face& f : faces)
      for (Point& x : f.x) x[1] += 0.013;
    search.move(faces);
    for (int i = 0; i < 400; ++i) {
      const double a = place(random), h = small(random);
      const Point p{a * std::cos(0.4), place(random), a * std::sin(0.4) + h};
      const Point facing{std::sin(0.4), 0, -std::cos(0.4)};
      const SurfacePoint closest = search.closest(p, 0.12, facing, -1);
      for (Index hint : {Index{-1}, closest.face, Index{70}}) {
        const bool asked = search.may_meet_watched(p, 0.12, facing, hint);
        n_left_out += asked ? 0 : 1;
        if (closest.face < 0 || watched[static_cast<std::size_t>(closest.face)] == 0) continue;
        ++n_met;
        EXPECT_TRUE(asked);
      }
    }
  }
  EXPECT_GT(n_met, 100);
  EXPECT_GT(n_left_out, 2000);  // of 6000: it is worth something
}

TEST(SlidingSearch, TakesTheLowestNumberOfEquallyNearFaces) {
  std::vector<Face> faces = landscape(2, 1, 0);
  for (Face& f : faces)
    for (Point& x : f.x) x[2] = 0;
  SlidingSearch search(faces, 0.1);
  search.move(faces);
  for (Index hint : {-1, 0, 1, 2, 3})
    EXPECT_EQ(search.closest({0.5, 0.5, 0.01}, 1, {0, 0, -1}, hint).face, 0);
}

TEST(SlidingSearch, BuildsItsTreeOnlyWhenANodeHasMovedFartherThanTheMargin) {
  std::vector<Face> faces = landscape(4, 2, 0);
  SlidingSearch search(faces, 0.1);
  EXPECT_EQ(search.n_builds(), 1);
  // Ten moves of 0.03: the fourth, eighth, … are beyond 0.1 since the last build.
  for (int i = 0; i < 10; ++i) {
    for (Face& f : faces)
      for (Point& x : f.x) x[0] += 0.03;
    search.move(faces);
  }
  EXPECT_EQ(search.n_builds(), 3);
}

TEST(SlidingKinematics, FindsTheSameBitsWhateverWasPlacedBefore) {
  const mesh::Mesh mesh = test::wavy_blocks(mesh::Shape::hex8);
  const auto u = test::overlapping(mesh), far = test::overlapping(mesh, 0.01, 0.09);
  for (bool smoothing : {false, true}) {
    const Sliding fresh(mesh, smoothing), travelled(mesh, smoothing);
    fresh->place(u);
    travelled->place(far);
    travelled->place(u);
    for (Index p = 0; p < fresh->n_points(); ++p) {
      EXPECT_EQ(fresh->points().table().partner[static_cast<std::size_t>(p)].face,
                travelled->points().table().partner[static_cast<std::size_t>(p)].face);
      EXPECT_EQ(fresh->points().table().partner[static_cast<std::size_t>(p)].xi,
                travelled->points().table().partner[static_cast<std::size_t>(p)].xi);
      EXPECT_EQ(fresh->points().table().partner[static_cast<std::size_t>(p)].penetration,
                travelled->points().table().partner[static_cast<std::size_t>(p)].penetration);
      EXPECT_EQ(fresh->points().table().partner[static_cast<std::size_t>(p)].normal,
                travelled->points().table().partner[static_cast<std::size_t>(p)].normal);
    }
  }
}

// On several processes each looks for the points that concern it alone: they must find the same, and the
// others must not reach its nodes.
TEST(SlidingKinematics, PlacesOwnPointsAsItPlacesAll) {
  const mesh::Mesh mesh = test::wavy_blocks(mesh::Shape::hex8);
  for (bool smoothing : {false, true}) {
    const Sliding all(mesh, smoothing), own(mesh, smoothing);
    for (const double way : {0.0, 0.03, 0.06, 0.09, 0.02}) {
      const auto u = test::overlapping(mesh, 0.01, way);
      all->place(u);
      own->place(u, ContactKinematics::Points::own);
      for (Index p = 0; p < all->n_points(); ++p) {
        ASSERT_EQ(all->concerns(p), own->concerns(p));
        if (all->concerns(p)) {
          EXPECT_EQ(all->points().table().partner[static_cast<std::size_t>(p)].face,
                    own->points().table().partner[static_cast<std::size_t>(p)].face);
          EXPECT_EQ(all->points().table().partner[static_cast<std::size_t>(p)].xi,
                    own->points().table().partner[static_cast<std::size_t>(p)].xi);
          EXPECT_EQ(all->points().table().partner[static_cast<std::size_t>(p)].penetration,
                    own->points().table().partner[static_cast<std::size_t>(p)].penetration);
          continue;
        }
        const PointMotion motion = all->motion(p, {}, ContactKinematics::Asked::motion);
        for (const Index node : motion.nodes) EXPECT_GE(node, mesh.n_owned_nodes);
      }
      EXPECT_EQ(all->graph_outdated(), own->graph_outdated());
    }
  }
}

struct Cliques : ContactKinematics::CliqueSink {
  std::set<std::pair<Index, Index>> pairs;
  void add(std::span<const Index> nodes) override {
    for (Index a : nodes)
      for (Index b : nodes) pairs.emplace(a, b);
  }
};

TEST(SlidingKinematics, AsksForANewGraphOnlyWhenNodesMeetThatAreNotInIt) {
  const mesh::TwoBlocks blocks{{1.0, 0.1}, {0.2, 0.1}, {20, 1}, {4, 1}, 0};
  const mesh::Mesh mesh = test::distribute_blocks(test::raw_blocks(blocks, mesh::Shape::quad4));
  for (bool smoothing : {false, true}) {
    const Sliding sliding(mesh, smoothing);
    // Each process asks for its own rows: matrices are made again when one does (linear::graph_outdated).
    const auto outdated = [&] { return parallel::any_process(sliding->graph_outdated()); };
    EXPECT_TRUE(outdated());
    Cliques cliques;
    sliding->add_to_graph(cliques);
    int renewals = 0;
    for (int i = 0; i <= 70; ++i) {
      sliding->place(test::nodal_field(mesh, 2, [&](const Point&, bool upper) {
        return std::vector{upper ? 0.01 * i : 0.0, upper ? -1e-3 : 0.0};
      }));
      if (outdated()) {
        ++renewals;
        cliques.pairs.clear();
        sliding->add_to_graph(cliques);
        EXPECT_FALSE(outdated());
      }
      for (Index p = 0; p < sliding->n_points(); ++p) {
        const PointMotion m = sliding->motion(p, {}, ContactKinematics::Asked::motion);
        for (Index a : m.nodes) {
          if (a >= mesh.n_owned_nodes) continue;
          for (Index b : m.nodes) ASSERT_TRUE(cliques.pairs.contains({a, b}));
        }
      }
    }
    // 14 faces are crossed; two rings last for two or three.
    EXPECT_GE(renewals, 3);
    EXPECT_LE(renewals, 7);
  }
}

}  // namespace
}  // namespace solidus::contact
