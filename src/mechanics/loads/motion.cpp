/// Coefficients of the two methods of integration in one form: factors of displacement, velocity and
/// acceleration.
#include "mechanics/loads/motion.hpp"

#include <stdexcept>

namespace solidus::mechanics {

Motion Motion::newmark(double gamma, double beta) {
  constexpr double k_rounding = 1e-12;  // β is mostly given as the least one
  if (!(gamma >= 0.5 && gamma <= 1) || !(beta >= least_beta(gamma) * (1 - k_rounding)))
    throw std::invalid_argument("Newmark's method needs 1/2 <= gamma <= 1 and beta >= (gamma + 1/2)^2/4");
  Motion m;
  m.gamma = gamma;
  m.beta = beta;
  m.memory = 0.5 - beta;
  m.work_share = 0.5;
  return m;
}

Motion Motion::generalised_alpha(double spectral_radius) {
  if (!(spectral_radius >= 0 && spectral_radius <= 1))
    throw std::invalid_argument("the spectral radius lies between 0 and 1");
  // Chung and Hulbert (1993): second order, and the least damping of low frequencies for that of the highest
  // ones.
  Motion m;
  m.alpha_m = (2 * spectral_radius - 1) / (1 + spectral_radius);
  m.alpha_f = spectral_radius / (1 + spectral_radius);
  m.gamma = 0.5 - m.alpha_m + m.alpha_f;
  m.beta = 0.25 * (1 - m.alpha_m + m.alpha_f) * (1 - m.alpha_m + m.alpha_f);
  m.memory = 0.5 - m.beta;
  m.work_share = 0.5;
  return m;
}

}  // namespace solidus::mechanics
