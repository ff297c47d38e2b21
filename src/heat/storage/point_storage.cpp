/// A template on the number of nodes: gather temperatures, evaluate the enthalpy at each point of eight
/// elements at once, scatter.
#include "heat/storage/point_storage.hpp"

#include "heat/conduction/block_shapes.hpp"
#include "mesh/block_geometry.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::heat {

namespace {

/// The degree of the quadrature of heat: products of two shape functions are exact in straight elements.
int default_degree(mesh::Shape shape) {
  if (mesh::order(shape) == 1) return 3;
  return shape == mesh::Shape::tri6 || shape == mesh::Shape::tet10 ? 4 : 5;
}

template <int n_nodes>
class Storage final : public PointStorage {
 public:
  Storage(const mesh::Mesh& mesh, const mesh::ElementBlock& block, AnalysisKind kind,
          const material::Material& material, SensibleForm form, int degree)
      : geometry_(mesh, block, kind,
                  mesh::gauss_rule(block.shape, degree > 0 ? degree : default_degree(block.shape))),
        material_(material),
        curve_(material.enthalpy()),
        form_(form),
        old_(geometry_.weight.size()) {}

  void bind(const linear::BlockMatrix& matrix) override {
    slots_ = {matrix, geometry_.nodes, n_nodes, geometry_.n_elements};
  }

  void start(std::span<const double> old_temperature, double dt) override {
    dt_ = dt;
    // The enthalpy of each point at the start of the stage; printed forms need its temperature too.
    if (form_ != SensibleForm::enthalpy) old_temperature_.resize(old_.size());
    for_points(old_temperature, [&](Index, int, std::size_t at, Lane t) {
      old_[at] = enthalpy(t);
      if (form_ != SensibleForm::enthalpy) old_temperature_[at] = t;
    });
  }

  void extrapolate(std::span<const double> temperature, double factor) override {
    for_points(temperature, [&](Index, int, std::size_t at, Lane t) {
      old_[at] += Lane(factor) * (enthalpy(t) - old_[at]);
    });
  }

  void add_residual(std::span<const double> temperature, std::span<double> r) const override {
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Nodal t = gather<n_nodes>(geometry_, batch, temperature);
      Nodal sum{};
      // At each point the heat stored since the start of the stage, as a rate.
      for (int q = 0; q < geometry_.n_points; ++q) {
        const double* n = values(q);
        const std::size_t at = point(batch, q);
        const Lane theta = at_point(t, n);
        const Lane stored = enthalpy(theta) - old_[at] + printed(at, theta, &PrintedExcess::heat);
        const Lane rate = stored * geometry_.weight_at(batch, q) * Lane(1.0 / dt_);
        for (std::size_t a = 0; a < n_nodes; ++a) sum[a] += Lane(n[a]) * rate;
      }
      // Ghost rows are summed too: their owners compute the same element.
      scatter<n_nodes>(geometry_, batch, sum, r);
    }
  }

  void add_tangent(std::span<const double> temperature, linear::BlockMatrix& matrix) const override {
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Nodal t = gather<n_nodes>(geometry_, batch, temperature);
      ConductionMatrix<n_nodes> m{};
      // The slope of that rate is the capacity at the point.
      for (int q = 0; q < geometry_.n_points; ++q) {
        const double* n = values(q);
        const Lane theta = at_point(t, n);
        const Lane capacity = for_each_lane(theta, [this](double x) { return curve_.capacity(x); }) +
                              printed(point(batch, q), theta, &PrintedExcess::slope);
        const Lane c = capacity * geometry_.weight_at(batch, q) * Lane(1.0 / dt_);
        for (std::size_t a = 0; a < n_nodes; ++a)
          for (std::size_t b = 0; b < n_nodes; ++b) m[a][b] += Lane(n[a] * n[b]) * c;
      }
      scatter_matrix<n_nodes>(slots_.of(batch), m, matrix);
    }
  }

  double stored(std::span<const double> temperature) const override {
    Lane total(0.0);
    for_points(temperature, [&](Index batch, int q, std::size_t at, Lane t) {
      total += (enthalpy(t) - old_[at]) * geometry_.weight_at(batch, q) * geometry_.counted[as_size(batch)];
    });
    return sum(total);
  }

  double enthalpy(std::span<const double> temperature) const override {
    Lane total(0.0);
    for_points(temperature, [&](Index batch, int q, std::size_t, Lane t) {
      total += enthalpy(t) * geometry_.weight_at(batch, q) * geometry_.counted[as_size(batch)];
    });
    return sum(total);
  }

  double latent(std::span<const double> old_temperature, std::span<const double> temperature) const override {
    double total = 0;
    // What has transformed, by the change of the fraction at the points.
    for (const material::PhaseChange& change : material_.phase_changes) {
      Lane transformed(0.0);
      const auto add = [&](double sign) {
        return [&, sign](Index batch, int q, std::size_t, Lane t) {
          transformed += Lane(sign) * change.fraction.value(t) * geometry_.weight_at(batch, q) *
                         geometry_.counted[as_size(batch)];
        };
      };
      for_points(old_temperature, add(1.0));
      for_points(temperature, add(-1.0));
      // Latent heat per mass times density times the volume that transformed.
      total += material_.density * change.latent_heat * sum(transformed);
    }
    return total;
  }

  EntropyChange entropy_change(std::span<const double> from, std::span<const double> to) const override {
    Lane change(0.0), magnitude(0.0);
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Nodal t0 = gather<n_nodes>(geometry_, batch, from), t1 = gather<n_nodes>(geometry_, batch, to);
      for (int q = 0; q < geometry_.n_points; ++q) {
        const Lane weight = geometry_.weight_at(batch, q) * geometry_.counted[as_size(batch)];
        const Lane before = entropy(at_point(t0, values(q))), after = entropy(at_point(t1, values(q)));
        change += weight * (after - before);
        magnitude += weight * abs(before);
      }
    }
    return {sum(change), sum(magnitude)};
  }

  std::size_t bytes() const override {
    return geometry_.bytes() + slots_.bytes() + old_.capacity() * sizeof old_[0];
  }

 private:
  using Nodal = std::array<Lane, n_nodes>;

  const double* values(int q) const { return geometry_.values.data() + q * n_nodes; }
  std::size_t point(Index batch, int q) const { return as_size(batch * geometry_.n_points + q); }
  static Lane at_point(const Nodal& t, const double* n) {
    Lane s(0.0);
    for (std::size_t a = 0; a < n_nodes; ++a) s += Lane(n[a]) * t[a];
    return s;
  }
  Lane enthalpy(Lane t) const {
    return for_each_lane(t, [this](double x) { return curve_.upper(x); });
  }
  /// Returns the excess of the printed form over the difference of enthalpies.
  Lane printed(std::size_t at, Lane t, double PrintedExcess::*part) const {
    Lane excess(0.0);
    if (form_ == SensibleForm::enthalpy) return excess;
    for (int lane = 0; lane < k_lanes; ++lane)
      excess.set(lane, printed_excess(material_, form_, old_temperature_[at][lane], t[lane]).*part);
    return excess;
  }
  Lane entropy(Lane t) const {
    return for_each_lane(t, [this](double x) { return curve_.upper_entropy(x); });
  }
  template <class Visit>
  void for_points(std::span<const double> temperature, const Visit& visit) const {
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Nodal t = gather<n_nodes>(geometry_, batch, temperature);
      for (int q = 0; q < geometry_.n_points; ++q) visit(batch, q, point(batch, q), at_point(t, values(q)));
    }
  }

  mesh::BlockGeometry geometry_;
  const material::Material& material_;
  material::EnthalpyCurve curve_;
  SensibleForm form_;
  PackVector<Lane> old_;              ///< h(Θ_n), [batch][point] [J/m³]
  PackVector<Lane> old_temperature_;  ///< Θ_n, with a printed form only [K]
  linear::LaneSlots slots_;
  double dt_ = 1;
};

}  // namespace

std::unique_ptr<PointStorage> make_point_storage(const mesh::Mesh& mesh, const mesh::ElementBlock& block,
                                                 AnalysisKind kind, const material::Material& material,
                                                 SensibleForm form, int degree) {
  return for_shape(block.shape, [&]<int n, int dim>() -> std::unique_ptr<PointStorage> {
    static_assert(dim == 2 || dim == 3);
    return std::make_unique<Storage<n>>(mesh, block, kind, material, form, degree);
  });
}

}  // namespace solidus::heat
