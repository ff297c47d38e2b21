/// Closed formulas of the smallest rotation between two unit vectors and its derivatives; they fail only
/// for opposite vectors.
#include "contact/surfaces/rotation.hpp"

namespace solidus::contact {

RotationRates rotation_rates(const Point& a, const Point& b, const Point& s) {
  // The least rotation of a onto b: R s = s - (a + b) (a + b)·s/(1 + a·b) + 2 b (a·s), and its derivatives.
  const Point sum = add(a, b);
  const double c = 1 / (1 + dot(a, b)), along = dot(sum, s);
  RotationRates r;
  // By s itself, which is R.
  add_identity(r.by_vector, 1, 3);
  add_outer(r.by_vector, -c, sum, sum);
  add_outer(r.by_vector, 2, b, a);

  // By a, from which the rotation starts.
  add_identity(r.by_from, -c * along, 3);
  add_outer(r.by_from, -c, sum, s);
  add_outer(r.by_from, c * c * along, sum, b);
  add_outer(r.by_from, 2, b, s);

  // By b, to which it leads.
  add_identity(r.by_to, -c * along + 2 * dot(a, s), 3);
  add_outer(r.by_to, -c, sum, s);
  add_outer(r.by_to, c * c * along, sum, a);
  return r;
}

}  // namespace solidus::contact
