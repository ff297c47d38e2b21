#include "numbers/pieces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace solidus {
namespace {

/// The last piece that starts at or before x, by a search from the left.
std::size_t searched(const std::vector<Pieces::Piece>& pieces, double x) {
  std::size_t i = 0;
  while (i + 1 < pieces.size() && pieces[i + 1].x <= x) ++i;
  return i;
}

/// Starts at random distances between `shortest` and 1.
std::vector<Pieces::Piece> random_pieces(int n, double shortest, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<Pieces::Piece> pieces{{300, uniform(random), uniform(random)}};
  while (static_cast<int>(pieces.size()) < n)
    pieces.push_back(
        {pieces.back().x + std::pow(shortest, uniform(random)), uniform(random), uniform(random)});
  return pieces;
}

TEST(Pieces, LanesAndNumbersFindThePieceThatASearchFindsForAnyNumberAndSpacing) {
  std::mt19937 random(5);
  for (const int n : {1, 2, 3, 4, 15, 16, 17, 100, 3000})
    for (const double shortest : {1.0, 0.3, 1e-3, 1e-7}) {
      const auto expected = random_pieces(n, shortest, random);
      const Pieces pieces(expected);
      std::uniform_real_distribution<double> uniform(expected.front().x - 1, expected.back().x + 1);
      for (int k = 0; k < 500; ++k) {
        Lane x;
        for (int i = 0; i < k_lanes; ++i) x.set(i, uniform(random));
        const double start =
            expected[static_cast<std::size_t>(k) % expected.size()].x;  // exactly, and next to it
        x.set(1, start);
        x.set(2, std::nextafter(start, 0.0));
        x.set(6, std::nextafter(start, 1e9));
        const auto line = pieces.line(x);
        for (int i = 0; i < k_lanes; ++i) {
          const Pieces::Piece& piece = expected[searched(expected, x[i])];
          ASSERT_EQ(pieces.line(x[i]).slope, piece.slope) << n << " pieces at " << x[i];
          ASSERT_EQ(line.slope[i], piece.slope) << n << " pieces at " << x[i];
          ASSERT_NEAR(line.value[i], piece.y + piece.slope * (x[i] - piece.x),
                      1e-15);  // rounding of numbers < 2
        }
      }
    }
}

TEST(Pieces, AnArgumentThatIsNotANumberGivesAValueThatIsNone) {
  std::mt19937 random(6);
  for (const int n : {1, 3, 100}) {
    const Pieces pieces(random_pieces(n, 0.1, random));
    Lane x(300.5);
    x.set(4, std::numeric_limits<double>::quiet_NaN());
    const auto line = pieces.line(x);
    for (int i = 0; i < k_lanes; ++i) EXPECT_EQ(std::isnan(line.value[i]), i == 4);
    EXPECT_TRUE(std::isnan(pieces.line(x[4]).value));
  }
}

}  // namespace
}  // namespace solidus
