/// Concepts by which the element kernels tell laws apart: by the form of their tangent, by what they hold and
/// by where their state lies.
#pragma once

namespace solidus::mechanics {

/// A law whose tangent is κ 1⊗1 + 2Ĝ I_dev; others offer a full `tangent` (Sym4), which is symmetric where
/// the law says so.
template <class Response>
concept IsotropicTangent = requires(const Response& r) {
  r.bulk;
  r.twice_shear;
};
/// A law whose tangent is the isotropic one + left ⊗ right, where flow_increment > 0.
template <class Response>
concept RankOneTangent = IsotropicTangent<Response> && requires(const Response& r) {
  r.left;
  r.right;
  r.flow_increment;
};
/// A law whose tangent has the adiabatic part thermal_factor thermal_left ⊗ thermal_right besides.
template <class Response>
concept AdiabaticTangent = RankOneTangent<Response> && requires(const Response& r) {
  r.thermal_factor;
  r.thermal_left;
  r.thermal_right;
};
/// A law that holds the entropy of the committed state.
template <class Properties>
concept HoldsEntropy = requires(Properties& p) {
  p.entropy;
};

/// A law whose state has as many numbers as its user says: its State refers to them in the history.
template <class Law>
concept KeepsStateInPlace = requires {
  typename Law::StateInPlace;
};

/// A law that needs no memory besides its arguments and results.
struct NoWorkspace {
  template <class Law>
  explicit NoWorkspace(const Law&) {}
};
template <class Law>
struct WorkspaceOfLaw {
  using type = NoWorkspace;
};
template <KeepsStateInPlace Law>
struct WorkspaceOfLaw<Law> {
  using type = typename Law::Workspace;
};
/// The memory that a law whose state lies in place writes its state into: one for all points of a loop.
template <class Law>
using Workspace = typename WorkspaceOfLaw<Law>::type;

}  // namespace solidus::mechanics
