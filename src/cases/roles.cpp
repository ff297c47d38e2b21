/// A role is told by the name of a body or by its data; decisions that depend on roles are made here.
#include "cases/roles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <utility>

#include "cases/case_materials.hpp"
#include "material/cards/library.hpp"
#include "system/errors.hpp"
#include "system/log.hpp"

namespace solidus::cases {

namespace {

constexpr std::array<std::pair<std::string_view, Role>, 28> k_words = {{
    {"riser", Role::riser},        {"feeder", Role::riser}, {"speiser", Role::riser},
    {"sleeve", Role::sleeve},      {"chill", Role::chill},  {"insulation", Role::insulation},
    {"insulat", Role::insulation}, {"core", Role::core},    {"kern", Role::core},
    {"mould", Role::mould},        {"mold", Role::mould},   {"sand", Role::mould},
    {"drag", Role::mould},         {"cope", Role::mould},   {"shell", Role::mould},
    {"kokille", Role::die},        {"die", Role::die},      {"tool_steel", Role::die},
    {"runner", Role::gating},      {"gate", Role::gating},  {"ingate", Role::gating},
    {"gating", Role::gating},      {"sprue", Role::gating}, {"pouring", Role::gating},
    {"einguss", Role::gating},     {"cast", Role::casting}, {"part", Role::casting},
    {"guss", Role::casting},
}};

/// Whether a text has a word: a short one has to be a word of its own ("die" is no part of "diesel"), one of
/// more than four letters may begin or end another.
bool has_word(const std::string& text, std::string_view word) {
  const auto letter = [&](std::size_t i) { return std::isalpha(static_cast<unsigned char>(text[i])) != 0; };
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    const bool begins = at == 0 || !letter(at - 1);
    const bool ends = at + word.size() == text.size() || !letter(at + word.size());
    if (word.size() > 4 ? begins || ends : begins && ends) return true;
  }
  return false;
}

}  // namespace

std::string_view name(Role role) {
  constexpr std::array<std::string_view, 9> names = {"casting", "riser", "mould",      "core",  "chill",
                                                     "sleeve",  "die",   "insulation", "gating"};
  return names[static_cast<std::size_t>(role)];
}

bool is_poured(Role role) {
  return role == Role::casting || role == Role::riser || role == Role::gating;
}

std::optional<Role> role_in_name(const std::string& name) {
  std::string low = name;
  std::transform(low.begin(), low.end(), low.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const auto& [word, role] : k_words)
    if (has_word(low, word)) return role;
  return {};
}

Role role_of(const BodySpec& body, const material::Material& material) {
  if (body.role) return *body.role;
  if (material.solidification() != nullptr) return Role::casting;
  const auto solid = [](std::optional<Role> role) { return role && !is_poured(*role); };
  if (const auto told = role_in_name(body.name); solid(told)) return *told;
  const std::string of_material = std::filesystem::path(body.material).stem().string();
  if (const auto told = role_in_name(of_material); solid(told)) return *told;
  return Role::mould;
}

void decide_physics(CaseSpec& spec) {
  // Bodies whose physics is left to the program conduct heat only, if their material has no elastic
  // properties and nothing is poured into them. Where no other body deforms, the case keeps what it says, and
  // errors name it.
  std::vector<std::size_t> conductors;
  bool deforms = false;
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    // Left open, a body takes part in all physics until its material says otherwise.
    BodySpec& body = spec.bodies[b];
    const bool open = body.physics == BodySpec::ActivePhysics::automatic;
    if (open) body.physics = BodySpec::ActivePhysics::all;
    bool conducts = body.physics == BodySpec::ActivePhysics::heat;
    if (open && spec.coupled()) {
      try {
        const material::Material material =
            material::find_material(body.material, material_folders(), body.where);
        const Role role = role_of(body, material);
        if (!material.mechanical() && !is_poured(role)) {
          conductors.push_back(b);
          conducts = true;
        }
      } catch (const InputError&) {  // NOLINT: load_materials() says it
      }
    }
    deforms = deforms || !conducts;
  }
  if (conductors.empty() || !deforms) return;
  // The log names each body that only conducts, with its material.
  std::string said;
  for (const std::size_t b : conductors) {
    spec.bodies[b].physics = BodySpec::ActivePhysics::heat;
    said += fmt::format("{}'{}' ({})", said.empty() ? "" : ", ", spec.bodies[b].name,
                        std::filesystem::path(spec.bodies[b].material).stem().string());
  }
  logging::info("without elastic properties, and so only conducting heat: {}", said);
}

bool only_conducts(const BodySpec& body) {
  return body.physics == BodySpec::ActivePhysics::heat;
}

}  // namespace solidus::cases
