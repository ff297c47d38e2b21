#include "heat/radiation/enclosed_surfaces.hpp"

#include <algorithm>
#include <cmath>

#include "heat/radiation/enclosure.hpp"
#include "system/errors.hpp"
#include "system/log.hpp"

namespace solidus::heat {

namespace {

constexpr std::size_t k_mixed_iterations = 5;
constexpr double k_independent = 1e-12;  ///< pivots, of the largest

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

std::vector<double> difference(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> d(a);
  for (std::size_t i = 0; i < d.size(); ++i) d[i] -= b[i];
  return d;
}

/// The least squares γ of f − Σ_j γ_j columns_j by Cholesky of the normal equations; columns that depend on
/// those before them get zero.
std::vector<double> least_squares(const std::vector<std::vector<double>>& columns,
                                  const std::vector<double>& f) {
  // Factor L of the matrix of scalar products, row by row.
  const std::size_t n = columns.size();
  std::vector<std::vector<double>> l(n, std::vector<double>(n, 0.0));
  std::vector<double> y(n, 0.0), gamma(n, 0.0);
  double largest = 0;
  for (std::size_t i = 0; i < n; ++i) largest = std::max(largest, dot(columns[i], columns[i]));
  for (std::size_t i = 0; i < n; ++i) {
    y[i] = dot(columns[i], f);
    for (std::size_t k = 0; k <= i; ++k) {
      double sum = dot(columns[i], columns[k]);
      for (std::size_t m = 0; m < k; ++m) sum -= l[i][m] * l[k][m];
      if (k < i)
        l[i][k] = l[k][k] > 0 ? sum / l[k][k] : 0;
      else
        l[i][i] = sum > k_independent * largest ? std::sqrt(sum) : 0;
    }
    for (std::size_t m = 0; m < i; ++m) y[i] -= l[i][m] * y[m];
    y[i] = l[i][i] > 0 ? y[i] / l[i][i] : 0;
  }
  // Back substitution.
  for (std::size_t i = n; i-- > 0;) {
    double sum = y[i];
    for (std::size_t k = i + 1; k < n; ++k) sum -= l[k][i] * gamma[k];
    gamma[i] = l[i][i] > 0 ? sum / l[i][i] : 0;
  }
  return gamma;
}

}  // namespace

EnclosedSurfaces::EnclosedSurfaces() = default;
EnclosedSurfaces::~EnclosedSurfaces() = default;
EnclosedSurfaces::EnclosedSurfaces(EnclosedSurfaces&&) noexcept = default;
EnclosedSurfaces& EnclosedSurfaces::operator=(EnclosedSurfaces&&) noexcept = default;

/// Surfaces of radiations stand behind those of fluxes and films, in their order.
void EnclosedSurfaces::set(const mesh::Mesh& mesh, AnalysisKind kind, const linear::ActiveSet& active,
                           bool closed, const ThermalConditions& conditions) {
  numbers_.clear();
  std::vector<std::string> names;
  const std::size_t first = conditions.fluxes.size() + conditions.films.size();
  for (std::size_t i = 0; i < conditions.radiations.size(); ++i) {
    if (!conditions.radiations[i].enclosed) continue;
    numbers_.push_back(first + i);
    names.push_back(conditions.radiations[i].surface);
  }
  falling_.clear();
  iterations_.clear();
  // What sees each other is known already where the same faces do.
  const bool known = names == names_ && seen_ && *seen_ == active;
  names_ = names;
  if (known) return;
  enclosure_.reset();
  seen_ = std::make_unique<linear::ActiveSet>(active);
  if (names.empty()) return;
  if (!closed)
    throw InputError({}, "surfaces that see each other need heat.integration = \"closed\"",
                     "the closed rule, which is the default");
  std::vector<mesh::Surface> surfaces;
  for (const std::string& name : names)
    surfaces.push_back(active.part(mesh, named_group(mesh.surfaces, name, "surface")));
  enclosure_ = std::make_unique<Enclosure>(mesh, kind, surfaces);
  const ViewFactors& f = enclosure_->view_factors();
  logging::info(
      "radiation between surfaces: {} faces in {} clusters, {} view factors in {:.2g} s and {:.3g} MB; rays "
      "were off by {:.2g} at most, closed to 1e-12 since",
      enclosure_->n_faces(), f.size(), f.entries.size(), enclosure_->seconds(),
      1e-6 * static_cast<double>(enclosure_->bytes()), f.corrected);
}

/// The irradiation that follows from temperatures: the emissivities of the surfaces and the surroundings are
/// those of their conditions.
std::vector<double> EnclosedSurfaces::following(SurfaceHeats& surfaces, std::span<const double> temperature) {
  std::vector<EnclosureSurface> laws;
  for (const std::size_t s : numbers_) {
    const EnclosedSide& side = *surfaces.each()[s].law().enclosed();
    laws.push_back({[&side](double t) { return side.emissivity(t); }, side.environment});
  }
  return enclosure_->irradiation(temperature, laws);
}

/// Gives the irradiation of the clusters to the nodes of each surface.
void EnclosedSurfaces::tell(SurfaceHeats& surfaces) {
  const std::vector<std::vector<double>> at_nodes = enclosure_->at_nodes(falling_);
  for (std::size_t k = 0; k < numbers_.size(); ++k) surfaces.each()[numbers_[k]].irradiate(at_nodes[k]);
}

void EnclosedSurfaces::begin(SurfaceHeats& surfaces, std::span<const double> temperature) {
  iterations_.clear();
  falling_ = following(surfaces, temperature);
  tell(surfaces);
}

/// One fixed-point iteration: true where the irradiation has changed by less than the tolerance, else the
/// next guess is a mixture of earlier ones.
bool EnclosedSurfaces::follow(SurfaceHeats& surfaces, std::span<const double> temperature, double tolerance) {
  std::vector<double> next = following(surfaces, temperature);
  // Differences of fourth roots are temperatures of what a cluster seems to stand in.
  double largest = 0;
  for (std::size_t c = 0; c < next.size(); ++c)
    largest = std::max(largest, std::abs(std::sqrt(std::sqrt(next[c])) - std::sqrt(std::sqrt(falling_[c]))));
  const bool settled = largest < tolerance;
  if (settled) {
    falling_ = std::move(next);
  } else {
    std::vector<double> off = difference(next, falling_);
    iterations_.push_back({std::move(next), std::move(off)});
    if (iterations_.size() > k_mixed_iterations) iterations_.pop_front();
    falling_ = mixed();
  }
  tell(surfaces);
  return settled;
}

/// Anderson's method: the combination of the last iterations whose residuals nearly cancel.
std::vector<double> EnclosedSurfaces::mixed() const {
  const Iteration& last = iterations_.back();
  // The newest differences stand first: older ones that say the same are left out.
  std::vector<std::vector<double>> columns;
  for (std::size_t j = iterations_.size() - 1; j > 0; --j)
    columns.push_back(difference(iterations_[j].off, iterations_[j - 1].off));
  const std::vector<double> gamma = least_squares(columns, last.off);
  std::vector<double> x = last.followed;
  for (std::size_t k = 0; k < gamma.size(); ++k) {
    const std::size_t j = iterations_.size() - 1 - k;
    for (std::size_t c = 0; c < x.size(); ++c)
      x[c] -= gamma[k] * (iterations_[j].followed[c] - iterations_[j - 1].followed[c]);
  }
  // Radiation is not negative: where the mixture is, it went too far.
  return std::ranges::all_of(x, [](double v) { return v >= 0; }) ? x : last.followed;
}

double EnclosedSurfaces::to_environment() const {
  return enclosure_ ? enclosure_->to_environment() : 0;
}

std::size_t EnclosedSurfaces::bytes() const {
  return enclosure_ ? enclosure_->bytes() : 0;
}

}  // namespace solidus::heat
