/// Each check is one property: it runs the law along the history, in a rotated frame or with half the
/// steps, and compares.
#include "point/check_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "numbers/index_casts.hpp"
#include "numbers/types.hpp"

namespace solidus::point {

namespace {

using Tensor = Sym<double>;
using Matrix3 = std::array<std::array<double, 3>, 3>;

constexpr int k_samples = 40;  ///< steps whose tangent is checked
/// Perturbations of the strain: the best one counts, for rounding spoils short ones and a kink long ones.
constexpr double k_perturbations[] = {1e-6, 1e-7, 1e-8};
constexpr double k_tangent = 1e-4, k_symmetry = 1e-6, k_isotropy = 1e-6;  ///< allowed, relative
constexpr double k_energy = 0.05, k_moduli = 0.01, k_dissipation = 1e-6;

constexpr int k_place[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};

Tensor rotated(const Tensor& a, const Matrix3& q) {
  Tensor r;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i; j < 3; ++j) {
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t l = 0; l < 3; ++l) sum += q[i][k] * q[j][l] * a[k_place[k][l]];
      r[k_place[i][j]] = sum;
    }
  return r;
}

/// Two turns, about z and about x, by angles that no axis of symmetry has.
Matrix3 rotation() {
  const double c = std::cos(0.7), s = std::sin(0.7), d = std::cos(1.1), t = std::sin(1.1);
  return {{{c, -s, 0}, {d * s, d * c, -t}, {t * s, t * c, d}}};
}

double largest(const Sym4<double>& c) {
  double size = 0;
  for (const auto& row : c.c)
    for (const double entry : row) size = std::max(size, std::abs(entry));
  return size;
}

bool same(const Answer& a, const Answer& b) {
  const auto bits = [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  };
  for (int i = 0; i < 6; ++i) {
    if (!bits(a.response.stress[i], b.response.stress[i])) return false;
    for (std::size_t j = 0; j < 6; ++j)
      if (!bits(a.tangent[i][j], b.tangent[i][j])) return false;
  }
  return std::equal(a.outside.begin(), a.outside.end(), b.outside.begin(), b.outside.end(), bits);
}

/// A figure with the time at which it is largest.
struct Worst {
  double value = -1, time = 0;  ///< negative: none

  void take(double figure, double at) {
    if (!(figure <= value)) value = figure, time = at;
  }
  std::string text(const char* what) const {
    return fmt::format("{} {:.2e}, at {:.6g} s", what, value, time);
  }
};

class Checks {
 public:
  Checks(const material::Material& material, const Program& program)
      : material_(material),
        outside_(external_law(material)),
        program_(program),
        point_(material, program.options),
        turned_(material, program.options) {}

  std::vector<LawCheck> run() {
    // Along the history of the case every step is checked: at some the answers against differences, at all
    // the rotated law and the energies.
    for (const Segment& segment : program_.segments) {
      // The path of a segment starts where the last one ended.
      const Path path(segment, point_.state().strain, point_.state().stress, point_.state().temperature);
      point_.restart();
      double start = 0;
      const std::vector<double> steps = path.steps();
      // Samples are spread over all steps, since differences cost many answers each.
      const std::size_t every = std::max<std::size_t>(1, steps.size() * program_.segments.size() / k_samples);
      for (std::size_t i = 0; i < steps.size(); ++i) {
        const StepResult step = point_.attempt(path.at(start + steps[i]), steps[i]);
        if (!step.converged)
          return {{"history", false,
                   fmt::format("no equilibrium at {:.6g} s{}{}; more steps?", point_.state().time,
                               step.complaint.empty() ? "" : ": ", step.complaint)}};
        if (i % every == 0) check_answers(step, steps[i]);
        check_rotated(step, steps[i]);
        check_energies(step, steps[i]);
        point_.accept(step);
        // The state is accepted only after its checks, which ask for other answers from the same
        // start.
        start += steps[i];
        ++n_steps_;
      }
    }
    return results();
  }

 private:
  /// Tangent and repetition at the end of a step.
  void check_answers(const StepResult& step, double dt) {
    const auto at = [&](const Tensor& strain) { return point_.answer(step.state.temperature, strain, dt); };
    const Answer here = at(step.state.strain);
    const double time = step.state.time, size = largest(here.tangent);
    double best = std::numeric_limits<double>::max();
    // Differences with several perturbations: a small one suffers from rounding, a large one from curvature;
    // the best counts.
    for (const double h : k_perturbations) {
      double worst = 0;
      for (int j = 0; j < 6; ++j) {
        Tensor up = step.state.strain, down = up;
        up[j] += j < 3 ? h : 0.5 * h;  // engineering shears
        down[j] -= j < 3 ? h : 0.5 * h;
        const Answer above = at(up), below = at(down);
        finite_ = finite_ && above.response.status == material::Status::converged &&
                  below.response.status == material::Status::converged;
        for (int i = 0; i < 6; ++i) {
          const double slope = (above.response.stress[i] - below.response.stress[i]) / (2 * h);
          worst = std::max(worst, std::abs(slope - here.tangent[i][as_size(j)]) / size);
        }
      }
      best = std::min(best, worst);
    }
    tangent_.take(best, time);
    // How far the tangent is from a symmetric one.
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < i; ++j)
        skew_.take(std::abs(here.tangent[i][as_size(j)] - here.tangent[j][as_size(i)]) / size, time);
    if (!same(here, at(step.state.strain)) && repeats_) repeats_ = false, differs_at_ = time;
    ++n_tangents_;
  }

  /// The same history in a frame that is turned.
  void check_rotated(const StepResult& step, double dt) {
    StepResult turned;
    const Tensor strain = rotated(step.state.strain, rotation_);
    const Answer answer = turned_.answer(step.state.temperature, strain, dt);
    const Tensor expected = rotated(step.state.stress, rotation_);
    scale_ = std::max(scale_, norm(expected));
    if (scale_ > 0) isotropy_.take(norm(answer.response.stress - expected) / scale_, step.state.time);
    turned.state = {step.state.time,        step.state.temperature, strain,
                    answer.response.stress, answer.response.state,  answer.outside};
    turned_.accept(turned);
  }

  void check_energies(const StepResult& step, double dt) {
    const MaterialPointState& before = point_.state();
    const double work = 0.5 * dot(before.stress + step.state.stress, step.state.strain - before.strain);
    const double dissipated = dt * step.response.dissipation;
    moved_ += std::abs(work);
    dissipated_ += dissipated;
    if (dissipated < 0) negative_.take(-dissipated, step.state.time);
    if (outside_ == nullptr || step.state.temperature != before.temperature) return;
    using Law = material::ExternalLaw;
    const double *now = step.state.outside.data() + Law::k_energies,
                 *old = before.outside.data() + Law::k_energies;
    if (!outside_->library().tells_stored() || !outside_->library().tells_dissipated()) return;
    told_work_ += work;
    told_moved_ += std::abs(work);
    told_ += outside_->library().stored(now) - outside_->library().stored(old) + now[1] - old[1];
  }

  /// Moduli of the undeformed solid against those of the material file.
  void check_moduli(std::vector<LawCheck>& checks) const {
    Worst worst;
    for (const double temperature : temperatures_of_law(material_)) {
      // A fresh point at each temperature, without history.
      const MaterialPoint fresh(material_, {.temperature = temperature, .strain_reference = temperature});
      const Answer answer = fresh.answer(temperature, Tensor{}, 1.0);
      // The isotropic moduli that the file gives, for a solid without melt.
      const auto expected = material::properties_at(material_, temperature, temperature,
                                                    material::PhaseState<double>{1.0, 0.0});
      const Sym4<double> moduli = Sym4<double>::isotropic(expected.bulk, 2 * expected.shear);
      double difference = 0;
      for (int i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j)
          difference = std::max(difference, std::abs(answer.tangent[i][j] - moduli[i][j]));
      worst.take(difference / largest(moduli), temperature - k_zero_celsius);
    }
    checks.push_back(
        {"moduli", worst.value <= k_moduli,
         fmt::format("initial stiffness differs from young_modulus and poisson_ratio by {:.2e}, at "
                     "{:.5g} degC",
                     worst.value, worst.time)});
  }

  std::vector<LawCheck> results() const {
    // The checks of a law in the order of the report: that it answers at all, its tangent, symmetry,
    // repetition, isotropy, dissipation and energy. Each has its worst place and its limit.
    const bool symmetric = outside_ != nullptr ? outside_->symmetric() : point_.law().symmetric();
    std::vector<LawCheck> checks;
    // Finite answers first: the figures below mean nothing without them.
    checks.push_back({"finite", finite_,
                      finite_ ? fmt::format("{} steps and all strains around {} of them have an answer",
                                            n_steps_, n_tangents_)
                              : "some strain near the history has no answer"});
    checks.push_back(
        {"tangent", tangent_.value <= k_tangent, tangent_.text("differs from central differences by")});
    checks.push_back({"symmetry", !symmetric || skew_.value <= k_symmetry,
                      skew_.text(symmetric ? "differs from its transpose by"
                                           : "unsymmetric, as declared; differs from its transpose by")});
    checks.push_back({"repetition", repeats_,
                      repeats_ ? "the same bits for the same input, whatever was asked in between"
                               : fmt::format("the same input gave another answer at {:.6g} s: the law keeps "
                                             "something besides its state variables",
                                             differs_at_)});
    checks.push_back(
        {"isotropy", isotropy_.value <= k_isotropy, isotropy_.text("in a rotated frame stress differs by")});
    checks.push_back(
        {"dissipation", negative_.value <= k_dissipation * moved_,
         negative_.value > 0
             ? fmt::format("negative by {:.3g} J/m3 at {:.6g} s; {:.4g} J/m3 in all", negative_.value,
                           negative_.time, dissipated_)
             : fmt::format("never negative; {:.4g} J/m3 of {:.4g} J/m3 of work", dissipated_, moved_)});
    // The balance of energy can be checked only where the law tells what it stores and dissipates.
    if (told_moved_ > 0) {
      const double defect = std::abs(told_work_ - told_) / told_moved_;
      checks.push_back(
          {"energy", defect <= k_energy,
           fmt::format("work less stored and dissipated energy of the law: {:.2e} of the work", defect)});
    } else if (outside_ != nullptr) {
      checks.push_back(
          {"energy", true,
           outside_->library().tells_stored() && outside_->library().tells_dissipated()
               ? "not checked: no steps at constant temperature"
               : "the law tells no energies: heat is by taylor_quinney, or as dissipation says"});
    }
    check_moduli(checks);
    return checks;
  }

  const material::Material& material_;
  const material::ExternalLaw* outside_;
  const Program& program_;
  MaterialPoint point_, turned_;
  Matrix3 rotation_ = rotation();
  Worst tangent_, skew_, isotropy_, negative_;
  bool finite_ = true, repeats_ = true;
  double differs_at_ = 0, scale_ = 0, moved_ = 0, dissipated_ = 0, told_work_ = 0, told_moved_ = 0, told_ = 0;
  int n_tangents_ = 0, n_steps_ = 0;
};

}  // namespace

std::vector<LawCheck> check_law(const material::Material& material, const Program& program) {
  return Checks(material, program).run();
}

}  // namespace solidus::point
