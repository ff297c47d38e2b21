/* A law with the generic interface of MFront, written by hand in C: J2 plasticity with linear isotropic hardening
 * whose moduli and flow stress fall with temperature. What MFront would generate has the same symbols.
 *
 *   sigma = K tr(e) 1 + 2 G dev(e - e_p),  sqrt(3/2) |s| <= s_0(T) + H p,
 *   E(T) = E_0 (1 - a (T - 293.15)), s_0(T) = s_00 (1 - b (T - 293.15)),  nu, H constant
 *
 * Build:  cc -O2 -shared -fPIC -o libj2_generic.so j2_generic.c -lm
 *
 * Tensors are 11, 22, 33, sqrt(2) 12, sqrt(2) 13, sqrt(2) 23. The layout of the structures and the names of the
 * symbols are those of version 1 of the interface (TFEL 4, MGIS 2).
 */
#include <math.h>
#include <string.h>

typedef struct {
  const double *gradients, *thermodynamic_forces, *mass_density, *material_properties, *internal_state_variables,
      *stored_energy, *dissipated_energy, *external_state_variables;
} InitialState;
typedef struct {
  const double* gradients;
  double* thermodynamic_forces;
  const double *mass_density, *material_properties;
  double *internal_state_variables, *stored_energy, *dissipated_energy;
  const double* external_state_variables;
} State;
typedef struct {
  char* error_message;
  double dt;
  double* K;
  double *rdt, *speed_of_sound;
  InitialState s0;
  State s1;
} BehaviourData;

enum { young, poisson, flow_stress, hardening, young_slope, flow_slope };

int J2Generic_Tridimensional(BehaviourData* d) {
  const double* p = d->s1.material_properties;
  const double warmer = d->s1.external_state_variables[0] - 293.15;
  const double E = p[young] * (1 - p[young_slope] * warmer), nu = p[poisson];
  const double G = E / (2 * (1 + nu)), K = E / (3 * (1 - 2 * nu)), H = p[hardening];
  const double yield = p[flow_stress] * (1 - p[flow_slope] * warmer);
  /* State: ElasticStrain (6), EquivalentPlasticStrain. */
  const double *old = d->s0.internal_state_variables, *e0 = d->s0.gradients, *e1 = d->s1.gradients;
  double* now = d->s1.internal_state_variables;
  if (!(E > 0)) {
    if (d->error_message != 0) strcpy(d->error_message, "Young's modulus is not positive at this temperature");
    return -1;
  }

  double elastic[6], s[6], trace = 0, norm = 0;
  for (int i = 0; i < 6; ++i) elastic[i] = old[i] + e1[i] - e0[i];
  for (int i = 0; i < 3; ++i) trace += elastic[i];
  for (int i = 0; i < 6; ++i) {
    s[i] = 2 * G * (elastic[i] - (i < 3 ? trace / 3 : 0));
    norm += s[i] * s[i];
  }
  norm = sqrt(norm);
  const double trial = sqrt(1.5) * norm, radius = yield + H * old[6];
  double dp = 0, theta = 1, theta_bar = 0;
  if (trial > radius) {
    dp = (trial - radius) / (3 * G + H);
    theta = 1 - 3 * G * dp / trial;
    theta_bar = 1 / (1 + H / (3 * G)) - (1 - theta);
  }
  double n[6];
  for (int i = 0; i < 6; ++i) {
    n[i] = norm > 0 ? s[i] / norm : 0;
    now[i] = elastic[i] - sqrt(1.5) * dp * n[i];
    d->s1.thermodynamic_forces[i] = theta * s[i] + (i < 3 ? K * trace : 0);
  }
  now[6] = old[6] + dp;

  /* K[0] says on input what is asked for: here a tangent whenever it is not zero. */
  if (d->K[0] > 0.5)
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j)
        d->K[6 * i + j] = (i < 3 && j < 3 ? K - 2 * G * theta / 3 : 0) + (i == j ? 2 * G * theta : 0) -
                          (dp > 0 ? 2 * G * theta_bar * n[i] * n[j] : 0);

  double elastic_energy = 0.5 * K * trace * trace, deviator = 0;
  for (int i = 0; i < 6; ++i) deviator += theta * theta * s[i] * s[i];
  elastic_energy += deviator / (4 * G);
  *d->s1.stored_energy = elastic_energy + 0.5 * H * now[6] * now[6];
  *d->s1.dissipated_energy = *d->s0.dissipated_energy + yield * dp;
  return 1;
}

/* What describes the law. */
#define SYMBOL(name) J2Generic_##name
const char* SYMBOL(mfront_ept) = "J2Generic";
const char* SYMBOL(mfront_interface) = "Generic";
const char* SYMBOL(tfel_version) = "4.0";
const char* SYMBOL(src) = "j2_generic.c";
unsigned short SYMBOL(api_version) = 1;
unsigned short SYMBOL(mfront_mkt) = 1;         /* a behaviour */
unsigned short SYMBOL(BehaviourType) = 1;      /* based on strain */
unsigned short SYMBOL(BehaviourKinematic) = 1; /* infinitesimal */
unsigned short SYMBOL(SymmetryType) = 0, SYMBOL(ElasticSymmetryType) = 0; /* isotropic */
unsigned short SYMBOL(UsableInPurelyImplicitResolution) = 1;
unsigned short SYMBOL(nGradients) = 1, SYMBOL(nThermodynamicForces) = 1;
const char* SYMBOL(Gradients)[] = {"Strain"};
int SYMBOL(GradientsTypes)[] = {1};
const char* SYMBOL(ThermodynamicForces)[] = {"Stress"};
int SYMBOL(ThermodynamicForcesTypes)[] = {1};
unsigned short SYMBOL(nMaterialProperties) = 6;
const char* SYMBOL(MaterialProperties)[] = {"YoungModulus",   "PoissonRatio",     "FlowStress",
                                            "HardeningSlope", "YoungModulusFall", "FlowStressFall"};
unsigned short SYMBOL(nInternalStateVariables) = 2;
const char* SYMBOL(InternalStateVariables)[] = {"ElasticStrain", "EquivalentPlasticStrain"};
int SYMBOL(InternalStateVariablesTypes)[] = {1, 0};
unsigned short SYMBOL(nExternalStateVariables) = 0;
const char* SYMBOL(ExternalStateVariables)[] = {0};
int SYMBOL(ExternalStateVariablesTypes)[] = {0};
unsigned short SYMBOL(TemperatureRemovedFromExternalStateVariables) = 1;
unsigned short SYMBOL(requiresStiffnessTensor) = 0, SYMBOL(requiresThermalExpansionCoefficientTensor) = 0;
unsigned short SYMBOL(ComputesInternalEnergy) = 1, SYMBOL(ComputesDissipatedEnergy) = 1;
